# SPDX-License-Identifier: Apache-2.0
"""Lamps of a few pixels in scene-linear brackets, which name no white level: what the longer frames cut off is
not believed, whatever it is next to, and what frames contradict is as wide as they are apart. Frames by numpy:
Poisson electrons, Gaussian read noise, cut off at 1. Written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from usdlux import write_exr  # noqa: E402

ELECTRONS, READ_NOISE = 20_000.0, 3.0
PER_NIT = 0.65 * 100 / (78 * 64)  # of ISO 100 at f/8, 1 s
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])  # of linear sRGB


def shoot(path, light, time, rng, full=1.0):
    electrons = rng.poisson(light * PER_NIT * time * ELECTRONS) + rng.normal(0, READ_NOISE, light.shape)
    write_exr(path, np.minimum(electrons / ELECTRONS, full))


def merged(lights, times, rng, full=1.0):
    files = [HOME / f"f{i}.exr" for i in range(len(times))]
    for path, light, time in zip(files, lights, times):
        shoot(path, light, time, rng, full)
    said = answer("merge", *files, "-o", HOME / "o.exr", "--sigma", HOME / "s.exr", "--exposures",
                  ",".join(map(repr, times)), "--f-number", "8", "--iso", "100", "--mains", "none", "--force")
    return read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr"), said


def room(height, width, lamp, pixels):
    """A dim wavy wall with a grey lamp of pixels x pixels in its middle, and where that is."""
    y, x = np.mgrid[:height, :width]
    nits = 10 * (1.5 + np.sin(x / 9) * np.cos(y / 7))
    at = np.s_[height // 2:height // 2 + pixels, width // 2:width // 2 + pixels]
    nits[at] = lamp
    return np.repeat(nits[..., None], 3, -1), at


random = np.random.default_rng(20261129)
SIX = [0.001 * 4.0**i for i in range(6)]
# Cut off at 1, and at what a sensor's channel leaves of it; in the three longest frames, in five, in one alone.
for lamp, pixels, full, times in ((3000, 2, 1.0, SIX), (3000, 2, 0.83, SIX), (60000, 1, 1.0, SIX),
                                  (2.5 / PER_NIT / 0.016, 1, 1.0, SIX[:3]), (60000, 7, 1.0, SIX)):
    light, at = room(240, 320, lamp, pixels)
    found, sigma, said = merged([light] * len(times), times, random, full)
    scale = np.median(found / (light @ WEIGHTS))
    z = (found[at] / scale - lamp) / (sigma[at] / scale)
    print(f"{lamp:.0f} cd/m2, {pixels} px, cut off at {full}: {found[at].mean() / scale / lamp:.3f}, z {z.ravel()[:4]}")
    assert abs(found[at].mean() / scale / lamp - 1) < 0.08, lamp
    assert np.abs(z).max() < 5, lamp
    assert said["clipped_fraction"] == 0, said

# Where nothing is cut off nothing is taken to be: the same wall, its brightest place in every frame.
light, _ = room(240, 320, 60, 1)
found, sigma, said = merged([light] * 3, SIX[3:], random, 1e9)
assert said["clipped_fraction"] == 0 and not said.get("warnings"), said
assert np.abs(found / np.median(found / (light @ WEIGHTS)) / (light @ WEIGHTS) - 1).max() < 0.2

# Pictures of few pixels that the longest frames show full all over.
for height, width in ((2, 2), (3, 3), (4, 4), (6, 6)):
    light = np.array([50.0, 60.0, 70.0]) * random.uniform(0.2, 2, (height, width, 1))
    found, sigma, said = merged([light] * 6, SIX, random)
    off = found / (light @ WEIGHTS) - 1
    z = (found - light @ WEIGHTS) / sigma
    print(f"{width} x {height} px: off by {np.abs(off).max():.3f}, z {np.abs(z).max():.1f}")
    assert np.abs(off).max() < 0.12 or np.abs(z).max() < 4, (height, width)

# A lit card that was carried out before the longest frame: either may be true, and sigma holds both.
before, at = room(240, 320, 100, 4)
after, _ = room(240, 320, 5, 4)
found, sigma, _ = merged([before, after], [0.016, 64 * 0.016], random)
scale = np.median(found / (after @ WEIGHTS))
for truth in (100, 5):
    z = np.abs(found[at] / scale - truth) / (sigma[at] / scale)
    print(f"a card that was {truth} cd/m2: z {z.max():.2f}")
    assert z.max() < 3, truth

# A lamp's disk in a dark room as a session's source: nothing between it and black shows a level.
f = 160 / np.tan(np.radians(15))
y, x = np.mgrid[:240 * 4, :320 * 4]
disk = np.hypot((x + 0.5) / 4 - 160, (y + 0.5) / 4 - 120) < 0.03 * f
disk = disk.reshape(240, 4, 320, 4).mean((1, 3))
tint = np.array([1.7, 0.85, 0.4])
light = (disk * 10_000 + 0.2)[..., None] * tint / (tint @ WEIGHTS)
(HOME / "lamp" / "captures").mkdir(parents=True)
for i in range(6):
    shoot(HOME / "lamp" / "captures" / f"f{i}.exr", light, 4.0**i / 4000, random)
(HOME / "lamp" / "session.toml").write_text(f"""lightcal = 1
name = "s"
[room]
dark = true
[[light]]
name = "key"
kind = "disk"
[[capture]]
light = "key"
frames = "captures/*.exr"
exposure_s = [{", ".join(repr(4.0**i / 4000) for i in range(6))}]
f_number = 8
iso = 100
use = "source"
distance_m = 1.0
fov_deg = 30
lamp_class = "tungsten"
anchor_illuminance_lx = {10_000 * np.pi * 0.03**2}
""")
candela = answer("fit", HOME / "lamp")["lights"][0]["intensity_cd"]
print("a disk in the dark:", candela)
assert candela["low95"] < 10_000 * np.pi * 0.03**2 < candela["high95"], candela
