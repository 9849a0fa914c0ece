# SPDX-License-Identifier: Apache-2.0
"""A pbrt-v4 scene by its file format's page: directives, quoted types, bracketed values."""
import math
import re

import numpy as np

from seen import GateError, Rig, Seen, cross, luminance, unit

TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|\[|\]|[^\s\[\]"]+')


def directives(text):
    """[(comment, directive, [plain words], {parameter: values})]"""
    found, comment = [], ""
    names = {"ColorSpace", "Scale", "LookAt", "Camera", "Film", "Sampler", "Integrator",
             "WorldBegin", "LightSource", "AttributeBegin", "AttributeEnd", "AreaLightSource",
             "Transform", "ConcatTransform", "Rotate", "Shape", "Material"}
    for line in text.split("\n"):
        if line.startswith("#"):
            comment = line[1:].split(" substituted: ")[0].strip().strip('"')
            continue
        tokens = TOKEN.findall(line)
        i = 0
        while i < len(tokens):
            if tokens[i] in names:
                found.append((comment, tokens[i], [], {}))
                i += 1
            elif tokens[i].startswith('"') and " " in tokens[i]:
                j = i + 1
                if tokens[j] == "[":
                    j = tokens.index("]", i)
                    values = tokens[i + 2:j]
                else:
                    values = [tokens[j]]
                found[-1][3][tokens[i].strip('"').split(" ", 1)[1]] = [v.strip('"') for v in values]
                i = j + 1
            elif tokens[i] == "[":
                j = tokens.index("]", i)
                found[-1][2].extend(tokens[i + 1:j])
                i = j + 1
            elif found:
                found[-1][2].append(tokens[i].strip('"'))
                i += 1
            else:
                raise GateError("pbrt: " + line)
    return found


def rotation(degrees, axis):
    """Rodrigues."""
    x, y, z = unit(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turn = math.radians(degrees)
    out = np.eye(4)
    out[:3, :3] += math.sin(turn) * k + (1 - math.cos(turn)) * k @ k
    return out


def read(text):
    lights, cards, k = {}, [], None
    area = material = None
    ctm, kept = np.eye(4), []

    def point(p):
        return list(ctm[:3, :3] @ p + ctm[:3, 3])

    for comment, word, plain, p in directives(text):
        number = {key: [float(v) for v in values] for key, values in p.items()
                  if all(re.fullmatch(r"[-+.e\d]+", v) for v in values)}
        if word == "Film":
            if p["sensor"] != ["cie1931"]:
                raise GateError("pbrt: sensor")
            k = number["iso"][0] / 100.0
        if word == "WorldBegin":
            ctm = np.eye(4)
        if word == "AttributeBegin":
            kept.append(ctm)
            area = material = None
        if word == "AttributeEnd":
            ctm = kept.pop()
        if word == "Material":
            material = number["reflectance"][0]
        if word == "Transform":
            ctm = np.array(plain, float).reshape(4, 4).T
        if word == "ConcatTransform":
            ctm = ctm @ np.array(plain, float).reshape(4, 4).T
        if word == "Rotate":
            ctm = ctm @ rotation(float(plain[0]), [float(v) for v in plain[1:]])
        if word == "AreaLightSource":
            area = number
        if word == "Shape" and plain[0] == "bilinearmesh":
            q = number["P"]
            p00, p10, p01, p11 = (point(q[3 * i:3 * i + 3]) for i in range(4))
            u = [b - a for a, b in zip(p00, p10)]
            v = [b - a for a, b in zip(p00, p01)]
            centre = [(a + b) / 2 for a, b in zip(p00, p11)]
            normal = unit(cross(u, v))
            size = [sum(x * x for x in axis) ** 0.5 for axis in (u, v)]
            if material is not None:
                cards.append((centre, normal, material))
                continue
        if word == "Shape" and area is not None:
            rgb = area["L"]
            seen = Seen(rgb=rgb, nits=area["scale"][0] * luminance(rgb))
            if plain[0] == "bilinearmesh":
                seen.at, seen.aim, seen.size = centre, normal, size
            else:
                x, y, z, seen.at = (list(ctm[:3, i]) for i in range(4))
                handed = sum(a * b for a, b in zip(cross(x, y), z))
                if abs(handed - 1) > 1e-9:
                    raise GateError("pbrt: a transform that turns shapes inside out")
                if plain[0] == "disk":
                    seen.aim = z
            lights[comment] = seen
        if word != "LightSource":
            continue
        rgb = number.get("I") or number["L"]
        seen = Seen(rgb=rgb)
        y = luminance(rgb)
        if plain[0] == "distant":
            seen.lux = number["illuminance"][0] * y
        elif plain[0] == "infinite":
            seen.nits = number["scale"][0] * y
        else:
            seen.candela = number["scale"][0] * y
            seen.at = point(number["from"])
        if plain[0] in ("spot", "distant"):
            seen.aim = unit([b - a for a, b in zip(point(number["from"]), point(number["to"]))])
        if plain[0] == "spot":
            seen.outer = number["coneangle"][0]
            seen.inner = seen.outer - number["conedeltaangle"][0]
            seen.law = "smooth"
        lights[comment] = seen
    return lights, Rig(k, cards) if cards else None
