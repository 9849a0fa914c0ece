#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What a fixture of 200 states costs: the whole `lightcal fit` of them, and one answer of `state`.

    speed.py LIGHTCAL

Processor time of the whole process, its start included, the median of 21: a bicolour panel read at 20
levels and 10 colour temperatures, asked at one that lies between. Fails above 50 ms and 20 ms.
"""
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy as np

import coverage
import fixtures

RUNS = 21


def milliseconds(words):
    times = []
    for _ in range(RUNS):
        child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = status
        if status != 0:
            sys.exit(f"{words}: status {status}")
        times.append(1e3 * (usage.ru_utime + usage.ru_stime))
    return statistics.median(times)


def main():
    lightcal = os.path.abspath(sys.argv[1])
    random = np.random.default_rng(1)
    fixture = fixtures.Fixture(random, "bicolour")
    fixture.read_at = [(level, label) for level in range(100, 0, -5)
                       for label in np.linspace(2700, 6500, 10).round(1)]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "session.toml").write_text(coverage.session(fixture, random), encoding="utf-8")
        light = folder / "light.json"
        nothing = milliseconds([lightcal, "convert", "1cd", "--kind", "point"])
        fit = milliseconds([lightcal, "fit", folder, "-o", light, "--quiet", "--force"])
        state = milliseconds([lightcal, "state", light, "--at", "dimmer=37,cct_K=4321", "--quiet"])
    print(f"{len(fixture.read_at)} states: fit {fit:.1f} ms, state {state:.1f} ms "
          f"(a start alone {nothing:.1f} ms)")
    if fit > 50.0 or state > 20.0:
        sys.exit("more than 50 ms or 20 ms")


if __name__ == "__main__":
    main()
