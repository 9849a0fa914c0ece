# SPDX-License-Identifier: Apache-2.0
"""What every figure of the standing page is made of: rows, measured in turns."""
import dataclasses
import datetime
import json
import math
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import time

OWN, PUBLISHED, PUBLIC = "lightcal", "published method", "public tool"
SCIPY = ("python3-scipy", "scipy")  # package, name


@dataclasses.dataclass
class Row:
    """One setting of one method: processor time of its rounds, how far its answers lie from the
    truth."""
    method: str
    setting: str
    kind: str
    seconds: list
    error: float    # worst
    usual: float    # median

    @property
    def median(self):
        return statistics.median(self.seconds)

    @property
    def quartiles(self):
        if len(self.seconds) < 2:
            return self.median, self.median
        low, _, high = statistics.quantiles(self.seconds, n=4, method="inclusive")
        return low, high


@dataclasses.dataclass
class Figure:
    key: str
    title: str
    x_label: str
    y_label: str
    what: str             # what is measured, and by what truth
    baseline: tuple       # (method, setting) of the row that the others' times are ratios of
    unordered: list = dataclasses.field(default_factory=list)  # methods whose settings are no scale
    rows: list = dataclasses.field(default_factory=list)
    sentence: str = ""    # what a person can do with it
    versions: list = dataclasses.field(default_factory=list)
    missing: list = dataclasses.field(default_factory=list)
    made: str = ""        # date and load

    def row(self, method, setting=None):
        """The first row of a method, or None."""
        return next((r for r in self.rows
                     if r.method == method and setting in (None, r.setting)), None)

    def base(self):
        return self.row(*self.baseline)

    def takes(self, there, *tools):
        """Whether public tools take part: (package, name) of each is said with its version, or as
        missing."""
        for package, name in tools:
            if there:
                self.versions.append(version_of(package, name))
            else:
                self.missing.append(name)
        return there


def save(figure, path):
    path.write_text(json.dumps(dataclasses.asdict(figure), indent=1, ensure_ascii=False) + "\n",
                    encoding="utf-8")


def load(path):
    fields = json.loads(path.read_text(encoding="utf-8"))
    fields["rows"] = [Row(**row) for row in fields["rows"]]
    return Figure(**fields)


@dataclasses.dataclass
class Bench:
    """Where things are and how much to do."""
    build: pathlib.Path
    work: pathlib.Path
    quick: bool
    own_only: bool

    @property
    def rounds(self):
        return 3 if self.quick else 7

    def program(self, name):
        """A program of the build, or None."""
        path = self.build / "tests/bench" / name
        return path if path.exists() else None

    def python_has(self, module):
        return subprocess.run(["/usr/bin/python3", "-c", f"import {module}"], check=False,
                              stderr=subprocess.DEVNULL).returncode == 0

    def lightcal(self):
        return self.build / "app/lightcal"

    def write_table(self, name, rows):
        path = self.work / name
        path.write_text("\n".join(" ".join(repr(float(x)) for x in row) for row in rows) + "\n")
        return path


def run(command):
    """Standard output of a command that must succeed."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def program_task(command, kind):
    """A task that runs a program of page/rows.h once; kind may depend on the method's name."""
    def task():
        for line in run(command).splitlines():
            method, setting, seconds, worst, usual = line.split("\t")
            yield Row(method, setting, kind(method), [float(seconds)], float(worst), float(usual))
    return task


def function_task(method, setting, kind, answer, truth, relative=True):
    """A task that times answer(i) for every truth[i]; one call before the clock starts."""
    def task():
        answer(0)
        start = time.process_time()
        answers = [answer(i) for i in range(len(truth))]
        seconds = (time.process_time() - start) / len(truth)
        errors = sorted(abs(a - t) / (abs(t) if relative else 1.0)
                        for a, t in zip(answers, truth))
        yield Row(method, setting, kind, [seconds], float(errors[-1]),
                  float(errors[len(errors) // 2]))
    return task


def machine():
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    system = re.search(r'PRETTY_NAME="(.*)"', pathlib.Path("/etc/os-release").read_text())
    compiler = run(["clang++-19", "-dumpversion"]).strip()
    return (f"{model.group(1) if model else platform.machine()}, {os.cpu_count()} processors, "
            f"{system.group(1)}, clang++ {compiler}, Release")


def measure(figure, tasks, rounds):
    """Runs the tasks in turns, A B A B, and gathers their rows in the order they first came."""
    load_before = os.getloadavg()[0]
    rows = {}
    for _ in range(rounds):
        for task in tasks:
            for row in task():
                known = rows.setdefault((row.method, row.setting), row)
                if known is not row:
                    known.seconds += row.seconds
    figure.rows = list(rows.values())
    now = datetime.datetime.now(datetime.timezone.utc)
    figure.made = (f"{now:%Y-%m-%d %H:%M} UTC, {rounds} rounds, load {load_before:.1f} before and "
                   f"{os.getloadavg()[0]:.1f} after, on {machine()}")
    return figure


def version_of(package, name=None):
    """"name version" of an installed Debian package, without Debian's own part."""
    text = run(["dpkg-query", "-W", "-f", "${Version}", package])
    return f"{name or package} {text.split(':')[-1].split('-')[0].split('+')[0]}"


def is_there(program):
    return shutil.which(program) is not None


def two_digits(number):
    """"9300", "93", "0.93", "5e-11"."""
    if number >= 100:
        size = 10 ** (math.floor(math.log10(number)) - 1)
        return f"{round(number / size) * size:,.0f}".replace(",", " ")
    mantissa, _, exponent = f"{number:.2g}".partition("e")
    return mantissa + (f"e{int(exponent)}" if exponent else "")


def times(ratio):
    """"8.7 x", "120 x", "1/63 000"."""
    return f"{two_digits(ratio)} x" if ratio >= 0.01 else f"1/{two_digits(1 / ratio)}"


def off(error):
    """"2e-5", "0.4 %", "12 %"."""
    if error == 0:
        return "0"
    rounded = float(f"{error:.1g}")
    return two_digits(rounded) if rounded < 1e-4 else f"{two_digits(100 * error)} %"


def duration(seconds):
    """"13 ns", "0.31 s"."""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"
