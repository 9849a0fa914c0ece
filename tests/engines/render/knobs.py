#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A lamp with a dimmer and a colour temperature, exported to Blender with both as properties, turned
and rendered in Cycles at five states: lux and chromaticity of the card against `lightcal state`.

    knobs.py LIGHTCAL
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
HOME = pathlib.Path(tempfile.mkdtemp())
XY = {3200: (0.4234, 0.3990), 4400: (0.3626, 0.3650), 5600: (0.3302, 0.3411)}
# Read: the first, second and fourth; between: the others.
STATES = [(100, 5600), (40, 5600), (70, 5600), (100, 3200), (100, 5000)]


def run(*words):
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True, cwd=HOME,
                          check=False)
    assert done.returncode == 0, f"{words}: {done.stderr}"
    return done.stdout


def reading(dimmer, cct, distance):
    x, y = XY[cct]
    lux = 800 * (1.0 if cct == 5600 else 0.9) * (dimmer / 100) ** 1.6 / distance**2
    return (f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {distance}\n'
            f"illuminance_lx = {lux:.9g}\nxy = [{x}, {y}]\ncolor_source = \"spectrometer\"\n"
            f"state = {{ dimmer = {dimmer}, cct_K = {cct} }}\n")


def main():
    (HOME / "lamp").mkdir()
    text = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n'
            '[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    for distance in (1, 2, 4):
        text += reading(100, 5600, distance)
    for dimmer, cct in ((80, 5600), (60, 5600), (40, 5600), (20, 5600), (100, 4400), (100, 3200)):
        text += reading(dimmer, cct, 1)
    (HOME / "lamp/session.toml").write_text(text)
    run("fit", "lamp", "-o", "lamp.json")
    run("export", "lamp.json", "--to", "blender", "-o", "out")
    told = [json.loads(run("state", "lamp.json", "--at", f"dimmer={d},cct_K={c}", "--json"))
            for d, c in STATES]
    (HOME / "states.json").write_text(json.dumps([{"dimmer": d, "cct_K": c} for d, c in STATES]))
    blender = shutil.which("blender")
    assert blender, "blender is missing: tests/packages.txt"
    done = subprocess.run(
        [blender, "-b", "--factory-startup", "-P", HERE / "knobs_probe.py", "--",
         HOME / "out/lamp.blender.py", HOME / "states.json", HOME / "answers.json"],
        capture_output=True, text=True, check=False)
    assert (HOME / "answers.json").exists(), done.stdout[-3000:] + done.stderr[-3000:]
    answers = json.loads((HOME / "answers.json").read_text())
    offset = json.loads((HOME / "lamp.json").read_text())["lights"][0].get(
        "distance_offset_m", {"value": 0})["value"]
    assert answers["limits"] == [20, 100], answers["limits"]
    failed = []
    for (dimmer, cct), state, seen in zip(STATES, told, answers["seen"]):
        r, g, b = seen["rgb"]
        # Linear sRGB to XYZ (IEC 61966-2-1).
        X = 0.4124564 * r + 0.3575761 * g + 0.1804375 * b
        Y = 0.2126729 * r + 0.7151522 * g + 0.0721750 * b
        Z = 0.0193339 * r + 0.1191920 * g + 0.9503041 * b
        lux = math.pi * 683 * Y
        expected = state["intensity_cd"]["value"] / 4.0  # the effective source 2 m above
        off = lux / expected - 1
        dx, dy = X / (X + Y + Z) - state["xy"][0], Y / (X + Y + Z) - state["xy"][1]
        print(f"dimmer {dimmer} cct {cct}: {lux:.3f} lx, state {expected:.3f} lx, {100 * off:+.3f} %, "
              f"dx {dx:+.5f} dy {dy:+.5f}")
        if abs(off) > 0.005 or max(abs(dx), abs(dy)) > 0.001:
            failed.append((dimmer, cct))
    assert not failed, (failed, offset)
    print("Blender", answers["blender"])


if __name__ == "__main__":
    main()
