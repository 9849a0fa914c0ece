#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A state's number that no dimmer gives (ten times too large, another state's) is doubted while it is typed and in
every answer made of it; lawful dimmers of fourteen kinds, read with 1 % noise by numpy, never are.

    mistyped_states.py LIGHTCAL [SEEDS]
"""
import json
import os
import pty
import select
import shutil
import subprocess
import sys
import pathlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, answer, run  # noqa: E402

SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 3
HEAD = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n'
        '[[meter]]\nname = "m"\nsigma_relative = 0.03\n')
CODES = ("state_not_monotonic", "state_out_of_line")


def session(name, rows=()):
    folder = HOME / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "session.toml").write_text(HEAD + "".join(
        f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = 1\nstate = {{ dimmer = {label} }}\n'
        f"illuminance_lx = {lux:.8g}\n" for label, lux in rows))
    return folder


def doubts(folder, command="fit"):
    return [one for one in answer(command, folder).get("warnings", []) if one["code"] in CODES]


# ---- the tester's sweep, through a pipe: said at once and in every answer ----
SWEEP = ("--light", "key", "--distance", "1m", "--over", "dimmer=100,80,60,40,20,10", "--typed")
folder = session("piped")
done = subprocess.run([LIGHTCAL, "sweep", "-s", folder, *SWEEP], input="1200\n12\n1920\n432\n768\n48\n1200\n",
                      capture_output=True, text=True, cwd=HOME, check=True)
wrong = next(row for row in map(json.loads, (folder / "readings.jsonl").read_text().splitlines())
             if row["illuminance_lx"] == 1920)["state"]["dimmer"]
assert done.stderr.count("hardly its light") == 1 and "--undo" in done.stderr, done.stderr
for command in ("fit", "state", "run"):
    words = ("--to", "json") if command == "run" else ()
    said = run(command, folder, *words).stderr
    assert f"dimmer={wrong:g}" in said and "10 times too large" in said, (command, said)
assert doubts(folder)[0]["code"] == "state_not_monotonic"

# ---- at a terminal: asked, typed again, taken back ----
folder = session("asked")
master, slave = pty.openpty()
person = subprocess.Popen([LIGHTCAL, "sweep", "-s", folder, *SWEEP[:4], "--over", "dimmer=100,50,10", "--in-order", "--typed"],
                          stdin=slave, stdout=subprocess.PIPE, stderr=slave, cwd=HOME)
os.close(slave)
seen = ""


def until(words):
    global seen
    while words not in seen:
        ready, _, _ = select.select([master], [], [], 60)
        assert ready, seen
        seen += os.read(master, 4096).decode()
    seen = seen[seen.index(words) + len(words):]


for question, typed in (("does the meter show", "1200"), ("does the meter show", "3090"), ("Is that right?", ""),
                        ("does the meter show", "400"), ("does the meter show", "u"),
                        ("took the last reading back: key 400.0 lx at 1.000 m", None),
                        ("does the meter show", "309"), ("does the meter show", "12"),
                        ("does the meter show", "1200")):
    until(question)
    if typed is not None:
        os.write(master, typed.encode() + b"\n")
assert person.wait(60) == 0
half = answer("state", folder, "--at", "dimmer=50")["intensity_cd"]["value"]
assert abs(half / 309 - 1) < 0.02, half
assert '"undo":' in (folder / "readings.jsonl").read_text()

# ---- lawful dimmers ----
LAWS = {
    "linear": lambda x: x / 100, "square": lambda x: (x / 100)**2, "gamma": lambda x: (x / 100)**2.2,
    "filament": lambda x: (x / 100)**3.4, "dali": lambda x: 10.0**(3 * (x / 100 - 1)),
    "root": lambda x: (x / 100)**0.5,
    "s_curve": lambda x: (x / 100)**2 * (3 - 2 * x / 100),
    "steep_s": lambda x: (1 / (1 + np.exp(-(x - 50) / 6)) - 1 / (1 + np.exp(50 / 6))) / (1 - 2 / (1 + np.exp(50 / 6))),
    "knee": lambda x: np.interp(x, [0, 20, 100], [0, 0.1, 1]),
    "late_knee": lambda x: np.interp(x, [0, 60, 100], [0.002, 0.05, 1]),
    "plateau": lambda x: np.interp(x, [0, 20, 60, 100], [0.01, 0.5, 0.5, 1]),
    "eight_bit": lambda x: max(1, round(255 * (x / 100)**2.2)) / 255,
    "two_stage": lambda x: 0.1 * (x / 100) + 0.9 * max(0, (x - 40) / 60)**2,
    "early_full": lambda x: min(1, x / 70),
}
LABELS = ([100, 80, 60, 40, 20, 10], [100, 50, 10], [100, 90, 80, 70, 60, 50, 40, 30, 20, 10, 5], [100, 75, 50, 25])
false, lawful, missed, slips = [], 0, [], 0
for name, law in LAWS.items():
    for seed in range(SEEDS):
        rng = np.random.default_rng(40 * sorted(LAWS).index(name) + seed)
        labels = LABELS[seed % len(LABELS)]
        rows = [(label, 3000 * law(label) * np.exp(rng.normal(0, 0.01))) for label in labels]
        rows.append((100, rows[0][1] * np.exp(rng.normal(0, 0.01))))
        lawful += 1
        if found := doubts(session("lawful", rows)):
            false.append((name, labels, found[0]["message"]))
        at = int(rng.integers(0, len(labels)))
        slip = [(label, lux * (10 if i == at else 1)) for i, (label, lux) in enumerate(rows)]
        # What leaves the dimmer in order and near its neighbours' line nobody can see.
        order = [lux for _, lux in sorted(slip[:len(labels)])]
        if any(a > 1.2 * b for a, b in zip(order, order[1:])):
            slips += 1
            found = doubts(session("slip", slip))
            if not any(f"dimmer={labels[at]}" in one["subject"] + one["message"] for one in found):
                missed.append((name, labels, at, found))
print(f"{lawful} lawful dimmers, {len(false)} doubted; {slips} slips out of order, {len(missed)} not told")
assert not false, false
assert not missed, missed
