# SPDX-License-Identifier: Apache-2.0
"""Intervals where no wall matters: one reading in the dark, lamps to be located, a typed meter; and
sessions that no lamp of the model could have made."""
import math
import tempfile

import numpy as np

from predicted import predicted
from sessions import HEAD, Lamp, binomial, fit_all, fit_session, knows_fixture, summary
from traced_table import DISTANCES, draw_of_205, draw_offset, read_table

DARK = {"dark": True}


def dark_room(lightcal):
    """[room] dark = true, where the program knows that key."""
    lamp = Lamp(truth=1, readings=[{"distance_m": 1.0, "illuminance_lx": 50.0}], room=DARK)
    with tempfile.TemporaryDirectory(prefix="room_coverage_") as folder:
        _, document = fit_session(lightcal, [lamp], folder)
    if "lights" in document:
        return DARK
    print("(the program knows no dark room)")
    return None


def dark(lightcal, sessions):
    """One reading in the dark: fixture unknown (a draw of the 205 tables), and a bulb."""
    room, fixtures = dark_room(lightcal), knows_fixture(lightcal)
    print(" " * 20 + HEAD)
    for fixture in (None, "bulb"):
        for d in (0.5, 1.0, 2.0):
            rng = np.random.default_rng([1, int(10 * d), fixture is None])
            lamps = []
            while len(lamps) < sessions:
                offset = draw_offset(rng, fixture) if fixture else draw_of_205(rng)
                lux = 900 / (d + offset) ** 2 * math.exp(rng.normal(0, 0.03) + rng.normal(0, 0.01))
                lamp = Lamp(truth=900.0, readings=[{"distance_m": d, "illuminance_lx": lux}],
                            room=room)
                if fixture and fixtures:
                    lamp.keys["fixture"] = fixture
                lamps.append(lamp)
            answers = fit_all(lightcal, lamps)
            print(f"dark, {fixture or 'unknown':8s} {d:3.1f} m {summary(lamps, answers)}", flush=True)


def located(lightcal, sessions):
    """Six readings of 1 % on the floor around a point lamp of unknown place: the corners of a square,
    its centre, the middle of a side. Coverage of each coordinate and of the intensity."""
    room = dark_room(lightcal)
    places = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 0], [1, 0, 0]], float)
    rng = np.random.default_rng(2)
    held, count, refused, errors = np.zeros(4), 0, {}, []
    with tempfile.TemporaryDirectory(prefix="room_coverage_") as folder:
        for _ in range(sessions):
            lamp_at = rng.uniform((-0.8, -0.8, 1.4), (0.8, 0.8, 2.4))
            truth = 10 ** rng.uniform(2, 3)
            lamp = Lamp(truth=truth, room=room, meter={"sigma_relative": 0.01})
            for place in places:
                way = lamp_at - place
                lux = truth * way[2] / np.linalg.norm(way) ** 3 * math.exp(rng.normal(0, 0.01))
                lamp.readings.append({"position_m": list(place), "normal": [0, 0, 1],
                                      "illuminance_lx": lux, "sigma_relative": 0.01})
            _, document = fit_session(lightcal, [lamp], folder)
            lights = document.get("lights")
            if not lights or "position_m" not in lights[0]:
                code = document.get("error", {}).get("code", "no position")
                refused[code] = refused.get(code, 0) + 1
                continue
            light, count = lights[0], count + 1
            at = light["position_m"]
            value = np.array(at["value"] if isinstance(at, dict) else at)
            u95 = at["u95"] if isinstance(at, dict) else light.get("position_u95_m", [math.nan] * 3)
            held[:3] += np.abs(value - lamp_at) <= np.broadcast_to(np.array(u95), 3)
            errors.append(np.linalg.norm(value - lamp_at))
            intensity = light["intensity_cd"]
            low = intensity.get("low95", intensity["value"] - intensity["u95"])
            high = intensity.get("high95", intensity["value"] + intensity["u95"])
            held[3] += low <= truth <= high
    for name, hits in zip(("x", "y", "z", "intensity"), held):
        share, error = binomial(hits, max(1, count))
        print(f"located: {name:9s} held in {100 * share:5.1f} +- {100 * error:.1f} %")
    print(f"located: {count} fitted, refused {refused or 'none'}, median error "
          f"{100 * np.median(errors or [math.nan]):.1f} cm")


def typed(lightcal, sessions):
    """Twelve readings in the dark by one meter that is off by 5 % (1 sigma: the maker's 10 %)."""
    room, fixtures = dark_room(lightcal), knows_fixture(lightcal)
    rng = np.random.default_rng(3)
    lamps = []
    for _ in range(sessions):
        gain = 900 * math.exp(rng.normal(0, 0.05))
        offset = draw_offset(rng, "bulb")
        lamp = Lamp(truth=900.0, meter={"sigma_relative": 0.05}, room=room)
        if fixtures:
            lamp.keys["fixture"] = "bulb"
        for i in range(12):
            d = 0.5 + 0.25 * i
            lux = gain / (d + offset) ** 2 * math.exp(rng.normal(0, 0.01))
            lamp.readings.append({"distance_m": d, "illuminance_lx": lux})
        lamps.append(lamp)
    answers = fit_all(lightcal, lamps)
    print(" " * 20 + HEAD + "\ntyped, 12 readings  " + summary(lamps, answers))
    halves = [(a[2] - a[0]) / 2 / a[1] for a in answers if not isinstance(a, str)]
    if halves:
        print(f"typed, narrowest half width {100 * min(halves):.1f} %")


