#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plan foretells a card of a lamp read by `lit` as of the same lamp read by itself.

usage: lit_plan.py LIGHTCAL
"""
import json
import pathlib
import subprocess
import sys
import tempfile

FILL = '[[light]]\nname = "fill"\nkind = "point"\nfixture = "bulb"\nposition_m = [2, 1, 1.5]\n'
KEY = '[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\nposition_m = [0, 0, 1.5]\n'
METER = '[[meter]]\nname = "m"\nsigma_relative = 0.05\n'
PLACE = 'position_m = [1, -1, 1]\nnormal = [0, 0, 1]\n'
BOTH = f'[[reading]]\nlit = ["key", "fill"]\n{PLACE}illuminance_lx = 20\n'
BY_LIT = f'[[reading]]\nlit = ["fill"]\n{PLACE}illuminance_lx = 9\n'
ALONE = f'[[reading]]\nlight = "fill"\n{PLACE}illuminance_lx = 9\n'
OF_KEY = '[[reading]]\nlight = "key"\ndistance_m = 1\nilluminance_lx = 50\n'


def run(lightcal, folder, command, session):
    path = folder / "session.toml"
    path.write_text("lightcal = 1\n" + session)
    return subprocess.run([lightcal, command, str(path), "--json"], capture_output=True, text=True)


def card_of_fill(lightcal, folder, session):
    document = json.loads(run(lightcal, folder, "plan", session).stdout)
    fill = next(light for light in document["lights"] if light["name"] == "fill")
    card = next(step for step in fill["candidates"] if step["action"] == "shadow_card")
    return card["expected_lx"], card["u95_relative"]


def main():
    lightcal = sys.argv[1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        alone = card_of_fill(lightcal, folder, FILL + METER + ALONE)
        for lit in (BOTH + BY_LIT, BY_LIT + BOTH):
            told = card_of_fill(lightcal, folder, KEY + FILL + METER + lit + OF_KEY)
            assert abs(told[0] - alone[0]) < .3 and abs(told[1] - alone[1]) < .1, (told, alone)
        assert alone[0] > 5, "bulbs send more to walls than to a meter at such an angle"
        # What the plan asks for is told how to be written, and can be.
        wrong = BY_LIT.replace("illuminance", "shadow_card = true\nilluminance")
        said = run(lightcal, folder, "validate", FILL + METER + BY_LIT + wrong)
        assert said.returncode != 0 and "light = \\\"key" in said.stdout, said
        right = ALONE.replace("9", "7").replace("illuminance", "shadow_card = true\nilluminance")
        said = run(lightcal, folder, "plan", KEY + FILL + METER + BOTH + BY_LIT + OF_KEY + right)
        assert said.returncode == 0, said
        print("alone and by lit:", alone)


if __name__ == "__main__":
    main()
