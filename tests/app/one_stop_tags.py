# SPDX-License-Identifier: Apache-2.0
"""A frame whose exposure tag is a stop wrong, as an edited file has it, in brackets of cameras whose shutters scatter
by 3 %: of three frames and more the others outvote it wherever it stands, the file is named, and what the picture
shows is used; two frames do not tell which of them is wrong, and the scale is as unsure. Frames by numpy: Poisson
electrons, read noise, an RGGB mosaic. Written without a header of lightcal."""
import math
import pathlib
import shutil
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, answer, refused  # noqa: E402
from card_session import write_card_session  # noqa: E402
from plain_dng import mosaic, write_dng  # noqa: E402
from plain_exr import read_exr  # noqa: E402

ELECTRONS, READ_NOISE = 20_000.0, 3.0
NITS_AT_WHITE = 78 / 0.65 * 64 / 100  # f/8, ISO 100, 1 s
TIMES = [1 / 512, 1 / 128, 1 / 32, 1 / 8, 1 / 2]
rng = np.random.default_rng(20261130)
v, u = np.mgrid[:96, :144]
nits = NITS_AT_WHITE * 2.0 ** (((u // 12) * 5 % 12) * 0.9 - 2.0) * (1 + 0.2 * np.sin(u / 5) * np.cos(v / 6))


def shoot(times, tags):
    shutil.rmtree(HOME / "c", ignore_errors=True)
    (HOME / "c").mkdir()
    for i, (time, tag) in enumerate(zip(times, tags)):
        true = time * math.exp(rng.normal(0, 0.03))
        electrons = rng.poisson(np.repeat(nits[..., None], 3, -1) * true / NITS_AT_WHITE * ELECTRONS)
        signal = np.clip((electrons + rng.normal(0, READ_NOISE, electrons.shape)) / ELECTRONS, -0.02, 1)
        write_dng(HOME / f"c/f{i}.dng", mosaic(signal), tag, 8, 100, (1, 1, 1))


def merged(count):
    return ("merge", *(HOME / f"c/f{i}.dng" for i in range(count)), "-o", HOME / "o.exr", "--mains", "none", "--force")


def scale_of_merge():
    found = read_exr(HOME / "o.exr")
    found = found if found.ndim == 2 else found @ [0.0722, 0.7152, 0.2126]
    return float(np.median(found / nits))


def codes(said):
    return [(w["code"], pathlib.Path(w["subject"]).name) for w in said.get("warnings", [])
            if w["code"] in ("exposure_off", "labels_disagree")]


cases = 0
for count in (3, 4, 5):
    for odd in range(count):
        for factor in (0.5, 2.0):
            for _ in range(2):
                times = TIMES[:count]
                tags = list(times)
                tags[odd] *= factor
                shoot(times, tags)
                said = answer(*merged(count))
                assert codes(said) == [("exposure_off", f"f{odd}.dng")], (count, odd, factor, codes(said))
                assert abs(scale_of_merge() - 1) < 0.08, (count, odd, factor, scale_of_merge())
                cases += 1
print(f"{cases} brackets of three frames and more: the odd file is named, the scale within 8 %")

# Of two frames, and where two say this and two that, nobody knows: both ends are within the scale's interval.
for tag_factors in ((2.0, 1), (0.5, 1), (1, 2.0), (1, 0.5), (2, 2, 1, 1), (1, 2, 1, 2)):
    times = TIMES[:len(tag_factors)]
    shoot(times, [time * factor for time, factor in zip(times, tag_factors)])
    said = answer(*merged(len(times)))
    found, u95 = scale_of_merge(), said["scale"]["u95_relative"]
    print(f"tags times {tag_factors}: scale {found:.3f}, u95 {u95:.2f}, {codes(said)}")
    assert [code for code, _ in codes(said)] == ["labels_disagree"], codes(said)
    assert all(f"f{i}.dng" in str(said["warnings"]) for i in range(len(times))), said["warnings"]
    assert abs(found - 1) < u95 and u95 > 0.6, (found, u95)

# By two stops: refused, wherever it stands.
for odd in range(3):
    for _ in range(3):
        tags = TIMES[:3]
        tags[odd] *= 4
        shoot(TIMES[:3], tags)
        refused("exposures_disagree", *merged(3), says="EV from what")

# In a session, too.
write_card_session(HOME, (49, 33, 10, 30))
nits = np.full_like(nits, 0.2 * NITS_AT_WHITE) * (1 + 0.5 * (u > 72))
for odd in (0, 1, 2):
    tags = [1 / 8, 1 / 4, 1 / 2]
    tags[odd] *= 2
    shoot([1 / 8, 1 / 4, 1 / 2], tags)
    said = answer("fit", HOME, "-o", HOME / "light.json", "--force")
    assert codes(said) == [("exposure_off", f"f{odd}.dng")], said["warnings"]
    candela = said["lights"][0]["intensity_cd"]
    truth = math.pi * 0.2 * NITS_AT_WHITE / 0.18
    print(f"a session with the tag of frame {odd} wrong: {candela['value'] / truth:.3f}")
    assert abs(candela["value"] / truth - 1) < 0.25 and candela["low95"] < truth < candela["high95"], candela
