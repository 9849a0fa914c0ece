# SPDX-License-Identifier: Apache-2.0
"""`lightcal merge` of codes whose response is stated and of whose exposure labels one is wrong: of three frames and
more it is found, named and mended; of two it is said that one is wrong, and sigma holds either. Rounded labels, and a
response that is another's, stay what they are. Patches by numpy; written without a header of lightcal."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer  # noqa: E402
from code_camera import srgb  # noqa: E402
from plain_exr import read_exr  # noqa: E402
from plain_png import write_png  # noqa: E402

SIDE, ACROSS, DOWN = 24, 8, 5
ELECTRONS, READ_NOISE = 30_000.0, 6.0
CURVES = {"srgb": (srgb, 255), "linear": (lambda signal: signal, 65535), "gamma": (lambda signal: signal ** (1 / 1.7), 255)}
random = np.random.default_rng(20261129)


def scene(stops):
    nits = random.permutation(0.5 * 2.0 ** np.linspace(0, stops, ACROSS * DOWN)).reshape(DOWN, ACROSS)
    y, x = np.mgrid[:DOWN * SIDE, :ACROSS * SIDE]
    return np.repeat(np.repeat(nits, SIDE, 0), SIDE, 1) * (1 + 0.2 * np.sin(x / 5.0) * np.sin(y / 7.0))


def shoot(light, times, curve, top):
    files = []
    for i, time in enumerate(times):
        electrons = random.poisson(np.minimum(light * time * ELECTRONS, 2 * ELECTRONS)).astype(float)
        signal = np.clip((electrons + random.normal(0, READ_NOISE, light.shape)) / ELECTRONS, 0, 1)
        files.append(HOME / f"{i}.png")
        codes = np.round(top * curve(signal)).astype(np.uint16 if top > 255 else np.uint8)
        write_png(files[-1], np.repeat(codes[..., None], 3, -1))
    return files


def merged(kind, stated, count, odd=0, factor=1.0):
    """Warnings, and the share of pixels within 95 % and the median error, beside a spot reading of a middling patch."""
    curve, top = CURVES[kind]
    light = scene(2 * count + 3)
    times = [0.7 / light.max() * 4.0**i for i in range(count)]
    labels = [time * light.max() / 700 for time in times]
    labels[odd] *= factor
    files = shoot(light, times, curve, top)
    patches = light.reshape(DOWN, SIDE, ACROSS, SIDE)[:, 6:18, :, 6:18].mean((1, 3)).ravel()
    spot = int(np.argsort(patches)[patches.size * 5 // 8])
    said = answer("merge", *files, "-o", HOME / "o.exr", "--sigma", HOME / "s.exr", "--force", "--f-number", "8",
                  "--iso", "100", "--mains", "none", "--exposures", ",".join(map(repr, labels)), "--response", stated,
                  "--anchor", f"{spot % ACROSS * SIDE + 6},{spot // ACROSS * SIDE + 6},12,12={patches[spot]:.6g}",
                  "--anchor-sigma", "1%")
    found, sigma = (p[..., 0] if p.ndim == 3 else p for p in (read_exr(HOME / "o.exr"), read_exr(HOME / "s.exr")))
    bright = light > light.max() / 2.0 ** (2 * count + 1)
    held = np.mean(np.abs(found - light)[bright] < 1.96 * np.hypot(sigma, 0.01 * found)[bright])
    off = float(np.sqrt(np.mean(np.log(found / light)[bright] ** 2)))
    warned = [(w["code"], pathlib.Path(w["subject"]).name) for w in said.get("warnings", [])
              if w["code"] in ("exposure_off", "labels_disagree", "response_disagrees")]
    print(f"{kind} stated {stated}, {count} frames, label {odd} times {factor}: rms {100 * off:.1f} %, "
          f"{100 * held:.0f} % held, {warned}")
    return warned, held, off


for kind in ("srgb", "linear"):
    for count, odd, factor in ((5, 0, 1.0), (5, 2, 1.3), (5, 4, 1.4), (5, 0, 0.7), (3, 1, 1.4), (3, 2, 1.4), (2, 0, 1.0)):
        warned, held, off = merged(kind, kind, count, odd, factor)
        assert held > 0.93 and off < 0.03, (kind, count, odd, factor, held, off)
        assert warned == ([("exposure_off", f"{odd}.png")] if factor != 1.0 else []), warned
    for odd in (0, 1):
        warned, held, _ = merged(kind, kind, 2, odd, 1.4)
        assert held > 0.93 and warned, (kind, held, warned)

# Labels of a dial are no fault, and a response that is another's is no fault of the labels'.
warned, held, _ = merged("srgb", "srgb", 4, 2, 1.12)
assert held > 0.93 and not warned, (held, warned)
warned, held, _ = merged("gamma", "srgb", 4)
assert "exposure_off" not in [code for code, _ in warned] and "response_disagrees" in [code for code, _ in warned], warned
