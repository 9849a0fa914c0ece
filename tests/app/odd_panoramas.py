# SPDX-License-Identifier: Apache-2.0
"""Panoramas that hold less than they should: too few pixels, and pixels darker than no light. The truth is a
uniform sphere: E = pi L on any plane."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from usdlux import write_exr  # noqa: E402

random = np.random.default_rng(11)


def dome(picture, *more):
    write_exr(HOME / "p.exr", picture)
    said = answer("dome", HOME / "p.exr", "--lux", np.pi * 10, "-o", HOME / "d", "--force", *more)
    return said, read_exr(HOME / "d" / "dome.exr")


def bad(said):
    return [w["message"] for w in said.get("warnings", []) if w["code"] == "bad_samples"]


for height in (1, 2):
    write_exr(HOME / "p.exr", np.full((height, 2 * height, 3), 10.0))
    refused("bad_view", "dome", HOME / "p.exr", "--lux", "31.4", "-o", HOME / "none", says="above the horizon")
    assert not (HOME / "none").exists()

grey = 10 + random.uniform(-0.5, 0.5, (32, 64, 1)) * np.ones(3)
said, _ = dome(grey)
assert not bad(said), said
scale = said["scale"]["factor"]
# One pixel, and a block, in two rows.
for at, count in ((np.s_[9, 20], "1 pixel "), (np.s_[9:11, 20:23], "6 pixels ")):
    holed = grey.copy()
    holed[at] = -1000
    said, written = dome(holed)
    assert len(bad(said)) == 1 and bad(said)[0].startswith(count) and "20,9" in bad(said)[0], said
    assert abs(said["scale"]["factor"] / scale - 1) < 0.002, (said["scale"], scale)
    assert written.min() > 8, written.min()

# Noise about black keeps its negative half, else the dark would shine; so do colours beyond the primaries.
for dark in (grey * np.where(np.arange(32) < 16, 1, 0)[:, None, None], grey * 0):
    noisy = dark + random.normal(0, 0.3, (32, 64, 1))
    noisy[4, 7] = 500
    said, written = dome(noisy)
    assert not bad(said) and written.min() < 0, said
said, written = dome(grey * np.array([-0.3, 1.2, 1.0]))
assert not bad(said) and written.min() < 0, said
