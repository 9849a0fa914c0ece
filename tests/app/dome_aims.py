# SPDX-License-Identifier: Apache-2.0
"""`lightcal dome --aim auto` on views cut by numpy from a real panorama: aims, scale, lux, refusals, brackets.

The laws are tests/tools/panorama_views.py's. The large proof, beside Hugin, is tests/bench/auto_aims.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import numpy as np  # noqa: E402

import panorama_views as views  # noqa: E402
import usdlux  # noqa: E402

LIGHTCAL = sys.argv[1]


def dome(words, code=0):
    done = subprocess.run([LIGHTCAL, "dome", *map(str, words), "--json"], capture_output=True, text=True)
    assert done.returncode == code, (done.returncode, done.stderr[-2000:])
    return json.loads(done.stdout)


def check(name, got, **most):
    for key, limit in most.items():
        value = got[key]
        assert abs(value) <= limit, f"{name}: {key} is {value}, {limit} allowed; {got}"
    print(name, {k: (round(v, 5) if isinstance(v, float) else v) for k, v in got.items()})


def paths(folder, truth):
    return [folder / t["file"] for t in truth]


def ordinary_lens(panorama, folder):
    """Eight views round the horizon; the lens bends, and its field of view is not said."""
    camera = views.Camera("rect", 480, 400, 75, bend=0.02, samples=1)
    truth = views.write_views(panorama, camera, views.ring(8, 0), folder / "rect", 11)
    words = [*paths(folder / "rect", truth), "--aim", "auto", "-o", folder / "rect_out"]
    answer = dome(words)
    got = views.judge(answer, truth, panorama, camera)
    check("8 of an ordinary lens", got, median_deg=.05, p95_deg=.15, scale_worst=.003)
    assert abs(got["fov_deg"] - 75) < .3 and got["within_u95"] > .6, got
    assert max(map(abs, got["lux"].values())) < .01, got
    assert any(w["code"] == "horizon_assumed" for w in answer["warnings"])
    # One view named as level is level, looks along yaw 0, and the others keep their places.
    level = dome([*words, "--fov", 75, "--force", "--up", "view03.exr,2,-1"])
    assert np.allclose([level["views"][3][k] for k in ("yaw_deg", "pitch_deg", "roll_deg")], (0, 2, -1), atol=1e-9)
    assert not any(w["code"] == "horizon_assumed" for w in level["warnings"])
    check("with a level view", views.judge(level, truth, panorama, camera), median_deg=.05, p95_deg=.15)
    # What nothing joins is named.
    camera = views.Camera("rect", 300, 300, 50, samples=1)
    lone = views.write_views(panorama, camera, [(0, 0), (25, 0), (180, 0), (45, 0)], folder / "lone", 12)
    error = dome([*paths(folder / "lone", lone), "--aim", "auto", "--fov", 50, "-o", folder / "no"], code=3)["error"]
    assert error["code"] == "views_do_not_overlap" and error["subject"].endswith("view02.exr"), error
    assert not (folder / "no").exists()


def fisheyes(panorama, folder, count, fov):
    camera = views.Camera("equidistant", 480, 480, fov, samples=1)
    truth = views.write_views(panorama, camera, views.ring(count, 0), folder / f"fish{count}", 13)
    answer = dome([*paths(folder / f"fish{count}", truth), "--aim", "auto", "--projection", "equidistant", "--fov", fov,
                   "-o", folder / f"fish{count}_out"])
    got = views.judge(answer, truth, panorama, camera)
    check(f"{count} fisheyes", got, median_deg=.05, p95_deg=.15, scale_worst=.003)
    # Two share their rims alone: what the lens loses between middle and rim, no overlap can say.
    if count > 2:
        assert max(map(abs, got["lux"].values())) < .01, got


def brackets(panorama, folder):
    """Three frames a view, clipped by the sensor as real ones are; files given out of order by name."""
    camera = views.Camera("rect", 360, 360, 80, samples=1)
    random = np.random.default_rng(14)
    truth, files = [], []
    for i, (yaw, pitch) in enumerate(views.ring(6, 0)):
        rows = views.axes(yaw + random.uniform(-2, 2), pitch + random.uniform(-2, 2), random.uniform(-2, 2))
        light = camera.shoot(panorama, rows, 1.0, random)
        middle = float(np.median(light))
        for k, time in enumerate((1 / 4, 1 / 64, 1 / 1024)):
            signal = light / middle * time * 2
            frame = np.clip(signal + random.normal(0, 2e-4, signal.shape), 0, 1).astype(np.float32)
            files.append(folder / f"shot{3 * i + k:02d}.exr")
            usdlux.write_exr(files[-1], frame, floats={"expTime": time, "aperture": 8.0, "isoSpeed": 100.0})
        truth.append({"file": files[-3].name, "rows": rows.tolist(), "exposure": 1 / middle})
    words = [*files, "--aim", "auto", "--bracket", 3, "--fov", 80, "-o", folder / "bracket_out"]
    answer = dome(words)
    assert [v["file"] for v in answer["views"]] == [str(f) for f in files[::3]]
    got = views.judge(answer, truth, panorama, camera)
    check("6 brackets of 3", got, median_deg=.06, p95_deg=.2, scale_worst=.005)
    error = dome([*files[:-1], *words[len(files):]], code=3)["error"]
    assert error["code"] == "bracket_count", error
    error = dome([*files[:4], *files[5:], files[4], *words[len(files):]], code=3)["error"]
    assert error["code"] == "bracket_pattern", error


def bare_sky(panorama, folder):
    """A sky at dusk, nothing else in any view: little is known of it, and no less than is told."""
    camera = views.Camera("rect", 600, 600, 60, samples=1)
    truth = views.write_views(panorama, camera, [(7, 42), (47, 42), (87, 42), (127, 42)], folder / "sky", 3)
    answer = dome([*paths(folder / "sky", truth), "--aim", "auto", "--fov", 60, "-o", folder / "sky_out"])
    got = views.judge(answer, truth, panorama, camera)
    check("4 of a bare sky", got, median_deg=.3, p95_deg=.6, scale_worst=.003)
    assert got["within_u95"] == 1, got


with tempfile.TemporaryDirectory() as place:
    whole = views.read_hdr(ROOT / "sample_data/pictures/latlong/lobby.hdr")
    ordinary_lens(whole, pathlib.Path(place))
    fisheyes(whole, pathlib.Path(place), 4, 185)
    fisheyes(whole, pathlib.Path(place), 2, 200)
    brackets(whole, pathlib.Path(place))
    bare_sky(views.read_hdr(ROOT / "sample_data/pictures/latlong/sunset.hdr"), pathlib.Path(place))
