# SPDX-License-Identifier: Apache-2.0
"""A spot reading whose place shows unlike light is named, and the scale is as unsure as where the meter's circle lay;
fine texture averages out and is not. By numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from usdlux import write_exr  # noqa: E402

H, W = 64, 96
random = np.random.default_rng(20261129)
y, x = np.mgrid[:H, :W]
world = np.where(x < 48, 50.0, 150.0) * (1 + 0.3 * np.sin(2.0 * x) * np.sin(2.2 * y))
files = []
for i, time in enumerate((1.0, 4.0)):
    files.append(HOME / f"{i}.exr")
    write_exr(files[-1], np.repeat(random.normal(world * time, 0.01 * np.sqrt(world * time))[..., None], 3, -1))


def anchored(*place):
    said = answer("merge", *files, "-o", HOME / "o.exr", "--force", "--exposures", "1,4", "--f-number", "8", "--iso", "100",
                  "--mains", "none", "--anchor", ",".join(map(str, place)) + "=100", "--anchor-sigma", "2%")
    return said["scale"]["u95_relative"], "anchor_uneven" in [w["code"] for w in said.get("warnings", [])]


u95, uneven = anchored(10, 10, 30, 30)
assert u95 < 0.06 and not uneven, (u95, uneven)
u95, uneven = anchored(33, 10, 30, 30)
# A quarter of the spot aside, the meter has three quarters of one half: 125 of 100.
assert u95 > 0.25 and uneven, (u95, uneven)
print(f"over an edge of 1 : 3 the scale is +- {100 * u95:.0f} %")
