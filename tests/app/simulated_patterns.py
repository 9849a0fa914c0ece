# SPDX-License-Identifier: Apache-2.0
"""What `simulate` says off the axis, against lamps written out here: a spot of stated beam and field (as bright as
its exported IES file, by this file's own interpolation), one of which nothing is stated, beams read by angles
that are a degree off, a bulb over its base, panels that shine by cos^m. Its 95 % must hold them; what faces the
axis stays as sure as it was. Written without a header of lightcal."""
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

LIGHTCAL = str(pathlib.Path(sys.argv[1]).resolve())
FOLDER = tempfile.TemporaryDirectory()
HEAD = ('lightcal = 1\nname = "w"\n[room]\ndark = true\n[[meter]]\nname = "m"\nsigma_relative = %g\n'
        'repeatability_relative = %g\n[[light]]\nname = "s"\nposition_m = [0, 0, 2]\n')
SPOT = 'kind = "spot"\naim = [0, 0, -1]\n'


def run(*words):
    done = subprocess.run([LIGHTCAL, *map(str, words)], check=True, capture_output=True, text=True)
    return done.stdout


def session(lamp, readings, scale=0.01, scatter=0.003):
    """readings: (distance, degrees off the axis, lux)."""
    text = HEAD % (scale, scatter) + lamp
    for distance, degrees, lux in readings:
        text += f'[[reading]]\nlight = "s"\nmeter = "m"\ndistance_m = {distance}\nilluminance_lx = {lux:.5g}\n'
        text += f"off_axis_deg = {degrees}\n" if degrees else ""
    path = pathlib.Path(FOLDER.name) / "w.toml"
    path.write_text(text)
    light = pathlib.Path(FOLDER.name) / "light.json"
    run("fit", path, "-o", light, "--force")
    return light


def simulated(light, points):
    """(value, u95) of meters that face the lamp."""
    at = [f"{x:.6f},{y:.6f},{z:.6f}" for x, y, z in points]
    answer = json.loads(run("simulate", light, "--normal", "lamp", "--at", *at, "--json"))
    return [(p["illuminance_lx"]["value"], p["illuminance_lx"]["u95"]) for p in answer["points"]]


def on_floor(degrees):
    return 2 * math.tan(math.radians(degrees)), 0, 0


def floor_lux(candela, degrees):
    return candela * math.cos(math.radians(degrees)) ** 2 / 4


def check(name, found, truth, widest=None):
    value, u95 = found
    print(f"{name}: {value:.4g} +- {u95:.2g} lx, {truth:.4g} there")
    assert abs(value - truth) <= u95, name
    assert widest is None or u95 <= widest * value, name


AXIS = [(1, 0, 1000), (2, 0, 250)]

# A spot of stated beam and field: its own file, and any beam of those angles.
stated = session(SPOT + "beam_deg = 40\nfield_deg = 70\n", AXIS)
ANGLES = (0, 10, 20, 30, 60)
ies = pathlib.Path(FOLDER.name) / "out"
run("export", stated, "--to", "ies", "-o", ies)
numbers = [float(w) for w in next(ies.glob("**/*.ies")).read_text().split("TILT=NONE")[1].split()]
count = int(numbers[3])
gammas, candela = numbers[13:13 + count], numbers[13 + count + 1:13 + 2 * count + 1]
scale = numbers[2]
for degrees, found in zip(ANGLES, simulated(stated, [on_floor(a) for a in ANGLES])):
    i = max(k for k in range(count - 1) if gammas[k] <= degrees)
    part = (degrees - gammas[i]) / (gammas[i + 1] - gammas[i])
    of_file = floor_lux(scale * (candela[i] + part * (candela[i + 1] - candela[i])), degrees)
    assert abs(found[0] - of_file) <= 0.02 * of_file + 0.02, (degrees, found, of_file)
    p = math.log(math.log(10) / math.log(2)) / math.log(35 / 20)
    for half in (20, 21.5):  # as printed, and as far off as such angles are
        truth = floor_lux(1000 * 2 ** -((degrees / half) ** p), degrees)
        check(f"stated, {degrees} of a beam of {2 * half}", found, truth, 0.06 if degrees == 0 else None)

# No walls in the dark: none are asked for. Outdoors none either.
path = pathlib.Path(FOLDER.name) / "w.toml"
for room, said in (("dark = true", "says dark"), ("outdoors = true", "outdoors")):
    path.write_text(path.read_text().replace("dark = true", room))
    effects = json.loads(run("simulate", path, "--at", "0,0,0", "--json"))["effects"]
    walls = [one["reason"] for one in effects if one["name"] == "room_bounce"]
    assert walls and all(said in one and "no [room]" not in one for one in walls), walls

# A reflector, or a lamp that nobody names, read by distances alone may shine to any side: which is asked for, and
# an aim answers it.
def aimed(light, *words):
    done = subprocess.run([LIGHTCAL, "simulate", str(light), "--at", "0,0,0", "--json", *words], check=True,
                          capture_output=True, text=True)
    lux = json.loads(done.stdout)["points"][0]["illuminance_lx"]
    return lux["u95"] / lux["value"], done.stdout + done.stderr


