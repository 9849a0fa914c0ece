#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A clipped light has not the colour of the sky around it. The world: a blue sky with a glow about a small sun, all
that is beyond the limit cut off; and a lamp whose blurred edge, below the limit, still shows its colour.

    clipped_suns.py LIGHTCAL
"""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from usdlux import write_exr  # noqa: E402

H = 256
PITCH = np.pi / H
AZIMUTH, POLAR = np.meshgrid((np.arange(2 * H) + 0.5) * PITCH - np.pi, (np.arange(H) + 0.5) * PITCH)
WAY = np.stack([np.sin(POLAR) * np.sin(AZIMUTH), np.sin(POLAR) * np.cos(AZIMUTH), np.cos(POLAR)], -1)
OMEGA = np.sin(POLAR) * PITCH ** 2
SUN = np.array([np.cos(0.7), 0.0, np.sin(0.7)])
ANGLE = np.degrees(np.arccos(np.clip(WAY @ SUN, -1, 1)))
Y709 = np.array([0.2126, 0.7152, 0.0722])
BLUE, WARM = (np.array(c) / (Y709 @ c) for c in ([0.85, 1.0, 1.35], [1.3, 1.0, 0.4]))


def up(luminance):
    return float((luminance * np.clip(WAY[..., 2], 0, None) * OMEGA).sum())


def dome(name, light, clip):
    sky = np.where(WAY[..., 2] > 0, 3000 + 9000 * np.exp(-ANGLE / 12), 1000.0)
    whole = sky[..., None] * BLUE + light[..., None] * WARM
    write_exr(HOME / f"{name}.exr", np.minimum(whole, clip))
    return answer("dome", HOME / f"{name}.exr", "--lux", f"{up(sky + light):.6g}", "--lux-shaded", f"{up(sky):.6g}",
                  "--clip", f"{clip:g}", "--extract", 1, "-o", HOME / name)


sun = dome("sun", np.where(ANGLE < 0.6, 5e7, 0.0), 1e5)
assert abs(sun["lights"][0]["illuminance_lx"]["value"] / (5e7 * (OMEGA * (ANGLE < 0.6)).sum()) - 1) < 0.1, sun
assert "color" not in sun["lights"][0], sun["lights"][0]["color"]
assert "clipped_color" in [w["code"] for w in sun["warnings"]], sun["warnings"]

lamp = dome("lamp", 4e6 * np.exp(-0.5 * (ANGLE / 1.2) ** 2), 1e6)["lights"][0]
x, y, z = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ WARM
assert np.allclose(lamp["color"]["xy"], [x / (x + y + z), y / (x + y + z)], atol=0.004), lamp["color"]
