# SPDX-License-Identifier: Apache-2.0
"""A tube light read broadside, nearer than it is long: its candela, luminance and flux against a quadrature of a
Lambertian cylinder's mantle, and what an engine without tubes is said to give too much where it was read. Written
without a header of lightcal."""
import math
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402

LENGTH_M, RADIUS_M, NITS = 1.2, 0.013, 5000.0
CANDELA = 2 * RADIUS_M * LENGTH_M * NITS  # broadside, far away


def lux(distance):
    """By 400 x 2000 patches of the mantle; distance from the axis."""
    along = (np.arange(2000) + 0.5) / 2000 * LENGTH_M - LENGTH_M / 2
    around = (np.arange(400) + 0.5) / 400 * 2 * math.pi - math.pi
    z, phi = np.meshgrid(along, around, indexing="ij")
    dx, dy, dz = distance - RADIUS_M * np.cos(phi), -RADIUS_M * np.sin(phi), -z
    leaves = np.maximum(np.cos(phi) * dx + np.sin(phi) * dy, 0)
    patch = LENGTH_M / 2000 * RADIUS_M * 2 * math.pi / 400
    return NITS * float((leaves * dx / (dx**2 + dy**2 + dz**2) ** 2).sum()) * patch


for distance in (0.5, 1.0, 2.0, 4.0):
    shown = lux(distance)
    said = answer("quick", f"{shown:.6g}lx@{distance}m", "--kind", "tube", "--length", "1.2m", "--radius", "13mm",
                  "--room", "dark", "--to", "gltf", "-o", HOME / "out", "--force")
    lamp = said["lights"][0]
    too_much = 100 * (CANDELA / distance**2 / shown - 1)
    print(f"{distance} m: {lamp['intensity_cd']['value'] / CANDELA:.4f} of the candela; as a point {too_much:.1f} % too bright")
    assert abs(lamp["intensity_cd"]["value"] / CANDELA - 1) < 0.01, lamp["intensity_cd"]
    assert abs(lamp["luminance_nits"]["value"] / NITS - 1) < 0.01, lamp["luminance_nits"]
    assert abs(lamp["flux_lm"]["value"] / (math.pi * NITS * 2 * math.pi * RADIUS_M * LENGTH_M) - 1) < 0.01, lamp["flux_lm"]
    told, = (w["message"] for w in said["warnings"] if w["code"] == "substituted")
    part = re.search(r"too bright nearer, ([\d.]+) % at ([\d.]+) m, where it was read", told)
    if too_much < 1.5:
        assert not part, told
        continue
    assert part and abs(float(part[1]) - too_much) < 1.5 and float(part[2]) == distance, (told, too_much)
