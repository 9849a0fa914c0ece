# SPDX-License-Identifier: Apache-2.0
"""A person with a lux meter in a traced room, who reads a lamp and does what comes next."""
import math
import re

import numpy as np

from sessions import table
from traced_table import DISTANCES, OF_KIND, beam_angle, draw_offset


class Reader:
    """The room's light between the traced distances is interpolated (ln lux by ln distance)."""

    def __init__(self, row, rng, meter_sd=0.03, known=None):
        self.row, self.rng = row, rng
        self.candela = 10 ** rng.uniform(1.7, 3.5)
        self.gain = math.exp(rng.normal(0, meter_sd))
        self.fixture = OF_KIND[row["kind"]][rng.integers(len(OF_KIND[row["kind"]]))]
        self.offset = draw_offset(rng, self.fixture)
        self.others = rng.uniform(0, 0.02) * self.candela * self.gain
        draw = bool(rng.uniform() < 0.5)
        self.known = draw if known is None else known
        self.nearest = 0.25 if self.known else 0.5
        self.keys = {"name": "lamp", "kind": "point"}
        if self.known:
            self.keys["fixture"] = self.fixture
            if row["kind"] == "panel":
                self.keys.update(kind="rect", size_m=[row["width_m"], row["height_m"]], aim=[1.0, 0.0, 0.0])
                self.nearest = max(self.nearest, 0.5 * max(row["width_m"], row["height_m"]))
            if row["kind"] == "beam":
                self.keys.update(kind="spot", beam_deg=beam_angle(row["power"]), aim=[1.0, 0.0, 0.0])
        traced = np.isfinite(row["wall"])
        self.d = np.array(DISTANCES)[traced]
        self.reach = float(self.d[-1])
        self.readings = []

    def at(self, column, d):
        values = self.row[column][:len(self.d)]
        return math.exp(np.interp(math.log(d), np.log(self.d), np.log(values)))

    def direct(self, d):
        """lx for 1 cd on the axis; a panel's by the view factor of a rectangle (Howell B-3)."""
        if self.row["kind"] != "panel":
            return 1 / d ** 2
        width, height = self.row["width_m"], self.row["height_m"]
        sides = (width / (2 * d), height / (2 * d))
        half = sum(x / math.hypot(1, x) * math.atan(y / math.hypot(1, x)) for x, y in (sides, sides[::-1]))
        return 2 * half / (width * height)

    def shown(self, stated, what):
        """What the meter shows, to a tenth of a lux."""
        d = stated + self.offset
        lux = self.others
        if what != "off":
            lux += self.candela * self.gain * self.at("card" if what == "card" else "wall", d)
        if what == "lit":
            lux += self.candela * self.gain * self.direct(d)
        return round(lux * math.exp(self.rng.normal(0, 0.01)), 1)

    def take(self, stated, what):
        reading = {"light": "lamp", "meter": "m", "illuminance_lx": self.shown(stated or 1.0, what)}
        if stated:
            reading["distance_m"] = stated
        if what == "card":
            reading["shadow_card"] = True
        if what == "off":
            reading["lamp"] = "off"
        self.readings.append(reading)
        return reading["illuminance_lx"]

    def toml(self):
        text = "lightcal = 1\n" + table("[[light]]", self.keys)
        text += table("[[meter]]", {"name": "m", "sigma_relative": 0.03})
        return text + "".join(table("[[reading]]", reading) for reading in self.readings)

    def typed(self):
        """The readings as `quick` takes them: a card's and an off reading's beside the lit one there."""
        lit = []
        for reading in self.readings:
            lux = f"{reading['illuminance_lx']:g}lx"
            if "lamp" in reading:
                lit[-1][1] += f",off={lux}"
            elif "shadow_card" in reading:
                there = [one for one in lit if one[0] == reading["distance_m"]]
                there[-1][1] += f",card={lux}"
            else:
                lit.append([reading["distance_m"], f"{lux}@{reading['distance_m']:g}m"])
        return [text for _, text in lit]


def step_of(text):
    """(what, distance) that a next step asks for, or None where it asks for no reading."""
    found = re.search(r"([0-9.]+) m", text)
    d = float(found[1]) if found else None
    if text.startswith("add a shadow-card reading") and d:
        return "card", d
    if text.startswith("read once with the lamp off"):
        return "off", None
    if text.startswith(("read at", "read again at")) and d:
        return "lit", d
    return None
