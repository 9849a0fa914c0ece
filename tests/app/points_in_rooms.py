#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""simulate at points of a session with [room]: what a meter reads there stands beside the model.

usage: points_in_rooms.py LIGHTCAL

A bulb read at .5, 1 and 2 m in a room of stated size. What a meter reads in it at 1 and 2 m is known
by its readings there, to a third more than the meter and its repeatability say at the most, whether
or not the room is stated; a column of the lamp with walls is called that. A luminaire whose file is
brightest beside its axis is told below it what was read there. Knows nothing of
lightcal's code.
"""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

LAMP = '''[[light]]
name = "key"
kind = "point"
fixture = "bulb"
'''
READ = "".join(f'[[reading]]\nlight = "key"\ndistance_m = {d}\nilluminance_lx = {e}\n'
               for d, e in ((0.5, 203), (1, 58), (2, 20)))
ROOM = "[room]\nsize_m = [5, 4, 2.6]\nreflectance = 0.5\n"


OFFICE = '''[[meter]]
name = "class B"
sigma_relative = 0.03
[[light]]
name = "inset"
kind = "photometric"
fixture = "luminaire"
distribution = "inset.ldt"
position_m = [0, 0, 2.75]
aim = [0, 0, -1]
''' + "".join(f'[[reading]]\nlight = "inset"\nmeter = "class B"\nposition_m = {p}\nnormal = [0, 0, 1]\n'
                f"illuminance_lx = {e}\n" for p, e in (("[0, 0, 0]", 236), ("[0, 0, 0.75]", 416), ("[1, 0, 0.75]", 543)))
OFFICE_ROOM = "[room]\nsize_m = [6, 4, 2.8]\nreflectance = 0.5\n"
LDT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../sample_data/photometric/sample2.ldt")


def below_inset(lightcal, folder, room):
    shutil.copy(LDT, os.path.join(folder, "inset.ldt"))
    path = os.path.join(folder, "office.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write("lightcal = 1\n" + room + OFFICE)
    line = [lightcal, "simulate", path, "--at", "0,0,0.75", "--normal", "up", "--json"]
    return json.loads(subprocess.run(line, capture_output=True, text=True, check=True).stdout)["points"][0]


def points(lightcal, folder, room, *more):
    path = os.path.join(folder, "one.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write("lightcal = 1\n" + room + LAMP + READ)
    line = [lightcal, "simulate", path, "--position", "0,0,1.2", "--at", "1,0,1.2", "2,0,1.2",
            "--normal", "lamp", *more]
    return (json.loads(subprocess.run(line + ["--json"], capture_output=True, text=True, check=True).stdout),
            subprocess.run(line, capture_output=True, text=True, check=True).stdout)


def main():
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        plain, plain_text = points(sys.argv[1], folder, "")
        stated, text = points(sys.argv[1], folder, ROOM)
        for room in ("", OFFICE_ROOM):
            u = below_inset(sys.argv[1], folder, room)["in_room_lx"]
            if not u["low95"] < 416 < u["high95"]:
                failures.append(f"below an inset {'with' if room else 'without'} [room]: {u}, not 416")
        other, _ = points(sys.argv[1], folder, ROOM, "--room", "6,6,3")
    for before, after, read in zip(plain["points"], stated["points"], (58, 20)):
        if "in_room_lx" not in after:
            failures.append("no in_room_lx of a session with [room]")
            continue
        width = {}
        for name, point in (("plain", before), ("stated", after)):
            u = point["in_room_lx"]
            width[name] = math.log(u["high95"] / u["low95"])
            if not u["low95"] < read < u["high95"]:
                failures.append(f"{name}: {u} does not hold what was read, {read}")
        if width["stated"] > 1.02 * width["plain"]:
            failures.append(f"a stated room widens what a meter reads in it: {width}")
    if "lamp and walls (95 %)" not in text or "lamp alone (95 %)" not in plain_text:
        failures.append("the two quantities bear one name")
    if any("in_room_lx" in point for point in other["points"]):
        failures.append("readings in one room are told of another")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
