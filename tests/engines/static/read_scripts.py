# SPDX-License-Identifier: Apache-2.0
"""The data inside .blender.py, .three.js and .filament.json by what each engine makes of it
(rendered: Cycles 3.4, three.js, Filament; see ../render)."""
import json
import math

from seen import GateError, Rig, Seen, cross, luminance


def data(text, mark):
    return json.JSONDecoder().raw_decode(text[text.index("{", text.index(mark)):])[0]


def rig_of(root, turn):
    if "rig" not in root:
        return None
    rig = root["rig"]
    return Rig(root["exposure"]["exposure"],
               [(turn(c["centre_m"]), turn(rig["normal"]), c["reflectance"]) for c in rig["cards"]])


def blender(text):
    root = data(text, "json.loads(r'''")
    lights = {}
    for light in root["lights"]:
        y = luminance(light["color"])
        seen = Seen(rgb=light["color"])
        if light["type"] == "WORLD":
            seen.nits = light["strength"] * 683.0 * y
            lights[light["name"]] = seen
            continue
        watts = light["energy_W"] * y
        seen.at, seen.aim = light["position_m"], [-v for v in light["axes"][2]]
        if light["type"] == "SUN":
            seen.lux = watts * 683.0
        elif light["type"] == "AREA":  # 3.4: I0 = P/4 rad, from 4.0 P/pi; the script sets either
            w, h = light["size_m"]
            area = w * h * (math.pi / 4 if light["shape"] == "DISK" else 1)
            seen.nits = watts * 683.0 / math.pi / area
            seen.size = (w, h)
        elif light["type"] == "IES":
            if light["ies"].split("\n")[0].strip() != "IESNA:LM-63-2002":
                raise GateError("blender: ies")
            at = light["ies"].split("\r\n")
            first = [i for i, line in enumerate(at) if line.startswith("TILT=")][0]
            counts = at[first + 1].split()
            if at[first + 2].split()[1] != "1":
                raise GateError("blender: reserved factor, which Cycles multiplies by")
            values = [float(v) for v in " ".join(at[first + 3:]).split()]
            seen.law = "table"
            seen.candela = (watts * 683.0 / 177.83 *
                            max(values[int(counts[3]) + int(counts[4]):]))
        else:
            seen.candela = watts * 683.0 / (4 * math.pi)
            if light["type"] == "SPOT":
                seen.outer = math.degrees(light["spot_size_rad"]) / 2
                edge = math.cos(light["spot_size_rad"] / 2)
                seen.inner = math.degrees(math.acos(edge + light["spot_blend"] * (1 - edge)))
                seen.law = "smooth"
            else:
                seen.aim = None
        lights[light["name"]] = seen
    return lights, rig_of(root, lambda v: v)


def ours(v):  # from Y up
    return (v[0], -v[2], v[1])


def three(text):
    root = data(text, "export const preset")
    lights = {}
    for light in root["lights"]:
        value = light["intensity"] * luminance(light["color"])
        seen = Seen(rgb=light["color"], at=ours(light["position_m"]), aim=ours(light["direction"]))
        kind = light["type"]
        if kind in ("dome", "rect"):
            seen.nits = value
        elif kind == "directional":
            seen.lux = value
        else:
            seen.candela = value
        if kind == "rect":
            seen.size = (light["width_m"], light["height_m"])
            across = cross(ours(light["axes"][0]), ours(light["axes"][1]))
            if any(abs(a + b) > 1e-9 for a, b in zip(across, seen.aim)):
                raise GateError("three: the rectangle faces elsewhere")
        if kind == "spot":
            cone_of = light["three"]  # three's own; Babylon's is beside it
            seen.outer, seen.inner = (math.degrees(cone_of[k]) for k in ("outer_rad", "inner_rad"))
            seen.law = "smooth"
        if kind in ("point", "dome"):
            seen.aim = None
        lights[light["name"]] = seen
    return lights, rig_of(root, ours)


def filament_cosine(angle):
    """libs/math/include/math/fast.h; setSpotLightCone takes angles by it, and shares out lumens."""
    z = angle / (2 * math.pi) - 0.25
    z *= 16 * abs(z) - 8
    return z + 0.225 * z * (abs(z) - 1)


def filament(text):
    root = json.loads(text)
    lights = {}
    for light in root["lights"]:
        y = luminance(light["color"])
        seen = Seen(rgb=light["color"], at=ours(light["position_m"]), aim=ours(light["direction"]))
        kind = light["type"]
        if kind == "INDIRECT":
            seen.nits, seen.aim = light["intensity"] * y, None
        elif kind in ("SUN", "DIRECTIONAL"):
            seen.lux = light["intensity_lx"] * y
        else:
            seen.candela = light["intensity_candela"] * y
            sr = 4 * math.pi
            if kind == "FOCUSED_SPOT":
                seen.outer, seen.inner = (math.degrees(math.acos(min(1.0, filament_cosine(light[k]))))
                                          for k in ("outer_rad", "inner_rad"))
                sr = 2 * math.pi * (1 - filament_cosine(light["outer_rad"]))
            else:
                seen.aim = None
            if abs(light["intensity_lm"] / sr / light["intensity_candela"] - 1) > 1e-9:
                raise GateError("filament: candela and lumens disagree over the half angle")
        lights[light["name"]] = seen
    return lights, rig_of(root, ours)
