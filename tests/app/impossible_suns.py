# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome` names what no sky has: a light of more than 150 klx, a sun below the horizon. The world:
tests/tools/sun_and_sky.py, read with a meter that lay flat, and its picture turned upside down."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from sun_and_sky import Panorama  # noqa: E402
from usdlux import write_exr  # noqa: E402


def warned(pixels, lux):
    write_exr(HOME / "p.exr", pixels / 5000)
    said = answer("dome", HOME / "p.exr", "--lux", f"{lux:.6g}", "-o", HOME / "d", "--force")
    return {w["code"]: w["message"] for w in said.get("warnings", [])}


def sunny(elevation, lux):
    world = Panorama(128)
    z = world.way[..., 2]
    world.add(np.where(z > 0, 3000 + 2400 * z, 700.0), (0.75, 1.0, 1.45))
    world.add_disc(40, elevation, lux, colour=(1.15, 0.98, 0.75))
    return world


UP = (0, 0, 1)
for elevation, lux in ((35, 60000), (20, 30000), (65, 110000), (0.2, 5000), (50, 137000)):
    world = sunny(elevation, lux)
    said = warned(world.rgb, world.lux(UP))
    assert not {"brighter_than_sun", "sun_below_horizon"} & set(said), (elevation, lux, said)

# Upside down: the meter's lux are those of the ground's luminances then.
world = sunny(35, 60000)
said = warned(world.rgb[::-1], world.lux(UP))
assert "upside down" in said["brighter_than_sun"] and "elevation -34" in said["sun_below_horizon"], said
# Lit as the picture says, it still has its sun below the horizon.
said = warned(world.rgb[::-1], world.lux((0, 0, -1)))
assert "sun_below_horizon" in said, said

# A pond that mirrors the sun that stands above it.
world.add_disc(40, -35, 3000)
said = warned(world.rgb, world.lux(UP))
assert "sun_below_horizon" not in said, said

# A reading of another place: ten times too high.
said = warned(sunny(35, 60000).rgb, 10 * sunny(35, 60000).lux(UP))
assert "brighter_than_sun" in said and "sun_below_horizon" not in said, said