for fixture, place, given in ((fixture, place, given) for fixture in ('fixture = "reflector"\n', "") for place, given in
                              (("", ("--position", "s=0,0,2")), ("position_m = [0, 0, 2]\n", ()))):
    session('kind = "point"\n' + fixture, AXIS)
    path.write_text(path.read_text().replace("position_m = [0, 0, 2]\n", place))
    reflector = pathlib.Path(FOLDER.name) / "reflector.json"
    run("fit", path, "-o", reflector, "--force")
    wide, said = aimed(reflector, *given)
    assert wide > 1 and "no aim is known" in said and "--aim s=" in said, said
    sure, said = aimed(reflector, *given, "--aim", "s=0,0,-1")
    assert sure < 0.3 and "no aim" not in said, (sure, said)

# A point that nobody names, read from one side, is a bulb, a panel or a beam to that side; read from four it is
# as even as they say.
def placed(towards):
    text = HEAD % (0.01, 0.003) + 'kind = "point"\n'
    for x, y, z in towards:
        text += (f'[[reading]]\nlight = "s"\nmeter = "m"\nposition_m = [{x}, {y}, {z}]\nnormal = [{-x}, {-y}, '
                 f'{2 - z}]\nilluminance_lx = {100 / (x * x + y * y + (z - 2) ** 2):.6g}\n')
    path.write_text(text)
    light = pathlib.Path(FOLDER.name) / "placed.json"
    run("fit", path, "-o", light, "--force")
    return light


asks = {a: (math.cos(math.radians(a)), math.sin(math.radians(a)), 2) for a in (0, 30, 60, 90, 180)}
unnamed = placed([(1, 0, 2), (1.5, 0, 2), (2, 0, 2)])
for (degrees, _), found in zip(asks.items(), simulated(unnamed, asks.values())):
    c = math.cos(math.radians(degrees))
    for what, truth in (("bulb", 1 + 0.15 * (c - 1)), ("panel", max(c, 0)), ("beam", 2 ** -((degrees / 20) ** 2))):
        check(f"unnamed, a {what}, {degrees}", found, 100 * truth, 0.15 if degrees == 0 else None)
around = simulated(placed([(1, 0, 2), (-1, 0, 2), (0, 1.5, 2), (0, -1.5, 2)]), [(0.7, 0.7, 2)])[0]
check("unnamed, read from four sides", around, 100 / 0.98, 0.5)

# A spot of which nothing is stated: its axis, and anything beside it.
unknown = simulated(session(SPOT, AXIS), [on_floor(a) for a in (0, 20, 60)])
check("unknown, 0", unknown[0], 250, 0.06)
for degrees, found in ((20, unknown[1]), (60, unknown[2])):
    for half in (5, 15, 50):
        check(f"unknown, {degrees} of {2 * half}", found, floor_lux(1000 * 2 ** -((degrees / half) ** 2), degrees))

# Beams read by angles and about an axis that are a degree off.
held = asked = 0
for seed in range(5):
    chance = random.Random(seed)
    half, power = chance.uniform(16, 24), chance.uniform(1.5, 3)
    shape = lambda degrees: 2 ** -((abs(degrees) / half) ** power)
    axis, scale = chance.gauss(0, 1), math.exp(chance.gauss(0, 0.02))
    read = [(1, 0, 1000 * scale * shape(axis)), (3, 0, 1000 / 9 * scale * shape(axis))]
    read += [(2, a, 250 * scale * shape(a + axis + chance.gauss(0, 1)) * math.exp(chance.gauss(0, 0.01)))
             for a in (10, 20, 30, 40)]
    asks = (0, 5, 15, 25, 35, 50)
    for degrees, (value, u95) in zip(asks, simulated(session(SPOT, read, 0.02, 0.01), [on_floor(a) for a in asks])):
        truth = floor_lux(1000 * shape(degrees), degrees)
        assert u95 > 0 and (degrees > 0 or u95 < 0.08 * value), (seed, degrees, value, u95)
        asked += 1
        held += abs(value - truth) <= u95
print(f"beams: {held} of {asked} held")
assert held >= 0.9 * asked

# A bulb read at its side, then over its base and its crown.
bulb = session('kind = "point"\nfixture = "bulb"\n', [(0.5, 0, 400), (1, 0, 100), (2, 0, 25)])
for part in (0.7, 1.3):
    check(f"bulb that shines {part} times as much up", simulated(bulb, [(0, 0, 3)])[0], 100 * part)

# Panels of cos^m.
panel = session('kind = "rect"\nfixture = "panel"\nsize_m = [0.05, 0.05]\naim = [0, 0, -1]\n', AXIS)
check("panel, 0", simulated(panel, [on_floor(0)])[0], 250, 0.06)
for m in (0.75, 1.25):
    c = math.cos(math.radians(60))
    check(f"panel of cos^{m}, 60", simulated(panel, [on_floor(60)])[0], floor_lux(1000 * c**m, 60))
