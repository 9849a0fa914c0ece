# SPDX-License-Identifier: Apache-2.0
"""UsdLux rendered by brute force from its specification alone: a .usda is parsed by USD's text
grammar, variants composed, and the illuminance of matt cards summed over stratified samples of
every light's surface or sky. Includes nothing of lightcal and looks at no file but the .usda and
what it names. Source: the schema's text (pxr/usd/usdLux/schema.usda, OpenUSD 25.05):
  L = intensity 2^exposure colour [/ sizeFactor] [cone] [IES]   cd/m^2
  sizeFactor: world-space area; of a distant light pi sin^2(angle/2), 1 at angle 0
  cone: 1 - smoothstep(angle (1 - softness), angle, off axis), angles in degrees, half
  dome: OpenEXR's lat-long, longitude 0 along +Z, pi/2 along +X, +Y up
Misreadings are put in by name (Reader)."""
import os
import re
import struct

import numpy as np

import plain_png

WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
LIGHTS = ("SphereLight", "DiskLight", "RectLight", "CylinderLight", "DistantLight", "DomeLight")


# ---- the text ----

TOKEN = re.compile(r'\s*(?:#[^\n]*\n\s*)*("(?:[^"\\]|\\.)*"|@[^@]*@|<[^>]*>|[A-Za-z_][\w:.]*(?:\[\])?'
                   r'|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?inf|[(){}\[\]=,;])')


class Prim:
    def __init__(self, kind, name):
        self.kind, self.name = kind, name
        self.meta, self.values, self.children, self.sets = {}, {}, [], {}

    def child(self, name):
        return next((c for c in self.children if c.name == name), None)

    def walk(self, matrix=np.eye(4)):
        own = self.values.get("xformOp:transform")
        matrix = (np.array(own) if own is not None else np.eye(4)) @ matrix
        yield self, matrix
        for child in self.children:
            yield from child.walk(matrix)


class Parser:
    def __init__(self, text):
        if not text.startswith("#usda 1.0"):
            raise ValueError("no #usda 1.0")
        self.tokens, at = [], 0
        while at < len(text.rstrip()):
            m = TOKEN.match(text, at)
            if not m:
                raise ValueError("at " + text[at:at + 40])
            self.tokens.append(m.group(1))
            at = m.end()
        self.at = 0

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def next(self, wanted=None):
        token = self.peek()
        if token is None or (wanted and token != wanted):
            raise ValueError("%r instead of %r" % (token, wanted))
        self.at += 1
        return token

    def value(self):
        t = self.next()
        if t in "([":
            end, items = {"(": ")", "[": "]"}[t], []
            while self.peek() != end:
                items.append(self.value())
                if self.peek() == ",":
                    self.next()
            self.next(end)
            return items
        if t == "{":
            return self.dictionary()
        if t[0] in '"@<':
            return re.sub(r"\\(.)", r"\1", t[1:-1])
        if t in ("true", "false"):
            return float(t == "true")
        return float(t)

    def dictionary(self):
        found = {}
        while self.peek() != "}":
            self.next()  # the type
            name = self.next().strip('"')
            self.next("=")
            found[name] = self.value()
        self.next("}")
        return found

    def metadata(self, into):
        if self.peek() != "(":
            return
        self.next()
        while self.peek() != ")":
            if self.peek().startswith('"'):
                self.next()
                continue
            if self.peek() in ("prepend", "append"):
                self.next()
            name = self.next()
            self.next("=")
            into[name] = self.value()
        self.next(")")

    def body(self, prim, end="}"):
        while self.peek() != end:
            if self.peek() in ("def", "over", "class"):
                self.next()
                kind = "" if self.peek().startswith('"') else self.next()
                child = Prim(kind, self.next()[1:-1])
                self.metadata(child.meta)
                self.next("{")
                self.body(child)
                self.next("}")
                prim.children.append(child)
            elif self.peek() == "variantSet":
                self.next()
                name = self.next()[1:-1]
                self.next("=")
                self.next("{")
                prim.sets[name] = {}
                while self.peek() != "}":
                    variant = Prim("", self.next()[1:-1])
                    self.metadata(variant.meta)
                    self.next("{")
                    self.body(variant)
                    self.next("}")
                    prim.sets[name][variant.name] = variant
                self.next("}")
            else:
                words = []
                while re.match(r"\w", self.peek() or ""):
                    words.append(self.next())
                    if self.peek() in ("=", "(") or (len(words) > 1 and self.peek() in (
                            "}", "def", "over", "uniform", "float", "bool")):
                        break
                if not words:
                    raise ValueError("unexpected %r" % self.peek())
                prim.values.setdefault(words[-1], None)
                if self.peek() == "=":
                    self.next()
                    prim.values[words[-1]] = self.value()
                self.metadata({})
        return prim


