# SPDX-License-Identifier: Apache-2.0
"""A camera that writes codes of 8 bits, by numpy: photons, read noise, a response curve, rounding."""
import numpy as np
from built_command import HOME
from plain_png import write_png

ELECTRONS, READ_NOISE = 20_000.0, 3.0  # at the highest code


def srgb(signal):
    return np.where(signal <= 0.0031308, 12.92 * signal, 1.055 * signal ** (1 / 2.4) - 0.055)


def shoot(name, light, signals_per_light, curve, rng):
    files = []
    for i, scale in enumerate(signals_per_light):
        electrons = rng.poisson(np.minimum(light * scale, 2) * ELECTRONS) + rng.normal(0, READ_NOISE, light.shape)
        codes = np.round(255 * curve(np.clip(electrons / ELECTRONS, 0, 1))).astype(np.uint8)
        files.append(HOME / f"{name}{i}.png")
        write_png(files[-1], codes if codes.ndim == 3 else np.repeat(codes[..., None], 3, -1))
    return files
