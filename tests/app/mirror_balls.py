#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome --projection mirrorball` on balls of chromium traced ray by ray under published
panoramas (tests/tools/mirror_ball_world.py, which knows nothing of lightcal).

    mirror_balls.py LIGHTCAL
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import mirror_ball_world as world  # noqa: E402

LIGHTCAL = sys.argv[1]
PANORAMAS = ROOT / "sample_data/pictures/latlong"
FRESNEL_0 = float(world.fresnel(world.CHROMIUM, np.array(1.0)))
failures = []


def run(*words):
    done = subprocess.run([LIGHTCAL, *map(str, words)], capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout), done.stderr


def expect(ok, what):
    print(("ok    " if ok else "FAILED ") + what)
    if not ok:
        failures.append(what)


def box_words(box):
    return ",".join(f"{v:.3f}" for v in box)


def shoot(folder, name, panorama, camera, centre, seen=None, white=1.0, **how):
    """A picture file of a chromium ball, and its box."""
    picture = world.photograph(panorama, camera, centre,
                               world.mirror(panorama if seen is None else seen, **how))
    world.write_exr(folder / name, picture / white, white_luminance=white)
    return folder / name, camera.box(centre)


def worst_plane(got, truth, names=world.SIX):
    off = {n: got["illuminance_lx"][n]["total"] / truth[n] - 1.0 for n in names}
    name = max(off, key=lambda n: abs(off[n]))
    return abs(off[name]), f"{name} {100 * off[name]:+.2f} %"


def angle_deg(a, b):
    return np.degrees(np.arccos(np.clip(np.dot(a, b), -1, 1)))


def one_ball(folder):
    """A camera at 5 radii, the ball off the picture's middle: E outside the cap, and the sun."""
    for name, azimuth, elevation in (("lobby", 130, 25), ("sunset", -100, 40)):
        bare = 50.0 * world.read_hdr(PANORAMAS / f"{name}.hdr")
        panorama, sun = world.with_sun(bare, azimuth, elevation, 0.7 * world.six_lux(bare)["up"])
        camera = world.Camera(480, 400, 40.0, yaw=20.0, pitch=-5.0, roll=3.0)
        centre = 5.0 * camera.towards(270.0, 185.0)
        path, box = shoot(folder, name + ".exr", panorama, camera, centre, white=80.0)
        code, got, errors = run("dome", path, "--projection", "mirrorball", "--ball",
                                box_words(box), "--fov", "40", "--aim", "20,-5,3",
                                "--ball-reflectance", f"{FRESNEL_0:.4f},0.01", "--extract", "1",
                                "-o", folder / ("out_" + name), "--json")
        expect(code == 0, f"{name}: exit {code} {errors}")
        # A file that says cd/m2 and not how surely (20 %), and the ball's reflectance.
        stated = np.hypot(0.2, 1.96 * 0.01 / FRESNEL_0)
        expect(abs(got["scale"]["u95_relative"] / stated - 1) < 0.01,
               f"{name}: scale +- {100 * got['scale']['u95_relative']:.1f} %")
        cap = got["blind_cap"]
        axis = centre / np.linalg.norm(centre)
        at = np.radians([cap["azimuth_deg"], cap["elevation_deg"]])
        named = [np.sin(at[0]) * np.cos(at[1]), np.cos(at[0]) * np.cos(at[1]), np.sin(at[1])]
        expect(angle_deg(axis, named) < 0.1, f"{name}: the cap is named where the ball is")
        truth = world.six_lux(panorama, axis, cap["half_angle_deg"])
        off, where = worst_plane(got, truth)
        expect(off < 0.03, f"{name}: E on six planes outside a cap of {cap['half_angle_deg']:.1f} "
                           f"deg, worst {where}")
        light = got["lights"][0]
        expect(angle_deg(light["direction"], sun) < 0.5,
               f"{name}: sun off by {angle_deg(light['direction'], sun):.3f} deg")
        expect(abs(light["illuminance_lx"]["value"] / (0.7 * world.six_lux(bare)["up"]) - 1) < 0.03,
               f"{name}: sun's lux {light['illuminance_lx']['value']:.1f}")
        expect(any(w["code"] == "partly_seen" and "hides a cap" in w["message"]
                   for w in got["warnings"]), f"{name}: the hole is named")


