#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""app/README.md has a row for every file of app/, in its folder's table, and none for a file that is gone.

    check_app_readme.py
"""
import pathlib
import re

APP = pathlib.Path(__file__).resolve().parents[2] / "app"
ELSEWHERE = {"wasm", "trades"}  # described in words, not by file

told, folder = {}, None
for line in (APP / "README.md").read_text().splitlines():
    if heading := re.match(r"## `app/([^`]*?)/?`", line):
        folder = heading[1]
    if row := re.match(r"\| `(\w+)` \| \S", line):
        assert row[1] not in told.setdefault(folder, set()), f"app/{folder}: {row[1]} has two rows"
        told[folder].add(row[1])

there = {}
for source in sorted(APP.rglob("*")):
    if source.suffix in {".cc", ".h"} and source.relative_to(APP).parts[0] not in ELSEWHERE:
        there.setdefault(str(source.parent.relative_to(APP)).strip("."), set()).add(source.stem)
assert sum(len(names) for names in there.values()) > 150, there
for folder in there.keys() | (told.keys() - ELSEWHERE):
    missing, gone = there.get(folder, set()) - told.get(folder, set()), told.get(folder, set()) - there.get(folder, set())
    assert not missing, f"app/README.md says nothing of app/{folder}: {', '.join(sorted(missing))}"
    assert not gone, f"app/README.md names files that app/{folder} lacks: {', '.join(sorted(gone))}"
