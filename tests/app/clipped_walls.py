# SPDX-License-Identifier: Apache-2.0
"""A wall's picture in cd/m2 that was cut off flat at .6 of its peak may be clipped, and is said to be; whole it is not.
The sample's own picture, cut off by numpy. Written without a header of lightcal."""
import pathlib
import shutil
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from usdlux import write_exr  # noqa: E402

SAMPLE = pathlib.Path(__file__).resolve().parents[2] / "sample_data/sessions/lit_wall"
shutil.copytree(SAMPLE, HOME / "wall")
whole = read_exr(SAMPLE / "captures/wall.exr")
for share in (1.0, 0.6):
    write_exr(HOME / "wall/captures/wall.exr",
              np.repeat(np.minimum(whole, share * whole.max())[..., None], 3, -1), white_luminance=1.0)
    said = answer("fit", HOME / "wall", "-o", HOME / "wall.json", "--force")
    codes = [warning["code"] for warning in said.get("warnings", [])]
    assert ("maybe_clipped" in codes) == (share < 1), (share, codes)
