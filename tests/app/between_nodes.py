# SPDX-License-Identifier: Apache-2.0
"""A photometric file tells a lamp between its nodes as well as they are near: each reading is as unsure as the file is
towards it. A dim reading beside the beam, where the file is poor, takes nothing from those in the beam; and lamps read
between coarse nodes alone are held: smooth lobes, and luminaires whose own files keep every second node (the fifth of
one with a degree between them). Written without a header of lightcal."""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402


def lobe(kind, width):
    """Relative intensity at an angle off the axis, degrees; half the peak at `width`."""
    if kind == "gauss":
        return lambda g: 2 ** -((g / width) ** 2)
    power = math.log(0.5) / math.log(math.cos(math.radians(width)))
    return lambda g: max(0.0, math.cos(math.radians(g))) ** power


def width_and_lamp(name, shape, step, peak, seats, rng):
    """Of meters of 1 % at (distance, angle off the axis), facing the lamp. (half width, whether it holds the peak)"""
    home = HOME / name
    home.mkdir()
    gamma = [step * i for i in range(int(85 / step) + 1)]
    (home / "k.ies").write_text(
        "IESNA:LM-63-2002\n[TEST] x\n[TESTLAB] y\n[ISSUEDATE] z\n[MANUFAC] m\nTILT=NONE\n"
        f"1 -1 1 {len(gamma)} 1 1 2 0 0 0\n1 1 10\n{' '.join(map(str, gamma))}\n0\n"
        + " ".join(f"{1000 * shape(g):.6g}" for g in gamma) + "\n")
    text = ('lightcal = 1\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.005\n[[light]]\n'
            'name = "key"\nkind = "photometric"\nfixture = "luminaire"\ndistribution = "k.ies"\n'
            "position_m = [0, 0, 3]\naim = [0, 0, -1]\noff_axis_sigma_deg = 0\n")
    scale = math.exp(rng.gauss(0, 0.005))
    for distance, off in seats:
        x, down = distance * math.sin(math.radians(off)), distance * math.cos(math.radians(off))
        lux = peak * shape(off) / distance**2 * scale * math.exp(rng.gauss(0, 0.01))
        text += (f'[[reading]]\nlight = "key"\nmeter = "m"\nposition_m = [{x:.6f}, 0, {3 - down:.6f}]\n'
                 f"normal = [{-x / distance:.7f}, 0, {down / distance:.7f}]\nilluminance_lx = {lux:.6g}\n")
    (home / "session.toml").write_text(text)
    intensity = answer("fit", home)["lights"][0]["intensity_cd"]
    low, high = intensity["low95"], intensity["high95"]
    return (high - low) / 2 / intensity["value"], low <= peak <= high


beam = lobe("gauss", 10.0)
axis = [(1.0, 0.0), (1.5, 0.0), (2.0, 0.0)]
alone, _ = width_and_lamp("alone", beam, 5.0, 1300.0, axis, random.Random(1))
beside, _ = width_and_lamp("beside", beam, 5.0, 1300.0, axis + [(2.0, 27.5)], random.Random(1))
print(f"on the axis {100 * alone:.2f} %, with a dim reading beside the beam {100 * beside:.2f} %")
assert beside < 1.05 * alone, (alone, beside)

HELD, CASES = 0, 60
rng = random.Random(20261130)
widths = []
for case in range(CASES):
    shape = lobe(rng.choice(("gauss", "cosine")), math.exp(rng.uniform(math.log(8), math.log(35))))
    step = rng.choice((2.5, 5.0, 10.0))
    seats = [(rng.uniform(1, 3), rng.uniform(0, 12)) for _ in range(4)]
    width, held = width_and_lamp(f"lamp{case}", shape, step, math.exp(rng.uniform(5, 9)), seats, rng)
    HELD += held
    widths.append(width)
print(f"{HELD} of {CASES} held, median half width {100 * sorted(widths)[CASES // 2]:.1f} %")
assert HELD >= 54, HELD


def lobe_of_ldt(path):
    """(its angles, relative intensity at one of them) in C0 of a EULUMDAT file."""
    lines = path.read_text(errors="replace").splitlines()
    planes, count, sets = int(lines[3]), int(lines[5]), int(lines[25])
    first = 36 + 6 * sets + planes
    angles = [float(x) for x in lines[first:first + count]]
    values = [float(x) for x in lines[first + count:first + 2 * count]]
    return angles, dict(zip(angles, values))


HELD, CASES = 0, 0
for path in sorted((pathlib.Path(__file__).resolve().parents[2] / "sample_data" / "photometric").glob("*.ldt")):
    angles, values = lobe_of_ldt(path)
    step = angles[1] * (5 if angles[1] == 1 else 2)
    most = max(values[a] for a in angles if a % step == 0 and a <= 85)
    shape = lambda g: values[g] / most  # noqa: E731
    dropped = [a for a in angles if a % step and a < 80 and shape(a) > 0.2]
    held = 0
    for case in range(15):
        seats = [(rng.uniform(1, 3), rng.choice(dropped)) for _ in range(4)]
        held += width_and_lamp(f"{path.stem}_{case}", shape, step, math.exp(rng.uniform(5, 9)), seats, rng)[1]
    print(f"{path.name}, nodes {step} degrees apart: {held} of 15 held")
    HELD, CASES = HELD + held, CASES + 15
assert HELD >= 0.9 * CASES, (HELD, CASES)
