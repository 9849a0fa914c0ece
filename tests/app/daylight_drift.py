# SPDX-License-Identifier: Apache-2.0
"""Daylight that drifts between a reading and the lamp-off reading or the card that is taken from it: the interval
holds the lamp, and is the wider the more minutes lie between. A square law, by numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402

METRES, LAMPS, DRIFT = (0.5, 1, 2), 60, 0.02
HEAD = ('lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n'
        '[[meter]]\nname = "m"\nsigma_relative = 0.004\n')  # a laboratory's: it repeats as well


def reading(d, lux, more=""):
    return f'[[reading]]\nlight = "key"\nmeter = "m"\ndistance_m = {d}\nilluminance_lx = {lux:.5g}\n{more}'


def fit(text):
    path = HOME / "s.toml"
    path.write_text(HEAD + text)
    u = answer("fit", path)["lights"][0]["intensity_cd"]
    return u.get("low95", u["value"] - u["u95"]), u.get("high95", u["value"] + u["u95"])


def world(seed, other, drift):
    """Readings of a lamp with and without it; daylight differs by up to `drift` within each pair."""
    r = np.random.default_rng(seed)
    candela, offset = np.exp(r.uniform(np.log(50), np.log(500))), r.uniform(0, 0.03)
    day = candela * r.uniform(0.5, 2)
    text = ""
    for d in METRES:
        apart = 1 + drift * r.choice([-1, 1])
        shown = [lux * np.exp(r.normal(0, 0.004)) for lux in (candela / (d + offset)**2 + day, day * apart)]
        text += reading(d, shown[0]) + reading(d, shown[1], other)
    return text, candela


for name, other, drift in (("lamp off", 'lamp = "off"\n', DRIFT), ("card", "shadow_card = true\n", DRIFT / 2)):
    held, widths = 0, []
    for seed in range(LAMPS):
        text, candela = world(seed, other, drift)
        low, high = fit(text)
        held += low <= candela <= high
        widths.append(0.5 * np.log(high / low))
    print(f"{name}, daylight drifts {100 * drift:g} %: {held} of {LAMPS} held, half width {np.median(widths):.3f}")
    assert held >= LAMPS - 5, f"{name}: {held} of {LAMPS}"

OFF = 'lamp = "off"\ntime = "2026-06-21T10:%02d:00Z"\n'
widths = {}
for minutes in (1, 2, 10, 30):
    low, high = fit(reading(1, 300, 'time = "2026-06-21T10:00:00Z"\n') + reading(1, 200, OFF % minutes))
    widths[minutes] = 0.5 * np.log(high / low)
low, high = fit(reading(1, 300) + reading(1, 200, 'lamp = "off"\n'))
widths["unsaid"] = 0.5 * np.log(high / low)
print("half widths by minutes between:", widths)
assert widths[1] < widths[2] < widths[10] < widths[30]
assert abs(widths["unsaid"] / widths[2] - 1) < 0.01, "two minutes where nobody says"
# 200 lx of daylight, 10 minutes of .75 % each, beside 100 lx of the lamp: 15 %, 1 sigma.
assert abs(widths[10] / (1.96 * 0.15) - 1) < 0.35, widths
