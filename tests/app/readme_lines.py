#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every `lightcal` line of README.md, app/PICTURES.md and sample_data/README.md, in order, in an
empty folder, as a newcomer would; and holds the figures of the README's picture to what its command
prints.

    readme_lines.py LIGHTCAL_BINARY

The session block is written where the lines expect it. Lines that need a meter plugged in
(--device) are left out; everything else must exit 0.
"""
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import mirror_ball_world  # noqa: E402
import panorama_views  # noqa: E402

DOCUMENTS = [ROOT / "README.md", ROOT / "app/PICTURES.md", ROOT / "sample_data/README.md"]
PICTURE = ROOT / "app/first_lamp.svg"
PICTURES = ROOT / "sample_data/pictures"
CARD = ROOT / "sample_data/sessions/grey_card_dng"
WALL = ROOT / "sample_data/sessions/lit_wall"
CSV = "distance_m,illuminance_lx\n1.5,30.6\n"
TABLE = "name,distance_m,illuminance_lx,card_lx,fixture\nkey,1,58,10,bulb\nfill,2,20,8,bulb\n"


def command_lines(text):
    for block in re.findall(r"```sh\n(.*?)```", text, re.S):
        for line in block.splitlines():
            line = line.split("#")[0].strip()
            if line.startswith("lightcal ") and "--device" not in line:
                yield line
    for line in re.findall(r"`(lightcal [a-z]+ [^`]*?-o [^`]*)`", text):
        yield line


def transcript_faults(text, home, environment):
    """What stands under a "$ lightcal ..." is what it prints, line by line."""
    faults = []
    for line, shown in re.findall(r"```\n\$ (lightcal [^\n]*)\n(.*?)```", text, re.S):
        done = subprocess.run(["/bin/sh", "-c", line], cwd=home, env=environment,
                              capture_output=True, text=True, timeout=60, check=False)
        # A line of three dots stands for lines that are left out.
        pattern = ".*".join(re.escape(part) for part in re.split(r"(?m)^\.\.\.\n", shown))
        if not re.fullmatch(pattern, done.stdout, re.S):
            faults.append(f"{line}\n  prints\n{done.stdout}  and not\n{shown}")
    return faults


def picture_faults(home, environment):
    """The picture's <desc> holds its command, every <tspan class="found"> words that it prints."""
    drawing = PICTURE.read_text(encoding="utf-8")
    line = html.unescape(re.search(r"<desc>(lightcal [^<]*)</desc>", drawing).group(1))
    done = subprocess.run(["/bin/sh", "-c", line], cwd=home, env=environment, capture_output=True,
                          text=True, timeout=60, check=False)
    printed = " ".join(done.stdout.split())
    figures = re.findall(r'<tspan class="found">([^<]*)</tspan>', drawing)
    faults = [f"{PICTURE.name}: {figure} is not printed by {line}"
              for figure in figures if html.unescape(figure) not in printed]
    return faults if figures else [f"{PICTURE.name} shows no figure"]


def main():
    text = "\n".join(document.read_text(encoding="utf-8") for document in DOCUMENTS)
    session = re.search(r"```toml\n(.*?)```", text, re.S).group(1)
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        (home / "bin").mkdir()
        (home / "bin/lightcal").symlink_to(pathlib.Path(sys.argv[1]).resolve())
        (home / "desk_lamp").mkdir()
        (home / "desk_lamp/session.toml").write_text(session, encoding="utf-8")
        shutil.copytree(PICTURES / "png_bracket", home / "bracket",
                        ignore=shutil.ignore_patterns("README.md", "*.hdr"))
        shutil.copy(PICTURES / "latlong/lobby.hdr", home / "panorama.hdr")
        mirror_ball_world.examples(home, PICTURES / "latlong/lobby.hdr")
        panorama_views.write_views(panorama_views.read_hdr(home / "panorama.hdr"),
                                   panorama_views.Camera("rect", 320, 320, 75, samples=1),
                                   panorama_views.ring(8, 0), home / "hall", 5)
        window = (ROOT / "sample_data/vectors/glare/studio_60_10.hdr").read_bytes()
        (home / "window.hdr").write_bytes(
            window.replace(b"\n", b"\nVIEW= -vta -vh 180 -vv 180\n", 1))
        shutil.copytree(CARD, home / "grey_card", ignore=shutil.ignore_patterns("out"))
        shutil.copytree(WALL, home / "lit_wall", ignore=shutil.ignore_patterns("out"))
        shutil.copytree(CARD / "captures", home / "my_camera/captures")
        camera = re.search(r"```toml\n([^`]*camera_frames.*?)```", text, re.S).group(1)
        (home / "my_camera/session.toml").write_text(camera, encoding="utf-8")
        shutil.copy(ROOT / "sample_data/photometric/sample2.ldt", home / "lamp.ldt")
        samples = home / "sample_data"
        samples.mkdir()
        for sample in (ROOT / "sample_data").iterdir():
            if sample.name != "sessions":
                (samples / sample.name).symlink_to(sample)
        shutil.copytree(ROOT / "sample_data/sessions", samples / "sessions",
                        ignore=shutil.ignore_patterns("out"))
        (home / "measurement.csv").write_text(CSV, encoding="utf-8")
        gels = re.search(r"```text\n(filter,.*?)```", text, re.S).group(1)
        (home / "gels.csv").write_text(gels, encoding="utf-8")
        (home / "lamps.csv").write_text(TABLE, encoding="utf-8")
        environment = os.environ | {"PATH": f"{home}/bin:{os.environ['PATH']}",
                                    "XDG_DATA_HOME": f"{home}/data"}
        lines = list(command_lines(text))
        # What a program that was built without its page cannot write.
        paged = (home / "bin/lightcal").resolve().with_name("lightcal_page.html").exists()
        for line in lines:
            if not paged and (line.startswith("lightcal page") or "--to page" in line):
                continue
            if "out/light.json" in line:
                line = line.replace("out/light.json", "desk_lamp/out/light.json")
            done = subprocess.run(
                ["/bin/sh", "-c", line], cwd=home, env=environment, stdin=subprocess.DEVNULL,
                capture_output=True, text=True, timeout=300, check=False,
            )
            if done.returncode != 0:
                failures.append(f"{line}\n  exit {done.returncode}: {done.stderr.strip()}")
        failures += picture_faults(home, environment)
        failures += transcript_faults(text, home, environment)
        if len(lines) < 50:
            failures.append(f"only {len(lines)} lines found: has the README changed its form?")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
