# SPDX-License-Identifier: Apache-2.0
"""A merge by a camera's profile that knows no flat field says what the lens loses in the corners; one with a flat
field does not, nor a session, whose budget holds it. A card that only grows darker away from the picture's middle is
told so. By numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402
from plain_dng import mosaic, write_dng  # noqa: E402

H, W = 240, 360
random = np.random.default_rng(65)
y, x = np.mgrid[:H, :W]
radius = np.hypot(x - W / 2 + 0.5, y - H / 2 + 0.5) / (W / 2)
lens = (1 + (radius * np.tan(np.radians(65 / 2))) ** 2) ** -2  # cos^4 of a field of 65 degrees


def shoot(folder, scene):
    (HOME / folder).mkdir(parents=True, exist_ok=True)
    for i in range(4):
        light = np.repeat((scene * lens * 4.0**i)[..., None], 3, -1)
        noisy = random.normal(light, np.sqrt(np.maximum(light, 0) / 40000 + 1e-8))
        write_dng(HOME / folder / f"{i}.dng", mosaic(np.clip(noisy, 0, 1)), 0.001 * 4**i, 4, 100, (1, 1, 1))


def card(left, top):
    scene = np.full((H, W), 0.03)
    scene[top:top + 50, left:left + 80] = 0.08
    return scene


scale = """lightcal = 1
name = "cam"
[[camera_frames]]
use = "scale"
frames = "captures/*.dng"
rect = [145, 100, 70, 40]
luminance_nits = 100
sigma_relative = 0.02
"""
shoot("cal/captures", card(140, 95))
shoot("cal/flat", np.full((H, W), 0.05))
for name, more in (("bare", ""), ("flat", '[[camera_frames]]\nuse = "flat"\nframes = "flat/*.dng"\n')):
    (HOME / "cal/session.toml").write_text(scale + more)
    run("camera", "cal", "-o", f"{name}.json", "--force")


def lost(*more):
    said = answer("merge", *(HOME / "cal/captures").glob("*.dng"), "-o", "l.exr", "--force", "--mains", "none", *more)
    return [w["message"] for w in said.get("warnings", []) if w["code"] == "vignetting_unknown"]


said, = lost("--camera", "bare.json")
assert "54 %" in said and "34 degrees" in said and "--cos4" in said, said
assert not lost("--camera", "flat.json") and not lost()


def session(folder, left, top, width, height):
    (HOME / folder / "camera.json").write_bytes((HOME / "bare.json").read_bytes())
    (HOME / folder / "session.toml").write_text(f"""lightcal = 1
name = "card"
[room]
dark = true
[[light]]
name = "lamp"
kind = "point"
[[capture]]
light = "lamp"
frames = "captures/*.dng"
use = "card"
reflectance = 0.18
distance_m = 0.8
rect = [{left}, {top}, {width}, {height}]
camera = "camera.json"
""")
    return folder


shoot("middle/captures", card(140, 95))
codes = [w["code"] for w in answer("fit", session("middle", 145, 100, 70, 40)).get("warnings", [])]
assert "vignetting_unknown" not in codes, codes
# A large card to the side: 10 % and more by the lens alone.
side = np.full((H, W), 0.03)
side[40:200, 180:358] = 0.08
shoot("side/captures", side)
refused("card_uneven", "fit", session("side", 190, 50, 160, 140), says="vignetting.*flat field")
# One whose edge is in the rect is told to give its place, and no more.
error = refused("card_uneven", "fit", session("middle", 100, 70, 90, 60), says="give its place")
assert "vignetting" not in error["message"], error
