# SPDX-License-Identifier: Apache-2.0
"""Sessions as a person writes them, fitted by a lightcal that is built; several lamps a process."""
import dataclasses
import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np

LAMPS_A_SESSION = 25


@dataclasses.dataclass
class Lamp:
    truth: float  # cd towards the meter
    readings: list = dataclasses.field(default_factory=list)
    keys: dict = dataclasses.field(default_factory=lambda: {"kind": "point"})  # of [[light]]
    meter: dict = dataclasses.field(default_factory=lambda: {"sigma_relative": 0.03})
    other_meter: dict = None  # read what says "meter": "other"
    room: dict = None
    # What the grid posterior is told.
    exact_kind: str = "point"
    fixture: str = None
    power: float = math.nan


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    return f"{float(value):.6f}"


def table(head, keys):
    return head + "\n" + "".join(f"{k} = {toml_value(v)}\n" for k, v in keys.items())


def session_toml(lamps):
    text = "lightcal = 1\n"
    if lamps[0].room:
        text += table("[room]", lamps[0].room)
    for i, lamp in enumerate(lamps):
        text += table("[[light]]", {"name": f"l{i}", **lamp.keys})
        text += table("[[meter]]", {"name": f"m{i}", **lamp.meter})
        if lamp.other_meter:
            text += table("[[meter]]", {"name": f"o{i}", **lamp.other_meter})
        for reading in lamp.readings:
            other = reading.get("meter") == "other"
            text += table("[[reading]]", {**reading, "light": f"l{i}", "meter": f"{'o' if other else 'm'}{i}"})
    return text


def fit_session(lightcal, lamps, folder):
    """(exit code, document) of `fit --json`."""
    session = pathlib.Path(folder) / "session.toml"
    session.write_text(session_toml(lamps))
    child = subprocess.run([lightcal, "fit", session, "--json", "-q", "--force", "-o",
                            session.with_name("light.json")],
                           stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    try:
        return child.returncode, json.loads(child.stdout)
    except json.JSONDecodeError:
        return child.returncode, {}


def interval(light):
    """(low, value, high, readings thrown out)."""
    intensity = light["intensity_cd"]
    value, u95 = intensity["value"], intensity["u95"]
    return (intensity.get("low95", value - u95), value, intensity.get("high95", value + u95),
            len(light.get("fit", {}).get("rejected", [])))


def fit_all(lightcal, lamps):
    """`interval` of each lamp, or the error's code where it was refused."""
    groups = []
    for lamp in lamps:
        if groups and not lamp.room and not groups[-1][0].room and len(groups[-1]) < LAMPS_A_SESSION:
            groups[-1].append(lamp)
        else:
            groups.append([lamp])
    answers = []
    with tempfile.TemporaryDirectory(prefix="room_coverage_") as folder:
        for group in groups:
            _, document = fit_session(lightcal, group, folder)
            if len(document.get("lights", [])) == len(group):
                answers += [interval(light) for light in document["lights"]]
                continue
            for lamp in group:  # one of them was refused
                _, document = fit_session(lightcal, [lamp], folder)
                lights = document.get("lights", [])
                answers.append(interval(lights[0]) if lights else
                               document.get("error", {}).get("code", "no answer"))
    return answers


def knows_fixture(lightcal):
    lamp = Lamp(truth=1, readings=[{"distance_m": 1.0, "illuminance_lx": 50.0}],
                keys={"kind": "point", "fixture": "bulb"})
    with tempfile.TemporaryDirectory(prefix="room_coverage_") as folder:
        code, document = fit_session(lightcal, [lamp], folder)
    return code == 0 and "lights" in document


def binomial(hits, count):
    """Share and its standard error; never 0, as a run without a miss proves nothing."""
    share = hits / count
    return share, math.sqrt(max(share * (1 - share), 1 / count) / count)


HEAD = f"{'sessions':>9s} {'held':>13s} {'bias':>9s} {'half width':>11s} {'refused':>8s} {'rejected':>9s}"


def summary(lamps, answers):
    """A line under HEAD. `rejected`: sessions of which a true reading was thrown out."""
    fitted = [(lamp.truth, *answer) for lamp, answer in zip(lamps, answers)
              if not isinstance(answer, str)]
    if not fitted:
        return f"{len(lamps):9d}   all refused: {answers[:1]}"
    truth, low, value, high, rejected = np.array(fitted).T
    held, error = binomial(int(np.sum((low <= truth) & (truth <= high))), len(fitted))
    half = np.median((high - low) / 2 / value)
    bias = np.median(value / truth - 1)
    return (f"{len(lamps):9d} {100 * held:6.1f} +- {100 * error:3.1f} {100 * bias:+8.1f} %"
            f" {100 * half:9.1f} % {len(lamps) - len(fitted):8d} {int(np.sum(rejected > 0)):9d}")


def held(lamps, answers):
    """Share of the lamps that the interval holds; a refusal holds nothing."""
    holds = [not isinstance(a, str) and a[0] <= lamp.truth <= a[2] for lamp, a in zip(lamps, answers)]
    return sum(holds) / len(lamps)


def below(lamps, answers, bar):
    """Whether they are held less often than `bar`, beyond chance."""
    return held(lamps, answers) < bar - 3 * math.sqrt(bar * (1 - bar) / len(lamps))
