#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One meter reads a lamp before and after: its own error is in both, and a change of 5 % is seen beside it; of a
lamp that did not change one difference in twenty exceeds its u. Two meters leave their errors in.

    one_meter_twice.py LIGHTCAL
"""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, run  # noqa: E402


def fitted(name, lux, meter, gain, rng, noise=0.004):
    folder = HOME / name
    folder.mkdir(exist_ok=True)
    (folder / "session.toml").write_text(
        'lightcal = 1\n[room]\ndark = true\n[[light]]\nname = "key"\nkind = "directional"\n'
        f'[[meter]]\nname = "{meter}"\ncalibration_relative = 0.04\nsigma_relative = 0.04\n' + "".join(
            f'[[reading]]\nlight = "key"\nmeter = "{meter}"\n'
            f"illuminance_lx = {lux * gain * np.exp(rng.normal(0, noise)):.8g}\n" for _ in range(4)))
    answer("fit", folder, "-o", HOME / f"{name}.json")
    return HOME / f"{name}.json"


def light(*words):
    document = answer("diff", *words)
    return document, next(one for one in document["lights"][0]["quantities"] if one["quantity"] == "illuminance_lx")


seen = exceeded = apart = 0
TRIALS = 40
for seed in range(TRIALS):
    rng = np.random.default_rng(seed)
    gain, other = np.exp(rng.normal(0, 0.04, 2))
    before = fitted("before", 200, "c800", gain, rng)
    document, down = light(before, fitted("down", 190, "c800", gain, rng))
    assert document["lights"][0]["common_meter"] == "c800", document
    seen += down["verdict"] == "changed"
    exceeded += light(before, fitted("same", 200, "c800", gain, rng))[1]["verdict"] == "changed"
    document, two = light(before, fitted("other", 200, "other", other, rng))
    assert "common_meter" not in document["lights"][0] and two["u95"] > 2 * down["u95"], (two, down)
    apart += two["verdict"] == "changed"
    assert light(before, HOME / "down.json", "--correlation", "0")[1]["u95"] > 2 * down["u95"]
said = run("diff", before, HOME / "down.json").stdout
assert "The meter c800 read both" in said and "--correlation 0" in said, said
print(f"a change of 5 % seen {seen} of {TRIALS}; of none {exceeded}, with two meters {apart}")
assert seen >= 0.9 * TRIALS and exceeded <= 0.15 * TRIALS and apart <= 0.15 * TRIALS
