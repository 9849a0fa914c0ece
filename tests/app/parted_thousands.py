#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lamps of 2 to 90,000 cd as spreadsheets of many countries write them: a number is read as it was meant or the
table is refused, and never read a thousand times off; what the refusal says to do does it.

    parted_thousands.py LIGHTCAL
"""
import json
import pathlib
import random
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL  # noqa: E402

SESSION = 'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n'


def imported(text, *words):
    """The journal's readings, or the error's code and message."""
    folder = HOME / "session"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    (folder / "session.toml").write_text(SESSION)
    (HOME / "table.csv").write_text(text)
    done = subprocess.run([LIGHTCAL, "import", "table.csv", "-s", folder, "--light", "key", "--json", *words],
                          capture_output=True, text=True, cwd=HOME, check=False)
    if done.returncode:
        error = json.loads(done.stdout)["error"]
        return error["code"], error["message"]
    return [json.loads(line) for line in (folder / "readings.jsonl").read_text().splitlines()]


def written(value, digits, decimal, thousands):
    text = f"{value:,.{digits}f}"
    return text.replace(",", "T").replace(".", decimal).replace("T", thousands)


# ---- what the tester pasted ----
HEAD = "distance_m{0}illuminance_lx\n"
for sign, rows in (("\t", "1\t8,120\n2\t2,035\n"), (";", "1;8.120\n2;2.035\n"), ("\t", "1\t2,030\n2\t508\n3\t225\n")):
    code, said = imported(HEAD.format(sign) + rows)
    assert code == "decimals_ambiguous" and "--decimals" in said, said
    assert "8120" in said or "2030" in said, said
    comma = "," in rows
    for word in ("point", "comma"):
        lux = imported(HEAD.format(sign) + rows, "--decimals", word)[0]["illuminance_lx"]
        assert (lux > 1000) == (comma == (word == "point")), (rows, word, lux)
for rows, lux in (("0.5\t12,030.5\n1\t3,008\n", 12030.5), ("0,5\t12 030,5\n1\t3 008\n", 12030.5),
                  ("0,5\t1.234,5\n1\t309\n", 1234.5)):
    assert imported(HEAD.format("\t") + rows)[0]["illuminance_lx"] == lux, rows
assert imported('distance_m,illuminance_lx\n1,"1.234,5"\n2,309\n')[0]["illuminance_lx"] == 1234.5
rows = imported("0.5;2,030\n1;508\n2;127\n", "--columns", "distance_m,illuminance_lx")
assert [row["illuminance_lx"] for row in rows] == [2030, 508, 127], rows
code, said = imported("Serial 5\n", "--decimals", "point")
assert code in ("unknown_format", "no_rows"), code

# ---- controls are written as all else ----
rows = imported("dimmer;distance_m;illuminance_lx\n12,5;1,0;26,2\n100;1,0;209\n")
assert [row["state"]["dimmer"] for row in rows] == [12.5, 100], rows
for fader in ("10,0", "10,0%", "10,0 %"):
    rows = imported(f"state.fader;distance_m;illuminance_lx\n{fader};1;26\n100;1;209\n")
    assert [row["state"]["fader"] for row in rows] == [10, 100], (fader, rows)
rows = imported("state.mode;distance_m;illuminance_lx\nboost;1;26,5\n3200K;1;209\n")
assert [row["state"]["mode"] for row in rows] == ["boost", 3200], rows

# ---- a world of countries ----
COUNTRIES = ((",", ".", ","), ("\t", ".", ","), ("\t", ",", "."), (";", ",", "."), (";", ",", " "), (";", ",", "\u00a0"),
             ("\t", ",", "\u202f"), (";", ".", "'"), (";", ".", ""), (";", ",", ""), ("\t", ".", ""))
draw = random.Random(17)
right = refusals = 0
for case in range(330):
    delimiter, decimal, thousands = COUNTRIES[case % len(COUNTRIES)]
    candela = 2 * 45000 ** draw.random()
    digits, places = draw.choice((0, 0, 1, 2, 3)), draw.choice((0, 1, 2, 3))
    distances = sorted(draw.sample((1, 2, 3, 4) if places == 0 else (0.5, 1, 1.5, 2, 2.5, 3), 3))
    truth = [round(candela / d ** 2, digits) for d in distances]
    if min(truth) <= 0:
        continue
    quoted = '"{}"' if delimiter == "," else "{}"
    text = HEAD.format(delimiter) + "".join(
        written(d, places, decimal, thousands) + delimiter +
        (quoted.format(cell) if thousands and thousands in (cell := written(lux, digits, decimal, thousands)) else
         written(lux, digits, decimal, thousands)) + "\n" for d, lux in zip(distances, truth))
    found = imported(text)
    if isinstance(found, tuple):
        assert found[0] == "decimals_ambiguous", (text, found)
        refusals += 1
        found = imported(text, "--decimals", "comma" if decimal == "," else "point")
    else:
        right += 1
    lux = [row["illuminance_lx"] for row in found]
    assert all(abs(a - b) <= 1e-9 * b for a, b in zip(lux, truth)), (text, lux, truth)
print(f"{right} read rightly, {refusals} refused and then read as --decimals said")
assert refusals < 0.2 * right, (right, refusals)
