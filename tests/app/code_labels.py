# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge` of brackets of codes whose exposure labels are wrong: one odd label is measured, named and
mended, labels rounded by up to 13 % hold, and where three frames cannot tell whose label is odd sigma holds both.
Patches over nine stops by numpy through sRGB's curve; written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from code_camera import srgb  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from plain_png import write_png  # noqa: E402

SIDE, ACROSS, DOWN = 24, 8, 5
ELECTRONS, READ_NOISE = 30_000.0, 6.0  # at the highest code
FIVE = [4.0**i / 1024 for i in range(5)]
THREE = [1 / 500, 1 / 60, 1 / 8]


def scene(rng):
    nits = rng.permutation(0.5 * 2.0 ** np.linspace(0, 9, ACROSS * DOWN)).reshape(DOWN, ACROSS)
    y, x = np.mgrid[:DOWN * SIDE, :ACROSS * SIDE]
    return np.repeat(np.repeat(nits, SIDE, 0), SIDE, 1) * (1 + 0.2 * np.sin(x / 5.0) * np.sin(y / 7.0))


def shoot(light, times, rng):
    files = []
    for i, time in enumerate(times):
        electrons = rng.poisson(np.minimum(light * time * ELECTRONS / 2.5, 2 * ELECTRONS)).astype(float)
        signal = np.clip((electrons + rng.normal(0, READ_NOISE, light.shape)) / ELECTRONS, 0, 1)
        files.append(HOME / f"{len(times)}_{i}.png")
        write_png(files[-1], np.repeat(np.round(255 * srgb(signal))[..., None], 3, -1).astype(np.uint8))
    return files


def arguments(files, labels):
    return ("merge", *files, "-o", HOME / "o.exr", "--sigma", HOME / "s.exr", "--force", "--f-number", "8", "--iso", "100",
            "--mains", "none", "--exposures", ",".join(map(repr, labels)))


def merged(files, labels, light):
    """What is said, the worst patch beside their common scale, and the share of pixels within two sigma of it."""
    said = answer(*arguments(files, labels))
    found, sigma = read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr")
    found, sigma = (p[..., 0] if p.ndim == 3 else p for p in (found, sigma))
    ratio = (found / light).reshape(DOWN, SIDE, ACROSS, SIDE).mean((1, 3))
    scale = np.median(ratio)
    bright = light > 2  # below, codes are few
    within = np.abs(found / scale - light)[bright] < 2 * sigma[bright] / scale
    worst = np.max(np.abs(ratio[light[::SIDE, ::SIDE] > 2] / scale - 1))
    return said, worst, np.mean(within)


def named(said):
    return {pathlib.Path(w["subject"]).name: w["message"] for w in said.get("warnings", []) if w["code"] == "exposure_off"}


random = np.random.default_rng(20261129)
world = scene(random)
five, three = shoot(world, FIVE, random), shoot(world, THREE, random)

_, right, _ = merged(five, FIVE, world)
assert right < 0.02, right
for odd, factor in ((2, 1.33), (0, 1.33), (4, 0.6), (3, 1.13)):
    given = list(FIVE)
    given[odd] *= factor
    answered, worst, within = merged(five, given, world)
    names = named(answered)
    print(f"label {odd} times {factor}: worst patch {100 * worst:.2f} % ({100 * right:.2f} % with true labels), named {names}")
    # A label that is off by no more than rounding can bend all ratios, as any rounded one may.
    assert worst < (right + 0.01 if factor != 1.13 else 0.05), (odd, factor, worst)
    assert within > 0.9, (odd, factor, within)
    assert list(names) == ([f"5_{odd}.png"] if factor != 1.13 else []), names
    if factor != 1.13:
        off = float(names[f"5_{odd}.png"].split("exposed ")[1].split(" EV")[0])
        assert abs(off + np.log2(factor)) < 0.04, (off, factor)
        ratios = [f["ratio_ev"] for f in answered["frames"]]
        assert np.allclose(np.array(ratios) - ratios[2], np.log2(np.array(FIVE) / FIVE[2]), atol=0.04), ratios

# By more than a stop: as frames of a raw camera.
given = list(FIVE)
given[2] *= 2.5
refused("exposures_disagree", *arguments(five, given), says="EV from what")

def doubted(said):
    return any(w["code"] == "labels_disagree" for w in said.get("warnings", []))


# Three frames tell that the labels disagree; which one is odd they do not: nobody is named, and sigma holds each.
for odd, factor in ((1, 1.0), (1, 1.13), (1, 1.4), (0, 1.4), (2, 0.7), (0, 1.6), (2, 1.6), (0, 0.6), (2, 2.0)):
    given = list(THREE)
    given[odd] *= factor
    answered, worst, within = merged(three, given, world)
    print(f"of three, label {odd} times {factor}: worst patch {100 * worst:.1f} %, {100 * within:.0f} % within two sigma")
    assert within > 0.95, (odd, factor, within)
    assert not named(answered), (odd, factor, answered)
    assert doubted(answered) or factor in (1.0, 1.13), (odd, factor, answered)

# Anchored in the dark the error grows towards the bright end, by the width of all that frames see: end labels 1/3 to 1
# stop off, of three frames and four.
gradient = 0.4 * 10 ** (3.2 * np.linspace(0, 1, ACROSS * SIDE))[None] * np.ones((DOWN * SIDE, 1))
gradient *= 1 + 0.2 * np.sin(np.arange(DOWN * SIDE) / 7.0)[:, None]
for times in ([4.0**i / 512 for i in range(3)], [4.0**i / 512 for i in range(4)]):
    files = shoot(gradient, times, random)
    for odd in (0, len(times) - 1):
        for stops in (-1.0, -2 / 3, -1 / 3, 0, 1 / 3, 2 / 3, 1.0):
            given = list(times)
            given[odd] *= 2.0**stops
            said = answer(*arguments(files, given), "--anchor", f"30,40,8,8={gradient[40:48, 30:38].mean():.6g}")
            found, sigma = (p[..., 0] if p.ndim == 3 else p for p in (read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr")))
            own = said["scale"]["u95_relative"] / 1.96 * found
            seen = gradient * times[0] < 2.2
            within = np.mean(np.abs(found - gradient)[seen] < 2 * np.hypot(sigma, own)[seen])
            median = np.median((sigma / found)[seen])
            print(f"{len(times)} frames, label {odd} {stops:+.2f} EV: {100 * within:.1f} % within two sigma of {100 * median:.1f} %, "
                  f"named {list(named(said))}, doubted {doubted(said)}")
            assert within > 0.95, (odd, stops, within)
            assert all(f"{len(times)}_{odd}.png" == name for name in named(said)), named(said)
            assert stops != 0 or (median < 0.05 and not named(said) and not doubted(said)), (median, said)
