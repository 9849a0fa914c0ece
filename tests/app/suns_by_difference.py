# SPDX-License-Identifier: Apache-2.0
"""The sun that a merge clipped, by a lux reading: what the reading leaves over a sky that the camera's constant (95 %:
+- 40 %) makes as bright as it will. The interval holds the sun as often as it says, over seeded constants and meters.
The world: a sky and a disc by numpy; no header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from usdlux import write_exr  # noqa: E402

H, TRIALS, CAMERA_SD, METER_SD = 64, 40, 0.2, 0.05
PITCH = np.pi / H
AZIMUTH, POLAR = np.meshgrid((np.arange(2 * H) + 0.5) * PITCH - np.pi, (np.arange(H) + 0.5) * PITCH)
WAY = np.stack([np.sin(POLAR) * np.sin(AZIMUTH), np.sin(POLAR) * np.cos(AZIMUTH), np.cos(POLAR)], -1)
OMEGA = np.sin(POLAR) * PITCH**2
SUN = np.array([np.cos(0.6) * np.sin(0.7), np.cos(0.6) * np.cos(0.7), np.sin(0.6)])
SKY = np.where(WAY[..., 2] > 0, 2000 + 1500 * np.exp(-3 * WAY[..., 2]) + 800 * np.cos(AZIMUTH), 300.0)
DISC = WAY @ SUN > np.cos(np.radians(1.8))
SUN_LUX = 9800.0
NITS = SUN_LUX / float((DISC * OMEGA * (WAY @ SUN)).sum())
LIGHT = SKY + NITS * DISC
UP = float((LIGHT * np.clip(WAY[..., 2], 0, None) * OMEGA).sum())
TIMES = {"1/4000": 1 / 4000, "1/1000": 1 / 1000, "1/250": 1 / 250}

held, said = 0, []
for seed in range(TRIALS):
    random = np.random.default_rng(500 + seed)
    constant = 120 * np.exp(CAMERA_SD * random.standard_normal())
    frames = []
    for k, time in enumerate(TIMES.values()):
        signal = LIGHT * time * 100 / (constant * 64)
        electrons = random.poisson(np.minimum(signal * 40000, 1e9)) + 4 * random.standard_normal(signal.shape)
        frames.append(HOME / f"frame{k}.exr")
        write_exr(frames[-1], np.repeat(np.minimum(electrons / 40000, 1.0)[..., None], 3, -1))
    answer("merge", *frames, "-o", HOME / "merged.exr", "--exposures", ",".join(TIMES), "--f-number", 8, "--iso", 100,
           "--space", "rec709", "--mains", "none", "--force")
    lux = UP * np.exp(METER_SD * random.standard_normal())
    got = answer("dome", HOME / "merged.exr", "--lux", f"{lux:.0f}", "--extract", 1, "-o", HOME / "out", "--force")
    light = got["lights"][0]
    sun = light["illuminance_lx"]
    low, high = sun.get("low95", sun["value"] - sun["u95"]), sun.get("high95", sun["value"] + sun["u95"])
    held += low <= SUN_LUX <= high
    said.append(sun["u95"] / sun["value"])
print(f"the interval holds the sun in {held} of {TRIALS}; it says +- {100 * np.median(said):.0f} %, "
      f"the scale {got['scale']['u95_relative']:.2f}")
assert held >= 0.9 * TRIALS, held
assert np.median(said) < 1.0, said
