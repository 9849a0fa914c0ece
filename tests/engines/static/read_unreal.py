# SPDX-License-Identifier: Apache-2.0
"""The editor script run against the stand-in, and the T3D by its own grammar."""
import math
import re

import unreal_stand_in as unreal
from seen import GateError, Rig, Seen, decoded, luminance, read_ies


def ours(v):  # left-handed, Z up
    return (v[0], -v[1], v[2])


def forward(pitch, yaw):
    p, y = math.radians(pitch), math.radians(yaw)
    return ours((math.cos(p) * math.cos(y), math.cos(p) * math.sin(y), math.sin(p)))


def up(pitch, yaw, roll):
    p, y, r = (math.radians(v) for v in (pitch, yaw, roll))
    return ours((-(math.cos(r) * math.sin(p) * math.cos(y) + math.sin(r) * math.sin(y)),
                 math.cos(y) * math.sin(r) - math.cos(r) * math.sin(p) * math.sin(y),
                 math.cos(r) * math.cos(p)))


def seen_from(kind, get, rgb, use_temperature, at, aim):
    seen = Seen(at=[v / 100 for v in at], aim=aim)
    y = 1.0  # of the engine's own black body
    if use_temperature:
        seen.kelvin = get("temperature")
    else:
        seen.rgb = decoded([c / 255 for c in rgb])
        y = luminance(seen.rgb)
    value = get("intensity") * y
    if kind == "DirectionalLight":
        seen.lux = value
        return seen
    seen.candela = value
    if (1 - (2.0 * 100 / get("attenuation_radius")) ** 4) ** 2 < 0.99:
        raise GateError("unreal: attenuation radius at 2 m")
    if kind == "RectLight":
        seen.size = (get("source_width") / 100, get("source_height") / 100)
    if kind == "SpotLight":
        seen.outer, seen.inner = get("outer_cone_angle"), get("inner_cone_angle")
    if kind == "PointLight":
        seen.aim = None
    return seen


def read_script(text, path, ies_multiplier=1.0):
    spawned, warnings = unreal.run(text, path, ies_multiplier)
    if warnings:
        raise GateError("unreal: " + warnings[0])
    lights, cards, k = {}, [], None
    for actor, at, turn in spawned:
        xyz = (at["x"], at["y"], at["z"])
        root, kind = actor.root, type(actor).__name__
        if kind == "PostProcessVolume":
            held = actor.held["settings"].held
            for name in list(held):
                if not name.startswith("override_") and held.get("override_" + name) is not True:
                    raise GateError("unreal: %s has no override" % name)
            if held["auto_exposure_method"] is not unreal.AutoExposureMethod.AEM_MANUAL:
                raise GateError("unreal: exposure is not locked")
            if held["auto_exposure_apply_physical_camera_exposure"]:
                raise GateError("unreal: physical camera exposure on top")
            k = 2.0 ** held["auto_exposure_bias"]  # L_max = 2^EV100 at EV100 0
        if kind == "StaticMeshActor":
            reflectance = root.material.inputs["base"].held["r"]
            normal = up(turn["pitch"], turn["yaw"], turn["roll"])
            cards.append(([v / 100 for v in ours(xyz)], normal, reflectance))
        if not isinstance(root, unreal.LightComponent):
            continue
        held = root.held
        if kind != "DirectionalLight" and held["intensity_units"] is not unreal.LightUnits.CANDELAS:
            raise GateError("unreal: unit")
        color = held["light_color"].values
        seen = seen_from(kind, held.__getitem__, (color["r"], color["g"], color["b"]),
                         held["use_temperature"], ours(xyz), forward(turn["pitch"], turn["yaw"]))
        if "ies_texture" in held:
            with open(held["ies_texture"].file, newline="") as ies:
                peak = read_ies(ies.read())
            if abs(seen.candela * ies_multiplier / peak - 1) > 1e-3:
                raise GateError("unreal: %r cd of a profile of %r" % (seen.candela, peak))
            seen.candela *= ies_multiplier
        lights[actor.label] = seen
    return lights, Rig(k, cards) if cards else None


def read_t3d(text):
    lights, kind = {}, None
    depth = []
    for line in text.split("\n"):
        line = line.strip()
        if line.startswith("Begin "):
            depth.append(line.split()[1])
            found = re.match(r"Begin Actor Class=/Script/Engine\.(\w+) Name=(\w+) "
                             r"Archetype=/Script/Engine\.(\w+)'/Script/Engine\.Default__(\w+)'$", line)
            if depth[-1] == "Actor":
                if not found or len({found.group(1), found.group(3), found.group(4)}) != 1:
                    raise GateError("t3d: " + line)
                kind, values, label = found.group(1), {}, None
        elif line.startswith("End "):
            if depth.pop() != line.split()[1]:
                raise GateError("t3d: " + line)
            if line == "End Actor":
                lights[label] = from_t3d(kind, values)
        elif line.startswith("ActorLabel="):
            label = line.split("=", 1)[1].strip('"')
        elif line:
            if depth[-1] != "Object":
                raise GateError("t3d: " + line)
            key, value = line.split("=", 1)
            values[key] = value
    if depth:
        raise GateError("t3d: open blocks")
    return lights


def from_t3d(kind, values):
    def triple(key, names):
        found = dict(part.split("=") for part in values[key].strip("()").split(","))
        return [float(found[n]) for n in names]

    def get(name):
        return float(values["".join(part.capitalize() for part in name.split("_"))])

    if kind != "DirectionalLight" and values["IntensityUnits"] != "Candelas":
        raise GateError("t3d: unit")
    if kind in ("PointLight", "SpotLight") and values["bUseInverseSquaredFalloff"] != "True":
        raise GateError("t3d: falloff")
    pitch, yaw = triple("RelativeRotation", ("Pitch", "Yaw"))
    return seen_from(kind, get, triple("LightColor", "RGB"), values["bUseTemperature"] == "True",
                     ours(triple("RelativeLocation", "XYZ")), forward(pitch, yaw))
