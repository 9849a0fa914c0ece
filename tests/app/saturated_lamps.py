# SPDX-License-Identifier: Apache-2.0
"""What is saturated in every frame is no measurement, whatever the file: a lamp's own picture (a disk twice over the
white, one hot only in its middle) and a grey card, as DNG, three-channel EXR and PNG codes. A pixel of which any
channel is clipped has a sigma as large as itself. Frames by numpy: Poisson electrons, read noise, cut off at the
sensor's full well. Written without a header of lightcal."""
import json
import math
import pathlib
import shutil
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused, run  # noqa: E402
from code_camera import srgb  # noqa: E402
from plain_dng import mosaic, write_dng  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from plain_png import write_png  # noqa: E402
from usdlux import write_exr  # noqa: E402

ELECTRONS, READ_NOISE = 20_000.0, 3.0
NITS_AT_WHITE = 78 / 0.65 * 64 / 100  # f/8, ISO 100, 1 s
HEIGHT, WIDTH, DISTANCE_M, FOV_DEG = 80, 120, 2.0, 40.0
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])

rng = np.random.default_rng(20261129)
v, u = np.mgrid[:HEIGHT, :WIDTH]
METRES_PER_PIXEL = DISTANCE_M * math.tan(math.radians(FOV_DEG / 2)) / (WIDTH / 2)
r = np.hypot(u + 0.5 - WIDTH / 2, v + 0.5 - HEIGHT / 2) * METRES_PER_PIXEL


def signals(nits, time, colour=(1, 1, 1)):
    electrons = rng.poisson(nits[..., None] * np.array(colour) * time / NITS_AT_WHITE * ELECTRONS)
    return np.clip((electrons + rng.normal(0, READ_NOISE, electrons.shape)) / ELECTRONS, 0, 1)


def shoot(folder, kind, nits, times, colour=(1, 1, 1)):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    files = [folder / f"f{i}.{kind}" for i in range(len(times))]
    for path, time in zip(files, times):
        rgb = signals(nits, time, colour)
        if kind == "dng":
            write_dng(path, mosaic(rgb), time, 8, 100, (1, 1, 1))
        elif kind == "png":
            write_png(path, np.round(255 * srgb(rgb)).astype(np.uint8))
        else:
            write_exr(path, rgb)
    return files


def session(kind, times, capture):
    (HOME / "session.toml").write_text(f"""lightcal = 1
name = "saturated"
[room]
dark = true
[[light]]
name = "key"
kind = "disk"
minutes_on = 60
flicker_depth = 0
[[capture]]
light = "key"
frames = "c/*.{kind}"
distance_m = {DISTANCE_M}
exposure_s = {list(times)}
f_number = 8
iso = 100
{capture}{'response = "srgb"' if kind == 'png' else ''}
""")
    return ["fit", HOME, "-o", HOME / "light.json", "--force"]


SOURCE = f'use = "source"\nfov_deg = {FOV_DEG}\n'
disk = np.where(r < 0.15, 20_000.0, 15.0)
hot = 15 + 20_000 * np.exp(-((r / 0.06) ** 2))
OVER, ENOUGH = [1 / 128, 1 / 32, 1 / 8], [1 / 2048, 1 / 512, 1 / 128]
for kind in ("dng", "exr", "png"):
    for name, lamp in (("disk", disk), ("hot middle", hot)):
        shoot(HOME / "c", kind, lamp, OVER)
        refused("source_clipped", *session(kind, OVER, SOURCE), says="expose shorter|ND filter")
    shoot(HOME / "c", kind, np.where(r < 0.3, 20_000.0, 15.0), OVER)
    refused("card_unreadable", *session(kind, OVER, 'use = "card"\nreflectance = 0.18\nrect = [54, 34, 12, 12]\n'),
            says="saturated")

