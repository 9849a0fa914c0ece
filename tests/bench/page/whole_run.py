# SPDX-License-Identifier: Apache-2.0
"""Figure: sessions of three lights to presets, by `lightcal run` and by a script by hand; truth: the
lamps that made the readings, in rooms that tests/tools/traced_rooms traced."""
import dataclasses
import json
import math
import pathlib
import shutil
import sys

import numpy

import measure

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "rooms"))
import sessions  # noqa: E402
from traced_table import DISTANCES, beam_angle, draw_offset, read_table  # noqa: E402

FIXTURES = {"bulb": "bulb", "panel": "panel", "beam": "fresnel"}
SIGMA = 0.02  # of the meter, half of its variance in all its readings alike
ROUNDS = 15   # a room each
PROFILES = {  # strictest first
    "strictest": {"effects": "all", "estimator": {"solver": "full", "bounce_patches": 48}},
    "as usual": {},
    "no effects": {"effects": "none"},
    "lamps as points": {"estimator": {"exact_source": False}},
    "coarse walls": {"estimator": {"bounce_patches": 2}},
    "loose solver": {"estimator": {"solver": "loose"}},
    "cheapest": {"effects": "none", "cct_method": "mccamy",
                 "estimator": {"solver": "loose", "reject": False, "leave_one_out": False,
                               "exact_source": False}},
}


@dataclasses.dataclass
class Lit:
    """A room's session and the intensities that made its readings, by light."""
    folder: pathlib.Path
    truth: dict


def session_of(rows, rng, fixtures, folder):
    """What a person writes of three lamps in one room, six readings each."""
    size = [side * rng.uniform(0.95, 1.05) for side in rows[0]["size"]]
    reflectance = rows[0]["reflectance"] * rng.uniform(0.85, 1.15)
    text = 'lightcal = 1\nname = "page"\n'
    text += sessions.table("[room]", {"size_m": size, "reflectance": reflectance})
    text += sessions.table("[[meter]]", {"name": "m", "sigma_relative": SIGMA})
    each = SIGMA / math.sqrt(2)
    gain = math.exp(rng.normal(0, each))
    truth, readings = {}, ""
    for row in rows:
        kind = row["kind"]
        truth[kind] = 10 ** rng.uniform(2.0, 3.5)
        keys = {"name": kind, "kind": "point"}
        if fixtures:
            keys["fixture"] = FIXTURES[kind]
        if kind == "panel":
            keys.update(kind="rect", size_m=[row["width_m"], row["height_m"]], aim=[1.0, 0.0, 0.0])
        if kind == "beam":
            keys.update(kind="spot", beam_deg=beam_angle(row["power"]), aim=[1.0, 0.0, 0.0])
        text += sessions.table("[[light]]", keys)
        offset = draw_offset(rng, FIXTURES[kind])
        for i, d in enumerate(DISTANCES):
            lux = gain * truth[kind] * (row["direct"][i] + row["wall"][i]) * math.exp(
                rng.normal(0, each))
            readings += sessions.table("[[reading]]", {
                "light": kind, "meter": "m", "distance_m": d - offset, "illuminance_lx": lux,
                "xy": [0.4369, 0.4041]})
    folder.mkdir()
    (folder / "session.toml").write_text(text + readings)
    return Lit(folder, truth)


class Score:
    """Errors of ln I against the truth, and how many 95 % intervals hold it."""

    def __init__(self):
        self.errors, self.held, self.refused = [], 0, 0

    def add(self, path, truth):
        for light in json.loads(path.read_text())["lights"]:
            low, value, high = interval(light)
            self.errors.append(abs(math.log(value / truth[light["name"]])))
            self.held += low <= truth[light["name"]] <= high

    @property
    def holds(self):
        return f"{self.held} of {len(self.errors)}"


def interval(light):
    number = light["intensity_cd"]
    if isinstance(number, dict):
        return sessions.interval(light)[:3]
    factor = math.exp(light["u95_relative"])
    return number / factor, number, number * factor


