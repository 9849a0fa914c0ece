# SPDX-License-Identifier: Apache-2.0
"""A disc of even light in PNG frames as a source: its edge, where codes are least sure, is not taken for clipping. By
numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from code_camera import shoot, srgb  # noqa: E402

# A plain disc: 249 is its code in the longest frame and the highest of all. Nothing is clipped.
WIDTH, HEIGHT, FOCAL = 320, 240, 600.0
RADIUS, NITS, BEHIND = 0.05, 5000.0, 30.0
rows, columns = np.mgrid[:4 * HEIGHT, :4 * WIDTH]
far = np.hypot((columns + 0.5) / 4 - WIDTH / 2, (rows + 0.5) / 4 - HEIGHT / 2) / FOCAL
disc = np.where(far < RADIUS, NITS, BEHIND).reshape(HEIGHT, 4, WIDTH, 4).mean((1, 3))
colour = np.array([1.05, 1.0, 0.85])
longest = (((249 / 255 + 0.055) / 1.055) ** 2.4) / NITS / 1.05
frames = shoot("disc", disc[..., None] * colour, [longest * 2.0 ** (i - 7) for i in range(8)], srgb, np.random.default_rng(5))
candela = NITS * np.pi * RADIUS**2 * (colour @ [0.2126, 0.7152, 0.0722])
session = HOME / "session.toml"
session.write_text(f"""lightcal = 1
[room]
dark = true
[[light]]
name = "panel"
kind = "disk"
[[capture]]
light = "panel"
frames = "disc*.png"
exposure_s = [{", ".join(repr(2.0**i / 16000) for i in range(8))}]
f_number = 8
iso = 100
use = "source"
distance_m = 1.0
fov_deg = {2 * np.degrees(np.arctan(WIDTH / 2 / FOCAL))!r}
lamp_class = "tungsten"
anchor_illuminance_lx = {candela!r}
""")
fitted = answer("fit", session, "-o", HOME / "light.json")
assert not [w for w in fitted.get("warnings", []) if w["code"] == "exposure_off"], fitted["warnings"]
panel = fitted["lights"][0]["intensity_cd"]
print(f"a plain disc: {panel['value']:.1f} +- {panel['u95']:.1f} cd of {candela:.1f}")
assert abs(panel["value"] / candela - 1) < 0.03, panel
