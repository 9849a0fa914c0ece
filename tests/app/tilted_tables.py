# SPDX-License-Identifier: Apache-2.0
"""What a session says of the lamp of a photometric file: where its LM-63 file says how it dims when tilted, that this
is not applied, as a conversion says; of an axis along the aim that it turns nothing. Of TILT=NONE, and of an axis
across the aim, nothing. Files by hand; written without a header of lightcal."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402


def warned(tilt, axis=""):
    (HOME / "k.ies").write_text(
        "IESNA:LM-63-2002\n[TEST] x\n[TESTLAB] y\n[ISSUEDATE] z\n[MANUFAC] m\n" + tilt +
        "1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n1000 700 0\n")
    (HOME / "session.toml").write_text(
        'lightcal = 1\nname = "t"\n[[light]]\nname = "key"\nkind = "photometric"\ndistribution = "k.ies"\n'
        "position_m = [0, 0, 3]\naim = [1, 0, 0]\n" + axis)
    return {w["code"]: w["message"] for w in answer("fit", HOME).get("warnings", [])}


told = warned("TILT=INCLUDE\n1\n3\n0 45 90\n1.0 0.9 0.5\n")
assert "not applied" in told["tilt_dropped"] and "TILT" in told["tilt_dropped"], told
assert "tilt_dropped" not in warned("TILT=NONE\n")
assert "C0" in warned("TILT=NONE\n", "axis = [-1, 0, 0]\n")["axis_along_aim"]
assert not warned("TILT=NONE\n", "axis = [0, 1, 0]\n")