def two_balls(folder):
    """90 degrees apart, another exposure each: the camera is gone and nothing is hidden."""
    panorama = 20.0 * world.read_hdr(PANORAMAS / "studio.hdr")
    words = []
    for i, (yaw, gain) in enumerate(((0.0, 1.0), (90.0, 0.4))):
        camera = world.Camera(420, 420, 30.0, yaw=yaw)
        centre = 6.0 * camera.towards(210.0, 210.0)
        seen = world.without_camera(panorama, camera, centre)
        picture = gain * world.photograph(panorama, camera, centre, world.mirror(seen))
        world.write_exr(folder / f"two{i}.exr", picture)
        box = camera.box(centre)
        words += ["--aim", f"{yaw:g},0", "--ball", box_words(box)]
    truth = world.six_lux(panorama)
    code, got, errors = run("dome", folder / "two0.exr", folder / "two1.exr", "--projection",
                            "mirrorball", "--fov", "30", "--lux", f"{truth['up']:.3f}", *words,
                            "-o", folder / "out_two", "--json")
    expect(code == 0, f"two balls: exit {code} {errors}")
    off, where = worst_plane(got, truth)
    expect(off < 0.03, f"two balls: E on six planes, whole sphere, worst {where}")
    expect(got["seen_fraction"] > 0.9995, f"two balls: {got['seen_fraction']:.5f} of the sphere")
    ratio = got["views"][1]["factor"] / got["views"][0]["factor"]
    expect(abs(ratio * 0.4 - 1) < 0.01, f"two balls: one scale, {100 * (ratio * 0.4 - 1):+.2f} %")
    one = run("dome", folder / "two0.exr", "--projection", "mirrorball", "--fov", "30", "--ball",
              words[3], "--lux", f"{truth['up']:.3f}", "-o", folder / "out_one", "--json")[1]
    alone = one["illuminance_lx"]["back"]["total"] / truth["back"] - 1
    both = got["illuminance_lx"]["back"]["total"] / truth["back"] - 1
    expect(abs(both) < abs(alone), f"two balls: camera's side {100 * both:+.2f} % instead of "
                                   f"{100 * alone:+.2f} %")


def grey_plates(folder):
    """The plate's exposure from a grey ball, and from a card, beside the mirror ball."""
    for name in ("lobby", "sunset"):
        panorama = world.read_hdr(PANORAMAS / f"{name}.hdr")
        camera = world.Camera(320, 320, 30.0, yaw=-40.0, pitch=4.0)
        centre = 6.0 * camera.towards(190.0, 137.0)
        path, box = shoot(folder, f"{name}_ball.exr", panorama, camera, centre)
        exposed = 0.037  # of the plate, over the ball's picture
        plate = exposed * world.photograph(panorama, camera, centre, world.matt(panorama, 0.18))
        world.write_exr(folder / f"{name}_plate.exr", plate)
        words = ["dome", path, "--projection", "mirrorball", "--ball", box_words(box), "--fov", "30",
                 "--aim=-40,4", "--ball-reflectance", f"{FRESNEL_0:.4f}", "--plate",
                 folder / f"{name}_plate.exr", "--grey-ball", box_words(box)]
        code, got, errors = run(*words, "-o", folder / f"{name}_grey", "--json")
        expect(code == 0, f"{name}: grey ball, exit {code} {errors}")
        off = got["grey"]["factor"] / exposed - 1
        expect(abs(off) < 0.02, f"{name}: grey ball's scale {100 * off:+.2f} % "
                                f"+- {100 * got['grey']['u95_relative']:.1f} %")
        expect(abs(off) < got["grey"]["u95_relative"], f"{name}: inside its interval")
        expect(any(w["code"] == "relative_scale" and "plate" in w["message"]
                   for w in got["warnings"]), f"{name}: a plate without a unit is said")
        # ISO 12232: 78 / .65 N^2 / (t S) cd/m2 saturate f/8, 1/60 s, ISO 100.
        white = 78.0 / 0.65 * 64.0 * 60.0 / 100.0
        said = run(*words, "--plate-exposure", "f/8,1/60,100", "-o", folder / f"{name}_said",
                   "--json")[1]
        ratio = said["illuminance_lx"]["up"]["total"] / got["illuminance_lx"]["up"]["total"]
        expect(abs(ratio / white - 1) < 0.01, f"{name}: the plate's exposure makes it cd/m2")
        expect(0.35 < said["scale"]["u95_relative"] < 0.6, f"{name}: within what ISO speeds tell")
        world.write_exr(folder / f"{name}_nits.exr", plate, white_luminance=1.0)
        words[words.index("--plate") + 1] = folder / f"{name}_nits.exr"
        alone = run(*words, "-o", folder / f"{name}_alone", "--json")[1]["scale"]
        lux = exposed * world.six_lux(panorama)["up"]
        both = run(*words, "--lux", f"{lux:.4f}", "-o", folder / f"{name}_both", "--json")[1]["scale"]
        expect(both["u95_relative"] < min(alone["u95_relative"], 1.96 * 0.05) + 0.02,
               f"{name}: plate +- {100 * alone['u95_relative']:.1f} %, with a lux reading "
               f"+- {100 * both['u95_relative']:.1f} %")
        expect(both["u95_relative"] < alone["u95_relative"], f"{name}: a true reading never widens")
        normal = -camera.forward
        card = exposed * 0.18 / np.pi * world.planes(panorama, [normal])[0]
        world.write_exr(folder / "card.exr", np.tile(card, (60, 80, 1)))
        got = run(*words[:-4], "--plate", folder / "card.exr", "--grey-card", "20,20,30,30", "-o",
                  folder / f"{name}_card", "--json")[1]
        off = got["grey"]["factor"] / exposed - 1
        expect(abs(off) < 0.02, f"{name}: grey card's scale {100 * off:+.2f} %")
    code, answer, _ = run(*words[:-4], "--plate", folder / f"{name}_plate.exr", "--grey-ball",
                          "225,8,70,70", "-o", folder / "none", "--json")
    expect(code == 3 and "error" in answer, f"a box beside the ball: exit {code} "
           f"{answer['error']['code']}")


