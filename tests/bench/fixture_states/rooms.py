#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Do the intervals of a dimmed lamp hold it in rooms that lightcal did not make, wherever each state was read?

    rooms.py LIGHTCAL [ROOMS]      60 rooms a line; fails where a line holds under 87 %

Rooms: tests/tools/traced_rooms (no header of lightcal); bulbs and panels of known fixture, one meter of 3 % in
common (1 sigma) and 1 % a reading, the lamp's light starting where its fixture's statistics say. Full is read at
some distances, 50, 25 and 10 % (which give .45, .2 and .06 of it) at others. A line a session: how often candela and
part of full of the states read were held, and their median half widths.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "rooms"))
from traced_table import DISTANCES, draw_offset, read_table  # noqa: E402

CANDELA = 600.0
PART = {100: 1.0, 50: 0.45, 25: 0.2, 10: 0.06}
# name: where full was read, where the others
SESSIONS = {"full at .5 1 2 m, states at 1": ((0.5, 1.0, 2.0), (1.0,)),
            "each at .5 1 2 m": ((0.5, 1.0, 2.0), (0.5, 1.0, 2.0)),
            "full at 1 m, states at 2": ((1.0,), (2.0,)),
            "full at .5 1 m, states at 2": ((0.5, 1.0), (2.0,))}


def session(row, places, rng):
    lamp = ['kind = "point"', 'fixture = "bulb"']
    if row["kind"] == "panel":
        lamp = ['kind = "rect"', f'size_m = [{row["width_m"]}, {row["height_m"]}]', 'fixture = "panel"',
                "aim = [1.0, 0.0, 0.0]"]
    lines = ["lightcal = 1", '[[meter]]\nname = "m"\nsigma_relative = 0.03', '[[light]]\nname = "lamp"', *lamp,
             'lamp_class = "white_led"', "minutes_on = 600", "flicker_depth = 0.0"]
    offset, scale = draw_offset(rng, row["kind"]), np.exp(rng.normal(0, 0.03))
    for dimmer, part in PART.items():
        for d in places[dimmer < 100]:
            at = DISTANCES.index(d)
            lux = CANDELA * part * scale * (row["direct"][at] + row["wall"][at]) * np.exp(rng.normal(0, 0.01))
            lines += ["[[reading]]", 'light = "lamp"', 'meter = "m"', f"distance_m = {d - offset:.5f}",
                      f"illuminance_lx = {lux:.6g}", f"state = {{ dimmer = {dimmer} }}"]
    return "\n".join(lines) + "\n"


def judged(interval, truth):
    low = interval.get("low95", interval["value"] - interval["u95"])
    high = interval.get("high95", interval["value"] + interval["u95"])
    return low <= truth <= high, (high - low) / 2 / interval["value"]


def main():
    lightcal, rooms = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60
    faults = []
    print(f"{'lamp':6s} {'session':30s}  candela held, +-    of full held, +-")
    for kind in ("bulb", "panel"):
        rows = [row for row in read_table() if row["kind"] == kind and np.isfinite(row["wall"][:5]).all()]
        for number, (name, places) in enumerate(SESSIONS.items()):
            rng = np.random.default_rng([2026, 11, 28, number])
            found = []
            with tempfile.TemporaryDirectory() as folder:
                light = pathlib.Path(folder) / "light.json"
                for row in rows[:rooms]:
                    (pathlib.Path(folder) / "session.toml").write_text(session(row, places, rng))
                    subprocess.run([lightcal, "fit", folder, "-o", light, "--quiet", "--force"], check=True,
                                   capture_output=True)
                    for dimmer in list(PART)[1:]:
                        said = subprocess.run([lightcal, "state", light, "--at", f"dimmer={dimmer}", "--json"],
                                              check=True, capture_output=True).stdout
                        answer = json.loads(said)
                        found.append((*judged(answer["intensity_cd"], CANDELA * PART[dimmer]),
                                      *judged(answer["relative_to_full"], PART[dimmer])))
            share, half = 100 * np.mean(found, axis=0), 100 * np.median(found, axis=0)
            print(f"{kind:6s} {name:30s}  {share[0]:5.1f} %  {half[1]:5.1f} %      {share[2]:5.1f} %  "
                  f"{half[3]:5.1f} %", flush=True)
            if min(share[0], share[2]) < 87:
                faults.append(f"{kind}, {name}")
    for fault in faults:
        print(f"does not hold: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
