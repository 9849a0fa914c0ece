#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The WebAssembly module answers as the program does: quick, color, exposure, ratio over seeded
inputs, with the same exit codes, refusals and numbers (1e-9 relative).

    module_answers.py LIGHTCAL PACKAGE [--count 500] [--seed 22]

PACKAGE is the unpacked npm package. Prints the largest difference and where it is.
"""
import argparse
import concurrent.futures
import json
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
WITHIN = 1e-9
# Does not hold: a line in a hundred, whose offset and walls trade nearly evenly, stops this far apart
# by the two trust regions. No more lines than that, and no farther.
APART = 1e-6
# Numbers nearer to zero are held to 1e-15 of nothing: a Duv, an offset.
FLOOR = 1e-6


def quick(rng):
    candela = 10 ** rng.uniform(0, 4)
    offset = rng.uniform(0, 0.05)
    words = ["quick"]
    for distance in sorted(rng.sample([0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4], rng.randint(1, 5))):
        walls = rng.uniform(0, 0.3) * candela / 4
        direct = candela / (distance + offset) ** 2
        lux = (direct + walls) * rng.gauss(1, 0.02)
        word = f"{lux:.4g}lx@{distance}m"
        if rng.random() < 0.3:
            word += f",card={walls * rng.gauss(1, 0.02):.4g}lx"
        words.append(word)
    if rng.random() < 0.6:
        words += ["--fixture", rng.choice(["bulb", "cob_bare", "reflector", "fresnel", "panel",
                                           "softbox", "luminaire"])]
    if rng.random() < 0.5:
        words += ["--cct", f"{rng.uniform(1800, 9000):.0f}K"]
    if rng.random() < 0.6:
        words += ["--meter", rng.choice(["phone", "hobby", "lab", "3%"])]
    if rng.random() < 0.6:
        words += ["--room", rng.choice(["dark", "outdoors", "5,4,2.6", "8,6,3,0.7"])]
    if rng.random() < 0.3:
        words += ["--at", f"{rng.uniform(0.5, 6):.2f}m"]
    return words


def color(rng):
    kind = rng.randrange(4)
    if kind == 0:
        return ["color", "--xy", f"{rng.uniform(0.2, 0.6):.4f}", f"{rng.uniform(0.2, 0.5):.4f}"]
    if kind == 1:
        return ["color", "--cct", f"{10 ** rng.uniform(3.1, 4.3):.1f}K", "--duv",
                f"{rng.uniform(-0.02, 0.02):.4f}"]
    if kind == 2:
        return ["color", "--cct", f"{rng.uniform(4000, 25000):.0f}K", "--locus", "daylight"]
    return ["color", "--spectrum", "illuminant:" + rng.choice(
        ["A", "D50", "D65", "FL2", "FL11", "LED-B3", "LED-V1"])]


def exposure(rng):
    words = ["exposure", "--iso", str(rng.choice([50, 100, 400, 800, 3200, 25600]))]
    words += rng.choice([["--aperture", f"f/{rng.uniform(1.2, 22):.2g}"],
                         ["--t-stop", f"T{rng.uniform(1.3, 16):.2g}"]])
    words += rng.choice([["--shutter", f"1/{rng.randint(1, 8000)}"],
                         ["--angle", f"{rng.uniform(20, 358):.1f}", "--fps", "24"]])
    if rng.random() < 0.5:
        words += ["--light", f"{10 ** rng.uniform(0, 9):.3g}nits"]
    return words


def ratio(rng):
    return ["ratio", f"{10 ** rng.uniform(1, 4):.4g}lx", f"{10 ** rng.uniform(0, 3):.4g}lx"]


def difference(a, b, where):
    """(largest relative difference, where); infinite where they differ in kind."""
    if isinstance(a, bool) or isinstance(b, bool) or not isinstance(a, (int, float)):
        if isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
            parts = [difference(a[key], b[key], f"{where}.{key}") for key in a]
        elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
            parts = [difference(x, y, f"{where}[{i}]") for i, (x, y) in enumerate(zip(a, b))]
        else:
            return (0.0 if a == b else float("inf"), f"{where}: {a} is not {b}")
        return max(parts, default=(0.0, where))
    if not isinstance(b, (int, float)):
        return float("inf"), where
    # What walls may add is kept as logarithms and their covariances, a residual is a difference from
    # one, a share a part of one: there absolute is relative.
    of_one = ".in_room[" in where or where.endswith((".relative", ".share", ".sd_relative"))
    floor = 1.0 if of_one else FLOOR
    return abs(a - b) / max(abs(a), abs(b), floor), f"{where}: {a!r} and {b!r}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("lightcal", type=pathlib.Path)
    parser.add_argument("package")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=22)
    options = parser.parse_args()
    rng = random.Random(options.seed)
    kinds = [quick, quick, color, exposure, ratio]
    lines = [[*kinds[i % len(kinds)](rng), "--json"] for i in range(options.count)]
    # Lamps whose offset and walls trade nearly evenly: steps of Gauss and Newton came to no end there
    # (2e-8 apart before the last steps were Newton's).
    lines += [[*line.split(), "--json"] for line in (
        "quick 4.1lx@0.5m 0.349lx@2m 0.1382lx@3m --fixture softbox --meter lab --at 5.39m",
        "quick 354.7lx@0.5m 7.015lx@4m --fixture bulb --room 8,6,3,0.7")]
    # What must be refused is refused alike.
    lines += [["quick", "52lx", "--json"], ["quick", "52lx@1m", "--cct", "200K", "--json"],
              ["color", "--spectrum", "illuminant:X9", "--json"], ["quick", "--fixtur", "--json"],
              ["exposure", "--aperture", "0", "--json"]]
    program = options.lightcal.resolve()

    def by_program(words):
        done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        expected = list(pool.map(by_program, lines))
    asked = "\n".join(json.dumps({"words": words}) for words in lines)
    done = subprocess.run(["node", HERE / "answers.mjs", options.package], input=asked,
                          capture_output=True, text=True, check=True)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(answers) == len(lines), done.stderr
    worst, faults, apart, same = (0.0, ""), [], [], 0
    for words, (code, out), answer in zip(lines, expected, answers):
        line = " ".join(words)
        if answer["code"] != code:
            faults.append(f"{line}: ends with {answer['code']}, not {code}: {answer['err'][:200]}")
            continue
        same += answer["out"] == out
        if not out.strip():
            continue
        found = difference(json.loads(out), json.loads(answer["out"]), "")
        worst = max(worst, (found[0], f"{line} {found[1]}"))
        if WITHIN < found[0] <= APART:
            apart.append(f"apart: {line}: {found[1]}")
        elif found[0] > WITHIN:
            faults.append(f"{line}: {found[1]}")
    print(f"{len(lines)} commands, {same} equal to the byte, largest difference {worst[0]:.2g}: "
          f"{worst[1]}")
    if len(apart) > 1 + options.count // 100:
        faults += apart
    print("\n".join(apart[:5] + faults[:20]))
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
