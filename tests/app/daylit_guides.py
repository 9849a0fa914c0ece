#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A lamp that daylight drowns is not enough: guided reading goes where run says to go, nearer, until the lamp is told.
The world: 64 cd beside 780 lx.

    daylit_guides.py LIGHTCAL
"""
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, run  # noqa: E402

run("new", "hl", "--box", "9W 806lm 2900K", "--accuracy", "3%", "--yes")


def guided(typed):
    done = subprocess.run([LIGHTCAL, "read", "-s", "hl", "--guided", "--until", "3%"], input=typed, text=True,
                          capture_output=True, cwd=HOME, check=False)
    return done.stdout + done.stderr


said = guided("796\n780\n")
assert "Enough" not in said, said
step = re.search(r"3\. Put the meter ([\d.]+) m", said)
assert step, said
assert f"{float(step[1]):g} m" in run("run", "hl").stdout, step[1]
