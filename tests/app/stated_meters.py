# SPDX-License-Identifier: Apache-2.0
"""What a [[meter]] says of itself: sigma_relative is one factor on all it reads, repeatability_relative each
reading's own beside it, step_lx its display's last digit. Written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402

LAMP = '[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n[room]\ndark = true\n'
SESSION = HOME / "s.toml"


def session(readings, meter=""):
    text = 'lightcal = 1\n[[meter]]\nname = "m"\n' + meter + LAMP
    text += "".join(f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {d}\nilluminance_lx = {lux}\n'
                    for d, lux in readings)
    SESSION.write_text(text)
    return SESSION


def interval(readings, meter=""):
    u = answer("fit", session(readings, meter))["lights"][0]["intensity_cd"]
    return u.get("low95", u["value"] - u["u95"]), u.get("high95", u["value"] + u["u95"])


def half(readings, meter=""):
    low, high = interval(readings, meter)
    return 0.5 * np.log(high / low) / 1.959964


# One factor: a hundred readings leave what the instrument is off by.
many = [(d, 100 / d**2) for d in (0.5, 1, 2, 4)] * 25
assert 0.05 <= half(many, "sigma_relative = 0.05\n") < 0.06
# Each reading's own is beside it, and stays 1 % where nobody states it.
few = [(d, 103.7 / d**2) for d in (0.5, 1, 2)]
own = {r: half(few, f"sigma_relative = 0.001\nrepeatability_relative = {r}\n") for r in (0.003, 0.01, 0.03)}
assert own[0.003] < own[0.01] < own[0.03], own
shared = half(few, "sigma_relative = 0.05\nrepeatability_relative = 0.01\n")
assert abs(half(few, "sigma_relative = 0.05\n") / shared - 1) < 1e-6, "1 % where none is stated"
refused("bad_session", "fit", session(few, "calibration_relative = 0.02\nrepeatability_relative = 0.01\n"),
        says="keep one", status=3)

# Words that say so wherever the key is explained.
schema = pathlib.Path(__file__).parents[2] / "lib/lightcal/records/schemas/session.schema.json"
assert "1/sqrt(2)" not in schema.read_text()
readme = (pathlib.Path(__file__).parents[2] / "README.md").read_text()
assert "repeatability_relative" in readme and "(1 sigma) a reading" not in readme

# A display of tens: 40 cd shows 40 lx at 1 m and 10 at 2 m, and so does any lamp of 35 to 45 cd.
tens = [(1, 40), (2, 10)]
plain, stated = interval(tens, "sigma_relative = 0.02\n"), interval(tens, "sigma_relative = 0.02\nstep_lx = 10\n")
print("40 and 10 lx: as whole lux", plain, "as tens", stated)
assert np.log(stated[1] / stated[0]) > 1.5 * np.log(plain[1] / plain[0]), (plain, stated)
held = 0
for candela in np.linspace(35, 140, 43):
    shown = [(d, 10 * round(candela / d**2 / 10)) for d in (1, 1.5)]
    low, high = interval(shown, "sigma_relative = 0.02\nstep_lx = 10\n")
    held += low <= candela <= high
print(held, "of 43 lamps held by tens")
assert held >= 41, held
assert run("validate", SESSION).returncode == 0
