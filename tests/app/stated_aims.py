# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome` of views whose stated aims are wrong: refused or warned of, and which view is odd; never where they
are right, though gains and the lens differ, lamps clip, and people walk. Views are cut by tests/tools/panorama_views.py
from real panoramas; no header of lightcal."""
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
import panorama_views as views  # noqa: E402
from built_command import HOME, LIGHTCAL  # noqa: E402
from usdlux import write_exr  # noqa: E402

LATLONG = pathlib.Path(__file__).resolve().parents[2] / "sample_data/pictures/latlong"
RING = [(0, 0, 0), (90, 0, 0), (180, 0, 0), (270, 0, 0)]
SPHERE = ([(y, 0, 0) for y in range(0, 360, 45)] + [(y, 50, 0) for y in range(0, 360, 60)]
          + [(y, -50, 0) for y in range(0, 360, 60)] + [(0, 90, 0), (0, -90, 0)])


def shoot(name, panorama, camera, aims, seed, clip=None, walkers=0):
    random = np.random.default_rng(seed)
    files = []
    for i, aim in enumerate(aims):
        world = panorama
        if walkers:  # dark figures 5 degrees wide, elsewhere in each view
            world = panorama.copy()
            for at in random.integers(0, world.shape[1], walkers):
                rows = slice(int(0.44 * len(world)), int(0.7 * len(world)))
                world[rows, at:at + world.shape[1] // 72] = np.median(panorama) * random.uniform(.02, .5)
        picture = camera.shoot(world, views.axes(*aim), float(np.exp(.1 * random.standard_normal())), random)
        if clip:
            picture = np.minimum(picture, clip * np.median(picture[picture > 0]))
        files.append(HOME / f"{name}{i}.exr")
        write_exr(files[-1], picture)
    return files


def dome(files, aims, camera):
    """Its error, what it warned of disagreement, and all that it said."""
    words = [word for aim in aims for word in ("--aim", ",".join(map(str, aim)))]
    done = subprocess.run([LIGHTCAL, "dome", *map(str, files), "--projection", camera.kind, "--fov", str(camera.fov_deg),
                           *words, "-o", HOME / "out", "--force", "--json"], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 3), done.stderr
    said = json.loads(done.stdout)
    return said.get("error"), [w["message"] for w in said.get("warnings", []) if w["code"] == "views_disagree"], said


def right(what, files, aims, camera):
    error, warned, said = dome(files, aims, camera)
    assert not error and not warned, (what, error, warned)
    print(f"{what}, right: {said['agreement_sd_relative']:.4f}, {said.get('apart_fraction', np.nan):.3f} apart")


def wrong(what, files, aims, camera, refuse, odd):
    error, warned, _ = dome(files, aims, camera)
    assert error or warned, f"{what}: silent"
    if refuse:
        assert error and error["code"] == "views_contradict", (what, error, warned)
    text = error["message"] if error else warned[0]
    print(f"{what}: {'refused' if error else 'warned'}: {text}")
    if odd:
        without = text[text.index("without"):text.index("the others agree")]
        assert {i + 1 for i in range(len(files)) if f"{i + 1} (" in without} == odd, (what, text)


FISHEYE = views.Camera("equidistant", 300, 300, 185, samples=1)
LENS = views.Camera("rect", 240, 180, 75, samples=1)
for name in ("lobby", "sunset"):
    whole = views.read_hdr(LATLONG / f"{name}.hdr")
    four = shoot(f"{name}_four", whole, FISHEYE, RING, 1)
    right(f"{name}, 4 fisheyes", four, RING, FISHEYE)
    right(f"{name}, 4 fisheyes, people and clipped lamps",
          shoot(f"{name}_walk", whole, FISHEYE, RING, 2, clip=20, walkers=3), RING, FISHEYE)
    for what, aims, refuse, odd in (
            ("two files swapped", [RING[1], RING[0], *RING[2:]], True, {1, 2}),
            ("one rolled 90 degrees", [RING[0], (90, 0, 90), *RING[2:]], True, {2}),
            ("one 20 degrees off", [RING[0], (110, 0, 0), *RING[2:]], False, {2}),
            ("one 5 degrees off", [RING[0], (95, 0, 0), *RING[2:]], False, {2}),
            ("turned left, not right", [RING[0], RING[3], RING[2], RING[1]], True, None)):
        wrong(f"{name}, 4 fisheyes, {what}", four, aims, FISHEYE, refuse, odd)
whole = views.read_hdr(LATLONG / "lobby.hdr")
many = shoot("many", whole, LENS, SPHERE, 3, clip=30)
right("22 of an ordinary lens", many, SPHERE, LENS)
swapped = [*SPHERE[:3], SPHERE[4], SPHERE[3], *SPHERE[5:]]
wrong("22, two files swapped", many, swapped, LENS, False, {4, 5})
wrong("22, one rolled 90 degrees", many, [*SPHERE[:2], (90, 0, 90), *SPHERE[3:]], LENS, False, {3})
wrong("22, all turned left", many, [(-y, p, r) for y, p, r in SPHERE], LENS, True, None)
