# SPDX-License-Identifier: Apache-2.0
"""`lightcal fit` and a bulb a hand from a wall, whose light starts about where the bulb hangs.

A room of six grey faces in pieces of 4 cm, each lit once by the bulb, and what they throw on among themselves spread
evenly (an integrating sphere of their area). Seven meters lie flat. Whoever does not hold the place says that a wall is
near; behind a card at each it is held.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

LIGHTCAL = sys.argv[1]
SEEDS = int(sys.argv[2]) if len(sys.argv) > 2 else 12
SIZE = np.array([5.0, 4.0, 2.6])
GREY = 0.6
PIECE = 0.04
UP = np.array([0.0, 0.0, 1.0])


def faces():
    points, normals = [], []
    low, high = np.array([-2.5, -2.0, 0.0]), np.array([2.5, 2.0, 2.6])
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        grid = np.meshgrid(*[np.arange(low[k] + PIECE / 2, high[k], PIECE) for k in others])
        for at, way in ((low[axis], 1.0), (high[axis], -1.0)):
            face = np.zeros((grid[0].size, 3))
            face[:, axis] = at
            for k, values in zip(others, grid):
                face[:, k] = values.ravel()
            normal = np.zeros(3)
            normal[axis] = way
            points.append(face)
            normals.append(np.tile(normal, (len(face), 1)))
    return np.concatenate(points), np.concatenate(normals)


POINTS, NORMALS = faces()
AREA = 2.0 * (SIZE[0] * SIZE[1] + SIZE[1] * SIZE[2] + SIZE[0] * SIZE[2])


def walls(lamp, candela, place):
    way = lamp - POINTS
    lit = candela * np.maximum(np.sum(way * NORMALS, axis=1), 0.0) / np.linalg.norm(way, axis=1) ** 3
    to = POINTS - (place + 0.01 * UP)
    r2 = np.sum(to**2, axis=1)
    seen = np.maximum(to @ UP, 0.0) * np.maximum(-np.sum(to * NORMALS, axis=1), 0.0) / r2**2
    once = GREY / np.pi * np.sum(lit * seen) * PIECE**2
    return once + 4.0 * np.pi * candela * GREY**2 / ((1.0 - GREY) * AREA)


def session(seed, gap, cards, room):
    rng = np.random.default_rng(6400 + seed)
    lamp = np.array([0.5 * SIZE[0] - gap, rng.uniform(-0.8, 0.8), rng.uniform(1.1, 1.4)])
    candela = rng.uniform(40.0, 120.0)
    places = [lamp * [1, 1, 0] + [a, b, 0.0] for a, b in
              [(-0.05, -1), (-0.05, 1), (-1.85, 1), (-1.85, -1), (-0.95, 0), (-0.5, 0.4), (-1.3, -0.5)]]
    lines = ["lightcal = 1", "[room]" if room else "", f"size_m = {[float(v) for v in SIZE]}" if room else "",
             f"reflectance = {GREY}" if room else "", "[[meter]]", 'name = "m"', "sigma_relative = 0.01", "[[light]]",
             'name = "key"', 'kind = "point"']
    for place in places:
        place = np.round(place, 2)
        way = lamp - place
        back = walls(lamp, candela, place)
        for card, lux in ((False, candela * way[2] / np.linalg.norm(way) ** 3 + back), (True, back)):
            if card and not cards:
                continue
            lines += ["[[reading]]", 'light = "key"', 'meter = "m"', f"position_m = {[float(v) for v in place]}",
                      "normal = [0, 0, 1]", f"illuminance_lx = {lux * np.exp(0.01 * rng.normal()):.5g}"]
            lines += ["shadow_card = true"] if card else []
    return lamp, "\n".join(lines) + "\n"


def judged(gap, cards, room):
    """How many hold the place, say that a wall is near, or do either, of those answered."""
    held, told, either, answered = 0, 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "session.toml"
        for seed in range(SEEDS):
            lamp, text = session(seed, gap, cards, room)
            path.write_text(text)
            done = subprocess.run([LIGHTCAL, "fit", str(path), "--json"], capture_output=True, text=True)
            answer = json.loads(done.stdout)
            if done.returncode != 0:
                print(gap, cards, room, answer["error"]["code"])
                continue
            answered += 1
            light = answer["lights"][0]
            holds = bool(np.all(np.abs(light["position_m"] - lamp) <= light["position_u95_m"]))
            says = any(w["code"] == "near_wall" for w in answer.get("warnings", [])) or "half a metre" in done.stderr
            held, told, either = held + holds, told + says, either + (holds or says)
    print(f"{gap} m, cards {cards}, room {room}: of {answered} held {held}, told {told}, either {either}")
    return answered, held, told, either


def main():
    for room in (True, False):
        answered, _, _, either = judged(0.25, False, room)
        assert answered > 0 and either == answered
    answered, held, told, _ = judged(0.25, True, True)
    assert held >= 0.8 * answered and told == 0, "what a card left is no wall's"
    answered, held, told, _ = judged(1.5, False, True)
    assert held >= 0.8 * answered and told == 0


main()
