# SPDX-License-Identifier: Apache-2.0
"""A .unity.json as LightcalImporter.cs takes it. HDRP: cd, lx, nits; URP: its Lambert surfaces
return albedo times light, without 1/pi."""
import json
import math

from seen import GateError, Rig, Seen, luminance


def ours(v):  # left-handed, Y up
    return (v[0], v[2], v[1])


def read(text, pipeline="hdrp"):
    root = json.loads(text)
    if root["schema"] != "lightcal.unity/1":
        raise GateError("unity: schema")
    k = root["exposure"]["scale"]
    if abs(2.0 ** -root["exposure"]["ev100"] / 1.2 / k - 1) > 1e-9:
        raise GateError("unity: ev100 and scale disagree")
    lights = {}
    for lamp in root["lights"]:
        e = lamp[pipeline]
        rgb = lamp["color_linear"]
        if max(rgb) > 1 + 1e-9:
            raise GateError("unity: colour above 1")
        value = e["intensity"] * luminance(rgb) * (1.0 if pipeline == "hdrp" else math.pi / k)
        seen = Seen(rgb=rgb, at=ours(lamp["position"]), aim=ours(lamp["forward"]))
        if e["type"] == "Directional":
            seen.lux = value
        elif e["type"] == "Rectangle":
            seen.nits = value
            seen.size = (e["area_width_m"], e["area_height_m"])
        else:
            seen.candela = value
        if e["type"] == "Spot":
            seen.outer, seen.inner = e["spot_angle_deg"] / 2, e["inner_spot_angle_deg"] / 2
        lights[lamp["name"]] = seen
    cards = [(ours(c["position"]), [-x for x in ours(c["forward"])], c["reflectance"])
             for c in root.get("cards", [])]
    return lights, Rig(k, cards) if cards else None
