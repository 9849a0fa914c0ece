# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge` of PNG brackets whose codes are a power of light: linear ones as raw converters
write them, and displays' powers. None is preferred: patches over nine stops come back alike, up to
the one scale that a meter gives. Written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from plain_png import write_png  # noqa: E402

SIDE, ACROSS, DOWN = 32, 8, 5
TIMES = [4.0**i / 1024 for i in range(4)]
ELECTRONS, READ_NOISE = 30_000.0, 6.0  # at the highest code
WITHIN = 0.02


def scene(rng):
    """Patches from .25 to 128, each with a little of a pattern, so that codes between occur."""
    nits = rng.permutation(0.25 * 2.0 ** np.linspace(0, 9, ACROSS * DOWN)).reshape(DOWN, ACROSS)
    y, x = np.mgrid[:DOWN * SIDE, :ACROSS * SIDE]
    wave = 1 + 0.2 * np.sin(x / 5.0) * np.sin(y / 7.0)
    return np.repeat(np.repeat(nits, SIDE, 0), SIDE, 1) * wave


def shoot(light, gamma, top, rng):
    files = []
    for i, time in enumerate(TIMES):
        electrons = rng.poisson(np.minimum(light * time * ELECTRONS / 1.2, 2 * ELECTRONS)).astype(float)
        signal = np.clip((electrons + rng.normal(0, READ_NOISE, light.shape)) / ELECTRONS, 0, 1)
        codes = np.round(top * signal ** (1 / gamma))
        files.append(HOME / f"{gamma}_{top}_{i}.png")
        write_png(files[-1], np.repeat(codes[..., None], 3, -1).astype(np.uint16 if top > 255 else np.uint8))
    return files


def worst_patch(gamma, top):
    rng = np.random.default_rng([23, top, round(10 * gamma)])
    light = scene(rng)
    out = HOME / f"{gamma}_{top}.exr"
    answer("merge", *shoot(light, gamma, top, rng), "-o", out, "--f-number", "8", "--iso", "100", "--mains", "none",
           "--exposures", ",".join(map(repr, TIMES)))
    found = read_exr(out)

    def of_patches(picture):
        return picture.reshape(DOWN, SIDE, ACROSS, SIDE)[:, 6:-6, :, 6:-6].mean((1, 3))

    ratio = of_patches(found) / of_patches(light)
    return float(np.max(np.abs(ratio / np.median(ratio) - 1))), float(np.median(ratio))


for of_gamma, of_top in ((1.0, 65535), (1.8, 65535), (2.2, 65535), (2.2, 255)):
    off, scale = worst_patch(of_gamma, of_top)
    print(f"codes to the power {of_gamma} of {of_top}: worst patch {100 * off:.2f} %")
    assert off < WITHIN, (of_gamma, of_top, off)
    if of_gamma == 1.0:  # linear codes end where the sensor does: 78 lx s/ISO (ISO 12232), q = .65
        full_scale = 78 / 0.65 * 8**2 / 100 / 1.2
        print(f"  linear: {scale / full_scale:.3f} of what the ISO speed promises")
        assert abs(scale / full_scale - 1) < WITHIN, scale
