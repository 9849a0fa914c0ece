# SPDX-License-Identifier: Apache-2.0
"""What `photometric`, `validate` and a session say of files whose tables are not a whole lamp: angles that do not
increase (named, with their line), an axis without data, a turn whose ends differ, a tilt in measurement. Files by
hand; written without a header of lightcal."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "sample_data/photometric"


def ies(counts, body, newline="\n"):
    text = ("IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] y\n[ISSUEDATE] z\n[MANUFAC] Ours\nTILT=NONE\n"
            f"1 -1 1 {counts} 2 0 0 0\n1 1 60\n{body}\n")
    path = HOME / "lamp.ies"
    path.write_text(text.replace("\n", newline), newline="")
    return path


def warned(path):
    """Codes and messages, alike from `photometric`, `validate` and a session."""
    of_file = {w["code"]: w["message"] for w in answer("photometric", path).get("warnings", [])}
    of_verdict = answer("validate", path).get("warnings", [])
    assert {w["code"]: w["message"] for w in of_verdict} == of_file, (of_verdict, of_file)
    (HOME / "session.toml").write_text(
        'lightcal = 1\nname = "t"\n[[light]]\nname = "key"\nkind = "photometric"\n'
        f'distribution = "{path}"\nposition_m = [0, 0, 3]\naim = [1, 0, 0]\n')
    of_session = {w["code"]: w["message"] for w in answer("fit", HOME).get("warnings", [])}
    for code, message in of_file.items():
        assert of_session.get(code) == message, (code, of_session)
    return of_file


def told_of(path):
    return refused("bad_table", "photometric", path)["message"]


# (a) The angles and their line; over line ends of all kinds.
for newline in ("\n", "\r\n", "\r"):
    told = told_of(ies("4 1 1", "0 10\n25 20\n0\n100 90 50 10", newline))
    assert "vertical angles must increase: 20 after 25, line 10" in told, told
told = told_of(ies("3 3 1", "0 45 90\n0\n90 90\n1 2 3\n4 5 6\n7 8 9"))
assert "horizontal angles must increase: 90 after 90, line 11" in told, told
LDT = (SAMPLES / "sample2.ldt").read_bytes().decode("latin-1").splitlines()
MC, NG = int(LDT[3]), int(LDT[5])
FIRST_C = 26 + 6 * int(LDT[25]) + 10


def ldt(line, value):
    lines = list(LDT)
    lines[line] = value
    path = HOME / "lamp.ldt"
    path.write_text("\n".join(lines), encoding="latin-1")
    return path


told = told_of(ldt(FIRST_C + 2, LDT[FIRST_C + 1]))
want = float(LDT[FIRST_C + 1])
assert f"C angles must increase: {want:g} after {want:g}, line {FIRST_C + 3}" in told, told
told = told_of(ldt(FIRST_C + MC + 3, "1"))
assert f"gamma angles must increase: 1 after {float(LDT[FIRST_C + MC + 2]):g}, line {FIRST_C + MC + 4}" in told, told

# (b) An axis that nothing is given for.
told = warned(ies("4 1 1", "2.5 10 25 90\n0\n100 90 50 10"))
assert "begin at 2.5 degrees" in told["no_axis"] and "Add the angle 0" in told["no_axis"], told
assert "end at 175 degrees" in warned(ies("3 1 1", "90 120 175\n0\n1 50 100"))["no_axis"]
assert "begin at 5" in warned(ies("3 2 2", "5 10 20\n0 10\n9 5 1\n8 4 0"))["no_axis"]
for whole in (ies("3 1 1", "0 20 40\n0\n100 50 0"), ies("3 1 1", "90 120 180\n0\n1 50 100"),
              ies("3 2 2", "-20 0 20\n-10 10\n9 50 9\n9 50 9"), ies("2 1 1", "0 180\n0\n100 100")):
    assert not warned(whole), whole.read_text()

# (c) A turn whose ends differ: the two largest differing values; what rounding leaves is silent.
PLANE = "1000 900 500\n"
told = warned(ies("3 5 1", "0 45 90\n0 90 180 270 360\n" + 4 * PLANE + "1000 800 20\n"))
assert "500.00 cd and 20.000 cd" in told["open_turn"], told
assert "at 90 degrees" in told["open_turn"], told
assert not warned(ies("3 5 1", "0 45 90\n0 90 180 270 360\n" + 4 * PLANE + "1000 901 501\n"))

# (d) Measured tilted.
assert "15 degrees (line 25)" in warned(ldt(24, "15"))["measured_tilted"]
assert not warned(ldt(24, "0"))
for sample in sorted(SAMPLES.glob("*.ldt")):
    own = HOME / sample.name
    own.write_bytes(sample.read_bytes())
    assert set(warned(own)) <= {"lamp_sets"}, sample