# The same lamp in a shorter frame is measured.
shoot(HOME / "c", "dng", disk, ENOUGH)
run(*session("dng", ENOUGH, SOURCE))
found = json.loads((HOME / "light.json").read_text())["lights"][0]["intensity_cd"]
print("disk, unclipped:", found["value"] / (20_000 * math.pi * 0.15**2))
assert abs(found["value"] / (20_000 * math.pi * 0.15**2) - 1) < 0.03, found

# Beside a lux meter the clipped one has the meter's intensity, and no size of its picture's.
shoot(HOME / "c", "dng", disk, OVER)
lux = 20_000 * math.pi * 0.15**2 / (0.15**2 + DISTANCE_M**2)
words = session("dng", OVER, SOURCE + f"anchor_illuminance_lx = {lux}\n")
refused("size_missing", *words, says="give diameter_m")
(HOME / "session.toml").write_text((HOME / "session.toml").read_text().replace('"disk"', '"disk"\ndiameter_m = 0.3'))
said = answer(*words)
lamp = json.loads((HOME / "light.json").read_text())["lights"][0]
assert "source_clipped" in [warning["code"] for warning in said["warnings"]], said["warnings"]
assert abs(lamp["intensity_cd"]["value"] / (20_000 * math.pi * 0.15**2) - 1) < 0.03, lamp["intensity_cd"]

# A lamp of which red alone is clipped: every such pixel is a bound, and no other is.
for kind in ("dng", "exr"):
    files = shoot(HOME / "c", kind, np.where(r < 0.15, 0.5 * NITS_AT_WHITE, 0.05 * NITS_AT_WHITE), [1.0, 4.0],
                  (2.5, 1, 1) if kind == "exr" else (1.2, 1.2, 2.5))
    answer("merge", *files, "-o", HOME / "o.exr", "--sigma", HOME / "s.exr", "--exposures", "1,4", "--f-number", "8",
           "--iso", "100", "--mains", "none", "--force")
    luminance, sigma = read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr")
    share = sigma / (luminance if luminance.ndim == 2 else luminance[..., ::-1] @ WEIGHTS)
    inside, outside = share[r < 0.15 - 2 * METRES_PER_PIXEL], share[r > 0.15 + 2 * METRES_PER_PIXEL]
    print(kind, "one channel clipped: sigma / value", inside.min(), outside.max())
    assert inside.min() > 0.97 and outside.max() < 0.2, (kind, inside.min(), outside.max())

# A merged picture no longer says which pixels are bounds: its frames are asked for, anchored or not.
shoot(HOME / "c", "dng", np.where(r < 0.3, 2000.0, 15.0), OVER)
answer("merge", *(HOME / f"c/f{i}.dng" for i in range(3)), "-o", HOME / "merged.exr", "--mains", "none")
for anchor in ("", "anchor_illuminance_lx = 469\n"):
    words = session("exr", OVER, f'use = "card"\nreflectance = 0.18\n{anchor}')
    toml = (HOME / "session.toml").read_text().replace("c/*.exr", "merged.exr")
    (HOME / "session.toml").write_text("\n".join(line for line in toml.split("\n") if "exposure_s" not in line))
    refused("merged_picture", *words, says="give the frames that it was merged from")

# A merged picture no longer says which pixels are bounds: its frames are asked for, anchored or not.
shoot(HOME / "c", "dng", np.where(r < 0.3, 2000.0, 15.0), OVER)
answer("merge", *(HOME / f"c/f{i}.dng" for i in range(3)), "-o", HOME / "merged.exr", "--mains", "none")
for anchor in ("", "anchor_illuminance_lx = 469\n"):
    words = session("exr", OVER, f'use = "card"\nreflectance = 0.18\n{anchor}')
    lines = (HOME / "session.toml").read_text().replace("c/*.exr", "merged.exr").split("\n")
    (HOME / "session.toml").write_text("\n".join(line for line in lines if "exposure_s" not in line))
    refused("merged_picture", *words, says="give the frames that it was merged from")
