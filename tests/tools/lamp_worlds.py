# SPDX-License-Identifier: Apache-2.0
"""Lamps as sums over thousands of small pieces, and what a meter before them would show: the truth
of the session tests. Knows nothing of lightcal's code; metres, candela, lux; Z up."""
import numpy as np

PIECES = 48


def unit(v):
    v = np.asarray(v, float)
    return v / np.linalg.norm(v)


def frame(z):
    z = unit(z)
    x = unit(np.cross(z, [0, 0, 1] if abs(z[2]) < 0.9 else [1, 0, 0]))
    return x, np.cross(z, x), z


def grid(n):
    return (np.arange(n) + 0.5) / n


class Lamp:
    """kind, place, aim and sizes as a session says them; strength in axial candela (illuminance of a
    sun or sky)."""

    def __init__(self, kind, strength, position=(0, 0, 0), aim=(0, 0, -1), **size):
        self.kind, self.strength = kind, strength
        self.position, self.aim = np.asarray(position, float), unit(aim)
        self.size = size
        self.points, self.normals, self.weights = self._surface()

    def _surface(self):
        """Points, their normals (None: no surface) and candela per piece seen face on."""
        x, y, z = frame(self.aim)
        n = PIECES
        if self.kind in ("disk", "rect"):
            if self.kind == "rect":
                w, h = self.size["size_m"]
                u, v = (g.ravel() for g in np.meshgrid((grid(n) - 0.5) * w, (grid(n) - 0.5) * h))
                x = unit(self.size.get("axis", x))
                y = np.cross(z, x)
            else:
                r, f = (g.ravel() for g in np.meshgrid(np.sqrt(grid(n)), 2 * np.pi * grid(n)))
                r = r * self.size["diameter_m"] / 2
                u, v = r * np.cos(f), r * np.sin(f)
            points = self.position + np.outer(u, x) + np.outer(v, y)
            return points, np.tile(z, (len(u), 1)), np.full(len(u), self.strength / len(u))
        if self.kind == "sphere":
            c, f = (g.ravel() for g in np.meshgrid(2 * grid(3 * n) - 1, 2 * np.pi * grid(2 * n)))
            s = np.sqrt(1 - c * c)
            normals = np.stack([s * np.cos(f), s * np.sin(f), c], 1)
            points = self.position + normals * self.size["diameter_m"] / 2
            # A sphere of luminance L: I = L pi R^2, its surface is 4 pi R^2.
            return points, normals, np.full(len(c), 4 * self.strength / len(c))
        if self.kind == "tube":
            axis = unit(self.size["axis"])
            s, t, _ = frame(axis)
            l, f = (g.ravel() for g in np.meshgrid(grid(4 * n) - 0.5, 2 * np.pi * grid(4 * n)))
            normals = np.outer(np.cos(f), s) + np.outer(np.sin(f), t)
            points = self.position + np.outer(l * self.size["length_m"], axis)
            points = points + normals * self.size["radius_m"]
            # Square to the axis: I = L 2 R l, its surface is 2 pi R l.
            return points, normals, np.full(len(l), np.pi * self.strength / len(l))
        return self.position[None, :], None, np.array([self.strength])

    def shape(self, cosine):
        """Of the axial candela, for kinds without a surface."""
        if self.kind == "spot":
            inner, outer = np.cos(np.radians([self.size["inner_deg"], self.size["outer_deg"]]))
            return np.clip((cosine - outer) / (inner - outer), 0, 1) ** 2
        if self.kind == "photometric":
            angles, candela = self.size["table"]
            theta = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
            return np.interp(theta, angles, candela, right=0.0) / candela[0]
        return np.ones_like(cosine)

    def lux(self, at, normal):
        """On a small flat meter of this unit normal."""
        at, normal = np.asarray(at, float), unit(normal)
        v = self.points - at
        r2 = np.sum(v * v, 1)
        here = np.maximum(0.0, v @ normal) / np.sqrt(r2)
        out = -v / np.sqrt(r2)[:, None]
        if self.normals is not None:
            there = np.maximum(0.0, np.sum(out * self.normals, 1))
        else:
            there = self.shape(out @ self.aim)
        return float(np.sum(self.weights * here * there / r2))

    def flux(self):
        """Integral of the far field's intensity over all directions."""
        n = 400
        c, f = (g.ravel() for g in np.meshgrid(2 * grid(20 * n) - 1, 2 * np.pi * grid(8)))
        if self.kind == "tube":
            intensity = self.strength * np.sqrt(1 - c * c)
        elif self.kind in ("disk", "rect"):
            intensity = self.strength * np.maximum(c, 0)
        else:
            intensity = self.strength * self.shape(c)
        return float(4 * np.pi * np.mean(intensity))

    def luminance(self):
        size = self.size
        area = {
            "sphere": lambda: np.pi * size["diameter_m"] ** 2 / 4,
            "disk": lambda: np.pi * size["diameter_m"] ** 2 / 4,
            "rect": lambda: size["size_m"][0] * size["size_m"][1],
            "tube": lambda: 2 * size["radius_m"] * size["length_m"],
        }.get(self.kind)
        return None if area is None else self.strength / area()


class Meter:
    """One factor on all of its readings, and noise of each one's own; both relative, 1 sigma."""

    def __init__(self, random, repeatability, calibration):
        self.random, self.repeatability, self.calibration = random, repeatability, calibration
        self.gain = np.exp(calibration * random.standard_normal())

    def read(self, lux):
        return lux * self.gain * np.exp(self.repeatability * self.random.standard_normal())

    def toml(self, name):
        sigma = float(np.hypot(self.repeatability, self.calibration))
        return (f'[[meter]]\nname = "{name}"\nsigma_relative = {sigma}\n'
                f"calibration_relative = {self.calibration}\n")


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {toml_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(toml_value(v) for v in value) + "]"
    return repr(float(value))


def toml_block(title, values):
    lines = [f"{key} = {toml_value(value)}" for key, value in values.items()]
    return f"\n[[{title}]]\n" + "\n".join(lines) + "\n"
