# SPDX-License-Identifier: Apache-2.0
"""Views cut from a lat-long panorama as a camera would see them, and aims judged: numpy alone, no law of ours.

The world: x right of the panorama's centre, y into its centre, z up. A view's truth is the 3 x 3 matrix whose rows
are its right, forward and up. Lens: r = f tan(theta) (rect) or r = f theta (equidistant), radially bent by
r (1 + k ((r/R)^2 - 1)), then shifted as a tilted lens does (Brown's decentring p, q, in R), darkened by (1 + v (r/R)^2)^-2, R being the corner of a rect and the circle of a fisheye.
"""
import functools
import json
import math
import pathlib

import numpy as np

import usdlux


def read_hdr(path):
    """Radiance RGBE, run lengths by channel."""
    data = pathlib.Path(path).read_bytes()
    head = data.index(b"\n\n") + 2
    line_end = data.index(b"\n", head)
    words = data[head:line_end].split()
    height, width = int(words[1]), int(words[3])
    at = line_end + 1
    rows = np.zeros((height, 4, width), np.uint8)
    for y in range(height):
        assert data[at] == 2 and data[at + 1] == 2, "old run lengths"
        at += 4
        for c in range(4):
            x = 0
            while x < width:
                n = data[at]
                if n > 128:
                    rows[y, c, x:x + n - 128] = data[at + 1]
                    x += n - 128
                    at += 2
                else:
                    rows[y, c, x:x + n] = np.frombuffer(data, np.uint8, n, at + 1)
                    x += n
                    at += 1 + n
    scale = np.where(rows[:, 3] > 0, np.ldexp(1.0, rows[:, 3].astype(int) - 136), 0.0)
    return np.moveaxis(rows[:, :3] * scale[:, None, :], 1, 2).astype(np.float32)


def axes(yaw_deg, pitch_deg, roll_deg):
    """Right, forward, up of a camera: yaw to the right, then pitch up, then leaning to the right."""
    y, p, r = (math.radians(v) for v in (yaw_deg, pitch_deg, roll_deg))
    forward = np.array([math.sin(y) * math.cos(p), math.cos(y) * math.cos(p), math.sin(p)])
    level = np.array([math.cos(y), -math.sin(y), 0.0])
    upright = np.cross(level, forward)
    return np.array([level * math.cos(r) - upright * math.sin(r), forward, upright * math.cos(r) + level * math.sin(r)])


