#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a refusal tells to type is typed, and works; and small words that were taken for others.

    typed_advice.py LIGHTCAL
"""
import pathlib
import re
import shlex
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402


def advice_can_be_pasted():
    """Line with a gap, what was typed there, and what the answer names first."""
    for line, typed, told in [
            ("color --cct {}", "2,900K", "2900K"),
            ("color --cct {}", "2,900 K", "2900 K"),
            ("color --cct {}", "2900,5K", "2900.5K"),
            ("quick 192lx@0.5m --cct {}", "5,600K", "5600K"),
            ("quick 192lx@0.5m --meter {}", "3,5%", "3.5%"),
            ("quick 192lx@0.5m --kind disk --diameter {}", "0,125m", "0.125m")]:
        gap = shlex.split(line)
        at = gap.index("{}")
        said = run(*gap[:at], typed, *gap[at + 1:], code=2).stderr
        advice = re.search(r"decimals have a point here, and thousands no sign: (.*?)(?: or |$)",
                           said.strip())
        assert advice and advice[1] == told, said
        run(*gap[:at], advice[1], *gap[at + 1:])
    # Of a length a comma before three digits may mean either.
    said = run("quick", "192lx@0.5m", "--kind", "disk", "--diameter", "1,500m", code=2).stderr
    assert "1500m or 1.500m" in said, said


def a_command_names_its_own_options():
    assert "--lux" in run("read", "--typed", "--help").stdout
    said = run("watch", code=1).stderr
    assert "none is plugged in" in said and "--lux" not in said, said


def session(**reading):
    rows = "".join(f'{key} = "{value}"\n' for key, value in reading.items())
    path = HOME / "key.toml"
    path.write_text('lightcal = 1\n[[light]]\nname = "key"\nkind = "point"\n[[reading]]\nlight = "key"\n'
                    f'distance_m = 1.0\nilluminance_lx = 500\n{rows}')
    return path


def words_and_times():
    refused("bad_session", "fit", session(lamp="of"), "-o", "k.json", says='did you mean "off"')
    for time in ("yesterday", "21.11.2026 10:00", "2026-13-01T10:00:00Z", "2026-11-21T25:00:00Z",
                 "10:00", "2026-11-21T10:00:00 CET"):
        refused("bad_session", "fit", session(time=time), "-o", "k.json", says="ISO 8601")
    for time in ("2026-11-21T10:00:00Z", "2026-11-21T10:00:00.250Z", "2026-11-21T10:00:00",
                 "2026-11-21 10:00:00", "2026-11-21T10:00:00+02:00", "2026-11-21T10:00+0200",
                 "2026-11-21T10:00:00-05", "2026-11-21T10:00", "2026-11-21"):
        run("fit", session(time=time), "-o", "k.json", "--force")


def a_lamp_that_needs_no_gel_is_listed_once():
    table = run("match", "3200K", "--to", "3200K").stdout
    assert table.count("as it is") == 1, table
    assert table.count("no gel") <= 1, table
    assert run("match", "5600K", "--to", "3200K").stdout.count("(as it is)") == 1
    assert len(answer("match", "3200K", "--to", "3200K")["matches"]) >= 1


advice_can_be_pasted()
a_command_names_its_own_options()
words_and_times()
a_lamp_that_needs_no_gel_is_listed_once()
