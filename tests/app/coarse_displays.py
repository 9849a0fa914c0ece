#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""quick of meters that show whole lux, or tens of lux: what rounding took stands in the interval,
and plan knows the display by which fit did, where several lamps' figures together tell it.

usage: coarse_displays.py LIGHTCAL
"""
import json
import pathlib
import subprocess
import sys
import tempfile

from other_light import Held, answer, room, typed


# Of neither lamp's two figures alone is a step of 10 lx to be known.
TENS = """lightcal = 1
[room]
dark = true
[[meter]]
name = "m"
sigma_relative = 0.02
""" + "".join(f"""[[light]]
name = "{name}"
kind = "point"
fixture = "bulb"
""" + "".join(f"""[[reading]]
light = "{name}"
meter = "m"
distance_m = {d}
illuminance_lx = {e}
""" for d, e in rows) for name, rows in (("key", ((1, 1390), (3, 150))), ("fill", ((.5, 1240), (1, 310)))))


def plans_from_what_fit_told(lightcal):
    with tempfile.TemporaryDirectory() as folder:
        session = pathlib.Path(folder) / "tens"
        session.mkdir()
        (session / "session.toml").write_text(TENS)

        def answered(*words):
            done = subprocess.run([lightcal, *words, "--json"], capture_output=True, text=True, check=True)
            return json.loads(done.stdout)

        planned = {light["name"]: light["u95_relative"] for light in answered("plan", str(session))["lights"]}
        for light in answered("fit", str(session))["lights"]:
            fitted = light["intensity_cd"]["u95"] / light["intensity_cd"]["value"]
            now = planned[light["name"]]
            assert abs(now / fitted - 1) < .03, (light["name"], now, fitted)


def main():
    lightcal = sys.argv[1]
    plans_from_what_fit_told(lightcal)
    cards = {"no card": (), "a card at 2 m": (2,), "a card at each place": (0, 1, 2)}
    lamps = (("candles in whole lux", 1, (1, 3)), ("bulbs in tens of lux", 10, (20, 100)))
    for what, step, candela in lamps:
        for name, card in cards.items():
            held = Held()
            for seed in range(30):
                places, truth = room(seed, 1., day=0., candela=candela, step=step)
                words = typed(places, (), card)
                # Fewer than three different tens may be a display of whole lux.
                if step == 10 and len({x for i, p in enumerate(places)
                                       for x in (p[0], p[2] if i in card else 0) if x > 0}) < 3:
                    continue
                held.add(answer(lightcal, words), truth, words)
            held.check(f"{what}, {name}", 2, .5)
    told = answer(lightcal, ["140lx@0.5m", "40lx@1m", "10lx@2m,card=10lx"])
    assert told[1] < 32 < told[2], told


if __name__ == "__main__":
    main()