def compose(prim, chosen):
    """Variants below the local opinions, as LIVRPS has them."""
    for name, variants in prim.sets.items():
        word = chosen.get(name, prim.meta.get("variants", {}).get(name))
        if word in variants:
            merge(prim, variants[word])
    for child in prim.children:
        compose(child, chosen)


def merge(prim, weaker):
    for key, value in weaker.values.items():
        prim.values.setdefault(key, value)
    for child in weaker.children:
        own = prim.child(child.name)
        if own is None:
            prim.children.append(child)
        else:
            merge(own, child)


def load(path, variant=None):
    """(layer metadata, [(prim, world matrix)])"""
    with open(path) as text:
        parser = Parser(text.read())
    layer = {}
    parser.metadata(layer)
    root = Prim("", "")
    while parser.peek() is not None:
        parser.body(root, None)
    compose(root, {"renderer": variant} if variant else {})
    return layer, list(root.walk())


# ---- light ----

class Reader:
    """What a renderer makes otherwise than the specification; all off by default.
    factor: {prim type: factor}; sun: karma | lux | lux_pi | ris; cone: full | double | squared | smooth |
    linear | arnold (a full angle and a penumbra inside it); ies_cone: half the cone of an IES light whose file
    says none; area_in_metres: normalised by square metres, not square units; softness: a number it takes whatever the file says; normalised: prim types that it
    normalises whatever the file says; radius_times: a radius read so many times as large;
    dome_rotation: 3 x 3, from where the specification has a direction to where it shows it."""

    def __init__(self, **wrong):
        self.factor, self.sun, self.cone, self.softness = {}, None, None, None
        self.normalised, self.radius_times, self.dome_rotation = (), 1.0, None
        self.tubes_normalised = self.points = self.y_of_color = self.mirror = False
        self.sphere_area = self.domes_angular = self.clips_colors = False
        self.metres_per_unit, self.ies_cone, self.area_in_metres = 1.0, 90.0, False
        for name, value in wrong.items():
            assert hasattr(self, name), name
            setattr(self, name, value)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def grid(n, m):
    return [a.ravel() for a in np.meshgrid((np.arange(n) + .5) / n, (np.arange(m) + .5) / m)]


def read_ies(path):
    """(vertical degrees, candela by C plane and vertical, C degrees), LM-63-2002."""
    with open(path, newline="") as ies:
        text = ies.read()
    numbers = [float(t) for t in text.split("TILT=NONE", 1)[1].split()]
    scale, nv, nh = numbers[2], int(numbers[3]), int(numbers[4])
    at = 13
    vertical = np.array(numbers[at:at + nv])
    horizontal = np.array(numbers[at + nv:at + nv + nh])
    table = np.array(numbers[at + nv + nh:at + nv + nh + nv * nh]).reshape(nh, nv)
    return vertical, scale * numbers[10] * table, horizontal


