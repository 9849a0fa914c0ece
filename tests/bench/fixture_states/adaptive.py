#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Of how many readings `sweep --until 3%` leaves out, over fixtures of fixtures.py.

    adaptive.py LIGHTCAL [FIXTURES [FIRST_SEED]]

A person types what the meter of coverage.py shows at each state that lightcal asks for, of an even grid
of 20 levels, or of 10 levels and 6 colour temperatures. What it did not ask for is then looked up and
held against the truth: within 3 % in 95 of 100, and not more than 60 % of the grid's readings in the
median, returns to full included.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

import coverage
import fixtures

TARGET = 0.03
LEVELS, FEW_LEVELS = range(100, 0, -5), range(100, 0, -10)
LABELS = [2700, 3200, 3800, 4400, 5000, 5600]


def sweep(lightcal, fixture, random, folder):
    """-> readings taken, and the sweep's own document."""
    over = ["--over", "dimmer=" + ",".join(map(str, FEW_LEVELS if fixture.colored else LEVELS))]
    if fixture.colored:
        over += ["--over", "cct_K=" + ",".join(map(str, LABELS))]
    scale = np.exp(random.normal(0, 0.017))
    run = subprocess.Popen([lightcal, "sweep", "-s", folder, "--light", "lamp", "--typed", "--json",
                            "--until", f"{TARGET:.0%}", *over], stdin=subprocess.PIPE,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for line in run.stderr:
        asked = re.search(r"set dimmer=([\d.]+)(?:, cct_K=([\d.]+))?", line)
        if not asked:
            continue
        label = float(asked[2]) if asked[2] else None
        lux = 3000 * fixture.xyz(float(asked[1]), label)[1] * scale * np.exp(random.normal(0, 0.01))
        run.stdin.write(f"{lux:.8g}\n")
        run.stdin.flush()
    out = run.stdout.read()
    if run.wait() != 0:
        sys.exit(f"{folder}: {out}")
    return json.loads(out)


def judge(lightcal, kind, random, folder):
    fixture = fixtures.Fixture(random, kind)
    (folder / "session.toml").write_text(coverage.HEAD, encoding="utf-8")
    (folder / "readings.jsonl").unlink(missing_ok=True)
    told = sweep(lightcal, fixture, random, folder)
    grid = [(level, label) for level in (FEW_LEVELS if fixture.colored else LEVELS)
            for label in (LABELS if fixture.colored else [None])]
    subprocess.run([lightcal, "fit", folder, "-o", folder / "light.json", "--quiet", "--force"],
                   check=True, capture_output=True)
    good = []
    for at in random.choice(len(grid), 4, replace=False):
        level, label = grid[at]
        said = f"dimmer={level}" + (f",cct_K={label}" if label else "")
        answer = json.loads(subprocess.run([lightcal, "state", folder / "light.json", "--at", said,
                                            "--json"], check=True, capture_output=True).stdout)
        truth = fixture.xyz(level, label)[1] / fixture.xyz(100, label)[1]
        good.append(abs(answer["relative_to_full"]["value"] / truth - 1) <= TARGET)
    return told["taken"] / len(grid), good


def main():
    lightcal = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 60
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    by_kind = {kind: [] for kind in fixtures.KINDS}
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            kind = fixtures.KINDS[seed % len(fixtures.KINDS)]
            by_kind[kind].append(judge(lightcal, kind, np.random.default_rng(seed),
                                       pathlib.Path(folder)))
    every = [one for found in by_kind.values() for one in found]
    print("kind       fixtures  of the grid: median, most   within 3 %")
    for kind, found in [*by_kind.items(), ("all", every)]:
        if found:
            shares = [share for share, _ in found]
            print(f"{kind:10s} {len(found):8d}  {np.median(shares):19.0%}, {max(shares):4.0%}  "
                  f"{np.mean([one for _, good in found for one in good]):10.1%}")
    share = np.median([one for one, _ in every])
    held = np.mean([one for _, good in every for one in good])
    if share > 0.6 or held < 0.95:
        sys.exit(f"{share:.0%} of the grid's readings, within 3 % in {held:.1%}")


if __name__ == "__main__":
    main()
