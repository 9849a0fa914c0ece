# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome --lux-shaded` where lamps may be clipped and nobody says from where: the card's light is told, or the
reading is refused. The worlds: a room and three to five lamps in it (tests/tools/sun_and_sky.py), cut off at a value
that clips none to all of them, each time one lamp is shaded."""
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, json, refused  # noqa: E402
from sun_and_sky import Panorama, direction  # noqa: E402
from usdlux import write_exr  # noqa: E402

UP = (0, 0, 1)
random = np.random.default_rng(7)


def room_with(lamps, rows=96):
    world = Panorama(rows)
    x, y, z = np.moveaxis(world.way, -1, 0)
    world.add(20 * (1 + 0.3 * z + 0.2 * np.sin(9 * x) * np.cos(7 * y)), (1.2, 0.97, 0.7))
    for azimuth, elevation, lux, diameter in lamps:
        world.add_disc(azimuth, elevation, lux, diameter, (1.3, 0.97, 0.6))
    return world


def words(world, shaded_lux, clip):
    """Arguments of a picture in a unit that nobody states."""
    write_exr(HOME / "p.exr", np.minimum(world.rgb / 137, clip))
    lux = world.lux(UP)
    return ["dome", HOME / "p.exr", "--lux", f"{lux:.6g}", "--lux-shaded", f"{lux - shaded_lux:.6g}", "-o", HOME / "d", "--force"]


def up_from(lamp):
    return lamp[2] * np.sin(np.radians(lamp[1]))


# The two that clip hang side by side, one card before both.
lamps = [(30, 50, 172, 6), (-60, 40, 124, 2.4), (-66, 44, 124, 2.4), (150, 15, 103, 12)]
refused("several_clipped", *words(room_with(lamps), up_from(lamps[1]) + up_from(lamps[2]), 200), says="--clip")

told = held = shaded_held = clipped_ones = 0
WORLDS = 24
for _ in range(WORLDS):
    lamps = [(az + random.uniform(-20, 20), random.uniform(15, 75), random.uniform(30, 400), random.uniform(3, 8))
             for az in (-150, -75, 0, 75, 150)[:random.integers(3, 6)]]
    world = room_with(lamps)
    peaks = sorted((lux / (np.pi * np.sin(np.radians(size / 2)) ** 2) for _, _, lux, size in lamps), reverse=True)
    clip = random.choice([2.0, 0.7, 0.2]) * peaks[random.integers(0, 2)] / 137
    shaded = lamps[random.integers(len(lamps))]
    done = subprocess.run([LIGHTCAL, *map(str, words(world, up_from(shaded), clip)), "--json"], capture_output=True, text=True, check=False)
    said = json.loads(done.stdout)
    if done.returncode == 3:
        assert said["error"]["code"] in ("several_clipped", "shaded_light_unknown"), said["error"]
        continue
    told += 1
    clipped_ones += clip * 137 < peaks[0]
    off = abs(np.log(said["scale"]["factor"] / 137))
    held += off < np.log1p(said["scale"]["u95_relative"])
    if off > np.log1p(said["scale"]["u95_relative"]):
        print("missed", lamps, "clip", clip * 137, peaks, "shaded", shaded, said["scale"], [w["code"] for w in said.get("warnings", [])])
    near = [light for light in said["lights"] if np.dot(light["direction"], direction(*shaded[:2])) > np.cos(np.radians(2))]
    lux = near[0]["illuminance_lx"]
    within = lux.get("low95", lux["value"] - lux["u95"]) < shaded[2] < lux.get("high95", lux["value"] + lux["u95"])
    shaded_held += within
    if not within:
        print("shaded missed", near, shaded, lamps, said["scale"], clip * 137, peaks)
print(f"{told} of {WORLDS} told, {clipped_ones} of them with lamps that clip, {held} scales and {shaded_held} shaded lamps held")
assert told >= WORLDS / 2 and min(held, shaded_held) >= 0.93 * told and clipped_ones > 3, (told, held, shaded_held, clipped_ones)
