# SPDX-License-Identifier: Apache-2.0
"""Lamps whose readings agree among themselves: light that falls as 1/d^2 from half a metre on is the lamp's, since
no room's walls fall so steeply and are most of what is read there. Bulbs of 48 cd in a hall, 1 % a reading; an exact
tube; and bulbs beside a wall, whose own integral says how steep walls get. Written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import answer  # noqa: E402

DISTANCES = (0.5, 1.0, 2.0)
SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 40  # of few the frequencies are not judged
JUDGED = len(sys.argv) <= 2


def found(lux, *words):
    typed = [f"{e:.1f}lx@{d:g}m" for e, d in zip(lux, DISTANCES)]
    value = answer("quick", *typed, *words)["lights"][0]["intensity_cd"]
    return value["low95"], value["high95"]


def tube(length, distance):
    """Lux per candela broadside of a Lambertian tube."""
    x = ((np.arange(2000) + 0.5) / 2000 - 0.5) * length
    return float(np.mean(distance**2 / (x**2 + distance**2) ** 2))


def beside_wall(random):
    """Lux per candela at the three distances of what a Lambertian wall .1 to .5 m behind a bulb throws back to a
    meter that faces it from before the wall."""
    away, cosine = random.uniform(0.1, 0.5), random.uniform(0.1, 1)
    towards = np.array([np.sqrt(1 - cosine**2), 0, cosine])
    u = np.linspace(-4, 4, 161)
    x, y = np.meshgrid(0.12 * np.sinh(u), 0.12 * np.sinh(u))
    width = 0.12 * np.cosh(u) * 8 / 160
    squared = x**2 + y**2 + away**2
    on_wall = away / squared**1.5
    lux = []
    for d in DISTANCES:
        way = [d * towards[0] - x, -y, away + d * towards[2]]
        r = np.sqrt(way[0] ** 2 + way[1] ** 2 + way[2] ** 2)
        facing = np.clip((way[0] * towards[0] + way[2] * towards[2]) / r, 0, None)
        lux.append((on_wall * (way[2] / r) * facing / r**2 * np.outer(width, width)).sum() / np.pi)
    return random.uniform(0.25, 0.8) * np.array(lux)


square = np.array([1 / d**2 for d in DISTANCES])
deep, held = 0, 0
for seed in range(SEEDS):
    random = np.random.default_rng(seed)
    low, high = found(48 * square * np.exp(random.normal(0, 0.01, 3)), "--fixture", "bulb")
    deep += low < 30
    held += low <= 48 <= high
print(f"48 cd that agree: held {held} of {SEEDS}, low end below 30 cd {deep}")
assert not JUDGED or held >= 39 and deep <= 2, (held, deep)

low, high = found([400 * tube(1.2, d) for d in DISTANCES], "--length", "1.2m", "--radius", "13mm")
print(f"a tube of 400 cd: {low:.0f} to {high:.0f}")
assert 250 < low < 400 < high < 460, (low, high)

held, widths = 0, []
for seed in range(SEEDS):
    random = np.random.default_rng(1000 + seed)
    room = 0.12 * np.exp(random.normal(0, 0.4)) * (np.array(DISTANCES) / 3) ** random.normal(-0.7, 0.2)
    gain = 100 * np.exp(random.normal(0, 0.03))
    lux = gain * (square + beside_wall(random) + room) * np.exp(random.normal(0, 0.01, 3))
    low, high = found(lux, "--fixture", "bulb")
    held += low <= 100 <= high
    widths.append(high / low)
print(f"bulbs beside a wall: held {held} of {SEEDS}, {np.median(widths):.2f} from end to end")
assert not JUDGED or held >= 37, held
