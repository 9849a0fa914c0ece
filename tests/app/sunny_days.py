# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome` of days whose sun is cut off. One lux reading holds light that the picture lacks: the scale's
interval holds the truth, from a sun that gives the meter nearly all to the picture as it is. Without a reading, in
cd/m2, what the dome and its sun give is a lower bound, and their intervals reach up to the truth. A picture that is
not cut off is as sure as its meter.
The worlds: tests/tools/sun_and_sky.py; suns of 20 to 120 klx, 10 to 70 degrees high, no brighter than clean air lets
through; clear skies of 4 klx and more, haze, broken clouds; ground of 5 to 50 %; cut off at 65504 cd/m2 or lower, above the sky; all
turned about.

    sunny_days.py LIGHTCAL [WORLDS]"""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, json  # noqa: E402
from sun_and_sky import Panorama, direction  # noqa: E402
from usdlux import write_exr  # noqa: E402

random = np.random.default_rng(3)
WORLDS = int(sys.argv[2]) if len(sys.argv) > 2 else 4
UP, DOWN = (0, 0, 1), (0, 0, -1)


def a_day(rows=64):
    world = Panorama(rows)
    azimuth, elevation = random.uniform(-180, 180), random.uniform(10, 70)
    height = np.sin(np.radians(elevation))
    lux = min(random.uniform(20e3, 120e3), 133e3 * np.exp(-0.13 / height))
    z, to_sun = world.way[..., 2], np.degrees(np.arccos(np.clip(world.way @ direction(azimuth, elevation), -1, 1)))
    kind = random.choice(["clear", "haze", "clouds"])
    sky = {"clear": 1 + 0.6 * (1 - z) ** 2 + 2 * np.exp(-to_sun / 15),
           "haze": 1 + 0.3 * z + 6 * np.exp(-to_sun / 12) + 30 * np.exp(-to_sun / 3),
           "clouds": 1 + 3 * (np.sin(5 * world.way[..., 0] + 1) * np.sin(4 * world.way[..., 1]) * np.cos(3 * z) > 0.1)}[kind]
    sky = np.where(z > 0, sky, 0)
    world.add(sky, (0.75, 1.0, 1.4))
    world.rgb *= {"clear": random.uniform(4e3, 16e3), "haze": random.uniform(12e3, 35e3), "clouds": random.uniform(10e3, 40e3)}[kind] / world.lux(UP)
    brightest = min(1.3 * world.rgb.max(), 65504)
    world.add_disc(azimuth, elevation, lux, colour=(1.15, 0.98, 0.75))
    world.add(np.where(z < 0, random.uniform(0.05, 0.5) * world.lux(UP) / np.pi, 0), (1.2, 0.98, 0.7))
    return world, direction(azimuth, elevation), lux, np.exp(random.uniform(np.log(brightest), np.log(65504)))


def dome(*words):
    said = answer("dome", HOME / "p.exr", *words, "-o", HOME / "d", "--force")
    return said, [w["code"] for w in said.get("warnings", [])]


def ends(uncertain):
    return uncertain.get("low95", uncertain["value"] - uncertain["u95"]), uncertain.get("high95", uncertain["value"] + uncertain["u95"])


def holds(uncertain, truth):
    low, high = ends(uncertain)
    return low <= truth <= high


def environment():
    lights = json.loads((HOME / "d" / "light.json").read_text())["lights"]
    return next(light for light in lights if light["kind"] == "dome")["illuminance_lx"]


counts = dict.fromkeys(("scale", "below", "sun", "dome", "lower", "lower_sun", "down"), 0)
widths = []
for _ in range(WORLDS):
    world, sun, lux, clip = a_day()
    unit = 10 ** random.uniform(0, 4)
    read = world.lux(UP) * np.exp(random.normal(0, 0.03))
    # In a unit that nobody states, with a meter that lay flat.
    write_exr(HOME / "p.exr", np.minimum(world.rgb, clip) / unit)
    said, warned = dome("--lux", f"{read:.6g}", "--extract", 1)
    assert "maybe_clipped" in warned, warned
    scale = said["scale"]
    low, high = scale.get("low95", scale["factor"] * (1 - scale["u95_relative"])), scale.get("high95", scale["factor"] * (1 + scale["u95_relative"]))
    counts["scale"] += low <= unit <= high
    widths.append(np.log2(high / max(low, 1e-9)))
    light = said["lights"][0]
    assert np.dot(light["direction"], sun) > np.cos(np.radians(6)), (light, sun)
    counts["sun"] += holds(light["illuminance_lx"], lux)
    # Dome and sun together are what the meter read.
    assert abs(said["illuminance_lx"]["up"]["total"] / read - 1) < 0.02, (said["illuminance_lx"], read)
    below = answer("simulate", HOME / "d" / "light.json", "--at", "0,0,0", "--normal=0,0,-1")["points"][0]["illuminance_lx"]
    counts["below"] += below["low95"] <= world.lux(DOWN) <= below["high95"]
    said, warned = dome("--lux", f"{read:.6g}")
    counts["dome"] += holds(environment(), world.lux(UP))
    # A meter turned away from the sun is sure.
    said, warned = dome("--lux", f"{world.lux(DOWN):.6g}", "--lux-direction", "down")
    assert abs(said["scale"]["factor"] / unit - 1) < 0.02 and said["scale"]["u95_relative"] < 0.11, said["scale"]
    counts["down"] += "maybe_clipped" in warned and holds(environment(), world.lux(UP))
    # In cd/m2, without a reading.
    write_exr(HOME / "p.exr", np.minimum(world.rgb, 65504), half=bool(random.integers(2)), white_luminance=1.0)
    said, warned = dome("--extract", 1)
    counts["lower_sun"] += bool({"maybe_clipped", "clipped"} & set(warned)) and bool(said["lights"]) and holds(said["lights"][0]["illuminance_lx"], lux)
    said, warned = dome()
    counts["lower"] += bool({"maybe_clipped", "clipped"} & set(warned)) and holds(environment(), world.lux(UP))
    inspected = answer("inspect", HOME / "p.exr", "--projection", "latlong")
    assert "maybe_clipped" in [w["code"] for w in inspected["warnings"]], inspected
    # Whole.
    write_exr(HOME / "p.exr", world.rgb / unit)
    said, warned = dome("--lux", f"{world.lux(UP):.6g}")
    assert "maybe_clipped" not in warned and abs(said["scale"]["factor"] / unit - 1) < 0.01 and said["scale"]["u95_relative"] < 0.11, said["scale"]
print(f"held in {WORLDS}: {counts}; the scale's interval is {np.median(widths):.1f} stops wide")
assert min(counts.values()) >= 0.93 * WORLDS, counts
