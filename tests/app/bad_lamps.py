#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A session of twelve lamps, two of them with a number mistyped: every refusal names both, each with
its own cause, and the other ten go on by the line that the refusal says.

    bad_lamps.py LIGHTCAL
"""
import json
import pathlib
import re
import shlex
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

NAMES = [f"lamp {i:02d}" for i in range(1, 13)]
BAD = ["lamp 03", "lamp 07"]


def session(folder, lamps, mistyped=()):
    """Points of 100 ... 1200 cd in a dark room, read at four distances to 2 %."""
    random = np.random.default_rng(7)
    text = ('lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.02\n')
    rows = ""
    for index, name in enumerate(NAMES):
        lux = {d: 100.0 * (index + 1) / d**2 * np.exp(0.01 * random.standard_normal())
               for d in (0.7, 1.0, 2.0, 4.0)}
        if name in mistyped:
            lux[1.0] *= 30.0
        if name not in lamps:
            continue
        text += f'[[light]]\nname = "{name}"\nkind = "point"\nfixture = "panel"\n'
        for d, value in lux.items():
            rows += (f'[[reading]]\nlight = "{name}"\nmeter = "m"\ndistance_m = {d}\n'
                     f'illuminance_lx = {value:.5g}\n')
    (HOME / folder).mkdir()
    (HOME / folder / "session.toml").write_text(text + rows)
    return folder


def refusals_name_every_lamp():
    for line in (["run", "two", "-o", "none"], ["fit", "two", "-o", "none.json"],
                 ["explain", "two"], ["report", "two", "-o", "none.html"],
                 ["simulate", "two", "--at", "0,0,0"]):
        done = run(*line, "--json", code=3)
        error = json.loads(done.stdout)["error"]
        assert (error["code"], error["subject"]) == ("model_misfit", BAD[0]), error
        other, = error["others"]
        assert (other["code"], other["subject"]) == ("model_misfit", BAD[1]), error
        causes = [re.search(r"reading \d \(([\d.]+) lx", one["message"])[1]
                  for one in (error, other)]
        # Their own: thirty times 300 and 700 lx at 1 m.
        assert np.allclose([float(c) for c in causes], [9000.0, 21000.0], rtol=0.05), causes
        for name in BAD:
            assert f"lightcal: {name}: " in done.stderr, done.stderr
        assert not list(HOME.glob("none*")), "nothing is written"


def the_others_go_on():
    said = run("fit", "two", "-o", "none.json", code=3).stderr
    way_on = re.search(r"the other 10 lights are answered by (--without .*)", said)
    assert way_on, said
    by_name = answer("fit", "two", "-o", "without.json", *shlex.split(way_on[1]))
    good = answer("fit", "good", "-o", "good.json")
    assert by_name["lights"] == good["lights"], "as a session that has no others"
    assert [light["name"] for light in good["lights"]] == [n for n in NAMES if n not in BAD]
    one = answer("fit", "two", "-o", "one.json", "--lights", "lamp 01,lamp 12")
    assert [light["name"] for light in one["lights"]] == ["lamp 01", "lamp 12"]
    wrong = json.loads(run("fit", "two", "--without", "lmap 03", "--json", code=3).stdout)["error"]
    assert wrong["code"] == "unknown_light" and "lamp 03" in wrong["message"], wrong
    run("fit", "two", "--without", "lamp 03", "--lights", "lamp 01", code=2)
    # One bad lamp left: its own refusal, and the way on keeps what was left out already.
    left = run("fit", "two", "-o", "none.json", "--without", "lamp 03", code=3).stderr
    assert "--without 'lamp 03,lamp 07'" in left, left


def plans_say_next_of_the_others():
    lights = {light["name"]: light for light in answer("plan", "two")["lights"]}
    for name in NAMES:
        assert ("refused" in lights[name]) == (name in BAD), lights[name]
        assert ("next" in lights[name]) == (name not in BAD), lights[name]


def batches_say_so_briefly():
    done = run("run", "two", "good", "-o", "batch", "--to", "json", "--summary", "s.json", code=3)
    row = next(line for line in done.stdout.splitlines() if line.startswith("two"))
    assert all(name in row for name in BAD), row
    row = next(line for line in done.stdout.splitlines() if line.startswith("good"))
    assert "and 7 more" in row and "lamp 05" not in row, row
    two, good = json.loads((HOME / "s.json").read_text())["sessions"]
    assert [one["subject"] for one in two["error"]["others"]] == BAD[1:], two
    assert len(good["lights"]) == 10


session("two", NAMES, BAD)
session("good", [name for name in NAMES if name not in BAD])
refusals_name_every_lamp()
the_others_go_on()
plans_say_next_of_the_others()
batches_say_so_briefly()
