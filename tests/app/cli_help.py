# SPDX-License-Identifier: Apache-2.0
"""What `lightcal --help` and `lightcal COMMAND --help` say, taken apart."""
import dataclasses
import re
import subprocess


@dataclasses.dataclass
class Option:
    names: list  # ["-o", "--output"], or ["session"] of a word without a name
    words: list  # ["bash", "zsh", "fish"]; empty where anything may stand

    @property
    def nameless(self):
        return not self.names[0].startswith("-")


@dataclasses.dataclass
class Command:
    path: list  # ["export"], ["lights", "list"]
    options: list
    examples: list


def help_of(lightcal, path):
    done = subprocess.run([lightcal, *path, "--help"], capture_output=True, text=True, check=True)
    return done.stdout


def section(text, title):
    """The lines of a section without their indent; what wraps onto the next line is joined."""
    found = re.search(rf"^{title}:\n((?:  .*\n?)*)", text, re.M)
    if not found:
        return []
    lines = []
    for line in found.group(1).splitlines():
        if line.startswith("   ") and lines:
            lines[-1] += " " + line.strip()
        else:
            lines.append(line[2:])
    return lines


def option_of(line):
    names = re.match(r"[^\s=]+", line).group(0).split(",")
    words = re.search(r":\{([^}]*)\}", line)
    return Option(names, words.group(1).split(",") if words else [])


def commands_of(lightcal, path=()):
    """Every command and, below it, its own commands."""
    text = help_of(lightcal, path)
    found = []
    if path:
        options = [option_of(line) for title in ("Positionals", "Options")
                   for line in section(text, title)]
        found.append(Command(list(path), options, section(text, "Examples")))
    for line in section(text, "Subcommands"):
        found += commands_of(lightcal, [*path, line.split()[0]])
    return found
