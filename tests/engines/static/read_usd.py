# SPDX-License-Identifier: Apache-2.0
"""A .usda by its own small grammar. Formulas: UsdLux, intensity 1 = 1 nit."""
import math
import os
import re

from seen import GateError, Rig, Seen, luminance, read_ies


def prims(text):
    """[(type, name, {attribute: text})] of every def, in order; values of the variant chosen."""
    text, _, sets = text.partition("  variantSet ")
    if sets:
        text = text.rstrip() + "\n}\n"
        chosen = re.search(r'string renderer = ("\w+")', text).group(1)
        body = sets.split("\n    " + chosen + " (", 1)[1].split("\n    }\n", 1)[0]
        for over in re.finditer(r'over "(\w+)"\s*\{([^}]*)\}', body):
            head = re.search(r'def \w+ "%s" \(.*?\n  \)\n  \{\n' % over.group(1), text, re.S)
            text = text[:head.end()] + over.group(2).rstrip() + "\n" + text[head.end():]
    found, stack = [], []
    for line in text.split("\n"):
        line = line.strip()
        head = re.match(r'def (\w+) "(\w+)"', line)
        if head:
            found.append((head.group(1), head.group(2), {"parent": stack[-1] if stack else None}))
            pending = found[-1]
        elif line == "{":
            stack.append(pending)
        elif line == "}" and stack and not line.endswith("= {"):
            stack.pop()
        elif line.endswith("= {"):
            stack.append(("dictionary", "", {}))
        else:
            item = re.match(r"(?:uniform |prepend )?(?:[\w\[\]]+ )?([\w:.]+) = (.*)", line)
            if item and found:
                (stack[-1] if stack and stack[-1][0] != "dictionary" and stack[-1] is found[-1]
                 else found[-1])[2][item.group(1)] = item.group(2)
    if stack:
        raise GateError("usda: braces")
    return found


def floats(text):
    return [float(v) for v in re.findall(r"-?\d+\.?\d*(?:e[+-]?\d+)?", text)]


def read(text, folder):
    if not text.startswith("#usda 1.0") or "metersPerUnit = 1\n" not in text:
        raise GateError("usda: head or metersPerUnit")
    if 'upAxis = "Z"' not in text:
        raise GateError("usda: upAxis")
    lights, cards, k, reflectances = {}, [], None, []
    for kind, name, a in prims(text):
        m = floats(a["xformOp:transform"]) if "xformOp:transform" in a else None
        if kind == "Shader":
            reflectances.append(floats(a["inputs:diffuseColor"])[0])
        if kind == "Mesh":
            cards.append((m[12:15], m[8:11]))
        if kind == "Camera":
            k = 2.0 ** float(a["exposure"])
        if not kind.endswith("Light"):
            continue
        rgb = floats(a["inputs:color"])
        if max(rgb) > 1.0 + 1e-9 or a["inputs:enableColorTemperature"] != "0":
            raise GateError("usda: colour above 1 or a temperature on top")
        value = (float(a["inputs:intensity"]) * 2.0 ** float(a["inputs:exposure"]) *
                 luminance(rgb))
        seen = Seen(rgb=rgb, at=m[12:15], aim=[-v for v in m[8:11]])
        if kind != "DomeLight" and a["inputs:normalize"] != ("1" if kind == "DistantLight" else "0"):
            raise GateError("usda: normalize")
        if kind == "SphereLight":
            r = float(a["inputs:radius"])
            seen.aim = None
            if r == 0.005:
                seen.candela = value * math.pi * r * r
            else:
                seen.nits = value
            if "inputs:shaping:ies:file" in a:
                path = a["inputs:shaping:ies:file"].strip("@")
                with open(os.path.join(folder, path), newline="") as ies:
                    seen.candela *= read_ies(ies.read())
            if "inputs:shaping:cone:softness" in a:
                seen.aim = [-v for v in m[8:11]]
                seen.outer = float(a["inputs:shaping:cone:angle"])
                seen.inner = seen.outer * (1 - float(a["inputs:shaping:cone:softness"]))
                seen.law = "smooth_angle"
        elif kind == "DistantLight":
            seen.lux = value
        else:
            seen.nits = value
            if kind in ("DomeLight", "CylinderLight"):
                seen.aim = None
            if kind == "RectLight":
                seen.size = (float(a["inputs:width"]), float(a["inputs:height"]))
        lights[a["displayName"].strip('"')] = seen
    rig = [(c, n, r) for (c, n), r in zip(cards, reflectances)]
    return lights, Rig(k, rig) if rig else None
