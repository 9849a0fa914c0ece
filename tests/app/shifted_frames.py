# SPDX-License-Identifier: Apache-2.0
"""A bracket whose camera moved between its frames, in a session: what is refused for it names the frames and the shift
in pixels, and what to do, before the place that holds no card or lamp then. Frames by numpy: Poisson electrons, read
noise, an RGGB mosaic. Written without a header of lightcal."""
import pathlib
import re
import shutil
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from card_session import write_card_session  # noqa: E402
from plain_dng import mosaic, write_dng  # noqa: E402

ELECTRONS, READ_NOISE = 20_000.0, 3.0
TIMES = [1 / 512, 1 / 128, 1 / 32]
HEIGHT, WIDTH, LARGER = 200, 300, 60
rng = np.random.default_rng(20261130)
y, x = np.mgrid[:HEIGHT + 2 * LARGER, :WIDTH + 2 * LARGER]
scene = np.full(x.shape, 8.0)  # of 1 s, in parts of full
for _ in range(60):  # things on a wall, small and large
    left, top, width, height = rng.integers(0, x.shape[1]), rng.integers(0, x.shape[0]), *rng.integers(5, 90, 2)
    scene[top:top + height, left:left + width] = rng.uniform(4, 28)
card = scene.copy()
card[LARGER + 80:LARGER + 110, LARGER + 120:LARGER + 160] = 12.0


def shoot(light, shifts):
    shutil.rmtree(HOME / "c", ignore_errors=True)
    (HOME / "c").mkdir()
    for i, (time, (right, down)) in enumerate(zip(TIMES, shifts)):
        seen = light[LARGER - down:LARGER - down + HEIGHT, LARGER - right:LARGER - right + WIDTH]
        electrons = rng.poisson(np.repeat(seen[..., None], 3, -1) * time * ELECTRONS)
        signal = np.clip((electrons + rng.normal(0, READ_NOISE, electrons.shape)) / ELECTRONS, -0.02, 1)
        write_dng(HOME / f"c/f{i}.dng", mosaic(signal), time, 8, 100, (1, 1, 1))


write_card_session(HOME, (122, 82, 36, 26))
WORDS = ("fit", HOME, "-o", HOME / "light.json", "--force")
shoot(card, [(0, 0)] * 3)
answer(*WORDS)
for shifts, pixels in (([(0, 0), (22, 0), (22, 0)], 22), ([(0, 0), (-18, 14), (-18, 14)], 22.8),
                       ([(0, 0), (0, -20), (0, -20)], 20)):
    shoot(card, shifts)
    error = refused("card_uneven", *WORDS, says=r"moved by [\d.]+ pixels between .*f\d\.dng and this frame.*tripod")
    print(shifts, error["message"])
    told = float(re.search(r"moved by ([\d.]+) pixels", error["message"])[1])
    assert abs(told - pixels) < 2, (shifts, told)
    assert error["message"].index("pixels") < error["message"].index("rect ="), error
    assert ".dng" in error["message"], error
