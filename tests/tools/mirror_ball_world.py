# SPDX-License-Identifier: Apache-2.0
"""Mirror balls and grey balls under a lat-long panorama, traced ray by ray in numpy, and what each
plane truly gets: an independent world (nothing of lightcal's is read here).

Directions are x right, y forward, z up; the panorama's centre looks along +y.
"""
import functools

import numpy as np

from usdlux import write_exr

CHROMIUM = 3.17 + 3.33j  # complex index at 550 nm: Johnson and Christy 1974
REC709 = np.array([0.2126390058715104, 0.7151686787677559, 0.0721923153607337])


def read_hdr(path):
    """A run-length coded Radiance picture as float RGB."""
    data = open(path, "rb").read()
    head, body = data.split(b"\n\n", 1)
    size, body = body.split(b"\n", 1)
    words = size.split()
    height, width = int(words[1]), int(words[3])
    out = np.zeros((height, 4, width), np.uint8)
    at = 0
    for y in range(height):
        assert body[at] == 2 and body[at + 1] == 2
        at += 4
        for c in range(4):
            x = 0
            while x < width:
                n = body[at]
                if n > 128:
                    out[y, c, x:x + n - 128] = body[at + 1]
                    x, at = x + n - 128, at + 2
                else:
                    out[y, c, x:x + n] = np.frombuffer(body[at + 1:at + 1 + n], np.uint8)
                    x, at = x + n, at + 1 + n
    out = out.transpose(0, 2, 1).astype(np.float64)
    scale = np.where(out[..., 3] > 0, np.exp2(out[..., 3] - 136.0), 0.0)
    return (out[..., :3] + 0.5) * scale[..., None]


@functools.lru_cache(maxsize=4)
def directions(height, width):
    """Unit vectors of a panorama's pixel middles, and their solid angles; nobody changes them."""
    zenith = np.pi * (np.arange(height) + 0.5) / height
    azimuth = 2.0 * np.pi * ((np.arange(width) + 0.5) / width - 0.5)
    z, a = np.meshgrid(zenith, azimuth, indexing="ij")
    d = np.stack([np.sin(a) * np.sin(z), np.cos(a) * np.sin(z), np.cos(z)], -1)
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    omega = np.repeat(((edge[:-1] - edge[1:]) * 2.0 * np.pi / width)[:, None], width, 1)
    d.flags.writeable = omega.flags.writeable = False
    return d, omega


def look_up(panorama, d):
    """Bilinear, across the seam."""
    height, width = panorama.shape[:2]
    x = (np.arctan2(d[..., 0], d[..., 1]) / (2.0 * np.pi) + 0.5) * width - 0.5
    y = np.arccos(np.clip(d[..., 2], -1.0, 1.0)) / np.pi * height - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - x0)[..., None], (y - y0)[..., None]

    def at(yy, xx):
        return panorama[np.clip(yy, 0, height - 1), xx % width]

    top = at(y0, x0) * (1.0 - fx) + at(y0, x0 + 1) * fx
    bottom = at(y0 + 1, x0) * (1.0 - fx) + at(y0 + 1, x0 + 1) * fx
    return top * (1.0 - fy) + bottom * fy


def fresnel(index, cosine):
    """Unpolarised reflectance of a surface of complex index in air."""
    inside = np.sqrt(index * index - (1.0 - cosine * cosine) + 0j)
    s = np.abs((cosine - inside) / (cosine + inside)) ** 2
    p = np.abs((index * index * cosine - inside) / (index * index * cosine + inside)) ** 2
    return (s + p) / 2.0


class Camera:
    """A pinhole at the origin of the sphere's far scene, aimed by yaw, pitch, roll in degrees."""

    def __init__(self, width, height, fov_deg, yaw=0.0, pitch=0.0, roll=0.0):
        self.width, self.height = width, height
        self.focal = width / 2.0 / np.tan(np.radians(fov_deg) / 2.0)
        yaw, pitch, roll = np.radians([yaw, pitch, roll])
        self.forward = np.array([np.sin(yaw) * np.cos(pitch), np.cos(yaw) * np.cos(pitch),
                                 np.sin(pitch)])
        level = np.array([np.cos(yaw), -np.sin(yaw), 0.0])
        upright = np.cross(level, self.forward)
        self.right = level * np.cos(roll) - upright * np.sin(roll)
        self.up = upright * np.cos(roll) + level * np.sin(roll)

    def rays(self, samples):
        """Unit vectors through samples x samples points of every pixel."""
        s = (np.arange(samples) + 0.5) / samples
        x = (np.arange(self.width)[:, None] + s).ravel() - self.width / 2.0
        y = self.height / 2.0 - (np.arange(self.height)[:, None] + s).ravel()
        v = (self.right * (x / self.focal)[None, :, None] + self.forward +
             self.up * (y / self.focal)[:, None, None])
        return v / np.linalg.norm(v, axis=-1, keepdims=True)

    def towards(self, x, y):
        """Unit vector through the point x, y of the picture."""
        v = (self.right * (x - self.width / 2.0) + self.forward * self.focal +
             self.up * (self.height / 2.0 - y))
        return v / np.linalg.norm(v)

    def project(self, d):
        depth = d @ self.forward
        return (self.width / 2.0 + self.focal * (d @ self.right) / depth,
                self.height / 2.0 - self.focal * (d @ self.up) / depth)

    def box(self, centre):
        """x, y, width, height around the outline of the unit sphere at `centre`."""
        distance = np.linalg.norm(centre)
        axis, angle = centre / distance, np.arcsin(1.0 / distance)
        u = np.cross(axis, [0.3, 0.2, 0.9])
        u /= np.linalg.norm(u)
        v = np.cross(axis, u)
        t = np.linspace(0.0, 2.0 * np.pi, 7200)[:, None]
        x, y = self.project(axis * np.cos(angle) + (u * np.cos(t) + v * np.sin(t)) * np.sin(angle))
        return x.min(), y.min(), x.max() - x.min(), y.max() - y.min()


