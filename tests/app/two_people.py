#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two people read into one session: what one takes back is their own last reading, of their lamp, by its words.

    two_people.py LIGHTCAL
"""
import pathlib
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, answer, refused, run  # noqa: E402

folder = HOME / "s"
folder.mkdir()
LAMP = '[[light]]\nname = "{}"\nkind = "point"\nfixture = "bulb"\n'
(folder / "session.toml").write_text("lightcal = 1\n[room]\ndark = true\n" + LAMP.format("key") + LAMP.format("fill"))
journal = folder / "readings.jsonl"
READ = ("read", "-s", folder, "--light", "fill", "--distance", "1m", "--lux")


def counts(light):
    lights = {one["name"]: one for one in answer("fit", folder)["lights"]}
    return round(lights[light]["intensity_cd"]["value"]) if light in lights else None


# ---- a guided session on one lamp, another shell on the other ----
person = subprocess.Popen([LIGHTCAL, "read", "-s", folder, "--guided", "--typed", "--light", "key", "--no-shadow-card"],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=HOME)
person.stdin.write("203@1m\n")
person.stdin.flush()
begun = time.monotonic()
while not (journal.exists() and journal.read_text().endswith("\n")):
    assert time.monotonic() - begun < 60
    time.sleep(0.02)
run(*READ, "900")
_, said = person.communicate("u\n210@1m\nq\n", timeout=60)
assert "took the last reading back: key 203.0 lx at 1.000 m" in said, said
assert counts("fill") == 900 and counts("key") == 210, journal.read_text()

# ---- of a lamp that is named ----
run(*READ, "905")
said = answer("read", "-s", folder, "--light", "key", "--undo")
assert said["reading"]["light"] == "key" and said["reading"]["illuminance_lx"] == 210, said
assert counts("fill") in (902, 903) and counts("key") is None, journal.read_text()
refused("nothing_to_undo", "read", "-s", folder, "--light", "key", "--undo")
refused("unknown_light", "read", "-s", folder, "--light", "kye", "--undo")
assert answer("read", "-s", folder, "--undo")["reading"]["illuminance_lx"] == 905

# ---- the line that older versions wrote takes the last one back ----
run(*READ, "1000")
with journal.open("a") as lines:
    lines.write('{"undo":true}\n')
assert counts("fill") == 900, journal.read_text()
with journal.open("a") as lines:  # taken back already, no reading, no line: named, and nothing more is lost
    lines.write('{"undo":1}\n{"undo":3}\n{"undo":9999}\n{"undo":-1}\n')
said = run("fit", folder).stderr
assert said.count("is not used") == 4 and counts("fill") == 900, said
