# SPDX-License-Identifier: Apache-2.0
"""What a pipeline does with lightcal: checked by mypy --strict, and run by python_module.py."""
import pathlib
import sys
from typing import List

import numpy

import lightcal


def brightest(answer: lightcal.RunAnswer) -> lightcal.Light:
    def candela(light: lightcal.Light) -> float:
        return light["intensity_cd"]["value"] if "intensity_cd" in light else 0.0
    return max(answer["lights"], key=candela)


def card_luminance(frames: List[pathlib.Path]) -> float:
    merged = lightcal.merge(frames, sigma=True)
    middle = merged["luminance"][10:-10, 10:-10]
    weight = 1.0 / numpy.square(merged["sigma"][10:-10, 10:-10])
    return float(numpy.average(middle, weights=weight))


def main(session: str, *frames: str) -> None:
    lamp = brightest(lightcal.run(session, effects="auto", tol=0.01))
    print(f"{lamp['name']}: {lamp['intensity_cd']['value']:.0f} cd")
    presets = lightcal.export(lightcal.quick("192lx@0.5m", {"illuminance_lx": 52, "distance_m": 1},
                                             cct=2900, at=[3, "10ft"]), to=["blender", "gltf"])
    print(*sorted(presets["contents"]))
    print(f"{card_luminance([pathlib.Path(name) for name in frames]):.1f} cd/m2")
    try:
        lightcal.color(xy=(44.0, 40.0))
    except lightcal.Error as error:
        print(error.kind, error.code, error.subject)


if __name__ == "__main__":
    main(*sys.argv[1:])
