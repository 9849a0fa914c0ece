# SPDX-License-Identifier: Apache-2.0
"""A black level that is off by a code in fifteen thousand bends no sensor: what reaches .6 of full scale in the
shortest frame is not called saturated, and its sigma is its noise. A sensor that does bend is still seen. By numpy,
without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_dng import BLACK, WHITE, write_dng  # noqa: E402
from plain_exr import read_exr  # noqa: E402

H, W, FULL = 160, 240, 40000.0
TIMES = [2.0**-11 * 4**i for i in range(7)]
levels = np.exp(np.random.default_rng(1).permutation(np.linspace(np.log(0.6e-6), np.log(0.6), 48))).reshape(6, 8)
scene = np.kron(levels, np.ones((26, 30)))[:H, :W]
scene = np.pad(scene, ((0, H - scene.shape[0]), (0, W - scene.shape[1])), "edge") / TIMES[0]


def merged(seed, black, knee=1.0):
    random = np.random.default_rng(seed)
    pixels = 1 + 0.005 * random.standard_normal(scene.shape)
    files = []
    for i, time in enumerate(TIMES):
        light = scene * pixels * time * np.exp(0.01 * random.standard_normal())
        seen = (random.poisson(np.clip(light, 0, 3) * FULL) + 4 * random.standard_normal(light.shape)) / FULL
        if knee < 1.0:
            over = np.maximum(seen - knee, 0.0)
            seen = np.where(seen > knee, knee + (1 - knee) * (1 - np.exp(-over / (1 - knee))), seen)
        files.append(HOME / f"{i}.dng")
        write_dng(files[-1], np.clip(np.rint(BLACK + black + seen * (WHITE - BLACK)), 0, WHITE).astype("<u2"),
                  time, 8, 100, (1, 1, 1))
    said = answer("merge", *files, "-o", HOME / "l.exr", "--sigma", HOME / "s.exr", "--force", "--uncompressed",
                  "--mains", "none")
    brightest = scene == scene.max()
    luminance, sigma = read_exr(HOME / "l.exr"), read_exr(HOME / "s.exr")
    codes = [warning["code"] for warning in said.get("warnings", [])]
    return codes, np.median((sigma / luminance)[brightest]), said["clipped_fraction"]


for black in (0.0, 0.5, 1.0, -1.0, 1.5, 2.0, 3.0):
    for seed in range(6):
        codes, sigma, clipped = merged(seed, black)
        assert "clipped" not in codes and clipped == 0.0, (black, seed, codes, clipped)
        assert "light_changed" not in codes, (black, seed)
        assert sigma < 0.02, (black, seed, sigma)
# The brightest lies on the knee.
for seed in range(3):
    codes, sigma, clipped = merged(seed, 0.0, knee=0.52)
    assert clipped > 0.0, (seed, clipped)
