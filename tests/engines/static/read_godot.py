# SPDX-License-Identifier: Apache-2.0
"""A .tscn by its own grammar. Formulas: Godot's class reference and renders of 4.6.3."""
import math
import re

from seen import GateError, Rig, Seen, decoded, luminance, near

TINT_6500 = (1.0, 0.942, 0.992)  # what 4.6.3 was measured to multiply colours by, linear


def sections(text):
    found = []
    for line in text.split("\n"):
        line = line.strip()
        if not line or line.startswith(";"):
            continue
        head = re.fullmatch(r"\[(\w+)(.*)\]", line)
        if head:
            found.append((head.group(1), dict(re.findall(r'(\w+)="((?:[^"\\]|\\.)*)"', line)), {}))
        elif "=" in line and found:
            key, value = line.split("=", 1)
            found[-1][2][key.strip()] = value.strip()
        elif line not in ("}", "{") and not line.startswith('"'):
            raise GateError("tscn: cannot read " + line)
    if not found or found[0][0] != "gd_scene":
        raise GateError("tscn: no scene")
    return found


def numbers(value, word):
    match = re.fullmatch(word + r"\(([^()]*)\)", value)
    if not match:
        raise GateError("tscn: %s is no %s" % (value, word))
    return [float(v) for v in match.group(1).split(",")]


def ours(v):  # x, z up, -y forward
    return (v[0], -v[2], v[1])


def place(values):
    t = numbers(values["transform"], "Transform3D")
    back = (t[2], t[5], t[8])
    determinant = (t[0] * (t[4] * t[8] - t[5] * t[7]) - t[1] * (t[3] * t[8] - t[5] * t[6]) +
                   t[2] * (t[3] * t[7] - t[4] * t[6]))
    if abs(determinant - 1) > 1e-9:
        raise GateError("tscn: a basis that is no rotation")
    return ours(t[9:]), ours([-b for b in back]), ours(back)


def read(text, nearest_window=0.995):
    lights, cards, k, materials, ambient = {}, [], None, {}, None
    if "use_physical_light_units=true" not in text:
        raise GateError("tscn: does not say that it needs physical light units")
    for kind, head, values in sections(text):
        if kind == "sub_resource" and head["type"] == "CameraAttributesPhysical":
            n = float(values["exposure_aperture"])
            t = 1.0 / float(values["exposure_shutter_speed"])
            s = float(values["exposure_sensitivity"])
            k = t * s / 100.0 / (1.2 * n * n)
        if kind == "sub_resource" and head["type"] == "StandardMaterial3D":
            materials[head["id"]] = decoded(numbers(values["albedo_color"], "Color")[:3])[0]
        if kind == "sub_resource" and head["type"] == "Environment":
            if "background_intensity" in values:
                rgb = decoded(numbers(values["background_color"], "Color")[:3])
                # Light of a plain background is not exposed; what is seen of it is. Rendered in 4.6.3.
                energy = float(values["background_energy_multiplier"])
                lights["sky"] = Seen(nits=float(values["background_intensity"]) * energy *
                                     luminance(rgb), rgb=rgb)
                ambient = energy
        if kind != "node":
            continue
        if head["type"] == "MeshInstance3D":
            centre, _, normal = place(values)
            material = values["surface_material_override/0"].split('"')[1]
            cards.append((centre, normal, materials[material]))
        if not head["type"].endswith("Light3D"):
            continue
        at, aim, _ = place(values)
        if float(values["light_temperature"]) != 6500.0:
            raise GateError("tscn: light_temperature")
        rgb = [c * t for c, t in zip(decoded(numbers(values["light_color"], "Color")[:3]), TINT_6500)]
        seen = Seen(at=at, aim=aim, rgb=rgb)
        if head["type"] == "DirectionalLight3D":
            seen.lux = float(values["light_intensity_lux"]) * luminance(rgb)
        else:
            short = "spot" if head["type"] == "SpotLight3D" else "omni"
            if float(values[short + "_attenuation"]) != 2.0:
                raise GateError("tscn: attenuation is not 2")
            r = float(values[short + "_range"])
            if (1 - (10 / r) ** 4) ** 2 < nearest_window:
                raise GateError("tscn: range window at 10 m")
            per_candela = math.pi if short == "spot" else 4 * math.pi
            seen.candela = float(values["light_intensity_lumens"]) / per_candela * luminance(rgb)
            if short == "spot":
                seen.outer, seen.law = float(values["spot_angle"]), "power"
                seen.power = 1.0 / float(values["spot_angle_attenuation"])
                # Its shader takes max(1e-4, rim) to that power, on the axis too.
                seen.candela *= 1.0 - 1e-4 ** seen.power
            else:
                seen.aim = None
        lights[head["name"]] = seen
    if ambient is not None and k is not None:
        near("what the sky lights", ambient * luminance(lights["sky"].rgb),
             k * lights["sky"].nits, 1e-9)
    return lights, Rig(k, cards) if cards else None
