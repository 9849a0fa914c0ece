# Written by lightcal: a lamp's thumbnail. Nothing here needs Blender itself.
# SPDX-License-Identifier: Apache-2.0
"""The pool of light on a floor one metre below the lamp: E = I(angle) cos^3(angle), its brightest
place as white, in the lamp's colour."""
import math

import numpy as np

from . import laws

SIDE = 64
REACH = 1.6  # metres from the middle to an edge


def share_by_angle(light, angle):
    """Of the axial intensity; angles in radians, all planes of a table together."""
    kind = light.get('kind')
    if light.get('distribution'):
        table = light['distribution']
        gamma = np.radians(table['vertical_deg'])
        planes = np.array(table['candela'], float).reshape(-1, len(gamma))
        of_angle = planes.mean(axis=0)
        return np.interp(angle, gamma, of_angle, right=0.0) / max(of_angle.max(), 1e-9)
    if kind in ('rect', 'disk'):
        return np.cos(angle)
    if kind == 'spot' and light.get('cone'):
        inner, outer = (math.cos(math.radians(light['cone'].get(key, 0.0)))
                        for key in ('inner_deg', 'outer_deg'))
        return np.clip((np.cos(angle) - outer) / max(inner - outer, 1e-9), 0.0, 1.0) ** 2
    return np.ones_like(angle)


def pixels(light):
    """SIDE x SIDE RGBA, 0 to 1 as shown, rows from below."""
    at = (np.arange(SIDE) + 0.5) / SIDE * 2 * REACH - REACH
    x, y = np.meshgrid(at, at)
    angle = np.arctan(np.hypot(x, y))
    if light.get('kind') == 'dome':
        bright = np.where(y > 0, 0.35 + 0.65 * y / REACH, 0.12)
    elif light.get('kind') == 'directional':
        bright = np.where(np.hypot(x, y) < 0.7 * REACH, 1.0, 0.0)
    else:
        bright = share_by_angle(light, angle) * np.cos(angle) ** 3
        bright = bright / max(bright.max(), 1e-9)
    color, _ = laws.color_of(light)
    out = np.ones((SIDE, SIDE, 4), np.float32)
    out[:, :, :3] = np.clip(bright[:, :, None] * np.array(color), 0.004, 1.0) ** (1 / 2.2)
    return out