def photograph(panorama, camera, centre, shade, samples=3):
    """The unit sphere at `centre` before the panorama; shade(normals, incoming) gives its light."""
    rays = camera.rays(samples)
    along = rays @ centre
    under = along * along - centre @ centre + 1.0
    hit = (under > 0.0) & (along > 0.0)
    picture = look_up(panorama, rays)
    r = rays[hit]
    point = r * (along[hit] - np.sqrt(under[hit]))[:, None]
    picture[hit] = shade(point - centre, r)
    h, w = camera.height, camera.width
    return picture.reshape(h, samples, w, samples, 3).mean((1, 3))


def mirror(panorama, index=CHROMIUM):
    """A polished ball; index None sends all light back."""
    def shade(normal, ray):
        cosine = -np.sum(normal * ray, -1)
        out = ray + 2.0 * cosine[:, None] * normal
        share = 1.0 if index is None else fresnel(index, cosine)[:, None]
        return look_up(panorama, out) * share
    return shade


def planes(panorama, normals):
    """E / (1 unit of luminance) by channel on planes of these normals: the sum over all pixels."""
    d, omega = directions(*panorama.shape[:2])
    flat, light = d.reshape(-1, 3), (panorama * omega[..., None]).reshape(-1, 3)
    return np.array([np.maximum(0.0, flat @ n) @ light for n in normals])


def matt(panorama, reflectance):
    """A grey ball of Lambert's law; E of its normals by a sum over the panorama at a quarter."""
    h, w = panorama.shape[:2]
    step = max(1, h // 128)
    _, omega = directions(h, w)
    light = (panorama * omega[..., None]).reshape(h // step, step, w // step, step, 3).sum((1, 3))
    small, solid = directions(h // step, w // step)
    coarse = light / solid[..., None]
    table_d, _ = directions(64, 128)
    table = planes(coarse, table_d.reshape(-1, 3)).reshape(64, 128, 3)
    return lambda normal, ray: reflectance / np.pi * look_up(table, normal)


SIX = {"up": (0, 0, 1), "down": (0, 0, -1), "front": (0, 1, 0), "back": (0, -1, 0),
       "right": (1, 0, 0), "left": (-1, 0, 0)}


def six_lux(panorama, hidden=None, half_angle_deg=0.0):
    """Luminance-weighted E on six planes, less what lies within half_angle of `hidden`."""
    seen = panorama
    if hidden is not None:
        d, _ = directions(*panorama.shape[:2])
        seen = panorama * (d @ np.asarray(hidden) < np.cos(np.radians(half_angle_deg)))[..., None]
    lux = planes(seen, [np.array(n, float) for n in SIX.values()]) @ REC709
    return dict(zip(SIX, lux))


def with_sun(panorama, azimuth_deg, elevation_deg, lux, wide=1.0):
    """A sun of half a degree, times `wide`, added: lux on the plane that faces it. Its direction
    comes with it."""
    a, e = np.radians([azimuth_deg, elevation_deg])
    sun = np.array([np.sin(a) * np.cos(e), np.cos(a) * np.cos(e), np.sin(e)])
    d, omega = directions(*panorama.shape[:2])
    away = np.arccos(np.clip(d @ sun, -1, 1)) / wide
    disc = np.clip((np.radians(0.45) - away) / np.radians(0.3), 0, 1)
    out = panorama + (disc * lux / (disc * omega).sum())[..., None]
    return out, sun


def without_camera(panorama, camera, centre, half_angle_deg=8.0):
    """What the ball sees when camera and person stand in it: dark, with a red lamp on."""
    back = -centre / np.linalg.norm(centre)
    d, _ = directions(*panorama.shape[:2])
    there = d @ back > np.cos(np.radians(half_angle_deg))
    out = panorama.copy()
    out[there] = np.array([3.0, 0.2, 0.2]) * (panorama @ REC709).mean()
    return out


EXAMPLE_BOX = "36,36,228,228"  # round both balls of examples()


def examples(folder, panorama_path):
    """ball.exr and plate.exr, as a person would have them: a chromium and a grey ball through a
    lens of 25 degrees, by a camera that looks along +y."""
    panorama = read_hdr(panorama_path)
    camera = Camera(300, 300, 25.0)
    centre = np.array([0.0, 6.0, 0.0])
    for name, shade in (("ball", mirror(panorama)), ("plate", matt(panorama, 0.18))):
        write_exr(folder / f"{name}.exr", photograph(panorama, camera, centre, shade, samples=2))
