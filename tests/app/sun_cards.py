# SPDX-License-Identifier: Apache-2.0
"""A grey card in the sun: it stands at no distance from it, and daylight neither pulses nor follows the mains. A lamp
needs its distance, and may flicker."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402
from plain_png import write_png  # noqa: E402

LUX = 44000.0
rng = np.random.default_rng(20261130)
nits = LUX * 0.18 / np.pi
for i, time in enumerate((1 / 4000, 1 / 1000, 1 / 250)):
    # ISO 12232: a saturated pixel at 78 lx s of the focal plane over ISO; lens .65/N^2.
    codes = nits * 0.65 / 8**2 * time * 100 / 78 * 65535 * (1 + 0.005 * rng.standard_normal((60, 80)))
    write_png(HOME / f"{i}.png", np.repeat(np.round(np.minimum(codes, 65535))[..., None], 3, -1).astype(np.uint16))
FRAMES = ('[[capture]]\nlight = "key"\nframes = "*.png"\nuse = "card"\nreflectance = 0.18\nresponse = "linear"\n'
          "exposure_s = [0.00025, 0.001, 0.004]\nf_number = 8\niso = 100\nrect = [10, 10, 60, 40]\n")


def session(kind, lamp_class):
    (HOME / "session.toml").write_text(f'lightcal = 1\n[room]\noutdoors = true\n[[light]]\nname = "key"\nkind = "{kind}"\n'
                                       f'lamp_class = "{lamp_class}"\n' + FRAMES)


def flickers():
    light = answer("fit", HOME)["lights"][0]
    value = light["illuminance_lx"]
    assert value["low95"] < LUX < value["high95"], value
    return {part["name"] for part in light["budget"]} & {"rolling_shutter", "flicker", "mains", "warm_up"}


session("directional", "daylight")
assert flickers() == set(), flickers()
session("directional", "white_led")
assert "rolling_shutter" in flickers(), flickers()
session("point", "white_led")
said = run("fit", HOME, code=3).stderr
assert "distance_m is missing" in said, said
