# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge` of 8 bit brackets whose dark parts lie in the lowest codes: what sigma says holds there, where
codes are coarse and black is cut off, and a curve with a straight toe (sRGB) is followed into it. By numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from code_camera import shoot, srgb  # noqa: E402
from plain_exr import read_exr  # noqa: E402

TIMES = [1 / 500, 1 / 60, 1 / 8]
SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 4  # of few nothing but that they are merged is judged
FULL = 600.0  # light that the longest frame's highest code shows


def power(signal):
    return signal ** (1 / 2.2)


def film(signal):
    return signal**0.9 / (signal**0.9 + 0.18) * 1.18


def plane(path):
    picture = read_exr(path)
    return picture[..., 0] if picture.ndim == 3 else picture


def dark_bands(curve, seed):
    """Of each band of light: median ratio to the truth and the share within two sigma."""
    rng = np.random.default_rng([29, seed])
    low, high = 0.2, 3000.0
    steps = np.exp(rng.uniform(np.log(low), np.log(high), (8, 12)))
    y, x = np.mgrid[:96, :144]
    light = steps[y // 12, x // 12] * (1 + 0.2 * np.sin(x / 5.0) * np.cos(y / 7.0))
    files = shoot("dark", np.repeat(light[..., None], 3, -1), [t / TIMES[-1] / FULL for t in TIMES], curve, rng)
    answer("merge", *files, "-o", HOME / "d.exr", "--sigma", HOME / "s.exr", "--force", "--f-number", "8", "--iso", "100",
           "--mains", "none", "--exposures", ",".join(map(repr, TIMES)))
    found, sigma = plane(HOME / "d.exr"), plane(HOME / "s.exr")
    scale = np.median((found / light)[light > 50])
    bands = []
    for start, end in ((0.2, 0.5), (0.5, 1), (1, 2), (2, 4)):
        inside = (light >= start) & (light < end)
        ratio = found[inside] / scale / light[inside]
        within = np.abs(found[inside] / scale - light[inside]) < 2 * sigma[inside] / scale
        bands.append((np.median(ratio), np.mean(within)))
    return np.array(bands)


for shape in (srgb, power, film):
    mean = np.mean([dark_bands(shape, seed) for seed in range(SEEDS)], 0)
    print(shape.__name__, "median ratio", np.round(mean[:, 0], 2), "within two sigma", np.round(mean[:, 1], 2))
    assert len(sys.argv) > 2 or np.all(mean[:, 1] > 0.85), (shape.__name__, mean)
    assert len(sys.argv) > 2 or np.all(np.abs(mean[1:, 0] - 1) < 0.2), (shape.__name__, mean)
