#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when lib or devices speak of the command line: an option, an exit code, a command. They name
fields in braces ("give {merge.noise}"), which app/option_words.cc turns into options.

    check_words.py [ROOT]        exit 1 and one line an offence
    check_words.py --self-test   plants offences and expects each to be found
"""
import pathlib
import re
import sys
import tempfile

TEXT = re.compile(r'(?P<said>//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\2"|"(?:\\.|[^"\\\n])*")|'
                  r"(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'", re.S)
OPTION = re.compile(r"(?<![\w<!-])--[a-z][\w-]*(?!-->)(?!\s*:)|\(-[a-z] \d")
EXIT = re.compile(r"\bexit(?:s with)? (?:codes?|status|[0-9])", re.I)
FIELD = re.compile(r"\{([a-zA-Z]\w*(?:\.\w+)?)\}")
# What is said of other programs, and of style sheets, whose properties begin with two dashes.
OTHERS = {"devices/lightcal_devices/transport/process.h": EXIT,
          "devices/lightcal_devices/transport/process.cc": EXIT}
UDEV = "udevadm control --reload"
STYLE_SHEETS = "lib/lightcal/report/"


def commands(root):
    """The commands' names, as app/commands.cc has them."""
    table = root / "app/commands.cc"
    return re.findall(r'^    \{"(\w+)", "', table.read_text(encoding="utf-8"), re.M)


def fields(root):
    words = (root / "app/option_words.cc").read_text(encoding="utf-8")
    return set(re.findall(r'^    \{"([\w.]+)", "', words, re.M))


def texts(path, source):
    """(text, line) of each string and comment; of a file that is no C++, each line."""
    if path.suffix not in (".h", ".cc"):
        yield from ((line, number) for number, line in enumerate(source.splitlines(), 1))
        return
    for found in TEXT.finditer(source):
        if found["said"]:
            yield found["said"], source.count("\n", 0, found.start()) + 1


def unused(root):
    """Fields that app/option_words.cc has and nobody names."""
    texts = [path.read_text(encoding="utf-8") for house in ("lib", "devices")
             for path in (root / house).rglob("*.cc")]
    return [f"app/option_words.cc: {{{field}}} is named nowhere" for field in sorted(fields(root))
            if not any("{" + field + "}" in text for text in texts)]


def offences(root):
    verb = r"\blightcal (?:" + "|".join(commands(root)) + r")\b"
    command = re.compile(f'(?<!"){verb}|{verb}(?!")')  # "lightcal exposure" is a name of its own
    known, found = fields(root), []
    for house in ("lib", "devices"):
        for path in sorted((root / house).rglob("*")):
            if path.suffix not in (".h", ".cc", ".json", ".toml"):
                continue
            name = path.relative_to(root).as_posix()
            for text, line in texts(path, path.read_text(encoding="utf-8")):
                text = text.replace(UDEV, "")
                rules = [EXIT, command] + ([] if name.startswith(STYLE_SHEETS) else [OPTION])
                said = [rule.search(text) for rule in rules if rule is not OTHERS.get(name)]
                found += [f"{name}:{line}: {word.group()}" for word in said if word]
                found += [f"{name}:{line}: {{{field}}} is not in app/option_words.cc"
                          for field in FIELD.findall(text) if "." in field and field not in known]
    return found


PLANTED = [
    ("lib/lightcal/fit/a.cc", 'Refused("x", "y", "pass --fix-offset");', 1),
    ("lib/lightcal/fit/a.h", "// `fit --json` adds them", 1),
    ("devices/lightcal_devices/a.cc", "// ends with exit code 3", 1),
    ("devices/lightcal_devices/a.cc", 'text += "see lightcal merge";', 1),
    ("lib/lightcal/records/schemas/a.json", '{"description": "what --space gives"}', 1),
    ("lib/lightcal/fit/a.cc", 'text += "give {merge.nose}";', 1),
    ("lib/lightcal/fit/a.cc", 'text += "give {merge.noise}"; // see lightcal', 0),
    ("lib/lightcal/fit/a.cc", "for (int i = 9; --i > 0; --count) f(); // <!--x-->", 0),
    ("lib/lightcal/report/a.cc", 'css = ".a { color: var(--ink); --ink: #fff; }";', 0),
    ("lib/lightcal/presets/a.cc", 'scene.add("lightcal merge")', 0),
    ("devices/lightcal_devices/a.cc", '"run `sudo udevadm control --reload`"', 0),
]


def self_test():
    for name, text, expected in PLANTED:
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            rows = {"app/commands.cc": '    {"merge", "Merges"}', name: text + "\n",
                    "app/option_words.cc": '    {"merge.noise", "--noise"}'}
            for path, contents in rows.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(contents, encoding="utf-8")
            if len(offences(root)) != expected:
                sys.exit(f"{name}: {text!r}: {offences(root)}, not {expected}")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
        return
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2]
    found = offences(root.resolve()) + unused(root.resolve())
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
