#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Report pages of sample sessions, looked at in headless chromium (gate.mjs).

    gate.py --lightcal LIGHTCAL --modules DIR [--fault] [--screenshots DIR]

A session of lux readings and a spectrum, one of a lit wall (luminance, distribution), one of a card
in a bracket; each page below 1 MB.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SESSIONS = HERE.parents[2] / "sample_data/sessions"
NAMES = ("three_real_lights", "lit_wall", "grey_card_exr")
LARGEST_PAGE = 1_000_000


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--lightcal", required=True)
    parser.add_argument("--modules", required=True)
    parser.add_argument("--fault", action="store_true")
    parser.add_argument("--screenshots")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pages = []
        for name in NAMES[-1:] if options.fault else NAMES:
            page = pathlib.Path(folder) / f"{name}.html"
            subprocess.run([options.lightcal, "report", SESSIONS / name, "-o", page, "--quiet"],
                           check=True, stderr=subprocess.DEVNULL)
            if page.stat().st_size > LARGEST_PAGE:
                sys.exit(f"{name}: the page has {page.stat().st_size} bytes")
            pages.append(page)
        command = ["node", HERE / "gate.mjs", pathlib.Path(options.modules).resolve(), *pages]
        if options.fault:
            command.append("--fault")
        if options.screenshots:
            target = pathlib.Path(options.screenshots)
            target.mkdir(parents=True, exist_ok=True)
            for page in pages:
                shutil.copy(page, target)
            command += ["--screenshots", target]
        sys.exit(subprocess.run(command, check=False).returncode)


if __name__ == "__main__":
    main()
