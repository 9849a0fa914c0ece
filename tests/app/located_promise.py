# SPDX-License-Identifier: Apache-2.0
"""Where a layout leaves a lamp's place open, `lightcal fit` names a reading and says how well it would tell the place.

Flat meters on a circle, or on a square's corners, under a point in the dark, 1 % a reading; then with the reading that
was asked for. What was promised is about what comes.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

LIGHTCAL = sys.argv[1]
SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 24


def fitted(path, lamp, candela, places, rng):
    lines = ["lightcal = 1", "[room]", "dark = true", "[[meter]]", 'name = "m"', "sigma_relative = 0.01", "[[light]]",
             'name = "key"', 'kind = "point"']
    for place, noise in places:
        place = np.round(np.array(place, float), 3)
        way = lamp - place
        lux = candela * way[2] / np.linalg.norm(way) ** 3 * np.exp(0.01 * noise)
        lines += ["[[reading]]", 'light = "key"', 'meter = "m"', f"position_m = {[float(v) for v in place]}",
                  "normal = [0, 0, 1]", f"illuminance_lx = {lux:.5g}"]
    path.write_text("\n".join(lines) + "\n")
    return json.loads(subprocess.run([LIGHTCAL, "fit", str(path), "--json"], capture_output=True, text=True).stdout)


def main():
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "session.toml"
        for seed in range(SEEDS):
            rng = np.random.default_rng(9100 + seed)
            count = (4, 6)[seed % 2]
            turns = np.arange(count) * (2.0 * np.pi / count) if seed % 3 else np.arange(count) + 0.3
            places = [((np.cos(a), np.sin(a), 0.0), rng.normal()) for a in turns]
            lamp, candela = np.array([*rng.uniform(-0.5, 0.5, 2), rng.uniform(1.0, 2.2)]), rng.uniform(40.0, 500.0)
            error = fitted(path, lamp, candela, places, rng)["error"]
            assert error["code"] == "cocircular", error
            promised = float(re.search(r"about \+-([\d.e+]+) m", error["message"])[1])
            asked = [float(v) for v in re.search(r"position_m = \[([^\]]*)\]", error["message"])[1].split(",")]
            told = fitted(path, lamp, candela, places + [(asked, rng.normal())], rng)
            if "error" in told:
                print(f"{seed}: {promised} m promised, then {told['error']['code']}")
                continue
            got = max(told["lights"][0]["position_u95_m"])
            ratios.append(promised / got)
            print(f"{seed}: {promised} m promised, {got:.2f} m came")
    print(f"promised over come: {np.min(ratios):.2f} to {np.max(ratios):.2f}, median {np.median(ratios):.2f}")
    assert len(ratios) >= 0.8 * SEEDS
    assert 0.4 < np.median(ratios) < 2.5 and max(ratios) < 8.0 and min(ratios) > 0.125, ratios


main()
