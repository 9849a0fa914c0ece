# SPDX-License-Identifier: Apache-2.0
"""Gel tables in percent: by the column's name, by signs in the cells, and where nobody says which, said how they were
read. Of two stacks that nobody tells apart the one of fewer gels comes first, wherever a step of .05 ends.

    gels_in_percent.py LIGHTCAL
"""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import numpy as np  # noqa: E402
from built_command import HOME, answer, refused  # noqa: E402

NM = range(400, 701, 20)


def gel(name, text):
    (HOME / name).write_text(text, encoding="utf-8")
    return name


def column(heading, cells, mark=","):
    return gel("gel.csv", f"wavelength_nm{mark}{heading}\n" + "".join(f"{nm}{mark}{cell}\n" for nm, cell in zip(NM, cells)))


def passes(file, warned=0):
    """The light that passes, of the one gel in the file."""
    document = answer("color", "--spectrum", "illuminant:E", "--through", file)
    codes = [w["code"] for w in document.get("warnings", [])]
    assert codes.count("gels_as_fractions") == warned, (file, document.get("warnings"))
    return 2 ** -document["through"]["stops_lost"]["value"], document


flat = [0.3] * len(NM)
for heading, cells, share in (("D1 transmittance_percent", flat, .003), ("D1 T%", flat, .003), ("D1 %", flat, .003),
                              ("D1 transmittance", ["0.3%"] * len(NM), .003), ("D1 transmittance", ["45.2 %"] * len(NM), .452),
                              ("D1 transmittance_fraction", flat, .3), ("D1 T (%)", [45.2] * len(NM), .452)):
    got = passes(column(heading, cells))[0]
    assert abs(got / share - 1) < 1e-6, (heading, cells[0], got)
assert abs(passes(column("D1 transmittance", ["45,2%"] * len(NM), ";"))[0] / .452 - 1) < 1e-6
got, document = passes(column("D1 transmittance", flat), warned=1)
assert abs(got / .3 - 1) < 1e-6
told = next(w["message"] for w in document["warnings"] if w["code"] == "gels_as_fractions")
assert "parts of 1" in told and "30" in told and "transmittance_percent" in told, told
passes(column("D1 transmittance", [.9] * len(NM)))  # a clear one leaves no doubt
row = gel("row.csv", "filter," + ",".join(f"{nm}nm" for nm in NM) + "\nD1," + ",".join(["45.2%"] * len(NM)) + "\n")
assert abs(passes(row)[0] / .452 - 1) < 1e-6
mixed = ["45.2%"] * (len(NM) - 1) + [".4"]
refused("units_ambiguous", "color", "--spectrum", "illuminant:E", "--through", column("D1 transmittance", mixed),
        says="percent sign in some")
assert abs(passes(gel("fall.csv", "wavelength_nm,D1 transmittance\n" + "".join(f"{nm},.8\n" for nm in reversed(NM))))[0] / .8 - 1) < 1e-6

# A gel, and its two halves with a trace of tint, which come out a little nearer or farther than it.
random = np.random.default_rng(20261130)
tried = swapped = 0
for _ in range(60):
    slope, bend = random.uniform(.3, .5), random.uniform(.001, .0015)
    one = [slope + bend * (nm - 400) for nm in NM]
    tint = random.uniform(-.004, .004)
    half = [value ** .5 * (1 + tint * (nm - 550) / 150) for nm, value in zip(NM, one)]
    file = gel("pair.csv", "wavelength_nm,One transmittance,Half transmittance\n" +
               "".join(f"{nm},{a:.6f},{b:.6f}\n" for nm, a, b in zip(NM, one, half)))
    listed = answer("match", "illuminant:D65", "--to", "illuminant:D50", "--gels", file, "--reach", 1)["matches"]
    for place, match in enumerate(listed):
        for after in listed[place + 1:]:
            fewer = len(after["gels"]) < len(match["gels"])
            tried += fewer
            swapped += fewer and after["delta_e"]["observer"] <= match["delta_e"]["observer"] + .05
assert tried >= 5 and not swapped, f"{swapped} of {tried}"
print(tried, "pairs before a single gel, all of them nearer by more than a step")
