# SPDX-License-Identifier: Apache-2.0
"""The cone to type into Blender before 4.0, whose spot is dimmed by a further cosine, beside that of 4.0 and later: each
is nearer to the lamp (KHR_lights_punctual's square) by its own version's law than the other's numbers are.
Source of both laws: Cycles 3.4 and 5.2, rendered (tests/engines/render). Written
without a header of lightcal."""
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import run  # noqa: E402

angle = np.radians(np.linspace(0, 89.9, 2000))


def lamp(inner, outer):
    inner, outer = np.cos(np.radians([inner, outer]))
    return np.clip((np.cos(angle) - outer) / (inner - outer), 0, 1) ** 2


def cycles(size_deg, blend, before_4_0):
    edge = np.cos(np.radians(size_deg / 2))
    t = np.clip((np.cos(angle) - edge) / np.maximum(blend * (1 - edge), 1e-9), 0, 1)
    return t * t * (3 - 2 * t) * (np.cos(angle) if before_4_0 else 1)


for inner, outer in ((15, 25), (20, 40), (30, 60), (10, 70)):
    text = run("quick", "100lx@1m", "--kind", "spot", "--inner", inner, "--outer", outer, "--room", "dark", "--to",
               "blender", "-o", "out", "--force").stdout
    new, old = (tuple(map(float, pair)) for pair in
                (re.search(r"Blender Spot Size ([\d.]+)°, Blend ([\d.]+)", text).groups(),
                 re.search(r"before 4\.0 Spot Size ([\d.]+)°, Blend ([\d.]+)", text).groups()))
    truth = lamp(inner, outer)
    worst = {(typed, version): np.abs(cycles(*numbers, version) - truth).max()
             for typed, numbers in (("new", new), ("old", old)) for version in (False, True)}
    print(f"{inner} to {outer} degrees: 4.0 on {new} {worst['new', False]:.3f}; before {old} {worst['old', True]:.3f}, "
          f"4.0's numbers there {worst['new', True]:.3f}")
    assert worst["old", True] < worst["new", True] and worst["new", False] < worst["old", False], worst
    assert worst["old", True] < 0.2, worst