def read_hdr(path):
    """Radiance picture, float RGB, rows from the top; mantissas as they are, as OpenImageIO and USD's own
    stb_image read them (Radiance adds half a step)."""
    with open(path, "rb") as picture:
        data = picture.read()
    head, _, rest = data.partition(b"\n\n")
    line, _, body = rest.partition(b"\n")
    height, width = int(line.split()[1]), int(line.split()[3])
    exposure = 1.0
    for word in head.split(b"\n"):
        if word.startswith(b"EXPOSURE="):
            exposure *= float(word[9:])
    rows, at = np.zeros((height, width, 4), np.uint8), 0
    for y in range(height):
        if 8 <= width < 32768 and body[at] == 2 and body[at + 1] == 2:
            at += 4
            for c in range(4):
                x = 0
                while x < width:
                    n = body[at]
                    at += 1
                    if n > 128:
                        rows[y, x:x + n - 128, c] = body[at]
                        at, x = at + 1, x + n - 128
                    else:
                        rows[y, x:x + n, c] = np.frombuffer(body, np.uint8, n, at)
                        at, x = at + n, x + n
        else:
            rows[y] = np.frombuffer(body, np.uint8, width * 4, at).reshape(width, 4)
            at += width * 4
    e = rows[..., 3:].astype(float)
    return np.where(e > 0, rows[..., :3] * 2.0 ** (e - 136), 0.0) / exposure


