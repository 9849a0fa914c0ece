#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every example of every `lightcal COMMAND --help` runs as it is printed, in a folder that holds the
files its reader would have.

    help_examples.py LIGHTCAL_BINARY

Lines that need an instrument on a cable must fail for want of it (exit 1), not for their words, and
a check of a picture that is not of its rig.
"""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from cli_help import commands_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import mirror_ball_world
import panorama_views
import usdlux
SAMPLES = ROOT / "sample_data"
LIGHTCAL = pathlib.Path(sys.argv[1]).resolve()
# A meter or a camera must be plugged in; beauty.exr is a picture of something else than the rig.
FAILS = re.compile(
    r"^lightcal shoot |--device |^lightcal (read|watch) -s my_lamp --light key --distance 0.5m$"
    r"|--render beauty.exr ")
MY_LAMP = """lightcal = 1
name = "My lamp"
[[light]]
name = "key"
kind = "point"
position_m = [0, 0, 2.2]
[[meter]]
name = "cv600"
sigma_relative = 0.025
""" + "".join(f'[[reading]]\nlight = "key"\ndistance_m = {d}\nilluminance_lx = {e}\ncct_K = 2900\n'
              for d, e in [(0.5, 192.0), (1.0, 52.0), (2.0, 13.6)])
# These take half of the time, and nothing of theirs is read by another.
ALONE = ["tradeoff"]


def lacks_page(line):
    """A page that this program was built without, for want of a compiler."""
    wanted = line.startswith("lightcal page") or "--to page" in line
    return wanted and not (LIGHTCAL.parent / "lightcal_page.html").exists()


def prepare(home):
    """What the examples' reader has: sessions, pictures, exports of instruments; lightcal itself."""
    def lightcal(*words):
        subprocess.run([LIGHTCAL, *words], cwd=home, check=True, capture_output=True)

    (home / ".bin").mkdir()
    (home / ".bin/lightcal").symlink_to(LIGHTCAL)
    samples = home / "sample_data"
    samples.mkdir()
    for folder in SAMPLES.iterdir():
        if folder.name != "sessions":
            (samples / folder.name).symlink_to(folder)
    shutil.copytree(SAMPLES / "sessions", samples / "sessions", ignore=shutil.ignore_patterns("out"))
    frames = SAMPLES / "sessions/grey_card_dng/captures"
    shutil.copytree(frames, home / "bracket")
    shutil.copytree(frames, home / "my_camera/captures")
    pictures = (ROOT / "app/PICTURES.md").read_text(encoding="utf-8")
    camera = re.search(r"```toml\n([^`]*camera_frames.*?)```", pictures, re.S).group(1)
    (home / "my_camera/session.toml").write_text(camera, encoding="utf-8")
    shutil.copy(frames / "card_0.dng", home / "IMG_0042.CR2")
    for name, number in zip("abc", range(3)):
        shutil.copy(SAMPLES / f"pictures/png_bracket/parliament_{number}.png", home / f"{name}.png")
    shutil.copy(SAMPLES / "pictures/latlong/lobby.hdr", home / "lobby.hdr")
    panorama_views.write_views(panorama_views.read_hdr(home / "lobby.hdr"),
                               panorama_views.Camera("rect", 320, 320, 75, samples=1),
                               panorama_views.ring(8, 0), home / "hall", 5)
    shutil.copy(SAMPLES / "pictures/latlong/sunset.hdr", home / "sky.hdr")
    shutil.copy(SAMPLES / "pictures/exr/Rec709.exr", home / "beauty.exr")
    mirror_ball_world.examples(home, SAMPLES / "pictures/latlong/lobby.hdr")
    window = (SAMPLES / "vectors/glare/studio_60_10.hdr").read_bytes()
    (home / "window.hdr").write_bytes(window.replace(b"\n", b"\nVIEW= -vta -vh 180 -vv 180\n", 1))
    lightcal("dome", "sky.hdr", "--lux", "98klx", "-o", "sky")
    shutil.copy(home / "sky/dome.exr", home / "sky.exr")

    shutil.copy(SAMPLES / "spectra/uprtek_cv600/Nichia 80 CRI.xls", home / "lamp.xls")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    gels = re.search(r"```text\n(filter,.*?)```", readme, re.S).group(1)
    (home / "gels.csv").write_text(gels, encoding="utf-8")
    dmx = re.search(r"```toml\n(lightcal = 1\naddress.*?)```", readme, re.S).group(1)
    (home / "map.toml").write_text(dmx, encoding="utf-8")
    (home / "tape_measure.csv").write_text("distance_m,illuminance_lx\n1.5,23.5\n", encoding="utf-8")
    (home / "map.csv").write_text("lamp,object\n5600K,PropLamp_*\n", encoding="utf-8")
    (home / "lamps.csv").write_text("name,distance_m,illuminance_lx,card_lx,fixture\n"
                                    "key,1,58,10,bulb\nfill,1,31,4,bulb\n", encoding="utf-8")
    shutil.copy(SAMPLES / "spectra/jeti/spectral_Jeti_50pct.csv", home / "sweep.csv")
    shutil.copy(SAMPLES / "photometric/sample2.ldt", home / "lamp.ldt")
    lightcal("fit", "sample_data/sessions/amaran_200x_s_bare", "-o", "out/light.json")
    lightcal("engine", "rig", "--to", "usd", "-o", "learn")
    scene = usdlux.Scene(str(home / "learn/point.rig.usda"))
    usdlux.write_exr(home / "learn/point.rig.exr", scene.render(150, 100) * 2.0 ** scene.camera[0]["exposure"])


def run_examples(commands, home):
    """The examples of commands one after another; what went wrong. my_lamp is new for each command."""
    environment = os.environ | {"PATH": f"{home}/.bin:{os.environ['PATH']}", "HOME": str(home),
                                "XDG_DATA_HOME": str(home / ".data"), "MANPAGER": "cat"}
    failures = []
    for command in commands:
        shutil.rmtree(home / "my_lamp", ignore_errors=True)
        if command.path[0] != "new":  # which makes it
            (home / "my_lamp").mkdir()
            (home / "my_lamp/session.toml").write_text(MY_LAMP, encoding="utf-8")
        for line in command.examples:
            done = subprocess.run(["bash", "-c", line], cwd=home, env=environment,
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  timeout=120, check=False)
            if done.returncode != (1 if FAILS.search(line) or lacks_page(line) else 0):
                failures.append(f"{line}\n  exit {done.returncode}: {done.stderr.strip()}")
    return failures


def main():
    commands = commands_of(str(LIGHTCAL))
    lanes = [[c for c in commands if (c.path[0] in ALONE) == alone] for alone in (True, False)]
    with tempfile.TemporaryDirectory() as folder:
        homes = [pathlib.Path(folder) / name for name in ("one", "other")]
        homes[0].mkdir()
        prepare(homes[0])
        shutil.copytree(homes[0], homes[1], symlinks=True)
        with concurrent.futures.ThreadPoolExecutor(len(lanes)) as pool:
            failures = [failure for lane in pool.map(run_examples, lanes, homes) for failure in lane]
    # A command with commands of its own shows its examples above them.
    failures += [f"{c.path[0]} has no example" for c in commands if len(c.path) == 1 and not c.examples]
    count = sum(len(command.examples) for command in commands)
    print(f"{count} examples")
    if count < 50:
        failures.append(f"only {count} examples: has --help changed its form?")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
