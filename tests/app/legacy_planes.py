#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""LM-63-2002 knows type C from 0 to 0, 90, 180 or 360 degrees. A file of 90 to 270 (1995), and one whose turn lacks its last
plane, leave lightcal as such files, in every format that embeds one.

    legacy_planes.py LIGHTCAL
"""
import json
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, run  # noqa: E402

GAMMA = np.arange(0, 91, 5.0)


def candela(gamma, c):
    """Mirrored in C90-C270: of C by its sine alone."""
    g = np.radians(gamma)
    return 1000 * np.cos(g) ** 2 * (1 + 0.7 * np.sin(np.radians(c)) * np.sin(g))


def slanted(gamma, c):
    return candela(gamma, c + 35)


def write(name, planes, of):
    rows = "\r\n".join(" ".join(f"{v:.6f}" for v in of(GAMMA, c)) for c in planes)
    (HOME / name).write_text(
        f"IESNA:LM-63-1995\r\nTILT=NONE\r\n1 -1 1 {len(GAMMA)} {len(planes)} 1 2 0 0 0\r\n1 1 50\r\n"
        f"{' '.join(map(str, GAMMA))}\r\n{' '.join(map(str, planes))}\r\n{rows}\r\n", newline="")


def table(text):
    """(gamma, C, candela by C and gamma) of a file."""
    words = text.split("TILT=NONE", 1)[1].split()
    nv, nh, factor = int(words[3]), int(words[4]), float(words[2])
    numbers = np.array(words[13:13 + nv + nh + nv * nh], float)
    return numbers[:nv], numbers[nv:nv + nh], factor * numbers[nv + nh:].reshape(nh, nv)


def holds(text, of, mirrored=False):
    gamma, c, values = table(text)
    assert c[0] == 0 and c[-1] == 360, c
    assert (np.diff(c) > 0).all() and np.array_equal(values[0], values[-1]), c
    lit = gamma <= 90
    scale = values[0, 0] / of(0.0, 0.0)
    for plane, row in zip(c, values):
        want = scale * of(gamma[lit], -plane if mirrored else plane)
        assert np.abs(row[lit] - want).max() < 1e-4 * values.max(), (plane, row, want)


def embedded(name):
    """The IES files of an exported text, escaped as JSON or as they are."""
    text = (HOME / "out" / name).read_text()
    at = text.index("IESNA:LM-63")
    start = text.rindex('"', 0, at)
    return json.JSONDecoder().raw_decode(text[start:])[0]


for name, planes, of in (("whole", np.arange(90, 271, 15.0), candela), ("open", np.arange(0, 346, 15.0), slanted)):
    write(f"{name}.ies", planes, of)
    run("photometric", f"{name}.ies", "--to", "ies", "-o", f"{name}_again.ies")
    holds((HOME / f"{name}_again.ies").read_text(), of)
    # And once more: what is written is read as the same lamp.
    run("photometric", f"{name}_again.ies", "--to", "ies", "-o", f"{name}_third.ies")
    assert table((HOME / f"{name}_third.ies").read_text())[2].tolist() == table((HOME / f"{name}_again.ies").read_text())[2].tolist()
    (HOME / "session.toml").write_text(
        'lightcal = 1\nname = "s"\n[room]\ndark = true\n[[light]]\nname = "lamp"\nkind = "photometric"\n'
        f'distribution = "{name}.ies"\n' + "".join(
            f"[[reading]]\nlight = \"lamp\"\ndistance_m = {d}\nilluminance_lx = {1000 / d ** 2:.4f}\n" for d in (1, 2, 3)))
    run("run", "session.toml", "-o", "r", "--force")
    run("export", "r/light.json", "--to", "ies,blender,gltf,unreal,usd", "-o", "out", "--force")
    holds(next((HOME / "out").glob("*.ies")).read_text(), of)
    holds(embedded("light.blender.py"), of, mirrored=True)

# No plane at 180: what lies between its neighbours is what every reader draws there.
write("gap.ies", np.array([90.0, 150.0, 210.0, 270.0]), candela)
run("photometric", "gap.ies", "--to", "ies", "-o", "gap_again.ies")
gamma, c, values = table((HOME / "gap_again.ies").read_text())
assert c[0] == 0 and c[-1] == 360, c
assert np.abs(values[0][gamma <= 90] - (candela(GAMMA, 150.0) + candela(GAMMA, 210.0)) / 2).max() < 1e-3, values[0]
