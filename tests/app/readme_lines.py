#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every `lightcal` line of README.md, in order, in an empty folder, as a newcomer would.

    readme_lines.py LIGHTCAL_BINARY

The session block is written where the lines expect it. Lines that need a meter plugged in
(--device) are left out; everything else must exit 0.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
PICTURES = ROOT / "sample_data/pictures"
CARD = ROOT / "sample_data/sessions/grey_card_dng"
WALL = ROOT / "sample_data/sessions/lit_wall"
CSV = "distance_m,illuminance_lx\n1.5,23.5\n"


def command_lines(text):
    for block in re.findall(r"```sh\n(.*?)```", text, re.S):
        for line in block.splitlines():
            line = line.split("#")[0].strip()
            if line.startswith("lightcal ") and "--device" not in line:
                yield line
    for line in re.findall(r"`(lightcal [a-z]+ [^`]*?-o [^`]*)`", text):
        yield line


def main():
    text = README.read_text(encoding="utf-8")
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
        shutil.copytree(CARD, home / "grey_card", ignore=shutil.ignore_patterns("out"))
        shutil.copytree(WALL, home / "lit_wall", ignore=shutil.ignore_patterns("out"))
        shutil.copytree(CARD / "captures", home / "my_camera/captures")
        camera = re.search(r"```toml\n([^`]*camera_frames.*?)```", text, re.S).group(1)
        (home / "my_camera/session.toml").write_text(camera, encoding="utf-8")
        shutil.copy(ROOT / "sample_data/photometric/sample2.ldt", home / "lamp.ldt")
        (home / "measurement.csv").write_text(CSV, encoding="utf-8")
        environment = os.environ | {"PATH": f"{home}/bin:{os.environ['PATH']}",
                                    "XDG_DATA_HOME": f"{home}/data"}
        lines = list(command_lines(text))
        for line in lines:
            if "out/light.json" in line:
                line = line.replace("out/light.json", "desk_lamp/out/light.json")
            done = subprocess.run(
                ["/bin/sh", "-c", line], cwd=home, env=environment, stdin=subprocess.DEVNULL,
                capture_output=True, text=True, timeout=60, check=False,
            )
            if done.returncode != 0:
                failures.append(f"{line}\n  exit {done.returncode}: {done.stderr.strip()}")
        if len(lines) < 13:
            failures.append(f"only {len(lines)} lines found: has the README changed its form?")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