def view_lines(folder):
    """A fisheye whose Radiance VIEW line says so needs no --projection."""
    panorama = world.read_hdr(PANORAMAS / "studio.hdr")
    size, half = 400, np.radians(91.0)
    y, x = np.mgrid[:size, :size] + 0.5
    right, down = x - size / 2, y - size / 2
    r = np.hypot(right, down)
    theta = r / (size / 2) * half
    # Looking up, the picture's top towards -y.
    d = np.stack([np.sin(theta) * right / r, np.sin(theta) * down / r, np.cos(theta)], -1)
    picture = world.look_up(panorama, d) * (theta <= half)[..., None]
    exponent = np.ceil(np.log2(np.maximum(picture.max(-1), 1e-12)))
    mantissa = np.clip(picture / np.exp2(exponent - 8)[..., None], 0, 255).astype(np.uint8)
    code = np.dstack([mantissa, (exponent + 128).astype(np.uint8)])
    code[picture.max(-1) <= 1e-12] = 0
    for name, line in (("said", b"VIEW= -vta -vv 182\n"), ("plain", b"")):
        (folder / f"{name}.hdr").write_bytes(
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" + line + b"\n" +
            b"-Y %d +X %d\n" % (size, size) + code.tobytes())
    words = ["--lux", "300", "--json", "-o"]
    by_line = run("dome", folder / "said.hdr", *words, folder / "said")[1]
    by_words = run("dome", folder / "plain.hdr", "--projection", "equidistant", "--fov", "182",
                   *words, folder / "typed")[1]
    expect("views" in by_line and by_line["illuminance_lx"] == by_words["illuminance_lx"],
           "VIEW= -vta -vv 182 is --projection equidistant --fov 182")
    ratio = by_line["illuminance_lx"]["right"]["total"] / by_line["illuminance_lx"]["left"]["total"]
    d, _ = world.directions(*panorama.shape[:2])
    shown = half * (1 - 2 / (size / 2))  # two pixels before the rim nothing is taken
    upper = world.six_lux(panorama * (d[..., 2] > np.cos(shown))[..., None])
    expect(abs(ratio / (upper["right"] / upper["left"]) - 1) < 0.02, f"right over left {ratio:.3f}")
    code, answer, _ = run("dome", folder / "plain.hdr", *words, folder / "none")
    expect(code == 3 and answer["error"]["code"] == "bad_view", "without a line it is no panorama")


def closed_form(folder):
    """A uniform world of 100 cd/m2 in a perfect mirror is 100 pi lx behind the camera."""
    panorama = np.full((64, 128, 3), 100.0)
    camera = world.Camera(300, 300, 25.0)
    centre = 6.0 * camera.towards(150.0, 150.0)
    path, box = shoot(folder, "plain.exr", panorama, camera, centre, index=None)
    got = run("dome", path, "--projection", "mirrorball", "--ball", box_words(box), "--fov", "25",
              "--ball-reflectance", "1", "-o", folder / "out_plain", "--json")[1]
    lux = got["illuminance_lx"]["back"]["total"]
    expect(abs(lux / (100 * np.pi) - 1) < 1e-4, f"uniform: {lux:.3f} lx behind the camera")


def refusals(folder):
    ball = folder / "plain.exr"
    for more, code, word in ((["--ball", "10,10,100,150"], 3, "bad_ball"),
                             (["--ball", "250,10,100,100"], 3, "bad_ball"),
                             (["--ball", "1,2,3"], 2, "--ball"),
                             ([], 2, "--ball"),
                             (["--ball", "60,60,180,180", "--ball-distance", "0.4"], 2, "")):
        got, answer, _ = run("dome", ball, "--projection", "mirrorball", *more, "-o",
                             folder / "none", "--json")
        expect(got == code and word in json.dumps(answer), f"{more}: exit {got} {answer}")
    expect(not (folder / "none").exists(), "nothing is written by what is refused")


with tempfile.TemporaryDirectory() as name:
    place = pathlib.Path(name)
    for part in (closed_form, refusals, one_ball, two_balls, grey_plates, view_lines):
        part(place)
sys.exit(f"{len(failures)} failed" if failures else 0)
