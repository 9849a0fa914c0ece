#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every public header compiles alone: what it uses it includes, and what it includes is public.

    check_headers.py SOURCE BUILD     compiles each by CMake's own command (the sources that
                                      VERIFY_INTERFACE_HEADER_SETS lays out); exit 1 and their
                                      messages when one does not
    check_headers.py --self-test      a header that leaves an include out is found, and one that
                                      includes what is not installed with it

Nine tenths of such a compilation read what the header includes. A few precompiled beginnings spare
it: one is used only by headers that include, themselves or through other headers of ours,
everything that it holds, so that it hides no missing include.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

BEGINNINGS = 24
INCLUDE = re.compile(r'\s*#\s*include\s+[<"]([^>"]+)[>"]')


class Includes:
    """What a header includes, through all of ours, wherever no #if stands before it."""

    def __init__(self, roots):
        self.roots = roots
        self.found = {}

    def all_of(self, header):
        if header in self.found:
            return self.found[header]
        self.found[header] = frozenset()
        names, conditions = set(), 0
        for line in header.read_text().splitlines():
            word = re.match(r"\s*#\s*(if|endif)", line)
            if word:
                conditions += 1 if word.group(1) == "if" else -1
            include = INCLUDE.match(line)
            if not include or conditions:
                continue
            own = next((path for path in (folder / include.group(1)
                                          for folder in [header.parent, *self.roots])
                        if path.exists()), None)
            names |= self.all_of(own) | {str(own)} if own else {include.group(1)}
        self.found[header] = frozenset(names)
        return self.found[header]


def cost(names):
    """Of reading them: a library's header takes about as long as four of ours."""
    return sum(1 if name.startswith("/") else 4 for name in names)


def beginnings_of(included):
    """{header: the includes precompiled before it}: greedily those sets that spare most."""
    before = dict.fromkeys(included, frozenset())
    costs = {names: cost(names) for names in {*included.values(), frozenset()}}
    for _ in range(BEGINNINGS):
        def gain(names):
            return sum(max(0, costs[names] - costs[before[header]]) for header in included
                       if names <= included[header])
        best = max(sorted(set(included.values()), key=sorted), key=gain)
        for header, names in included.items():
            if best <= names and costs[best] > costs[before[header]]:
                before[header] = best
    return before


def compile_all(commands, includes):
    """{header: (its command's words without output and source, the source)} -> messages."""
    included = {header: includes.all_of(header) for header in commands}
    before = beginnings_of(included)
    folder = tempfile.TemporaryDirectory()
    paths = {names: pathlib.Path(folder.name) / f"beginning{number}.h"
             for number, names in enumerate(set(before.values()))}

    def precompile(names):
        ours_last = sorted(names, key=lambda name: (name.startswith("/"), name))
        paths[names].write_text("".join(f"#include <{name}>\n" for name in ours_last))
        words = next(commands[header][0] for header in commands if names <= included[header])
        subprocess.run([*words, "-x", "c++-header", "-c", paths[names], "-o", f"{paths[names]}.gch"],
                       check=True)

    def compile_one(header):
        words, source = commands[header]
        run = subprocess.run([*words, "-include", paths[before[header]], "-fsyntax-only", source],
                             capture_output=True, text=True)
        return f"{header} does not compile alone:\n{run.stderr}" if run.returncode else ""

    with folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(precompile, paths))
        return [message for message in pool.map(compile_one, commands) if message]


def commands_of(build, roots):
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        named = re.search(r"_verify_interface_header_sets/(\S+)\.cxx$", entry["file"])
        if not named:
            continue
        header = next(root / named.group(1) for root in roots if (root / named.group(1)).exists())
        words = shlex.split(entry["command"])
        words = words[:words.index("-o")]
        language = words.index("-x")  # each compilation says its own
        del words[language:language + 2]
        # A launcher would keep nothing of this.
        compiler = next(i for i, word in enumerate(words) if re.search(r"(\+\+|cc)(-\d+)?$", word))
        found[header] = (words[compiler:], entry["file"])
    return found


def not_installed(public, includes):
    """Messages of public headers whose includes of ours are not public: installed, they miss them."""
    own = {header: sorted(name for name in includes.all_of(header)
                          if name.startswith("/") and pathlib.Path(name) not in public)
           for header in public}
    return [f"{header} is installed without {', '.join(missing)}: list what it includes in the "
            "room's CMakeLists.txt, or leave it out" for header, missing in own.items() if missing]


def self_test():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for header, text in {
                "whole": "#include <string>\n#include <vector>\nstd::vector<std::string> a();\n",
                "again": "#include \"whole.h\"\nstd::vector<std::string> b();\n",
                "lacks": "#include <string>\nstd::vector<std::string> c();\n",
                "later": "#ifdef NEVER\n#include <vector>\n#endif\nstd::vector<int> d();\n"}.items():
            (folder / f"{header}.h").write_text("#pragma once\n" + text)
            (folder / f"{header}.cxx").write_text(f"#include \"{header}.h\"\n")
        words = ["c++", "-std=c++20", f"-I{folder}"]
        commands = {folder / f"{header}.h": (words, folder / f"{header}.cxx")
                    for header in ("whole", "again", "lacks", "later")}
        told = sorted(pathlib.Path(message.split()[0]).stem
                      for message in compile_all(commands, Includes([folder])))
        assert told == ["lacks", "later"], told
        alone = not_installed({folder / "again.h"}, Includes([folder]))
        assert len(alone) == 1 and "whole.h" in alone[0], alone
        both = {folder / "again.h", folder / "whole.h"}
        assert not not_installed(both, Includes([folder]))


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    source, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    roots = [source / "lib", source / "devices", source / "app"]
    commands = commands_of(build, roots)
    if len(commands) < 400:
        sys.exit(f"{len(commands)} headers to compile: CMake laid out fewer than there are")
    messages = (not_installed(set(commands), Includes(roots)) or
                compile_all(commands, Includes(roots)))
    print("\n".join(messages) or f"{len(commands)} headers compile alone")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
