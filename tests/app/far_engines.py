#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Of all formats at once the one that strays most from a lamp is named, with what that format's own export says.

    far_engines.py LIGHTCAL
"""
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, run  # noqa: E402

# A fresnel's beam, half at 15 degrees: flatter in the middle than any engine's cone.
gamma = np.arange(0, 91, 1.0)
candela = 8000 * 0.5 ** ((gamma / 15) ** 3)
(HOME / "f.ies").write_text(
    "IESNA:LM-63-2002\n[TEST] x\n[MANUFAC] x\nTILT=NONE\n1 -1 1 %d 1 1 2 0 0 0\n1 1 100\n%s\n0\n%s\n" %
    (len(gamma), " ".join(f"{g:g}" for g in gamma), " ".join(f"{c:.2f}" for c in candela)))
(HOME / "f.toml").write_text('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "photometric"\n'
                             'distribution = "f.ies"\n[[reading]]\nlight = "key"\ndistance_m = 4.0\n'
                             'illuminance_lx = 500\n')


def worst(text):
    return max(map(float, re.findall(r"within ([\d.]+) % of the axial", text)), default=0.0)


run("fit", "f.toml", "-o", "f.json")
alone = {name: worst(run("export", "f.json", "--to", name, "-o", name).stderr) for name in ("gltf", "godot", "unity")}
farthest = max(alone, key=alone.get)
assert alone[farthest] > 2 * alone["gltf"], alone
said = run("run", "f.toml", "-o", "all").stderr
assert worst(said) >= alone[farthest], (alone, said)
line = next(row for row in said.splitlines() if "of the axial" in row)
if worst(said) == alone[farthest]:
    assert farthest in line, line
assert said.count("of the axial") == 1, said
