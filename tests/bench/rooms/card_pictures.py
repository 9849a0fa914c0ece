# SPDX-License-Identifier: Apache-2.0
"""Brackets of a grey card as RAW, by a camera of which nobody states what it is off by."""
import dataclasses
import math

import numpy as np

from plain_dng import mosaic, write_dng

WIDTH, HEIGHT = 96, 64
CARD = (32, 20, 32, 24)  # x, y, width, height
REFLECTANCE, F_NUMBER, ISO = 0.18, 5.6, 100


@dataclasses.dataclass
class Camera:
    gain: float  # luminance that its pictures say over the true one, by the ISO speed
    print_: float  # the card's reflectance over what is printed on it


def photograph(camera, illuminance, light, rng, folder, name):
    """Three frames of the card in `light` (R, G, B as the camera sees it, of 1 lux), in full scales of ISO 12232:
    120 N^2 / (t S) cd/m^2. -> keys of the [[capture]]."""
    nits = illuminance * math.cos(math.radians(rng.uniform(0, 5))) * REFLECTANCE * camera.print_ / math.pi
    scene = np.full((HEIGHT, WIDTH), nits * rng.uniform(0.2, 1.5))
    x, y, width, height = CARD
    scene[y:y + height, x:x + width] = nits
    lost, scattered = rng.uniform(0, 0.04), rng.uniform(0.005, 0.02)
    scene = scene * (1 - lost) + scattered * scene.mean()
    middle = nits * math.exp(rng.uniform(-0.2, 0.2)) / 0.15  # an exposure as a person sets it
    for frame, stops in enumerate((-1.5, 0, 1.5)):
        full_scale = middle * 2.0 ** -stops
        exposure_s = 120 * F_NUMBER**2 / (full_scale * ISO)
        seen = scene / full_scale * camera.gain * math.exp(rng.normal(0, 0.02))
        seen = seen * (1 + rng.normal(0, 0.004, seen.shape))
        write_dng(folder / f"{name}_{frame}.dng", mosaic(seen[..., None] * light), exposure_s, F_NUMBER, ISO,
                  light / light.max())
    return {"frames": f"{name}_*.dng", "rect": list(CARD), "reflectance": REFLECTANCE}
