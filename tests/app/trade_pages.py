#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the worked examples of app/trades: each page in an empty folder of its own, as its reader would.

    trade_pages.py LIGHTCAL_BINARY            ends with 1 where a page prints what the program does not
    trade_pages.py LIGHTCAL_BINARY --update   writes what the program prints into the pages

A block "```toml desk/session.toml" is a file; of "```sh" and "```console" every line behind "$ " is
typed, in order. What stands under it is what it prints on stdout, word for word; a line of three dots stands
for lines that are left out. Every line must end with 0, unless "# exit 3" stands behind it.
"""
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "app/trades").glob("*.md"))
LEFT_OUT = "..."


def typed_and_shown(block):
    """[(line typed, [lines shown])] of a console block."""
    out = []
    for line in block.splitlines():
        if line.startswith("$ "):
            out.append((line[2:], []))
        elif out:
            out[-1][1].append(line)
    return out


def run(line, home, environment):
    wanted = int((re.search(r"# exit (\d)", line) or [0, 0])[1])
    done = subprocess.run(["/bin/sh", "-c", line], cwd=home, env=environment, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=120, check=False)
    fault = "" if done.returncode == wanted else f"{line}\n  exit {done.returncode}: {done.stderr.strip()}"
    return [shown.rstrip() for shown in done.stdout.splitlines()], fault


def matches(shown, printed):
    pattern = "\n".join(".*" if line == LEFT_OUT else re.escape(line) for line in shown)
    return re.fullmatch(pattern, "\n".join(printed), re.S) is not None


def walk(page, home, environment, update):
    """The page as it should be, and its faults."""
    faults, commands = [], 0

    def block(found):
        nonlocal commands
        head, body = found.group(1), found.group(2)
        words = head.split()
        if len(words) == 2:
            (home / words[1]).parent.mkdir(parents=True, exist_ok=True)
            (home / words[1]).write_text(body, encoding="utf-8")
        if words and words[0] == "console":
            out = []
            for line, shown in typed_and_shown(body):
                commands += 1
                printed, fault = run(line, home, environment)
                faults.extend([fault] if fault else [])
                out.append("$ " + line)
                out += shown if LEFT_OUT in shown and matches(shown, printed) else printed
                if not update and not matches(shown, printed):
                    faults.append(f"{page.name}: {line}\n" + "\n".join(
                        difflib.unified_diff(shown, printed, "the page", "the program", lineterm="")))
            return f"```{head}\n" + "".join(line + "\n" for line in out) + "```"
        if words and words[0] == "sh":
            for line in body.splitlines():
                if line.strip() and not line.startswith("#"):
                    commands += 1
                    faults.extend(fault for fault in [run(line, home, environment)[1]] if fault)
        return found.group(0)

    text = page.read_text(encoding="utf-8")
    new = re.sub(r"(?ms)^```([^\n]*)\n(.*?)^```$", block, text)
    prose = re.sub(r"(?ms)^```.*?^```$", "", text)
    wide = [line for line in prose.splitlines() if len(line) > 120]
    faults += [f"{page.name}: wider than 120 columns: {line}" for line in wide]
    if commands < 4:
        faults.append(f"{page.name}: only {commands} lines to type")
    return new, faults


def main():
    update = "--update" in sys.argv
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    faults = [f"README.md does not link {page.relative_to(ROOT)}" for page in PAGES
              if f"({page.relative_to(ROOT)})" not in readme]
    faults += [] if len(PAGES) == 5 else [f"{len(PAGES)} pages in app/trades, not five"]
    for page in PAGES:
        with tempfile.TemporaryDirectory(prefix=page.stem) as folder:
            home = pathlib.Path(folder)
            (home / "bin").mkdir()
            (home / "bin/lightcal").symlink_to(pathlib.Path(sys.argv[1]).resolve())
            samples = home / "sample_data"
            shutil.copytree(ROOT / "sample_data", samples, ignore=shutil.ignore_patterns("out", "raw"))
            environment = os.environ | {"PATH": f"{home}/bin:{os.environ['PATH']}", "TZ": "UTC",
                                        "XDG_DATA_HOME": f"{home}/data", "XDG_CONFIG_HOME": f"{home}/config"}
            new, found = walk(page, home, environment, update)
            faults += found
            if update and not found:
                page.write_text(new, encoding="utf-8")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
