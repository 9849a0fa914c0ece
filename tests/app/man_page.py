#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manual page: mandoc and groff find no fault in it, and it holds every command, option and word.

    man_page.py LIGHTCAL_BINARY
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from cli_help import commands_of

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())


def run(*words):
    environment = os.environ | {"LC_ALL": "C.UTF-8", "MANWIDTH": "100", "MANPAGER": "cat",
                                "SOURCE_DATE_EPOCH": "1780000000"}
    return subprocess.run(words, capture_output=True, text=True, env=environment, check=False)


def main():
    problems = []
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "lightcal.1"
        page.write_text(run(LIGHTCAL, "man").stdout, encoding="utf-8")
        lint = run("mandoc", "-T", "lint", "-W", "warning", str(page))
        shown = run("man", "--warnings", "-E", "UTF-8", "-l", str(page))
        for done in (lint, shown):
            if done.returncode != 0 or done.stderr or done is lint and done.stdout:
                problems.append(f"{done.args}: exit {done.returncode}\n{done.stdout[:2000]}{done.stderr}")
        # Overstruck letters are bold; hyphens of options must be the ASCII one, to be copied.
        text = re.sub(".\b", "", shown.stdout)
        if "2026-05-28" not in text:
            problems.append("SOURCE_DATE_EPOCH is not the page's date")
        for command in commands_of(LIGHTCAL):
            heading = "lightcal " + " ".join(command.path)
            if not re.search(rf"^\s+{heading}$", text, re.M):
                problems.append(f"no section {heading}")
            problems += [f"{heading}: no {word}" for option in command.options
                         for word in option.names + option.words if word not in text]
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
