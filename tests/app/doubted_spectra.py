# SPDX-License-Identifier: Apache-2.0
"""Spectra in coarse steps, with a gap or a short range, named by a session's reading: it says what `color` says of the
file, and its intervals of CCT and Duv hold those of the whole spectrum. Truths: `color` of the same lamp in 1 nm steps;
lamps by numpy and the CIE's table; written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402

NM = np.arange(380.0, 780.5, 1.0)
WHOLE = np.full(NM.size, True)


def band(nm, width):
    return np.exp(-0.5 * ((NM - nm) / width) ** 2)


LINES = 0.3 * band(436, 3) + 0.9 * band(545, 3) + 0.8 * band(611, 3) + 0.1 * band(490, 8) + 0.05
LED = 0.35 * band(452, 10) + band(585, 60)
BLACK = NM**-5.0 / np.expm1(1.4388e7 / (NM * 2400.0))


def write(name, lamp, kept):
    rows = "".join(f"{nm:g},{e:.7g}\n" for nm, e in zip(NM[kept], lamp[kept]))
    (HOME / name).write_text("wavelength_nm,relative\n" + rows)


def session_of(lamp, kept, extra=""):
    """Intervals of CCT and Duv, the truth of both, and the codes that a fit and `color` warn with."""
    write("whole.csv", lamp, WHOLE)
    write("lamp.csv", lamp, kept)
    (HOME / "session.toml").write_text(
        'lightcal = 1\nname = "t"\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n'
        'lamp_class = "white_led"\nminutes_on = 60\n' + "".join(
            f'[[reading]]\nlight = "key"\ndistance_m = {d}\nilluminance_lx = {500 / d**2}\nspectrum = "lamp.csv"\n{extra}\n'
            for d in (1, 2)))
    fit, file, whole = answer("fit", HOME), answer("color", "lamp.csv"), answer("color", "whole.csv")
    color = fit["lights"][0]["color"]
    told = {w["code"]: w["message"] for w in fit.get("warnings", [])}
    print(color["cct_K"], "truth", whole["cct_K"], color["duv"], color["duv_u95"], "truth", whole["duv"], told)
    assert set(told) == {w["code"] for w in file.get("warnings", [])}, (told, file["warnings"])
    assert color["cct_K"]["low95"] <= whole["cct_K"] <= color["cct_K"]["high95"]
    assert abs(color["duv"] - whole["duv"]) <= color["duv_u95"]
    return color["cct_K"]["u95"], told


def every(step):
    return np.isin(NM, NM[::step])


told = session_of(LINES, every(10))[1]
assert "every 10 nm" in told["undersampled"], told
assert session_of(LINES, every(5))[1]
told = session_of(LED, (NM <= 520) | (NM >= 570))[1]
assert "between 520 and 570 nm" in told["undersampled"], told
wide, told = session_of(BLACK, (NM >= 400) & (NM <= 700))
assert "400 to 700 nm" in told["spectrum_truncated"], told
narrow, told = session_of(BLACK, WHOLE)
assert not told and narrow < 41 < wide, (narrow, wide)
even, told = session_of(LED, every(5))
assert not told and even < 90, "light without lines, which any meter of 5 nm reads well"


def state_u95(times):
    """Of the CCT at half, which is read so many times with one spectrum."""
    rows = [(100, 500)] + [(50, 250)] * times
    (HOME / "session.toml").write_text(
        'lightcal = 1\nname = "t"\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\n'
        'lamp_class = "white_led"\nminutes_on = 60\n' + "".join(
            f'[[reading]]\nlight = "key"\ndistance_m = 1\nilluminance_lx = {lux}\nspectrum = "lamp.csv"\n'
            f"state = {{ dimmer = {dimmer} }}\n" for dimmer, lux in rows))
    [half] = [s for s in answer("fit", HOME)["lights"][0]["states"] if s["state"]["dimmer"] == 50]
    return half["color"]["cct_K"]["u95"]


# Sampling errs alike in all readings of a state: it counts once.
write("lamp.csv", LINES, every(5))
once, often = state_u95(1), state_u95(4)
print("a state's CCT, read once and four times:", once, often)
assert often <= 1.001 * once, (once, often)

# An instrument that was full: its top is flat, of figures in full and of three digits; a smooth top that is written in
# two or three digits is as wide as its steps make it, and light flat to its end, or from nothing to all, is what it is.
def said_clipped(lamp, digits):
    rows = "".join(f"{nm:g},{e:.{digits}f}\n" for nm, e in zip(NM, lamp / lamp.max()))
    (HOME / "top.csv").write_text("wavelength_nm,relative\n" + rows)
    return "spectrum_clipped" in [w["code"] for w in answer("color", "top.csv").get("warnings", [])]


DRIVEN = 0.8 * band(455, 10) + band(580, 50) + 0.02
for digits in (3, 7):
    for share in (0.9, 0.7, 0.5):
        assert said_clipped(np.minimum(DRIVEN, share * DRIVEN.max()), digits), (digits, share)
for digits in (2, 3, 7):
    for lamp in (DRIVEN, LED, LINES, BLACK, np.ones(NM.size), np.abs(NM - 550) < 50):
        assert not said_clipped(np.asarray(lamp, float), digits), digits
(HOME / "lamp.csv").write_text("wavelength_nm,relative\n" + "".join(f"{nm:g},{min(e, 0.7):.6g}\n" for nm, e in zip(NM, DRIVEN)))
assert "spectrum_clipped" in [w["code"] for w in answer("fit", HOME)["warnings"]]
print("a full instrument's flat top is named, a smooth one's steps are not")
