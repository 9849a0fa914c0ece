# SPDX-License-Identifier: Apache-2.0
"""`color --batch` carries a name column through; `color --xy` hints where the numbers are far from every white as x, y
and near the locus as u', v', and never of lamps: the samples' spectra, black bodies, daylight, single LEDs and the
mixes of three. u', v' by CIE 15 from x, y, here."""
import csv
import io
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "sample_data"

# The name, as it stands, after what stood there before; with quotes and commas in it.
(HOME / "in.csv").write_text('name,y,x,note\nkey,0.3290,0.3127,a\n"Rose, ""Pink""",0.0600,0.15,b\n,0.40745,0.44758,c\n')
lines = list(csv.reader(io.StringIO(run("color", "--batch", "in.csv").stdout)))
assert lines[0] == ["x", "y", "cct_K", "duv", "name"], lines[0]
assert [row[4] for row in lines[1:]] == ["key", 'Rose, "Pink"', ""], lines
assert [row[:2] for row in lines[1:]] == [["0.3127", "0.3290"], ["0.15", "0.0600"], ["0.44758", "0.40745"]], lines
assert abs(float(lines[1][2]) - 6504.34) < .01 and lines[2][2] == ""
rows = answer("color", "--batch", "in.csv")["rows"]
assert [row.get("name") for row in rows] == ["key", 'Rose, "Pink"', None], rows
(HOME / "in.csv").write_text("x,y,note\n0.3127,0.3290,a\n")
assert run("color", "--batch", "in.csv").stdout.startswith("x,y,cct_K,duv\n0.3127,0.3290,6504.")


def hinted(x, y):
    done = run("color", "--xy", f"{x},{y}")
    return "as u', v' these numbers are a white" in done.stderr, done.stderr


def xy_of(u, v):
    return 9 * u / (6 * u - 16 * v + 12), 4 * v / (6 * u - 16 * v + 12)


for u, v in ((.21, .49), (.2561, .5243), (.1978, .4683), (.2105, .4737), (.2265, .5030)):  # A, D65, E, 4000 K
    told, err = hinted(u, v)
    x, y = xy_of(u, v)
    assert told and err.count("\n") == 1 and f"--xy {x:.4f}"[:9] in err, (u, v, err)
    assert "hint" not in run("color", "--xy", f"{u},{v}", "--quiet").stderr
    run("color", "--xy", f"{u},{v}", "--strict")

# Lamps: none is hinted at.
lamps = [(.4476, .4074), (.3127, .3290), (.3333, .3333), (.5267, .4133), (.25, .25)]
for source in (*sorted((SAMPLES / "spectra/uprtek_cv600").glob("*.xls")),
               *(f"gaussian:{nm}:{width}" for nm in range(430, 671, 5) for width in (12, 25, 40)),
               *(f"illuminant:FL{n}" for n in range(1, 13)), *(f"led:{k}" for k in (4000, 6500))):
    lamps.append(tuple(answer("color", "--spectrum", source)["xy"]))
red, green, blue = (tuple(answer("color", "--spectrum", f"gaussian:{nm}:25")["xy"]) for nm in (630, 525, 460))
for a, b in ((red, green), (green, blue), (blue, red)):
    for k in range(1, 20):  # of two emitters of a fixture
        lamps.append(tuple(p + (q - p) * k / 20 for p, q in zip(a, b)))
wrong = [(round(x, 4), round(y, 4)) for x, y in lamps if hinted(x, y)[0]]
assert not wrong, wrong
print(len(lamps), "lamps, none hinted at")
