# SPDX-License-Identifier: Apache-2.0
"""Lamps whose light starts elsewhere than the distances. Off the axis as on it: softbox-like lamps that nobody
named, I cos^k about a source .3 m before the mark, one answer for `intensity_cd` and `beam.axial_cd`, which
foretells what was read. Written without a header of lightcal."""
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import LIGHTCAL, answer  # noqa: E402

SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 16  # of few the frequencies are not judged
DARK = ("--room", "dark", "--meter", "3%")


def answer_or_error(*words):
    done = subprocess.run([LIGHTCAL, *words, "--json"], capture_output=True, text=True, check=False)
    return json.loads(done.stdout)


def ends(value):
    return np.array([value["low95"], value["value"], value["high95"]])


def softbox(seed):
    """Two readings at a metre, on the axis and 20 degrees off it, of 200 cd."""
    random = np.random.default_rng(seed)
    start, half = random.normal(-0.3, 0.05), np.radians(random.uniform(15, 30))
    power = np.log(0.5) / np.log(np.cos(half))
    scale = np.exp(random.normal(0, 0.015))
    lux = [scale * 200 / (1 + start) ** 2 * np.cos(a) ** power * np.exp(random.normal(0, 0.01))
           for a in (0, np.radians(20))]
    return f"{lux[0]:.4g}lx@1m", f"{lux[1]:.4g}lx@1m,20deg"


held = alone = count = 0
for seed in range(SEEDS):
    typed = softbox(seed)
    said = answer_or_error("quick", *typed, *DARK, "--at", "1m")
    if "error" in said:  # its beam is open, which has a test of its own
        continue
    lamp = said["lights"][0]
    found, axial = ends(lamp["intensity_cd"]), ends(lamp["beam"]["axial_cd"])
    # The table's peak is the axis: one answer.
    assert np.allclose(found, axial, rtol=1e-9), (typed, found, axial)
    one = ends(answer("quick", typed[0], *DARK)["lights"][0]["intensity_cd"])
    assert np.all(np.abs(found / one - 1) < 0.08), (typed, found, one)
    held += found[0] <= 200 <= found[2]
    alone += one[0] <= 200 <= one[2]
    count += 1
    read = float(typed[0].split("lx")[0])
    foretold = ends(said["predictions"][0]["model_lx"])
    assert foretold[0] <= read <= foretold[2] and abs(foretold[1] / read - 1) < 0.03, (typed, foretold)
print(f"softboxes: {count}, held {held}, by the reading on the axis alone {alone}")
assert len(sys.argv) > 2 or count >= 8 and held >= alone - 1, (count, held, alone)
