# SPDX-License-Identifier: Apache-2.0
"""A reading that contradicts the spectrum it names, in lux or in colour: the session says so, with the unit that would
make them agree where one does, and once a lamp; rounding, two meters' spread and a number that was not read are let be.
Spectra by numpy and the CIE's table; written without a header of lightcal."""
import csv
import pathlib
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
from built_command import HOME, answer  # noqa: E402

NM = np.arange(380.0, 780.5, 1.0)
TABLE = ROOT / "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv"
ROWS = np.array([[float(cell) for cell in row] for row in list(csv.reader(TABLE.open()))[1:]])
V_LAMBDA = np.interp(NM, ROWS[:, 0], ROWS[:, 2])


def band(nm, width):
    return np.exp(-0.5 * ((NM - nm) / width) ** 2)


def written(name, lux, unit="irradiance_W_m2_nm"):
    """A white LED of about 3200 K, of so many lux where the values are W m-2 nm-1."""
    led = 0.25 * band(452, 10) + band(590, 60)
    led *= lux / (683.002 * (V_LAMBDA * led).sum())
    (HOME / name).write_text(f"wavelength_nm,{unit}\n" + "".join(f"{nm:g},{e:.7g}\n" for nm, e in zip(NM, led)))


def warned(typed, unit="irradiance_W_m2_nm"):
    """What is said of two readings, of 500 and of 125 lx by their spectra, each with those words."""
    text = ('lightcal = 1\nname = "t"\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = 0.02\n'
            '[[light]]\nname = "key"\nkind = "point"\nlamp_class = "white_led"\nminutes_on = 60\n')
    for distance, lux in ((1, 500.0), (2, 125.0)):
        written(f"{lux:g}.csv", lux, unit)
        text += (f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {distance}\nspectrum = "{lux:g}.csv"\n'
                 + typed(lux) + "\n")
    (HOME / "session.toml").write_text(text)
    told = [(w["code"], w["message"]) for w in answer("fit", HOME).get("warnings", [])]
    assert all(code in ("spectrum_disagrees", "color_disagrees") for code, _ in told), told
    print(*told, sep="\n")
    return told


def lux(factor):
    return lambda of_spectrum: f"illuminance_lx = {factor * of_spectrum:.6g}"


def only(told, code, *words):
    assert len(told) == 1 and told[0][0] == code and all(word in told[0][1] for word in words), told


only(warned(lux(3.0)), "spectrum_disagrees", "1500 lx", "500.0 lx", "no unit")
only(warned(lux(1 / 10.7639)), "spectrum_disagrees", "46.45 lx", "footcandles")
only(warned(lux(1e-3)), "spectrum_disagrees", "0.5000 lx", "thousands of lx")
only(warned(lux(0.01), "irradiance_W_m2_nm"), "spectrum_disagrees", "uW cm-2 nm-1")
only(warned(lux(1.0), "irradiance_mW_m2_nm"), "spectrum_disagrees", "values were W m-2 nm-1")
only(warned(lambda e: f"illuminance_lx = {e}\ncct_K = 5600"), "color_disagrees", "5600 K", "the spectrum is taken")
only(warned(lambda e: f"illuminance_lx = {e}\nxy = [0.33, 0.33]"), "color_disagrees", "0.3300, 0.3300")
assert not warned(lambda e: "")
assert not warned(lambda e: f"illuminance_lx = {1.05 * e}\ncct_K = 3250")
assert not warned(lambda e: f"illuminance_lx = {e}" if e < 200 else f"illuminance_lx = {0.3 * e}\nover_range = true")
assert not warned(lux(10.0), "relative"), "a relative spectrum has no lux"
