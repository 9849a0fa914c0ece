# SPDX-License-Identifier: Apache-2.0
"""Lamps whose size nobody says, read at distances like their own size: office panels, softboxes and tubes
under `quick --fixture` or nothing at all, with a shadow card at the last distance and without. Light is a
sum over the lamp's surface and over the patches of an empty room's walls, floor and ceiling (their first
bounce place by place, the others even); the meter is off by 3 % in all readings and by 1 % in each,
distances by 4 mm. The same in the dark. Then lamps thrown through halls: no ordinary room's
walls reach so far. Written without a header of lightcal."""
import json
import pathlib
import subprocess
import sys

import numpy as np

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 40  # of few the frequencies are not judged
JUDGED = len(sys.argv) <= 2


def rect(width, height, distance):
    """Lux per candela on the axis of a Lambertian rectangle."""
    x = (np.arange(80) + 0.5) / 80 - 0.5
    u, v = np.meshgrid(x * width, x * height)
    return float(np.mean(distance**2 / (u**2 + v**2 + distance**2) ** 2))


def tube(length, _, distance):
    """The same broadside of a tube thin beside its length: sin of the angle to it, cos at the meter."""
    x = ((np.arange(400) + 0.5) / 400 - 0.5) * length
    return float(np.mean(distance**2 / (x**2 + distance**2) ** 2))


class Room:
    """A box lit by a lamp of a candela that stands off one wall and shines across."""

    def __init__(self, random, all_round):
        size = np.array([random.uniform(3, 8), random.uniform(3.2, 7), random.uniform(2.4, 3.2)])
        reflectance = random.uniform(0.25, 0.6)
        lamp = np.array([random.uniform(0.3, 0.7) * size[0], random.uniform(0.3, 0.8), random.uniform(0.8, 1.6)])
        self.lamp, self.aim = lamp, np.array([0.0, 1.0, 0.0])
        step = 16
        at = (np.arange(step) + 0.5) / step
        places, normals, areas = [], [], []
        for axis in range(3):
            i, j = (k for k in range(3) if k != axis)
            u, v = (grid.ravel() for grid in np.meshgrid(at * size[i], at * size[j]))
            for end, sign in ((0.0, 1.0), (size[axis], -1.0)):
                place, normal = np.zeros((u.size, 3)), np.zeros((u.size, 3))
                place[:, i], place[:, j], place[:, axis], normal[:, axis] = u, v, end, sign
                places.append(place)
                normals.append(normal)
                areas.append(np.full(u.size, size[i] * size[j] / step**2))
        self.places, self.normals, self.areas = (np.concatenate(part) for part in (places, normals, areas))
        ray = self.places - lamp
        far = np.linalg.norm(ray, axis=1)
        shone = 1.0 if all_round else np.maximum(0, ray @ self.aim) / far
        first = reflectance * shone * np.maximum(0, -np.sum(ray * self.normals, 1)) / far**3
        even = np.sum(first * self.areas) / np.sum(self.areas) * reflectance / (1 - reflectance)
        self.exitance = first + even

    def on_meter(self, distance):
        """Lux behind a card, of a meter that looks back at the lamp."""
        ray = self.places - (self.lamp + distance * self.aim)
        far = np.linalg.norm(ray, axis=1)
        seen = np.maximum(0, ray @ -self.aim) / far * np.maximum(0, -np.sum(ray * self.normals, 1)) / far
        return float(np.sum(self.exitance / np.pi * seen / far**2 * self.areas))