def meters(lightcal, sessions):
    """A meter of 10 % (95 %) at .5, 1 and 2 m in traced rooms, twice each, alone and with one reading of
    another of 4 % at 1 m; bulbs."""
    rows = [row for row in read_table() if row["kind"] == "bulb"][-sessions:]
    print(" " * 20 + HEAD)
    for others in (0, 1, 3):
        rng = np.random.default_rng(6)
        lamps = []
        for row in rows:
            truth, offset = 10 ** rng.uniform(1.5, 3.5), draw_offset(rng, "bulb")
            lamp = Lamp(truth=truth, keys={"kind": "point", "fixture": "bulb"}, meter={"sigma_relative": 0.05},
                        other_meter={"sigma_relative": 0.02} if others else None)
            gains = np.exp(rng.normal(0, (0.05, 0.02)))

            def add(d, gain, **more):
                at = DISTANCES.index(d)
                lux = truth * gain * (row["direct"][at] + row["wall"][at]) * math.exp(rng.normal(0, 0.01))
                lamp.readings.append({"distance_m": d - offset, "illuminance_lx": lux, **more})

            for d in (0.5, 1.0, 2.0) * 2:
                add(d, gains[0])
            for d in (1.0, 0.5, 2.0)[:others]:
                add(d, gains[1], meter="other")
            lamps.append(lamp)
        print(f"two meters, {others} by 2  {summary(lamps, fit_all(lightcal, lamps))}", flush=True)


def bent(case, rng):
    """A session that a lamp of its model cannot have made."""
    truth = 10 ** rng.uniform(2, 3.5)
    gain = truth * math.exp(rng.normal(0, 0.03))
    offset = draw_offset(rng, "bulb")
    lamp = Lamp(truth=truth)
    distances = np.array([0.5, 0.7, 1.0, 1.5, 2.0, 3.0])

    def add(distance, lux, **more):
        lamp.readings.append({"distance_m": distance, **more,
                              "illuminance_lx": lux * math.exp(rng.normal(0, 0.01))})

    if case == "beam as point":  # readings beside the axis; the meter faces the lamp
        lamp.keys.update(position_m=[0.0, 0.0, 2.0])
        power = math.exp(rng.uniform(math.log(8), math.log(60)))
        for x in (0.0, 0.3, 0.6, 0.9, 1.2, 1.5):
            way = np.array([x, 0.0, -2.0])
            square = way @ way
            lamp.readings.append({
                "position_m": [x, 0.0, 0.0], "normal": list(-way / math.sqrt(square)),
                "illuminance_lx": gain * (2 / math.sqrt(square)) ** power / square
                * math.exp(rng.normal(0, 0.01))})
        return lamp
    odd, second = rng.integers(1, len(distances)), rng.uniform(0.3, 1.0)
    for i, d in enumerate(distances):
        lux = gain / (d + offset) ** 2
        if case == "two lamps as one" and d > 1:  # the other one: 60 cm beside the way, at 1 m
            lux += second * gain * (d - 1) / ((d - 1) ** 2 + 0.36) ** 1.5
        if case == "another lamp's reading" and i == odd:
            lux *= 2.5
        if case == "one distance in feet" and i == odd:
            d /= 0.3048
        add(d, lux)
    return lamp


def misfit(lightcal, sessions):
    """What happens to sessions that no lamp made: refused, said, or an interval that holds it."""
    for number, case in enumerate(("beam as point", "two lamps as one", "one distance in feet",
                                   "another lamp's reading")):
        rng = np.random.default_rng([4, number])
        counts = {}
        with tempfile.TemporaryDirectory(prefix="room_coverage_") as folder:
            for _ in range(sessions):
                lamp = bent(case, rng)
                _, document = fit_session(lightcal, [lamp], folder)
                lights = document.get("lights")
                if not lights:
                    what = "refused: " + document.get("error", {}).get("code", "no answer")
                else:
                    low, high = (lights[0]["intensity_cd"].get(k, math.nan) for k in ("low95", "high95"))
                    said = bool(lights[0].get("warnings") or document.get("warnings"))
                    rejected = bool(lights[0].get("fit", {}).get("rejected"))
                    held = low <= lamp.truth <= high
                    what = ("warned" if said else "reading rejected" if rejected else "silent") + (
                        ", held" if held else ", not held")
                counts[what] = counts.get(what, 0) + 1
        told = "; ".join(f"{what} {100 * n / sessions:.1f} %" for what, n in sorted(counts.items()))
        print(f"misfit: {case}: {told}", flush=True)


MODES = {"dark": dark, "located": located, "typed": typed, "meters": meters, "misfit": misfit,
         "predicted": predicted}