class Light:
    def __init__(self, prim, matrix, folder, reader, layer_metres=1.0):
        self.layer_metres = layer_metres
        self.kind, self.name, self.folder, self.reader = prim.kind, prim.name, folder, reader
        self.matrix = matrix
        self.v = prim.values
        self.axes = [unit(matrix[i, :3]) for i in range(3)]
        self.at = matrix[3, :3]
        self.ies = self.picture = None
        if self.v.get("inputs:shaping:ies:file"):
            self.ies = read_ies(os.path.join(folder, self.v["inputs:shaping:ies:file"]))
        if self.v.get("inputs:texture:file"):
            self.picture = read_hdr(os.path.join(folder, self.v["inputs:texture:file"]))
        if self.kind in reader.normalised:
            self.v = dict(self.v, **{"inputs:normalize": 1.0})
        if reader.radius_times != 1.0 and "inputs:radius" in self.v:
            self.v = dict(self.v, **{"inputs:radius": self.v["inputs:radius"] * reader.radius_times})
        if self.kind == "DomeLight" and reader.dome_rotation is not None:
            self.axes = [np.array(reader.dome_rotation) @ a for a in self.axes]

    def number(self, name, fallback):
        value = self.v.get("inputs:" + name)
        return fallback if value is None else value

    def base(self, size):
        """RGB of the luminance before shaping; size: the schema's sizeFactor."""
        color = np.array(self.number("color", [1.0, 1.0, 1.0]))
        if self.reader.clips_colors:
            color = np.minimum(color, 1.0)
        if self.reader.y_of_color:
            color = color / (color @ WEIGHTS)
        value = color * self.number("intensity", 50000.0 if self.kind == "DistantLight" else 1.0)
        value = value * 2.0 ** self.number("exposure", 0.0) * self.reader.factor.get(self.kind, 1.0)
        if self.kind != "DomeLight" and self.number("normalize", 0.0):
            metres = self.layer_metres if self.reader.area_in_metres and self.kind != "DistantLight" else 1.0
            value = value / (size * metres ** 2)
        return value

    def shape(self, away):
        """Factor by direction of emission."""
        along = np.clip(away @ -self.axes[2], -1, 1)
        off = np.degrees(np.arccos(along))
        out = np.ones_like(off)
        has = "inputs:shaping:cone:angle" in self.v or self.ies
        angle = self.number("shaping:cone:angle", self.reader.ies_cone if self.ies else 90.0) if has else 180.0
        soft = min(max(self.number("shaping:cone:softness", 0.0), 0.0), 1.0)
        if self.reader.softness is not None and angle < 90.0:
            soft = self.reader.softness
        law = self.reader.cone
        if angle < 90.0:
            angle *= {"full": 0.5, "double": 2.0}.get(law, 1.0)
        start = angle * (1 - soft)
        if law == "arnold":
            cone_angle, penumbra_angle = 2 * angle, soft * 2 * angle
            angle, start = cone_angle / 2, (cone_angle - penumbra_angle) / 2
        if law in ("squared", "smooth"):  # in the cosine
            ca, cs = np.cos(np.radians([angle, start]))
            t = np.clip((along - ca) / max(cs - ca, 1e-12), 0, 1)
            out = out * (t * t if law == "squared" else t * t * (3 - 2 * t))
        elif law == "linear":
            out = out * np.clip((angle - off) / max(angle - start, 1e-12), 0, 1)
        else:
            t = np.clip((off - start) / max(angle - start, 1e-12), 0, 1)
            out = np.where(off > angle, 0.0, out * (1 - t * t * (3 - 2 * t)))
        if self.ies:
            vertical, table, horizontal = self.ies
            c = np.degrees(np.arctan2(away @ self.axes[1], away @ self.axes[0])) % 360
            planes = np.array([np.interp(off, vertical, row, right=0.0) for row in table])
            if len(horizontal) == 1:
                out = out * planes[0]
            else:
                last = horizontal[-1]
                c = c if last > 180 else np.minimum(c, 360 - c)
                c = c if last > 90 else np.minimum(c, 180 - c)
                j = np.clip(np.searchsorted(horizontal, c, "right") - 1, 0, len(horizontal) - 2)
                f = (c - horizontal[j]) / (horizontal[j + 1] - horizontal[j])
                k = np.arange(len(c))
                out = out * (planes[j, k] * (1 - f) + planes[j + 1, k] * f)
        return out

    def illuminance(self, p, n, samples=96):
        """Linear RGB lux at points p (k, 3) on surfaces of normals n."""
        return np.array([self.one(a, b, samples) for a, b in zip(p, n)])

    def one(self, p, n, samples):
        method = {"SphereLight": self.sphere, "DiskLight": self.flat, "RectLight": self.flat,
                  "CylinderLight": self.tube, "DistantLight": self.distant, "DomeLight": self.dome}
        return method[self.kind](p, n, samples)

    def sphere(self, p, n, samples):
        r = self.number("radius", 0.5)
        to = self.at - p
        d = np.linalg.norm(to)
        if self.reader.points and self.v.get("treatAsPoint"):
            # radius and normalize left out: intensity as candela
            shaped = self.shape(-to[None] / d)[0]
            return self.base(1.0) * shaped * max(n @ to, 0.0) / d ** 3
        scale = self.reader.metres_per_unit ** -2.0
        area = (1.0 if self.reader.sphere_area else 4.0) * np.pi * r * r
        top = np.sqrt(1 - min(1.0, (r / d) ** 2))
        u, v = grid(samples, samples)
        cos = 1 - u * (1 - top)
        if r / d < 1e-3:  # 1 - cos loses its digits
            cos = np.sqrt(1 - u * (r / d) ** 2)
        sin = np.sqrt(np.maximum(0.0, 1 - cos * cos))
        z = to / d
        x = unit(np.cross(z, [0, 1, 0] if abs(z[1]) < .9 else [1, 0, 0]))
        y = np.cross(z, x)
        phi = 2 * np.pi * v
        w = cos[:, None] * z + (sin * np.cos(phi))[:, None] * x + (sin * np.sin(phi))[:, None] * y
        solid = 2 * np.pi * ((r / d) ** 2 / (1 + top))  # 1 - top without cancellation
        e = np.mean(np.maximum(w @ n, 0.0) * self.shape(-w)) * solid
        return self.base(area) * e * scale

    def over(self, p, n, points, normals, area, size):
        """Sum over surface samples of equal area."""
        to = points - p
        d2 = np.sum(to * to, axis=1)
        w = to / np.sqrt(d2)[:, None]
        cos = np.maximum(np.sum(-w * normals, axis=1), 0.0) * np.maximum(w @ n, 0.0)
        return self.base(size) * np.mean(cos / d2 * self.shape(-w)) * area

    def flat(self, p, n, samples):
        u, v = grid(samples, samples)
        if self.kind == "DiskLight":
            r = self.number("radius", 0.5)
            x, y = r * np.sqrt(u) * np.cos(2 * np.pi * v), r * np.sqrt(u) * np.sin(2 * np.pi * v)
            area = np.pi * r * r
        else:
            w, h = self.number("width", 1.0), self.number("height", 1.0)
            x, y, area = w * (u - .5), h * (v - .5), w * h
        points = self.at + x[:, None] * self.axes[0] + y[:, None] * self.axes[1]
        return self.over(p, n, points, -self.axes[2][None], area, area)

    def tube(self, p, n, samples):
        r, length = self.number("radius", 0.5), self.number("length", 1.0)
        u, v = grid(4 * samples, samples)
        phi = 2 * np.pi * v
        normal = np.cos(phi)[:, None] * self.axes[1] + np.sin(phi)[:, None] * self.axes[2]
        points = self.at + (length * (u - .5))[:, None] * self.axes[0] + r * normal
        area = 2 * np.pi * r * length
        if self.reader.tubes_normalised:
            self.v = dict(self.v, **{"inputs:normalize": 1.0})
        return self.over(p, n, points, normal, area, area)

    def distant(self, p, n, samples):
        angle = self.number("angle", 0.53)
        half = np.radians(min(max(angle / 2, 0.0), 180.0))
        size = np.pi * np.sin(half) ** 2 if half > 0 else 1.0
        wrong = self.reader.sun
        if wrong in ("lux", "lux_pi") or half == 0.0:
            self_base = self.base(1.0) * (np.pi if wrong == "lux_pi" else 1.0)
            return self_base * max(n @ self.axes[2], 0.0)
        if wrong == "karma":
            size *= np.pi  # normalised: lux over pi
        if wrong == "ris":
            size /= np.pi * np.sin(np.radians(0.265)) ** 2
        u, v = grid(samples, samples)
        sin = np.sqrt(u) * np.sin(half)  # uniform over the projected disc: cosine carried
        cos = np.sqrt(1 - sin * sin)
        w = ((sin * np.cos(2 * np.pi * v))[:, None] * self.axes[0] +
             (sin * np.sin(2 * np.pi * v))[:, None] * self.axes[1] + cos[:, None] * self.axes[2])
        return self.base(size) * np.mean(np.maximum(w @ n, 0.0) / cos) * np.pi * np.sin(half) ** 2

    def dome(self, p, n, samples):
        u, v = grid(4 * samples, 2 * samples)
        sin = 2 * v - 1
        cos = np.sqrt(1 - sin * sin)
        longitude = 2 * np.pi * (u - .5)
        local = np.stack([cos * np.sin(longitude), sin, cos * np.cos(longitude)], axis=1)
        weight = np.maximum(local @ np.array([a @ n for a in self.axes]), 0.0) * 4 * np.pi
        if self.picture is None:
            return self.base(1.0) * np.mean(weight)
        height, width, _ = self.picture.shape
        if self.reader.domes_angular and self.v.get("inputs:texture:format") != "latlong":
            # Debevec's angular map: the middle looks along -Z, the rim along +Z.
            r = np.arccos(-local[:, 2]) / np.pi / np.maximum(np.hypot(local[:, 0], local[:, 1]), 1e-12)
            i = np.clip(((.5 - .5 * r * local[:, 1]) * height).astype(int), 0, height - 1)
            j = np.clip(((.5 + .5 * r * local[:, 0]) * width).astype(int), 0, width - 1)
            return self.base(1.0) * np.mean(weight[:, None] * self.picture[i, j], axis=0)
        x = .5 - longitude / (2 * np.pi)
        if self.reader.mirror:
            x = 1 - x
        i = np.minimum((np.arccos(sin) / np.pi * height).astype(int), height - 1)
        j = (x * width).astype(int) % width
        return self.base(1.0) * np.mean(weight[:, None] * self.picture[i, j], axis=0)