def quick(*words):
    done = subprocess.run([LIGHTCAL, "quick", *words, "--json"], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def ends(answer):
    found = answer["lights"][0]["intensity_cd"]
    return found.get("low95", found["value"] - found["u95"]), found.get("high95", found["value"] + found["u95"])


for name, law, size, distances, words in (
        ("panel 60 x 60", rect, (0.6, 0.6), (0.5, 1.0, 2.0), ("--fixture", "panel")),
        ("panel 120 x 30", rect, (1.2, 0.3), (0.5, 1.0, 2.0), ("--fixture", "panel")),
        ("panel 30 x 20", rect, (0.3, 0.2), (0.5, 1.0, 2.0), ("--fixture", "panel")),
        ("softbox 90 x 60", rect, (0.9, 0.6), (0.7, 1.0, 2.0), ("--fixture", "softbox")),
        ("tube of 1.2 m", tube, (1.2, 0.0), (0.5, 1.0, 2.0), ()),
        ("bulb", rect, (0.02, 0.02), (0.5, 1.0, 2.0), ())):
    held, widths = {True: 0, False: 0}, {True: [], False: []}
    for seed in range(SEEDS):
        random = np.random.default_rng([20261129, seed])
        room = Room(random, law is tube or name == "bulb")
        candela = float(np.exp(random.uniform(np.log(30), np.log(3000))))
        gain = 1 + 0.03 * random.standard_normal()
        readings = []
        for distance in distances:
            there = distance + 0.004 * random.standard_normal()
            walls = candela * room.on_meter(there)
            lux = (candela * law(*size, there) + walls) * gain * (1 + 0.01 * random.standard_normal())
            readings.append(f"{lux:.4g}lx@{distance}m")
        card = f"{readings[-1]},card={walls * gain * (1 + 0.01 * random.standard_normal()):.4g}lx"
        for carded, told in ((False, readings), (True, readings[:-1] + [card])):
            answer = quick(*told, *words, "--meter", "6%")
            low, high = ends(answer) if "lights" in answer else (0.0, 0.0)
            held[carded] += low <= candela <= high
            widths[carded].append((high - low) / 2 / candela)
    print(f"{name}, size unsaid: {held[False]} of {SEEDS} held, +- {100 * np.median(widths[False]):.0f} %; "
          f"with a card {held[True]}, +- {100 * np.median(widths[True]):.0f} %")
    assert not JUDGED or held[False] >= 36 and held[True] >= 36, name

# In the dark no wall carries what the lamp may measure.
for name, law, size, distances, words in (
        ("panel 60 x 60", rect, (0.6, 0.6), (0.5, 1.0, 2.0), ("--fixture", "panel")),
        ("panel 120 x 30", rect, (1.2, 0.3), (0.5, 1.0, 2.0), ("--fixture", "panel")),
        ("softbox 90 x 60", rect, (0.9, 0.6), (0.7, 1.0, 2.0), ("--fixture", "softbox")),
        ("anything of 60 x 60", rect, (0.6, 0.6), (0.5, 1.0, 2.0), ()),
        ("tube of 1.2 m", tube, (1.2, 0.0), (0.5, 1.0, 2.0), ()),
        ("bulb", rect, (0.02, 0.02), (0.5, 1.0, 2.0), ())):
    held, widths = 0, []
    for seed in range(SEEDS):
        random = np.random.default_rng([20261130, seed])
        candela = float(np.exp(random.uniform(np.log(30), np.log(3000))))
        gain = 1 + 0.03 * random.standard_normal()
        readings = []
        for distance in distances:
            lux = candela * law(*size, distance + 0.004 * random.standard_normal()) * gain
            readings.append(f"{lux * (1 + 0.01 * random.standard_normal()):.4g}lx@{distance}m")
        answer = quick(*readings, *words, "--room", "dark", "--meter", "6%")
        low, high = ends(answer) if "lights" in answer else (0.0, 0.0)
        held += low <= candela <= high
        widths.append((high - low) / 2 / candela)
    print(f"{name} in the dark, size unsaid: {held} of {SEEDS} held, +- {100 * np.median(widths):.0f} %")
    assert not JUDGED or held >= 35 and np.median(widths) < 0.12, name

# A fresnel of 400 000 cd, 40 degrees wide, on a stage of 40 x 30 x 12 m and reflectance .3: at 20 m the path
# traced walls add 2.3 %.
low, high = ends(quick("1024lx@20m", "--fixture", "fresnel", "--room", "40,30,12,0.3"))
print(f"fresnel through a stated stage: {low:.0f} to {high:.0f} cd of 400000")
assert low < 400_000 < high < 500_000 and low > 300_000
# In rooms of which nothing is said, that are as large as their throw: E d^2 is held, and more light is farther.
last = 0.0
for throw in (2, 5, 10, 20, 40, 60, 100):
    answer = quick(f"1000lx@{throw}m", "--fixture", "fresnel")
    low, high = ends(answer)
    assert low < 1000 * throw**2 < high, (throw, low, high)
    assert answer["lights"][0]["intensity_cd"]["value"] > 2 * last, throw
    assert high / low < 9, (throw, low, high)
    last = answer["lights"][0]["intensity_cd"]["value"]
far = quick("1000lx@20m", "--room", "5,4,2.6", "--fixture", "bulb")
assert "outside_room" in [warning["code"] for warning in far["warnings"]], far
