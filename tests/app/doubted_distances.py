#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`read --distance 50`: metres or centimetres? Asked while the meter still stands there.

usage: doubted_distances.py LIGHTCAL
"""
import json
import os
import subprocess
import sys
import tempfile


def main():
    failures = []
    for room, distance, doubted in (("", "50", True), ("", "50cm", False), ("", "5", False),
                                    ("[room]\noutdoors = true\n", "50", False),
                                    ("[room]\noutdoors = true\n", "500", True)):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "session.toml"), "w", encoding="utf-8") as file:
                file.write("lightcal = 1\n" + room + '[[light]]\nname = "key"\nkind = "point"\n')
            line = [sys.argv[1], "read", "-s", folder, "--distance", distance, "--lux", "100", "--json"]
            done = subprocess.run(line, capture_output=True, text=True, check=False)
            codes = [w["code"] for w in json.loads(done.stdout).get("warnings", [])]
            if done.returncode != 0 or ("units_suspect" in codes) != doubted:
                failures.append(f"{room!r} {distance}: {done.returncode} {codes}")
            strict = subprocess.run(line + ["--strict"], capture_output=True, text=True, check=False)
            with open(os.path.join(folder, "readings.jsonl"), encoding="utf-8") as file:
                kept = len(file.readlines())
            if (strict.returncode == 3) != doubted or kept != (1 if doubted else 2):
                failures.append(f"{room!r} {distance}: strict {strict.returncode}, {kept} lines kept")
    if failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
