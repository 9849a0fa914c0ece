# SPDX-License-Identifier: Apache-2.0
"""Light that changes in a part of the picture between a bracket's frames does not pass for their exposures: what
did not change is held by sigma, and the change is named. Where nothing changed, nothing is said, nor widened. By
numpy, without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_dng import BLACK, WHITE, write_dng  # noqa: E402
from plain_exr import read_exr  # noqa: E402

H, W, FULL = 240, 320, 40000.0
LABELS = (1 / 2000, 1 / 500, 1 / 125, 1 / 30, 1 / 8)
TIMES = (1 / 2048, 1 / 512, 1 / 128, 1 / 32, 1 / 8)  # 1/30 s is 1/32
y, x = np.mgrid[:H, :W]
# Of full scale in a second: .6 of it in the shortest frame.
scene = 0.4 * np.exp(np.log(3000) * (y / H))


def merged(seed, steps, part=0.5, black=0.0):
    random = np.random.default_rng(seed)
    pixels = 1 + 0.005 * random.standard_normal(scene.shape)
    files = []
    for i, (label, time) in enumerate(zip(LABELS, TIMES)):
        light = scene * np.where(x < W * (1 - part), 1.0, steps[i])
        light = light * pixels * time * np.exp(0.01 * random.standard_normal())
        seen = random.poisson(np.clip(light, 0, 2) * FULL) + 4 * random.standard_normal(light.shape)
        codes = BLACK + black + seen / FULL * (WHITE - BLACK)
        files.append(HOME / f"{i}.dng")
        write_dng(files[-1], np.clip(np.rint(codes), 0, WHITE).astype("<u2"), label, 8, 100, (1, 1, 1))
    still = W - 8 if part == 1.0 else int(W * (1 - part)) - 8
    # The meter reads the brightest of what did not change.
    known = scene[220:236, 4:still].mean()
    said = answer("merge", *files, "-o", HOME / "l.exr", "--sigma", HOME / "s.exr", "--force", "--uncompressed",
                  "--mains", "none", "--anchor", f"4,220,{still - 4},16={known!r}", "--anchor-sigma", "0.5%")
    place = np.s_[4:200, 4:still]
    luminance, sigma = (read_exr(HOME / name)[place] for name in ("l.exr", "s.exr"))
    inside = np.mean(np.abs(luminance - scene[place]) < 1.96 * sigma)
    codes = [warning["code"] for warning in said.get("warnings", [])]
    return inside, np.median(sigma / luminance), codes


for name, part, steps in (("to 75 %", 0.5, (1, 0.97, 0.9, 0.8, 0.75)), ("to 75 %", 0.8, (1, 0.97, 0.9, 0.8, 0.75)),
                          ("to 92 %", 0.5, (1, 0.98, 0.96, 0.94, 0.92)), ("to 92 %", 0.8, (1, 0.98, 0.96, 0.94, 0.92)),
                          ("one frame 80 %", 0.5, (1, 1, 0.8, 1, 1)), ("one frame 80 %", 0.8, (1, 1, 0.8, 1, 1))):
    seen = [merged(seed, steps, part) for seed in range(6)]
    inside, wide = (np.mean([s[i] for s in seen]) for i in (0, 1))
    print(f"{name}, {part} of the picture: {100 * inside:.0f} % within 1.96 sigma, sigma {100 * wide:.1f} %")
    assert inside > 0.9, (name, part, inside)
    assert wide < 0.1, (name, part, wide)
    assert all("light_changed" in codes for *_, codes in seen), seen
steady = (1, 1, 1, 1, 1)
for name, more in (("steady", {}), ("all of it drifts", {"steps": (1, 0.97, 0.9, 0.8, 0.75), "part": 1.0}),
                   ("black 1 DN off", {"black": 1.0})):
    for seed in range(10, 14):
        inside, wide, codes = merged(seed, **{"steps": steady, **more})
        assert "light_changed" not in codes, (name, seed, codes)
        if name == "steady":
            assert inside > 0.9 and wide < 0.015, (name, seed, inside, wide)
