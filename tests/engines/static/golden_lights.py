# SPDX-License-Identifier: Apache-2.0
"""One lamp of every kind, and what any engine must make of it. Nothing here is lightcal's."""
import json
import math

KELVIN_2700 = (0.45986, 0.41060)  # CIE 15, Planckian locus

LAMPS = {
    "key": dict(kind="point", kelvin=2700.0, cd=1000.0, xy=KELVIN_2700, at=(1.0, 2.0, 3.0)),
    "green spot": dict(kind="spot", cd=5000.0, xy=(0.38, 0.42), at=(0.0, -1.0, 2.0),
                       aim=(0.6, 0.64, -0.48), inner=15.0, outer=25.0),
    "sun": dict(kind="directional", lx=98000.0, xy=(0.3324, 0.3474), aim=(0.0, 0.6, -0.8)),
    "panel": dict(kind="rect", kelvin=6500.0, cd=900.0, xy=(0.3135, 0.3237), at=(-1.0, 0.5, 2.0),
                  aim=(0.8, 0.0, -0.6), width=0.6, height=0.3),
    "globe": dict(kind="sphere", kelvin=2855.5, cd=50.0, xy=(0.4476, 0.4074), at=(2.0, -1.0, 1.5),
                  diameter=0.2),
    "downlight": dict(kind="disk", cd=60.0, xy=(0.38, 0.38), at=(0.0, 1.0, 2.5),
                      aim=(0.0, 0.0, -1.0), diameter=0.2),
    "tube": dict(kind="tube", cd=100.0, xy=(0.35, 0.36), at=(3.0, 1.0, 2.0), aim=(0.0, 1.0, 0.0),
                 length=1.2, radius=0.013),
    "luminaire": dict(kind="photometric", cd=2000.0, xy=(0.44, 0.40), at=(-2.0, 1.0, 2.8),
                      aim=(0.0, 0.0, -1.0)),
    "sky": dict(kind="dome", kelvin=7520.0,  # McCamy
                lx=1000.0 * math.pi, xy=(0.30, 0.31)),
}


def area(lamp):
    """Of the lamp as seen along its aim."""
    if lamp["kind"] in ("sphere", "disk"):
        return math.pi * lamp["diameter"] ** 2 / 4
    if lamp["kind"] == "rect":
        return lamp["width"] * lamp["height"]
    return 2 * lamp["radius"] * lamp["length"]


def light_json(names, distances=()):
    lights = []
    for name in names:
        lamp = LAMPS[name]
        light = {"name": name, "kind": lamp["kind"], "effects": [],
                 "color": {"xy": list(lamp["xy"])},
                 "fit": {"readings": 1, "used": 1, "rejected": [], "learned": [], "prior": []}}
        for key, unit in (("cd", "intensity_cd"), ("lx", "illuminance_lx")):
            if key in lamp:
                light[unit] = {"value": lamp[key], "u95": lamp[key] * 0.002}
        for key, field in (("at", "position_m"), ("aim", "aim")):
            if key in lamp:
                light[field] = list(lamp[key])
        for key in ("diameter", "width", "height", "length", "radius"):
            if key in lamp:
                light[key + "_m"] = lamp[key]
        if "outer" in lamp:
            light["cone"] = {"inner_deg": lamp["inner"], "outer_deg": lamp["outer"]}
        if lamp["kind"] == "directional":
            light["angular_diameter_deg"] = 0.53
        if lamp["kind"] == "photometric":
            angles = [2.0 * i for i in range(91)]
            light["distribution"] = {
                "type": "C", "horizontal_deg": [0.0], "vertical_deg": angles,
                "candela": [lamp["cd"] * max(0.0, math.cos(math.radians(a))) ** 8 for a in angles],
                "interpolated_share": 0.0, "budget": []}
        light["residuals"] = [
            {"index": i, "distance_m": d, "measured_lx": lamp.get("cd", 1) / d ** 2,
             "predicted_lx": lamp.get("cd", 1) / d ** 2, "relative": 0.0, "sigma_relative": 0.02,
             "used": True} for i, d in enumerate(distances)]
        lights.append(light)
    return json.dumps({"schema": "lightcal.light/1", "lights": lights,
                       "provenance": {"generator": "lightcal test"}})
