# SPDX-License-Identifier: Apache-2.0
"""A .gltf by KHR_lights_punctual: candela and lux times a linear colour, half angles in radians."""
import json
import math

from seen import GateError, Rig, Seen, luminance


def ours(v):  # from Y up
    return (v[0], -v[2], v[1])


def turned(q, v):
    """v by the quaternion q, as a matrix."""
    x, y, z, w = q
    m = ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
         (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
         (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def read(text):
    root = json.loads(text)
    kinds = root["extensions"]["KHR_lights_punctual"]["lights"]
    lights, cards = {}, []
    for node in root["nodes"]:
        turn = node.get("rotation", (0, 0, 0, 1))
        if "mesh" in node:
            primitive = root["meshes"][node["mesh"]]["primitives"][0]
            pbr = root["materials"][primitive["material"]]["pbrMetallicRoughness"]
            cards.append((ours(node["translation"]), ours(turned(turn, (0, 0, 1))),
                          pbr["baseColorFactor"][0]))
        light = node.get("extensions", {}).get("KHR_lights_punctual")
        if light is None:
            continue
        light = kinds[light["light"]]
        if max(light["color"]) > 1.0 + 1e-9:
            raise GateError("gltf: a colour above 1")
        seen = Seen(rgb=light["color"], at=ours(node["translation"]))
        value = light["intensity"] * luminance(light["color"])
        if light["type"] == "directional":
            seen.lux = value
        else:
            seen.candela = value
            # A range window at 10 m would dim what the meter read.
            if (1 - (10 / light["range"]) ** 4) < 0.995:
                raise GateError("gltf: range window at 10 m")
        if light["type"] != "point":
            seen.aim = ours(turned(turn, (0, 0, -1)))
        if "spot" in light:
            seen.outer = math.degrees(light["spot"]["outerConeAngle"])
            seen.inner = math.degrees(light["spot"]["innerConeAngle"])
        lights[node["name"]] = seen
    k = root["scenes"][0].get("extras", {}).get("lightcal", {}).get("exposure", {}).get("exposure")
    return lights, Rig(k, cards) if cards else None