class Scene:
    def __init__(self, path, variant=None, reader=None):
        self.layer, prims = load(path, variant)
        reader = reader or Reader()
        folder = os.path.dirname(path)
        metres = self.layer.get("metersPerUnit", 0.01)
        self.lights = {p.name: Light(p, m, folder, reader, metres) for p, m in prims if p.kind in LIGHTS}
        self.cards, self.camera = [], None
        materials = {p.name: p for p, _ in prims if p.kind == "Material"}
        for prim, m in prims:
            if prim.kind == "Mesh":
                shader = materials[prim.values["material:binding"].split("/")[-1]].children[0].values
                corners = np.array(prim.values["points"]) @ m[:3, :3] + m[3, :3]
                self.cards.append((prim.name, corners, np.array(shader["inputs:diffuseColor"]),
                                   np.array(shader.get("inputs:emissiveColor", [0.0] * 3))))
            if prim.kind == "Camera":
                self.camera = (prim.values, m)

    def illuminance(self, p, n, samples=96):
        return sum(light.illuminance(p, n, samples) for light in self.lights.values())

    def render(self, width, height, samples=24, steps=5):
        """Linear RGB nits of the cards through the camera, black elsewhere. The illuminance over a
        card is computed at steps x steps points and interpolated."""
        values, m = self.camera
        focal, aperture = values["focalLength"], values["verticalAperture"]
        y, x = np.mgrid[0:height, 0:width]
        pixel = aperture / height
        d = unit(np.stack([(x + .5 - width / 2) * pixel, (height / 2 - y - .5) * pixel,
                           np.full(x.shape, -focal)], axis=-1)) @ m[:3, :3]
        picture, depth = np.zeros((height, width, 3)), np.full((height, width), np.inf)
        for _, corners, diffuse, emission in self.cards:
            o, a, b = corners[0], corners[1] - corners[0], corners[3] - corners[0]
            n = unit(np.cross(a, b))
            denominator = d @ n
            with np.errstate(divide="ignore", invalid="ignore"):
                t = ((o - m[3, :3]) @ n) / denominator
            hit = m[3, :3] + t[..., None] * d - o
            s, r = hit @ a / (a @ a), hit @ b / (b @ b)
            seen = (t > 0) & (t < depth) & (s > 0) & (s < 1) & (r > 0) & (r < 1)
            if not seen.any():
                continue
            facing = n if n @ (m[3, :3] - o) > 0 else -n
            at = np.linspace(0, 1, steps)
            points = [o + i * a + j * b for j in at for i in at]
            e = self.illuminance(points, [facing] * len(points), samples).reshape(steps, steps, 3)
            fx, fy = s[seen] * (steps - 1), r[seen] * (steps - 1)
            i, j = (np.minimum(f.astype(int), steps - 2) for f in (fx, fy))
            fx, fy = (fx - i)[:, None], (fy - j)[:, None]
            lux = ((e[j, i] * (1 - fx) + e[j, i + 1] * fx) * (1 - fy) +
                   (e[j + 1, i] * (1 - fx) + e[j + 1, i + 1] * fx) * fy)
            picture[seen] = diffuse * lux / np.pi + emission
            depth[seen] = t[seen]
        return picture


