#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal check PRESET --session`: every format it reads predicts the readings as the fit does, and
a file edited by hand gives the edit back as its residual.

    check_presets.py LIGHTCAL_BINARY
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
ENDINGS = ["gltf", "preset.json", "blender.py", "three.js", "filament.json"]
READINGS = "".join(
    f'[[reading]]\nlight = "lamp"\ndistance_m = {d}\nilluminance_lx = {e}\ncct_K = 2700\nduv = 0.001\n'
    for d, e in [(1.0, 1003.0), (1.5, 441.0), (2.0, 250.6), (3.0, 110.7)])
LAMPS = {
    "point": 'kind = "point"\nposition_m = [1, 2, 3]\naim = [0.6, 0, -0.8]\n',
    "bulb": 'kind = "point"\n',
    "spot": 'kind = "spot"\ninner_deg = 15\nouter_deg = 25\nposition_m = [1, 2, 3]\naim = [0, 0.6, -0.8]\n',
    "rect": 'kind = "rect"\nsize_m = [0.1, 0.05]\nposition_m = [1, 2, 3]\naim = [0, 0.6, -0.8]\n',
}
# What to double by hand: the number behind this pattern.
FIGURE = {
    "gltf": r'("type": "\w+",\s+"color": \[[^]]*\],\s+"intensity": )([-\d.e+]+)',
    "blender.py": r'("energy_W": )([-\d.e+]+)',
    "three.js": r'("intensity": )([-\d.e+]+)',
    "filament.json": r'("intensity_candela": )([-\d.e+]+)',
    "preset.json": r'("intensity_cd": \{\s+"value": )([-\d.e+]+)',
}


def lightcal(*arguments):
    return subprocess.run([LIGHTCAL, *map(str, arguments)], capture_output=True, text=True, check=False)


def check(preset, session):
    done = lightcal("check", preset, "--session", session, "--json")
    assert done.returncode == 0, f"{preset}: {done.stdout} {done.stderr}"
    return json.loads(done.stdout)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, keys in LAMPS.items():
            session = pathlib.Path(folder) / name
            session.mkdir()
            (session / "session.toml").write_text(
                f'lightcal = 1\nname = "{name}"\n[[light]]\nname = "lamp"\n{keys}{READINGS}')
            done = lightcal("run", session, "-o", session / "out", "--force")
            assert done.returncode == 0, done.stderr
            for ending in ENDINGS:
                preset = session / "out" / f"{name}.{ending}"
                rows = check(preset, session)["readings"]
                assert len(rows) == 4, (preset, rows)
                for row in rows:
                    # The readings are within 1 % of 1/d^2; what a rect becomes as a spot is right
                    # beyond ten times its size.
                    assert abs(row["error"]) < 0.01, (preset, row)
                text = preset.read_text()
                edited, count = re.subn(
                    FIGURE[ending], lambda m: m.group(1) + repr(2 * float(m.group(2))), text, count=1)
                assert count == 1, preset
                double = session / f"{name}.{ending}"
                double.write_text(edited)
                for row, before in zip(check(double, session)["readings"], rows):
                    ratio = row["predicted_lx"] / before["predicted_lx"]
                    assert abs(ratio - 2) < 1e-9, (preset, ratio)
            broken = session / f"broken.{ENDINGS[0]}"
            broken.write_text("{\"nodes\": 3}")
            assert lightcal("check", broken, "--session", session).returncode == 3
        assert lightcal("check", "x.doc", "--session", session).returncode in (1, 2)
        assert lightcal("check").returncode == 2


main()