def made(bench):
    from merge import side_by_side
    timed = side_by_side().timed
    rounds = bench.rounds if bench.quick else ROUNDS
    figure = measure.Figure(
        key="whole_run", title="A session of three lights, from readings to presets",
        x_label="processor time of the whole process",
        y_label="worst relative error of an intensity",
        what=f"A bulb, a panel and a beam in one room, six readings of 2 % each, the room's size "
             f"stated to 5 % and its reflectance to 15 %: {rounds} rooms, one a round, traced with "
             "no code of lightcal (tests/tools/traced_rooms). lightcal writes 13 presets and a "
             "report; the script by hand (page/whole_run_by_hand.py: numpy and scipy, point law "
             "with offset and prior, McCamy) writes glTF and CSV. Error: against the lamps that "
             "made the readings.",
        baseline=("lightcal run", "as usual"), unordered=["lightcal run"])
    rng = numpy.random.default_rng(23)
    table = read_table(family="three_lamps")
    fixtures = sessions.knows_fixture(bench.lightcal())
    rooms = [session_of(table[3 * k:3 * k + 3], rng, fixtures, bench.work / f"session_{k}")
             for k in range(rounds)]
    scores = {}

    def own(name):
        profile, out = bench.work / "run.json", bench.work / "out"
        room = iter(rooms)

        def task():
            lit = next(room)
            profile.write_text(json.dumps({"schema": "lightcal.profile/1", **PROFILES[name]}))
            shutil.rmtree(out, ignore_errors=True)
            score = scores.setdefault(("lightcal run", name), Score())
            try:
                seconds = timed([str(bench.lightcal()), "run", str(lit.folder), "--profile",
                                 str(profile), "-o", str(out), "--quiet"])[1]
            except SystemExit:  # this setting finds no answer in this room
                score.refused += 1
                return
            score.add(out / "light.json", lit.truth)
            yield measure.Row("lightcal run", name, measure.OWN, [seconds], 0.0, 0.0)
        return task

    turn = iter(rooms)

    def by_hand():
        lit, out = next(turn), bench.work / "by_hand"
        seconds = timed(["/usr/bin/python3", "-B", str(HERE / "whole_run_by_hand.py"),
                         str(lit.folder / "session.toml"), str(out)])[1]
        scores.setdefault(HAND, Score()).add(out / "light.json", lit.truth)
        yield measure.Row(*HAND, measure.PUBLIC, [seconds], 0.0, 0.0)

    tasks = [own(name) for name in PROFILES]
    if figure.takes(not bench.own_only and bench.python_has("scipy"), measure.SCIPY):
        tasks.append(by_hand)
    measure.measure(figure, tasks, rounds)
    for row in figure.rows:
        score = scores[row.method, row.setting]
        row.error, row.usual = max(score.errors), float(numpy.median(score.errors))
    silent = [f"{name} in {score.refused}" for (_, name), score in scores.items() if score.refused]
    if silent:
        figure.what += f" No answer: {', '.join(silent)} of {rounds} rooms."
    figure.sentence = sentence(figure, scores)
    return figure


HAND = ("numpy and scipy by hand", "point law")


def sentence(figure, scores):
    base = figure.base()
    least = min(row.median for row in figure.rows if row.kind == measure.OWN)
    saved = max(0.0, 1 - least / base.median)
    text = (f"`run` takes {measure.duration(base.median)} for everything; it is off the lamps by "
            f"{measure.off(base.usual)} (worst {measure.off(base.error)}), and its 95 % intervals "
            f"hold {scores[figure.baseline].holds}; no setting saves more than "
            f"{measure.off(saved)} of the time")
    hand = figure.row(*HAND)
    if hand:
        nearer = ", nearer than `run`" if hand.usual < base.usual else ""
        text += (f"; a script by hand takes {measure.times(hand.median / base.median)} the time, is "
                 f"off by {measure.off(hand.usual)} (worst {measure.off(hand.error)}){nearer}, and "
                 f"holds {scores[HAND].holds}")
    return text + "."
