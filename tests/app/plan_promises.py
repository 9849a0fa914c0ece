#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A plan's promise comes where the meter shows what it expects, also of a softbox, whose distances may be from its
mount or from its front: what lies between the two is no reading to expect.

    plan_promises.py LIGHTCAL
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402


def lamp(room, read):
    return ('lightcal = 1\n' + room + '[[meter]]\nname = "m"\nsigma_relative = 0.02\nrepeatability_relative = 0.005\n'
            '[[light]]\nname = "key"\nkind = "rect"\nfixture = "softbox"\nsize_m = [0.9, 0.6]\n' + read)


def reading(metres, lux):
    return f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {metres:.9g}\nilluminance_lx = {lux:.9g}\n'


session = HOME / "softbox.toml"
for room in ("", "[room]\nsize_m = [5, 4, 2.6]\n"):
    for metres in (1.0, 2.0):
        text = lamp(room, reading(metres, 100.0))
        session.write_text(text)
        step = answer("plan", session, "--steps", "1")["lights"][0]["steps"][0]
        assert step["action"] == "read", step
        session.write_text(text + reading(step["distance_m"], step["expected_lx"]))
        candela = answer("fit", session)["lights"][0]["intensity_cd"]
        half = (candela.get("high95", candela["value"] + candela["u95"]) -
                candela.get("low95", candela["value"] - candela["u95"])) / 2 / candela["value"]
        assert abs(half / step["u95_relative"] - 1) < 0.05, (room, metres, step, candela)
