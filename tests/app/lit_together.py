#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lamps lit together: what one lamp was read at alone stands at the same place however it is written, lamps read one by
one are what all of them together are less, and a lamp takes no light away.

    lit_together.py LIGHTCAL
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402

HEAD = ('lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.03\n'
        'repeatability_relative = 0.005\n')
CANDELA = {"key": 400.0, "fill": 135.0, "rim": 240.0}


def lamps(*names):
    return "".join(f'[[light]]\nname = "{name}"\nkind = "point"\n' for name in names)


def read(lit, distances, lux=None):
    """lit at their distances in metres, by the inverse square of each."""
    if lux is None:
        lux = sum(CANDELA[name] / distances[name] ** 2 for name in lit)
    named = ", ".join(f'"{name}"' for name in lit)
    far = ", ".join(f"{name} = {metres}" for name, metres in distances.items())
    return f'[[reading]]\nlit = [{named}]\nmeter = "m"\ndistances_m = {{ {far} }}\nilluminance_lx = {lux:.6g}\n'


def alone(name, metres, more=""):
    return (f'[[reading]]\nlight = "{name}"\nmeter = "m"\ndistance_m = {metres}\n'
            f'illuminance_lx = {CANDELA[name] / metres ** 2:.6g}\n{more}')


def session(name, text):
    path = HOME / f"{name}.toml"
    path.write_text(HEAD + text)
    return path


def candela(path):
    return {light["name"]: light["intensity_cd"] for light in answer("fit", path)["lights"]}


PLACES = ({"key": 2.0, "fill": 1.5}, {"key": 1.0, "fill": 2.5})
together = "".join(read(("key", "fill"), at) for at in PLACES)
by_lit = session("by_lit", lamps("key", "fill") + together + "".join(read(("fill",), {"fill": at["fill"]})
                                                                    for at in PLACES))
by_light = session("by_light", lamps("key", "fill") + together + "".join(alone("fill", at["fill"]) for at in PLACES))
one, other = candela(by_lit), candela(by_light)
for name in ("key", "fill"):
    assert abs(one[name]["value"] / CANDELA[name] - 1) < 0.02, (name, one)
    assert abs(other[name]["value"] / one[name]["value"] - 1) < 1e-9, (name, one, other)
    assert abs(other[name]["u95"] / one[name]["u95"] - 1) < 1e-6, (name, one, other)

# All of them, and all but one each alone.
PLACES = ({"key": 2.0, "fill": 1.5, "rim": 1.0}, {"key": 1.0, "fill": 2.5, "rim": 0.7}, {"key": 1.4, "fill": 2.0, "rim": 2.0})
text = lamps("key", "fill", "rim")
for at in PLACES:
    text += read(("key", "fill", "rim"), at) + read(("key",), {"key": at["key"]}) + read(("fill",), {"fill": at["fill"]})
found = candela(session("parts", text))
for name, truth in CANDELA.items():
    low = found[name].get("low95", found[name]["value"] - found[name]["u95"])
    high = found[name].get("high95", found[name]["value"] + found[name]["u95"])
    assert low < truth < high and high / low < 1.5, (name, found[name])

# Daylight is in each of them once: what was read with all of them off says how much.
def with_daylight(text, lux):
    lines = [f"illuminance_lx = {float(line.split('= ')[1]) + lux:.6g}" if line.startswith("illuminance_lx") else line
             for line in text.splitlines()]
    return "\n".join(lines) + "\n"


day = with_daylight(text, 5.0) + "".join(read((), at, 5.0) for at in PLACES)
found = candela(session("daylight", day))
assert abs(found["rim"]["value"] / CANDELA["rim"] - 1) < 0.1, found["rim"]

# Less with a lamp than without.
less = session("less", lamps("key", "fill") + read(("key", "fill"), {"key": 2.0, "fill": 1.5}, 50.0) +
               read(("fill",), {"fill": 1.5}, 60.0) + read(("key", "fill"), {"key": 1.0, "fill": 2.5}) +
               read(("fill",), {"fill": 2.5}))
refused("dark_above_lit", "fit", less, says="with fill lit .* 60.00 lx, .* 50.00: a lamp only adds light")

# A difference is no reading.
differ = session("differ", lamps("key", "fill") + read(("key", "fill"), {"key": 2.0, "fill": 1.5}, 160.0) +
                 read(("key",), {"key": 2.0}, 100.0) + read(("fill",), {"fill": 1.5}, 100.0))
said = run("fit", differ).stderr
assert "160.0 less 100.0" in said and "60.00" not in said, said

# A plan is of one lamp alone.
assert "turn the others off" in run("plan", by_lit, "--steps", "1").stdout
