#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A preset is held against its readings less the walls' part, whether a reading says its distance or its place: the
same readings told both ways are checked alike.

    places_and_walls.py LIGHTCAL
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

READ = ((0.5, 203.0), (1.0, 58.0), (2.0, 20.0))  # 48 cd and what grey walls add
LAMP = ('lightcal = 1\n[room]\nsize_m = [5, 4.4, 2.8]\nreflectance = 0.5\n[[light]]\nname = "a"\nkind = "point"\n'
        'fixture = "bulb"\nposition_m = [0, 0, 1.4]\n')


def checked(name, row):
    session = HOME / f"{name}.toml"
    session.write_text(LAMP + "".join(f'[[reading]]\nlight = "a"\nilluminance_lx = {lux}\n{row(d)}\n'
                                      for d, lux in READ))
    run("run", session, "--to", "gltf", "-o", HOME / name)
    return answer("check", next((HOME / name).glob("*.gltf")), "--session", session)


by_distance = checked("distance", lambda d: f"distance_m = {d}")
by_place = checked("place", lambda d: f"position_m = [{d}, 0, 1.4]\nnormal = [-1, 0, 0]")
assert by_distance["rms_relative"] < 0.02, by_distance
assert by_place["rms_relative"] < 0.02, by_place
for one, other in zip(by_distance["readings"], by_place["readings"]):
    assert other["walls_lx"] > 0 and abs(other["walls_lx"] / one["walls_lx"] - 1) < 0.1, (one, other)
