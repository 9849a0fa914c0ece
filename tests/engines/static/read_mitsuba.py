# SPDX-License-Identifier: Apache-2.0
"""A Mitsuba 3 scene by the plugin reference; names are those of the comments before the lights."""
import re
import xml.etree.ElementTree as tree

from seen import GateError, Rig, Seen, luminance, unit


def value(node, name):
    found = [n for n in node if n.get("name") == name]
    if len(found) != 1:
        raise GateError("mitsuba: %s %s" % (node.tag, name))
    return [float(v) for v in found[0].get("value").split()]


def vector(node, name):
    found = [n for n in node if n.get("name") == name][0]
    return [float(found.get(axis)) for axis in "xyz"]


def matrix(node):
    m = [float(v) for v in node.find("transform/matrix").get("value").split()]
    return [[m[4 * row + column] for row in range(3)] for column in range(4)]


def read(text):
    scale = float(re.search(r"nits times ([-+.e\d]+);", text).group(1))
    names = re.findall(r"^  <!-- (.*?)(?:; substituted: .*)? -->$", text, re.M)
    root = tree.fromstring(text.encode())
    lights, cards = {}, []
    for node in root:
        if node.tag == "shape" and node.find("bsdf") is not None:
            x, y, z, at = matrix(node)
            if node.get("type") != "rectangle":
                raise GateError("mitsuba: card")
            cards.append((at, unit(z), value(node.find("bsdf"), "reflectance")[0]))
            continue
        if node.tag not in ("emitter", "shape"):
            continue
        kind = node.get("type")
        emitter = node if node.tag == "emitter" else node.find("emitter")
        field = {"point": "intensity", "spot": "intensity", "directional": "irradiance"}.get(
            emitter.get("type"), "radiance")
        rgb = value(emitter, field)
        y = luminance(rgb) / scale
        seen = Seen(rgb=rgb)
        if field == "radiance":
            seen.nits = y
        elif field == "irradiance":
            seen.lux, seen.aim = y, vector(node, "direction")
        else:
            seen.candela = y
        if kind == "point":
            seen.at = vector(node, "position")
        if kind == "sphere":
            seen.at = vector(node, "center")
        if kind in ("spot", "disk", "rectangle"):
            x, y_axis, z, seen.at = matrix(node)
            seen.aim = unit(z)
            if kind == "rectangle":
                seen.size = [2 * sum(v * v for v in axis) ** 0.5 for axis in (x, y_axis)]
        if kind == "cylinder":
            ends = vector(node, "p0"), vector(node, "p1")
            seen.at = [(a + b) / 2 for a, b in zip(*ends)]
        if kind == "spot":
            seen.outer, seen.inner = value(node, "cutoff_angle")[0], value(node, "beam_width")[0]
            seen.law = "linear"
        lights[names[len(lights)]] = seen
    return lights, Rig(scale, cards) if cards else None
