# SPDX-License-Identifier: Apache-2.0
"""A lamp of a photometric file that hangs a degree aslant: its aim is found, and its C0 plane stays where it was,
though nobody said where that points. Its light three times as wide along x as along y, by this file's own
interpolation; what it then gives beside the readings, to both sides. Written without a header of lightcal."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402

GAMMA = list(range(0, 91, 5))
HALF = {0: 40.0, 90: 14.0}  # degrees to half the peak, in C0 and C90


def candela(plane, gamma):
    return 1000 * 2 ** -((gamma / HALF[plane]) ** 2)


def towards(lamp_x, lamp_y, down):
    gamma = math.degrees(math.atan2(math.hypot(lamp_x, lamp_y), down))
    share = math.degrees(math.atan2(abs(lamp_y), abs(lamp_x))) / 90
    return (1 - share) * candela(0, gamma) + share * candela(90, gamma)


def lux(x, y, tilt):
    """On the floor three metres below, the lamp's foot swung towards x; the meter faces the lamp."""
    c, s = math.cos(tilt), math.sin(tilt)
    return towards(c * x - s * 3, y, s * x + c * 3) / (x * x + y * y + 9)


rows = "\n".join(" ".join(f"{candela(plane, g):.4f}" for g in GAMMA) for plane in (0, 90))
(HOME / "k.ies").write_text("IESNA:LM-63-2002\n[TEST] x\n[TESTLAB] y\n[ISSUEDATE] z\n[MANUFAC] m\nTILT=NONE\n"
                            f"1 -1 1 {len(GAMMA)} 2 1 2 0 0 0\n1 1 10\n{' '.join(map(str, GAMMA))}\n0 90\n{rows}\n")
TILT = math.radians(1.0)
text = ('lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.01\n[[light]]\nname = "key"\n'
        'kind = "photometric"\nfixture = "luminaire"\ndistribution = "k.ies"\nposition_m = [0, 0, 3]\naim = [0, 0, -1]\n')
for x, y in ((0, 0), (1.5, 0), (-1.5, 0), (0, 0.5), (0, -0.5), (2, 0.3)):
    r = math.sqrt(x * x + y * y + 9)
    text += (f'[[reading]]\nlight = "key"\nmeter = "m"\nposition_m = [{x}, {y}, 0]\n'
             f"normal = [{-x / r}, {-y / r}, {3 / r}]\nilluminance_lx = {lux(x, y, TILT):.5g}\n")
(HOME / "session.toml").write_text(text)
light = answer("fit", HOME, "-o", HOME / "light.json", "--force")["lights"][0]
assert 0.5 < math.degrees(math.asin(light["aim"][0])) < 1.5, light["aim"]
for x, y in ((2.2, 0), (-2.2, 0), (0, 1), (0, -1), (1, 0.7), (-1, 0.7)):
    got = answer("simulate", HOME / "light.json", "--normal", "lamp", f"--at={x},{y},0")["points"][0]["illuminance_lx"]
    want = lux(x, y, TILT)
    print(f"{x}, {y}: {got['value']:.4g} lx, {want:.4g} there")
    assert abs(got["value"] / want - 1) < 0.05, (x, y, got, want)