def write_exr(path, picture, half=False, white_luminance=None, floats=None):
    """Scan lines, no compression, with further attributes by name. Source: the OpenEXR file layout."""
    height, width, _ = picture.shape
    kind, dtype = (1, "<f2") if half else (2, "<f4")
    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", kind, 0, 1, 1) for c in (b"B", b"G", b"R"))
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)

    def attribute(name, of, data):
        return name + b"\0" + of + b"\0" + struct.pack("<i", len(data)) + data
    head = struct.pack("<2i", 20000630, 2) + b"".join([
        attribute(b"channels", b"chlist", channels + b"\0"),
        attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", box), attribute(b"displayWindow", b"box2i", box),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1.0))])
    numbers = dict(floats or {})
    if white_luminance is not None:
        numbers["whiteLuminance"] = white_luminance
    for name, value in numbers.items():
        head += attribute(name.encode(), b"float", struct.pack("<f", value))
    head += b"\0"
    size = width * 3 * np.dtype(dtype).itemsize
    offsets = [len(head) + 8 * height + y * (8 + size) for y in range(height)]
    with open(path, "wb") as out:
        out.write(head + struct.pack("<%dQ" % height, *offsets))
        for y in range(height):
            out.write(struct.pack("<2i", y, size))
            out.write(picture[y, :, ::-1].T.astype(dtype).tobytes())


def write_png(path, picture):
    """8 bit, sRGB, clipped."""
    v = np.clip(picture, 0, 1)
    code = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)
    plain_png.write_png(path, np.rint(code * 255).astype(np.uint8))