def lookup(panorama, direction):
    """Cubic (Catmull-Rom) between pixels, never below the least of the nearest four."""
    height, width, _ = panorama.shape
    x = (np.arctan2(direction[..., 0], direction[..., 1]) / (2 * np.pi) + 0.5) * width - 0.5
    y = np.arccos(np.clip(direction[..., 2], -1, 1)) / np.pi * height - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)

    def weights(t):
        return [0.5 * (-t + 2 * t**2 - t**3), 0.5 * (2 - 5 * t**2 + 3 * t**3), 0.5 * (t + 4 * t**2 - 3 * t**3),
                0.5 * (-t**2 + t**3)]

    wx, wy = weights(x - x0), weights(y - y0)
    total = np.zeros(direction.shape[:-1] + (3,), np.float32)
    least = np.full_like(total, np.inf)
    for j in range(4):
        row = y0 + j - 1
        flip = (row < 0) | (row >= height)
        row = np.where(row < 0, -1 - row, np.where(row >= height, 2 * height - 1 - row, row))
        for i in range(4):
            column = (x0 + i - 1 + np.where(flip, width // 2, 0)) % width
            value = panorama[row, column]
            total += (wx[i] * wy[j])[..., None].astype(np.float32) * value
            if i in (1, 2) and j in (1, 2):
                least = np.minimum(least, value)
    return np.maximum(total, 0.5 * least)


class Camera:
    def __init__(self, kind, width, height, fov_deg, bend=0.0, dark=0.25, noise=0.004, samples=2, tilt=(0.0, 0.0)):
        self.kind, self.width, self.height, self.fov_deg = kind, width, height, fov_deg
        self.bend, self.dark, self.noise, self.samples, self.tilt = bend, dark, noise, samples, tilt
        half = math.radians(fov_deg) / 2
        if kind == "rect":
            self.focal, self.rim = width / 2 / math.tan(half), math.hypot(width, height) / 2
        else:
            self.rim = min(width, height) / 2
            self.focal = self.rim / half

    def shoot(self, panorama, rows, exposure, random):
        """What the file holds: light x lens x exposure, shot noise of a middle grey by self.noise."""
        total = np.zeros((self.height, self.width, 3), np.float32)
        for sub in range(self.samples ** 2):
            dx, dy = (sub % self.samples + .5) / self.samples, (sub // self.samples + .5) / self.samples
            u, v = np.meshgrid(np.arange(self.width) + dx - self.width / 2, self.height / 2 - np.arange(self.height) - dy)
            share2 = (u * u + v * v) / self.rim ** 2
            stretch = 1 + self.bend * (share2 - 1)
            (p, q), x, y = self.tilt, u / self.rim, v / self.rim
            u = u * stretch + self.rim * (p * (share2 + 2 * x * x) + 2 * q * x * y)
            v = v * stretch + self.rim * (q * (share2 + 2 * y * y) + 2 * p * x * y)
            r = np.hypot(u, v)
            if self.kind == "rect":
                ray = np.stack([u, np.full_like(u, self.focal), v], -1)
            else:
                theta = r / self.focal
                aside = np.where(r > 0, np.sin(theta) / np.maximum(r, 1e-12), 0)
                ray = np.stack([u * aside, np.cos(theta), v * aside], -1)
            ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
            seen = lookup(panorama, ray @ rows)
            if self.kind != "rect":
                seen[share2 > 1] = 0
            total += seen / (1 + self.dark * share2[..., None]) ** 2
        signal = total * (exposure / self.samples ** 2)
        grey = max(1e-9, float(np.median(signal[signal > 0])))
        noise = self.noise * np.sqrt(grey * np.maximum(signal, 0) + (0.1 * grey) ** 2)
        noisy = signal + noise * random.standard_normal(signal.shape, np.float32)
        return np.where(signal > 0, np.maximum(noisy, 1e-7 * grey), 0).astype(np.float32)


def ring(count, pitch, start=0.0):
    return [(start + 360.0 * i / count, pitch) for i in range(count)]


def sphere36():
    return ring(12, 0) + ring(9, 42, 7) + ring(9, -42, 11) + ring(2, 80, 20) + ring(2, -80, 50) + [(0, 88), (0, -88)]


def write_views(panorama, camera, aims, folder, seed, roll_sd=2.0, exposure_ev=0.5):
    """Files view00.exr ... and truth.json; a uniform roll, yaw and pitch jitter of `roll_sd`, exposures apart."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(seed)
    truth = []
    for i, (yaw, pitch) in enumerate(aims):
        jitter = random.uniform(-roll_sd, roll_sd, 3)
        rows = axes(yaw + jitter[0], pitch + jitter[1], jitter[2])
        exposure = 2.0 ** random.uniform(-exposure_ev, exposure_ev)
        name = f"view{i:02d}.exr"
        usdlux.write_exr(folder / name, camera.shoot(panorama, rows, exposure, random))
        truth.append({"file": name, "rows": rows.tolist(), "exposure": exposure})
    (folder / "truth.json").write_text(json.dumps(truth))
    return truth


def best_turn(found, true):
    """The rotation that brings all found cameras nearest to the true ones (Kabsch)."""
    u, _, vt = np.linalg.svd(sum(f.T @ t for f, t in zip(found, true)))
    return u @ np.diag([1, 1, np.linalg.det(u @ vt)]) @ vt


def aim_errors_deg(found, true):
    """Angle of what is left of each camera's rotation after one common turn."""
    turn = best_turn(found, true)
    left = [f @ turn @ t.T for f, t in zip(found, true)]
    skew = [np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) for m in left]
    return np.degrees([math.atan2(np.linalg.norm(s), np.trace(m) - 1) for s, m in zip(skew, left)])


def scale_errors(factors, exposures):
    off = np.log(np.array(factors) * np.array(exposures))
    return off - off.mean()


@functools.lru_cache(maxsize=2)
def middles(height, width):
    """Directions of a lat-long's pixels, and the solid angle of one in each row."""
    zenith = (np.arange(height) + .5) / height * np.pi
    azimuth = ((np.arange(width) + .5) / width - .5) * 2 * np.pi
    edge = np.cos(np.arange(height + 1) / height * np.pi)
    ray = np.stack(np.broadcast_arrays(np.sin(zenith)[:, None] * np.sin(azimuth), np.sin(zenith)[:, None] * np.cos(azimuth),
                                       np.cos(zenith)[:, None] + 0 * azimuth), -1)
    return ray, (edge[:-1] - edge[1:]) * 2 * np.pi / width


BETWEEN = []  # (panorama, its light in twice as many pixels each way) of the panorama judged last


def between_pixels(panorama):
    if not BETWEEN or BETWEEN[0][0] is not panorama:
        ray, omega = middles(2 * panorama.shape[0], 2 * panorama.shape[1])
        luminance = np.concatenate([lookup(panorama, ray[y:y + 32]) @ np.array([.2126, .7152, .0722])
                                    for y in range(0, len(ray), 32)])  # a few rows stay in a cache
        BETWEEN[:] = [(panorama, luminance * omega[:, None])]
    return BETWEEN[0][1]


def seen_by(cameras, width, height):
    """1 where some camera of (Camera, rows) shows the middle of a lat-long pixel."""
    ray = middles(height, width)[0].reshape(-1, 3)
    seen = np.zeros(height * width, bool)
    for camera, rows in cameras:
        before = ray @ np.asarray(rows)[1] > (0 if camera.kind == "rect" else -2)
        left = np.flatnonzero(before & ~seen)
        right, forward, up = np.asarray(rows) @ ray[left].T
        aside = np.maximum(np.hypot(right, up), 1e-12)
        if camera.kind == "rect":
            ideal = aside / np.maximum(forward, 1e-9) * camera.focal
        else:
            ideal = np.arctan2(aside, forward) * camera.focal
        r = ideal
        for _ in range(8):
            r = ideal / (1 + camera.bend * (np.minimum(r / camera.rim, 2) ** 2 - 1))
        if camera.kind == "rect":
            seen[left] = (abs(right / aside * r) < camera.width / 2) & (abs(up / aside * r) < camera.height / 2)
        else:
            seen[left] = r < camera.rim - 2
    return seen.reshape(height, width)


PLANES = {"up": (0, 0, 1), "down": (0, 0, -1), "front": (0, 1, 0), "right": (1, 0, 0), "back": (0, -1, 0),
          "left": (-1, 0, 0)}


def judge(answer, truth, panorama, camera):
    """What `dome --json` says against what the views were cut with."""
    found = [axes(v["yaw_deg"], v["pitch_deg"], v["roll_deg"]) for v in answer["views"]]
    true = [np.array(t["rows"]) for t in truth]
    aims = aim_errors_deg(found, true)
    scale = scale_errors([v["factor"] for v in answer["views"]], [t["exposure"] for t in truth])
    turn = best_turn(found, true)
    gain = math.exp(np.mean(np.log([t["exposure"] for t in truth])))
    # The world between the panorama's pixels is as the cameras were shown it.
    height, width = 2 * panorama.shape[0], 2 * panorama.shape[1]
    seen = seen_by([(camera, t) for t in true], width, height)
    light, ray = between_pixels(panorama)[seen], middles(height, width)[0][seen]
    wanted = {name: float(light @ np.maximum(ray @ (np.array(normal, float) @ turn), 0))
              for name, normal in PLANES.items()}
    largest = max(wanted.values())
    lux = {}
    for name, want in wanted.items():
        if want > 0.2 * largest:
            # the dome's fall-off and scale have one factor in common that no view can tell
            lux[name] = answer["illuminance_lx"][name]["total"] / want / gain - 1
    shares = [float(a / v["u95_deg"]) for a, v in zip(aims, answer["views"])]
    return {"median_deg": float(np.median(aims)), "p95_deg": float(np.percentile(aims, 95)),
            "worst_deg": float(aims.max()), "within_u95": float(np.mean(np.array(shares) <= 1)),
            "shares_of_u95": shares,
            "u95_deg": float(np.median([v["u95_deg"] for v in answer["views"]])),
            "scale_worst": float(abs(scale).max()), "scale_rms": float(np.sqrt((scale ** 2).mean())),
            "lux": lux, "fov_deg": answer.get("field_of_view_deg"), "rms_px": answer.get("aims_rms_px"),
            "agreement": answer.get("agreement_sd_relative"), "rim": answer.get("rim_transmission")}
