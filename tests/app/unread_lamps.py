#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lamps that nobody read are named all at once, and what a refusal tells to type leaves an answer.

    unread_lamps.py LIGHTCAL
"""
import pathlib
import re
import shlex
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402

NAMES = ["key", "fill", "back"]


def session(name, *readings):
    path = HOME / f"{name}.toml"
    path.write_text("lightcal = 1\n[room]\ndark = true\n" +
                    "".join(f'[[light]]\nname = "{lamp}"\nkind = "point"\nfixture = "bulb"\n' for lamp in NAMES) +
                    "".join(f'[[reading]]\nlight = "{lamp}"\n{rest}\n' for lamp, rest in readings))
    return path


none = session("none")
error = refused("no_readings", "fit", none)
assert [error["subject"]] + [other["subject"] for other in error["others"]] == NAMES, error
assert "--without" not in run("fit", none, code=3).stderr

some = session("some", ("back", "distance_m = 1.0\nilluminance_lx = 50.0"))
assert [light["name"] for light in answer("fit", some)["lights"]] == ["back"]

# One whose readings are refused, one unread, one read: what is told to type answers.
odd = session("odd", ("key", "distance_m = 1.0\nilluminance_lx = 10.0"),
              ("key", "distance_m = 2.0\nilluminance_lx = 90.0"),
              ("back", "distance_m = 1.0\nilluminance_lx = 50.0"))
said = run("fit", odd, code=3).stderr
advice = re.search(r"answered by (--without \S+)", said)
assert advice, said
assert "back" in [light["name"] for light in answer("fit", odd, *shlex.split(advice[1]))["lights"]]
