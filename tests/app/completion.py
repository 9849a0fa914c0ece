#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The completion scripts in real shells: bash and zsh at a pseudo-terminal with the Tab key, fish by
its own `complete -C`.

    completion.py LIGHTCAL_BINARY
"""
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

LIGHTCAL = pathlib.Path(sys.argv[1]).resolve()
TAB = "\t"
START_OF_LINE = "\x01"
# What is typed, then Tab; what stands on the line then.
CASES = [
    ("lightcal ru", "lightcal run"),
    ("lightcal export --to gl", "lightcal export --to gltf"),
    ("lightcal export --to gltf,bl", "lightcal export --to gltf,blender"),
    ("lightcal export --to=gl", "lightcal export --to=gltf"),
    ("lightcal read --dist", "lightcal read --distance"),
    ("lightcal color --locus day", "lightcal color --locus daylight"),
    ("lightcal --js", "lightcal --js"),
    ("lightcal completion fi", "lightcal completion fish"),
    ("lightcal fit my_la", "lightcal fit my_lamp"),
    ("lightcal merge --camera my_cam", "lightcal merge --camera my_camera.json"),
]
# What is typed, then Tab twice; the words that are offered.
LISTED = ("lightcal export --to g", ["gltf", "godot"])
SHELLS = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], ". ./lightcal.bash"),
    "zsh": (["zsh", "-f", "-i"],
            "autoload -Uz compinit && compinit -u -D; unsetopt PROMPT_SP; . ./lightcal.zsh"),
}
PROMPT = "ready> "


class Shell:
    def __init__(self, words, folder):
        environment = {"PATH": f"{folder}:/usr/bin:/bin", "HOME": folder, "PS1": PROMPT,
                       "PROMPT": PROMPT, "TERM": "dumb", "LC_ALL": "C.UTF-8"}
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.execvpe(words[0], words, environment)

    def send(self, text):
        os.write(self.terminal, text.encode())

    def until(self, pattern, seconds=60):  # until it counts as hung
        """Everything shown until the pattern has been."""
        shown, end = "", time.monotonic() + seconds
        while not re.search(pattern, shown, re.S):
            ready, _, _ = select.select([self.terminal], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                raise TimeoutError(f"no {pattern!r} in {shown!r}")
            shown += os.read(self.terminal, 4096).decode(errors="replace")
        return shown

    def close(self):
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.terminal)


def line_after_tab(shell, typed):
    """The line as the shell holds it: made the argument of an echo, between marks."""
    shell.send(typed + TAB)
    time.sleep(0.15)  # a completion runs no program: this only lets the terminal's echo pass
    shell.send(START_OF_LINE + "echo '<'" + "\x05" + "'>'\n")
    shown = shell.until(r"\n<[^\n]*>\r?\n.*" + PROMPT)
    # A folder's slash is on the line for zsh, but goes when something else is typed.
    return re.search(r"\n<([^\n]*)>\r?\n", shown).group(1).strip().rstrip("/")


def try_shell(name, folder):
    words, load = SHELLS[name]
    problems = []
    shell = Shell(words, folder)
    try:
        shell.until(PROMPT)
        shell.send(load + "; echo loa''ded\n")
        shell.until(r"\nloaded\r?\n.*" + PROMPT)
        for typed, wanted in CASES:
            found = line_after_tab(shell, typed)
            if found != wanted:
                problems.append(f"{name}: {typed}<Tab> gave {found!r}, not {wanted!r}")
        typed, offered = LISTED
        shell.send(typed + TAB + TAB)
        shell.until(".*".join(offered))
    finally:
        shell.close()
    return problems


def try_fish(folder):
    problems = []
    for typed, wanted in CASES:
        # fish gives the last word alone, with what it means behind a tab.
        last = wanted.split()[-1]
        done = subprocess.run(
            ["fish", "--no-config", "-c", f"source lightcal.fish; complete -C '{typed}'"],
            cwd=folder, env=os.environ | {"HOME": folder, "PATH": f"{folder}:/usr/bin:/bin"},
            capture_output=True, text=True, check=False)
        offered = [line.split("\t")[0].rstrip("/") for line in done.stdout.splitlines()]
        if done.stderr or (wanted != typed and last not in offered):
            problems.append(f"fish: {typed}<Tab> offers {offered}, not {last}: {done.stderr}")
    return problems


def main():
    with tempfile.TemporaryDirectory() as folder:
        home = pathlib.Path(folder)
        (home / "lightcal").symlink_to(LIGHTCAL)
        (home / "my_lamp").mkdir()
        (home / "my_camera.json").write_text("{}", encoding="utf-8")
        for shell in ("bash", "zsh", "fish"):
            script = subprocess.run([LIGHTCAL, "completion", shell], capture_output=True, check=True)
            (home / f"lightcal.{shell}").write_bytes(script.stdout)
        problems = try_shell("bash", folder) + try_shell("zsh", folder) + try_fish(folder)
    if problems:
        sys.exit("\n".join(problems))


if __name__ == "__main__":
    main()
