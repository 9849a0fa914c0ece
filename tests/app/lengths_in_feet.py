# SPDX-License-Identifier: Apache-2.0
"""Feet and inches together wherever a length is typed, and what is no such length refused; of the box's words the
one that is not understood is quoted. Truth: 1 in = 25.4 mm, 1 ft = 12 in, by hand."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402

INCHES = {"1ft8in": 20, "1ft 8in": 20, "1 ft 8 in": 20, "1'8\"": 20, "1' 8": 20, "5' 8 1/2\"": 68.5, "5'8-1/2\"": 68.5,
          "5 feet 8 inches": 68, "5′8″": 68, "5’ 8”": 68, "6'": 72, "6ft": 72, "8 1/2in": 8.5, "1/2in": .5,
          "2.5ft": 30, "5ft0in": 60, "5' 8''": 68, "8''": 8, "1FT8IN": 20, "5'-8\"": 68, "1 1/2ft": 18}
for typed, inches in INCHES.items():
    metres = inches * .0254
    lux = answer("convert", "100cd", "--kind", "point", "--distance", typed)["illuminance_lx"]
    assert abs(lux * metres**2 / 100 - 1) < 1e-9, (typed, lux, metres)
for typed in ("5'12\"", "5' 8 1/0\"", "5'8\"3", "ft8in", "1ft8cm", "5'8 1/2 1/2\"", "1.5 1/2in", "5-8"):
    run("convert", "100cd", "--kind", "point", "--distance", typed, code=2)
# The same words in a reading, a size, a prediction and a room.
told = answer("quick", "52lx@1ft8in", "--at", "5' 8 1/2\"")
same = answer("quick", "52lx@508mm", "--at", "1739.9mm")
cd = [one["lights"][0]["intensity_cd"]["value"] for one in (told, same)]
assert abs(cd[0] / cd[1] - 1) < 1e-9, cd
panel = [answer("quick", "500lx@2m", "--kind", "rect", "--size", size)["lights"][0]["luminance_nits"]["value"]
         for size in ("1ft8inx2ft4in", "508mmx711.2mm")]
assert abs(panel[0] / panel[1] - 1) < 1e-9, panel
# Of what unit is 20?
assert "unit of 20" in run("convert", "100cd", "--kind", "rect", "--size", "20x1ft8in", code=2).stderr
run("quick", "500lx@2m", "--kind", "rect", "--size", "20x1ft8in", code=2)

# The box.
for words, word in (("9W 806lm bright 36deg", "bright"), ("9W ca. 806lm", "ca."), ("9 W 806lm", "9")):
    told = refused("usage", "new", HOME / "s", "--yes", "--box", words, status=2)["message"]
    assert f'"{word}" is not understood' in told and "9W 806lm 2900K 36deg" in told, told
for flag, kind in (("--diameter", "sphere"), ("--length", "tube")):
    told = refused("usage", "new", HOME / "s", "--yes", "--kind", kind, flag, "abc", status=2)["message"]
    assert '"abc" is none' in told, told
