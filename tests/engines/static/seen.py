# SPDX-License-Identifier: Apache-2.0
"""What a reader saw in an exported file, in our axes and in photometric units, and the comparison
with the golden lamps. Colour mathematics from the primaries, by hand."""
import math

from golden_lights import LAMPS, area

# Rec. 709 luminance, IEC 61966-2-1.
WEIGHTS = (0.2126, 0.7152, 0.0722)


def luminance(rgb):
    return sum(w * c for w, c in zip(WEIGHTS, rgb))


def decoded(srgb):
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in srgb]


def chromaticity(rgb):
    x = 0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]
    y = luminance(rgb)
    z = 0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]
    return x / (x + y + z), y / (x + y + z)


class Seen:
    """One light: photometric values already times the luminance of its colour."""

    def __init__(self, **values):
        self.__dict__.update(dict(candela=None, lux=None, nits=None, rgb=None, at=None, aim=None,
                                  inner=None, outer=None, law="squared", power=1.0, kelvin=None, size=None))
        self.__dict__.update(values)


class Rig:
    def __init__(self, k, cards):
        self.k = k          # pixel = k * nits
        self.cards = cards  # (centre, normal, reflectance) in our axes


class GateError(Exception):
    pass


def near(what, got, expected, relative):
    if got is None or not abs(got - expected) <= relative * abs(expected) + 1e-12:
        raise GateError("%s: %r, expected %r" % (what, got, expected))


def near_vector(what, got, expected, tolerance):
    if any(not abs(g - e) <= tolerance for g, e in zip(got, expected)):
        raise GateError("%s: %r, expected %r" % (what, got, expected))


def cone(law, inner, outer, power=1.0):
    """An engine's intensity by angle in degrees over that on the axis."""
    ci, co = math.cos(math.radians(inner or 0.0)), math.cos(math.radians(outer))

    def at(deg):
        c = math.cos(math.radians(deg))
        if law == "power":
            u = (1 - c) / (1 - co)
            return 1 - u ** power if u < 1 else 0.0
        t = ((outer - deg) / (outer - inner) if law in ("linear", "smooth_angle")
             else (c - co) / (ci - co))
        t = min(1.0, max(0.0, t))
        return {"squared": t * t, "linear": t}.get(law, t * t * (3 - 2 * t))
    return at


# What each law can do to a 15/25 degree spot, by a search written apart: worst, of the axial value.
BEST_15_25 = {"squared": 1e-6, "smooth": .066, "smooth_angle": .050, "linear": .057, "power": .145}


def compare_beam(name, seen, lamp):
    """The axis is compared as candela; here the flux and the worst direction."""
    want, got = cone("squared", lamp["inner"], lamp["outer"]), cone(seen.law, seen.inner, seen.outer, seen.power)
    steps = [0.05 * i for i in range(1201)]
    flux = sum(got(a) * math.sin(math.radians(a)) for a in steps) / sum(
        want(a) * math.sin(math.radians(a)) for a in steps)
    near(name + " half angle, by the flux", flux, 1.0, 0.025)
    worst = max(abs(got(a) - want(a)) for a in steps)
    if worst > BEST_15_25[seen.law]:
        raise GateError("%s half angle: %.3f of the axial value off" % (name, worst))


def compare(lights, names, relative):
    """lights: {name: Seen}"""
    for name in names:
        lamp = LAMPS[name]
        if name not in lights:
            raise GateError(name + " is missing")
        seen = lights[name]
        if seen.nits is not None and "cd" in lamp:
            near(name + " nits", seen.nits, lamp["cd"] / area(lamp), relative)
        elif seen.nits is not None:
            near(name + " nits", seen.nits, lamp["lx"] / math.pi, relative)
        elif "cd" in lamp:
            near(name + " candela", seen.candela, lamp["cd"], relative)
        else:
            near(name + " lux", seen.lux, lamp["lx"], relative)
        if seen.at is not None and "at" in lamp:
            near_vector(name + " position", seen.at, lamp["at"], 1e-5)
        if seen.aim is not None and "aim" in lamp:
            near_vector(name + " aim", seen.aim, lamp["aim"], 1e-5)
        if lamp["kind"] == "spot":
            if seen.outer is not None:
                compare_beam(name, seen, lamp)
            elif seen.law != "table":
                raise GateError(name + " half angle: there is none")
        if seen.kelvin is not None:
            near(name + " kelvin", seen.kelvin, lamp.get("kelvin", 0.0), 0.002)
        elif seen.rgb is not None:
            # 8 bits of the darkest component move xy by .004.
            near_vector(name + " xy", chromaticity(seen.rgb), lamp["xy"], 0.004)
        if seen.size is not None and lamp["kind"] == "rect":
            near_vector(name + " size", seen.size, (lamp["width"], lamp["height"]), 1e-6)


def check_rig(lights, rig):
    """The 18 % card at .18 +- 2 % in linear light, from what the file says alone: one point."""
    seen = lights["key"]
    done = 0
    for centre, normal, reflectance in rig.cards:
        v = [s - c for s, c in zip(seen.at, centre)]
        d = math.sqrt(sum(x * x for x in v))
        cosine = sum(a * b for a, b in zip(v, normal)) / d
        pixel = rig.k * reflectance / math.pi * seen.candela * cosine / d ** 2
        near("card of %g shows as" % reflectance, pixel, reflectance, 0.02)
        done += abs(reflectance - 0.18) < 1e-6
    if done != 1:
        raise GateError("no 18 % card")


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def read_ies(text):
    """Peak candela of an LM-63-2002 file under the rules every reader accepts (CRLF, factors 1)."""
    if "\n" in text.replace("\r\n", ""):
        raise GateError("ies: lines must end in CRLF")
    lines = text.split("\r\n")
    if lines[0] != "IESNA:LM-63-2002":
        raise GateError("ies: " + lines[0])
    first = next(i for i, line in enumerate(lines) if line.startswith("TILT="))
    if lines[first] != "TILT=NONE":
        raise GateError("ies: " + lines[first])
    numbers = lines[first + 1].split()
    if len(numbers) != 10 or numbers[2] != "1" or numbers[0] != "1":
        raise GateError("ies: lamps, multiplier: " + lines[first + 1])
    electrical = lines[first + 2].split()
    if len(electrical) != 3 or electrical[0] != "1" or electrical[1] != "1":
        raise GateError("ies: ballast and reserved factor: " + lines[first + 2])
    vertical, horizontal = int(numbers[3]), int(numbers[4])
    values = [float(v) for v in " ".join(lines[first + 3:]).split()]
    if len(values) != vertical + horizontal + vertical * horizontal:
        raise GateError("ies: count of values")
    return max(values[vertical + horizontal:])
