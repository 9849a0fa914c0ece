#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every command, option and word of lightcal, mistyped by two swapped letters, and options by the
name they have elsewhere: exit 2, and the message names what was meant.

    suggestions.py LIGHTCAL_BINARY
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys

from cli_help import commands_of

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())


def mistyped(word, others):
    """The word with two neighbouring letters swapped, the last ones whose swap begins no other word."""
    for i in range(len(word) - 2, 1, -1):
        typo = word[:i] + word[i + 1] + word[i] + word[i + 2:]
        begins = any(other.startswith(typo) for other in others)  # which is meant then?
        if not begins and word[i] != "-":
            return typo
    return None


def one_slip_away(typed, meant):
    """One swap, or one letter more, less or other."""
    if len(typed) == len(meant):
        differ = [i for i in range(len(typed)) if typed[i] != meant[i]]
        return len(differ) == 1 or (len(differ) == 2 and differ[1] == differ[0] + 1)
    short, long = sorted((typed, meant), key=len)
    return any(long[:i] + long[i + 1:] == short for i in range(len(long)))


def lines_to_try():
    """(arguments, the word meant, the typed one)"""
    commands = commands_of(LIGHTCAL)
    for command in commands:
        beside = [c.path[-1] for c in commands if c.path[:-1] == command.path[:-1]]
        typo = mistyped(command.path[-1], beside)
        if typo:
            yield [*command.path[:-1], typo], command.path[-1], typo
    for command in commands:
        known = [name for option in command.options for name in option.names]
        for option in command.options:
            for name in option.names:
                typo = mistyped(name, known) if name.startswith("--") else None
                if typo:
                    yield [*command.path, typo], name, typo
            for word in option.words:
                typo = mistyped(word, option.words)
                if typo:
                    named = [] if option.nameless else [option.names[-1]]
                    yield [*command.path, *named, typo], word, typo


def problem_of(line):
    arguments, meant, typed = line
    done = subprocess.run([LIGHTCAL, *arguments, "--json"], capture_output=True, text=True,
                          stdin=subprocess.DEVNULL, check=False, timeout=30)
    where = "lightcal " + " ".join(arguments)
    if done.returncode != 2:
        return f"{where}: exit {done.returncode}"
    error = json.loads(done.stdout)["error"]
    _, _, said = error["message"].partition("did you mean ")
    answer = said.partition("?")[0].strip('"')
    if error["code"] != "usage" or (answer != meant and not one_slip_away(typed, answer)):
        return f"{where}: {error}, {meant} was meant"
    return None


# What another command, or another program, calls it.
OTHER_NAMES = ((["new"], "--light", "--lamp"), (["read"], "--lamp", "--light"), (["fit"], "--light", "--lights"),
               (["quick"], "--kelvin", "--cct"), (["fit"], "--save", "--output"), (["export"], "--target", "--to"),
               (["read"], "--illuminance", "--lux"), (["new"], "--sigma", "--accuracy"))


def main():
    lines = list(lines_to_try())
    lines += [([*path, typed], meant, typed) for path, typed, meant in OTHER_NAMES]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        problems = [problem for problem in pool.map(problem_of, lines) if problem]
    if len(lines) < 250:
        problems.append(f"only {len(lines)} words found: has --help changed its form?")
    print(f"{len(lines)} mistyped words")
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
