#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A meter turned nearly edgewise to the lamp reads its walls, whose light no cosine dims: that is no slip of units,
and the lamp is answered by the truth. A slip beside such a reading is still named.

    grazing_meters.py LIGHTCAL
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402

CANDELA = 116.0
WALLS_LX = 9.1  # of a room that spreads the bulb's light evenly (an integrating sphere)
LAMP = ('lightcal = 1\n[room]\nsize_m = [5.7, 4.7, 2.9]\n[[meter]]\nname = "m"\nsigma_relative = 0.05\n'
        'repeatability_relative = 0.01\n[[light]]\nname = "a"\nkind = "point"\nfixture = "bulb"\n'
        'position_m = [0, 0, 1.4]\n')


def read(metres, tilt_deg, typed_as=1.0):
    tilt = math.radians(tilt_deg)
    lux = CANDELA * max(math.cos(tilt), 0.0) / metres**2 + WALLS_LX
    return (f'[[reading]]\nlight = "a"\nmeter = "m"\nposition_m = [{metres * typed_as}, 0, 1.4]\n'
            f'normal = [{-math.cos(tilt):.7f}, {math.sin(tilt):.7f}, 0]\nilluminance_lx = {lux:.4g}\n')


def session(name, *readings):
    path = HOME / f"{name}.toml"
    path.write_text(LAMP + "".join(readings))
    return path


for tilt_deg in (80, 86.3, 86.8, 88, 89.5):
    near = [read(d, 0) for d in (0.55, 0.7, 0.9, 1.2, 1.7)]
    light = answer("fit", session(f"grazing{tilt_deg}", *near, read(2.7, tilt_deg)))["lights"][0]
    candela = light["intensity_cd"]
    low = candela.get("low95", candela["value"] - candela["u95"])
    high = candela.get("high95", candela["value"] + candela["u95"])
    assert low < CANDELA < high, (tilt_deg, low, high)
    assert light["fit"]["rejected"] == [], (tilt_deg, light["fit"])

slip = session("feet", *(read(d, 0) for d in (0.55, 0.7)), read(0.6, 0, typed_as=1 / 0.3048), read(2.0, 86))
refused("units_ambiguous", "fit", slip, says="reading 2 .*feet")
