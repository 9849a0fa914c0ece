# SPDX-License-Identifier: Apache-2.0
"""A set of many lamps with states: one note for all, a report of some of its lamps, and a comma in a number named."""
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, run  # noqa: E402

LAMPS = 12
TEXT = "lightcal = 1\n[room]\ndark = true\n" + "".join(
    f'[[light]]\nname = "lamp {i}"\nkind = "point"\nfixture = "bulb"\n' + "".join(
        f'[[reading]]\nlight = "lamp {i}"\ndistance_m = 1\nilluminance_lx = {dimmer * (1 + i / 10)}\n'
        f'state = {{ dimmer = {dimmer} }}\n' for dimmer in ((100, 50, 25) if i else (100, 50)))
    for i in range(LAMPS))
(HOME / "set").mkdir()
(HOME / "set/session.toml").write_text(TEXT)
notes = [line for line in run("fit", "set").stderr.splitlines() if "states of their controls" in line or
         "states of its controls" in line]
print("\n".join(notes))
assert len(notes) == 1, notes
for word in (str(LAMPS), "2 to 3 states", "lamp 0 at dimmer=100", "lamp 2", f"and {LAMPS - 3} more"):
    assert word in notes[0], (word, notes)
assert "lamp 5" not in notes[0], notes

# report takes those that are asked for, of a session and of what was found of it.
run("fit", "set", "-o", "light.json")
for source in ("set", "light.json"):
    run("report", source, "-o", "page.html", "--lights", "lamp 3,lamp 4", "--force")
    page = (HOME / "page.html").read_text()
    assert "lamp 3" in page and "lamp 4" in page and "lamp 5" not in page, source
    run("report", source, "-o", "page.html", "--without", "lamp 3", "--force")
    page = (HOME / "page.html").read_text()
    assert "lamp 3" not in page and "lamp 5" in page, source
    lost = subprocess.run([LIGHTCAL, "report", source, "-o", "no.html", "--lights", "lamp x"], cwd=HOME,
                          capture_output=True, text=True)
    assert lost.returncode in (2, 3) and "lamp x" in lost.stderr and not (HOME / "no.html").exists(), lost

# A comma is named in every word of a ratio, alone too.
for words in (["1,000lx", "200lx"], ["192,5lx", "200lx"], ["800lx", "200,5lx"], ["1,000lx"]):
    said = subprocess.run([LIGHTCAL, "ratio", *words], capture_output=True, text=True)
    assert said.returncode == 2 and "decimals have a point here" in said.stderr, (words, said.stderr)
assert "1000lx or 1.000lx" in subprocess.run([LIGHTCAL, "ratio", "1,000lx", "2lx"], capture_output=True,
                                             text=True).stderr
assert json.loads(run("ratio", "800lx", "200lx", "--json").stdout)["stops"]["value"] == 2
