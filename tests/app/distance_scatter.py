#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Distances that scatter, each by itself: a tape held by hand, whole inches.

usage: distance_scatter.py LIGHTCAL

A bulb in a box of matt walls (one bounce by patches, the rest even), six readings from .3 m on by a
meter of 2 % in common and 1 % each. Its interval must hold the lamp as often as 95 % says: tape
readings off by 4 mm that nobody states, by 7 and 15 mm that are stated, whole inches; and a smaller
distance_sigma_m must narrow. Knows nothing of lightcal's code.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np

SESSIONS = 60
INCH = 0.0254


def patches(size):
    """Middle, normal and area of pieces of the walls of a box."""
    out = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        k, n = max(3, int(2 * size[u])), max(3, int(2 * size[v]))
        for end in (0, 1):
            for i in range(k):
                for j in range(n):
                    at = [0.0] * 3
                    at[axis], at[u], at[v] = end * size[axis], (i + .5) / k * size[u], (j + .5) / n * size[v]
                    normal = [0.0] * 3
                    normal[axis] = 1.0 - 2.0 * end
                    out.append(at + normal + [size[u] * size[v] / k / n])
    return np.array(out)


def from_walls(size, rho, lamp, meter, facing):
    p = patches(size)
    at, normal, area = p[:, :3], p[:, 3:6], p[:, 6]
    way = lamp - at
    first = np.clip((way * normal).sum(1), 0, None) / np.linalg.norm(way, axis=1) ** 3
    first *= 4 * math.pi / (first * area).sum()
    leaving = rho * (first + 4 * math.pi * rho / (area.sum() * (1 - rho))) / math.pi
    way = at - meter
    r = np.linalg.norm(way, axis=1)
    here = np.clip((way * facing).sum(1), 0, None) / r
    there = np.clip(-(way * normal).sum(1), 0, None) / r
    return (leaving * area * here * there / np.maximum(r, 0.15) ** 2).sum()


def session(seed, scatter, inches, stated):
    chance = np.random.default_rng(seed)
    candela, offset = 48 * math.exp(chance.normal(0, .3)), chance.normal(0, .024)
    said = np.round(np.geomspace(.3, 2.4, 6), 2)
    true = said + chance.normal(0, 1, 6) * scatter
    if inches:
        true = said * np.exp(chance.uniform(-.04, .04, 6))
        said = np.round(true / INCH) * INCH
    size = (chance.uniform(5.2, 7), chance.uniform(3.2, 5), chance.uniform(2.4, 3))
    rho = chance.uniform(.35, .65)
    lamp = np.array([.3 * size[0], chance.uniform(.3, .7) * size[1], chance.uniform(.9, 1.6)])
    along = np.array([1.0, 0.0, 0.0])
    gain = math.exp(chance.normal(0, .02))
    text = ('lightcal = 1\n[[meter]]\nname = "m"\nsigma_relative = 0.02\n[[light]]\nname = "key"\n'
            'kind = "point"\nfixture = "bulb"\n')
    if stated is not None:
        text += f"distance_sigma_m = {stated}\n"
    for distance, stood in zip(said, true):
        lux = candela / (stood + offset) ** 2
        lux += candela * from_walls(size, rho, lamp, lamp + along * stood, -along)
        lux *= gain * math.exp(chance.normal(0, .01))
        text += ('[[reading]]\nlight = "key"\nmeter = "m"\n'
                 f"distance_m = {distance:.6g}\nilluminance_lx = {lux:.1f}\n")
    return text, candela


def fit(lightcal, folder, text):
    path = os.path.join(folder, "one.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([lightcal, "fit", path, "--json", "-o", os.path.join(folder, "one.json")],
                          capture_output=True, text=True, check=False)
    return done.returncode, json.loads(done.stdout), done.stderr


def main():
    lightcal = sys.argv[1]
    failures = []
    least = SESSIONS * 0.95 - 3.0 * math.sqrt(SESSIONS * 0.95 * 0.05)
    with tempfile.TemporaryDirectory() as folder:
        widths = {}
        for name, scatter, inches, stated in (("4 mm", .004, False, None), ("7 mm", .007, False, .007),
                                              ("15 mm", .015, False, .015), ("inches", 0, True, None),
                                              ("none", 0, False, 0)):
            held, width, said = 0, [], 0
            for seed in range(SESSIONS):
                text, candela = session(seed, scatter, inches, stated)
                code, answer, errors = fit(lightcal, folder, text)
                if code != 0:
                    sys.exit(f"{name}, {seed}: {answer} {errors}")
                u = answer["lights"][0]["intensity_cd"]
                low, high = u.get("low95", u["value"] - u["u95"]), u.get("high95", u["value"] + u["u95"])
                held += low <= candela <= high
                width.append(0.5 * math.log(high / low))
                said += "whole inches" in errors
            widths[name] = float(np.median(width))
            print(f"{name}: held {held} of {SESSIONS}, ± {100 * widths[name]:.1f} %, said {said}")
            if held < least:
                failures.append(f"{name}: held {held} of {SESSIONS}")
            if (said > 0) != inches:
                failures.append(f"{name}: whole inches said {said} times")
        if not widths["none"] < widths["7 mm"] < widths["15 mm"]:
            failures.append(f"not narrower by a smaller sigma: {widths}")
        text, _ = session(1, .007, False, None)
        own = text.replace("distance_m = 0.3\n", "distance_m = 0.3\ndistance_sigma_m = 0.03\n")
        before, after = (fit(lightcal, folder, t)[1]["lights"][0]["intensity_cd"]["u95"]
                         for t in (text, own))
        if not after > before:
            failures.append("a reading's own distance_sigma_m changed nothing")
        # Once more at one place says nothing of how far that is.
        once = text.replace("distance_m", "distance_sigma_m = 0.02\ndistance_m")
        rows = once.split("[[reading]]")
        twice = "[[reading]]".join(rows[:1] + [row for row in rows[1:] for _ in range(4)])
        one, four = (fit(lightcal, folder, t)[1]["lights"][0]["intensity_cd"] for t in (once, twice))
        if four["u95"] / four["value"] < 0.9 * one["u95"] / one["value"]:
            failures.append(f"reading four times at each place narrows the distances: {one} {four}")
        code, answer, _ = fit(lightcal, folder, text.replace("distance_m = 0.3\n", "distance_m = 0.3\ndistance_sigma_m = -1\n"))
        if code != 3 or "distance_sigma_m" not in answer["error"]["message"]:
            failures.append(f"a negative distance_sigma_m: {answer}")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
