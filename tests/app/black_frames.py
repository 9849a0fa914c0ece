# SPDX-License-Identifier: Apache-2.0
"""Brackets that show nothing, or nothing but full scale, are told so by their cause, whatever they are made of."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, refused  # noqa: E402
from plain_png import write_png  # noqa: E402
from usdlux import write_exr  # noqa: E402

random = np.random.default_rng(8)


def bracket(suffix, write, pictures):
    files = [HOME / f"{suffix}{i}.{suffix}" for i in range(len(pictures))]
    for path, picture in zip(files, pictures):
        write(path, picture)
    times = ",".join(repr(0.01 * 4**i) for i in range(len(pictures)))
    return ["merge", *files, "-o", HOME / "none.exr", "--f-number", "8", "--iso", "100", "--mains", "none",
            "--exposures", times]


for count in (1, 3):
    black = [np.zeros((48, 64, 3), np.uint8)] * count
    refused("all_black", *bracket("png", write_png, black), says="lens cap")
    refused("all_saturated", *bracket("png", write_png, [p + np.uint8(255) for p in black]), says="shorter")
    refused("all_black", *bracket("exr", write_exr, [p.astype(float) for p in black]), says="lens cap")
# Read noise of a sensor whose black was taken away, once cut off at 0 and once not.
for low in (-1.0,):
    noise = [np.maximum(random.normal(0, 2e-4, (48, 64, 3)), low) for _ in range(3)]
    refused("all_black", *bracket("exr", write_exr, noise), says="lens cap")
refused("all_saturated", *bracket("exr", write_exr, [np.full((48, 64, 3), 0.97)] * 3), says="shorter")
