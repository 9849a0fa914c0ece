# SPDX-License-Identifier: Apache-2.0
"""What `lightcal merge` puts where an EXR frame holds no number: one pixel is bridged within its sigma, and of a hole,
before which a lamp may have stood, sigma says that nobody saw it. By numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from usdlux import write_exr  # noqa: E402

H, W = 48, 64
random = np.random.default_rng(20261129)
y, x = np.mgrid[:H, :W]
world = 5 + 0.5 * np.sin(x / 9.0) + 0.02 * x
holes = [(slice(10, 18), slice(20, 40)), (slice(30, 36), slice(0, 6)), (slice(40, 41), slice(50, 53))]
for hole in holes:
    world[hole] *= 1.7
files = []
for i, time in enumerate((1.0, 4.0)):
    seen = random.normal(world * time, 0.01 * np.sqrt(world * time))
    for hole in holes:
        seen[hole] = np.nan
    seen[5, 5] = np.nan
    files.append(HOME / f"{i}.exr")
    write_exr(files[-1], np.repeat(seen[..., None], 3, -1))
said = answer("merge", *files, "-o", HOME / "o.exr", "--sigma", HOME / "s.exr", "--exposures", "1,4", "--f-number", "8",
              "--iso", "100", "--mains", "none", "--anchor", f"50,20,8,6={world[20:26, 50:58].mean():.6g}")
assert "bad_samples" in [w["code"] for w in said["warnings"]], said
found, sigma = (p[..., 0] if p.ndim == 3 else p for p in (read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr")))
for hole in holes:
    held = np.mean(np.abs(found - world)[hole] < 1.96 * sigma[hole])
    print(f"a hole of {found[hole].shape}: {100 * held:.0f} % held, sigma {100 * np.median(sigma[hole] / found[hole]):.0f} %")
    assert held > 0.95, (hole, held)
assert abs(found[5, 5] / world[5, 5] - 1) < 0.1 and sigma[5, 5] < 0.1 * found[5, 5], (found[5, 5], sigma[5, 5])
whole = np.ones((H, W), bool)
for hole in (*holes, (5, 5)):
    whole[hole] = False
assert np.median(sigma[whole] / found[whole]) < 0.02
