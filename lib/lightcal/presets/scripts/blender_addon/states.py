# Written by lightcal: a lamp at a state of its controls. Nothing here needs Blender itself.
# SPDX-License-Identifier: Apache-2.0
"""Light against a level x follows ln E = c + p ln S(x + x0) + rest(x), S an S-curve or x + x0 itself,
p = 1 (a driver that does not end at zero) or free (tungsten, a gamma), or ln E = c + p x (equal
ratios); against a zoom a power; colour follows ln x by a slope, and its own control one to one.
`rest` is a Gaussian process (Matern 3/2), one a control and one of all together. x0, sizes and
lengths are averaged over by how probable each makes the readings (Rasmussen and Williams 2006, 2.2,
5.4)."""
import functools
import math

import numpy as np

from . import laws

Z95 = 1.959963984540054
LEVEL_FLOOR = 0.03
CONSTANT_VARIANCE = 25.0
LEAST_EVIDENCE = 7.0
SHARE_LEFT_OUT, FEWEST_FORMS, MOST_FORMS = 0.005, 8, 40
NEAREST, NEAREST_TO_FULL = 20, 10
# level rest, other rest, joint rest, level slope, other slope
SCALES = {'light': (1.0, 1.0, 1.0, 0.0, 0.5), 'mired': (0.2, 0.4, 0.3, 0.3, 0.3),
          'duv': (0.05, 0.03, 0.05, 0.002, 0.004)}
# Of a fade between two channels, half way: mean and 1 sigma; mireds by the square of the range.
FADES = {'light': (0.28, 0.24), 'mired': (0.09, 0.10), 'duv': (0.0, 0.0)}
OTHER_LENGTH = 0.45  # of a control's range
SLOPE_OF_REST = 6.5  # of a driver, up to full
POWER_OF_ZOOM, POWER_SD_OF_ZOOM = -1.0, 1.0
SPAN_OF_LOGARITHMIC, WEIGHT_OF_LOGARITHMIC = 3.0, 0.35
ZERO_SCALE = 0.06  # of where a dimmer's light begins
SMOOTH = ((0.003, 0.7), (0.012, 1.5), (0.03, 3.0), (0.1, 0.6), (0.3, 0.15))
SUDDEN = SMOOTH[:4] + ((0.3, 3.0),)  # of light: a knee between two states shows in neither
BENDS = SMOOTH[:3] + ((0.1, 4.8), (0.3, 9.0), (0.8, 6.0))
OTHER_RESTS = ((0.008, 1.0), (0.04, 2.0), (0.16, 2.0), (0.4, 0.7))
REPEATS = {'mired': 0.001, 'duv': 2e-4}


class Unknown(Exception):
    """A state that the readings do not tell of; the message is for people."""


def kind_of(name):
    if name == 'cct_K':
        return 'temperature'
    if name == 'zoom_deg':
        return 'zoom'
    other = name in ('tint', 'hue', 'saturation') or name.endswith('_deg')
    return 'other' if other else 'level'


def same(a, b):
    return abs(a - b) <= 1e-9 * max(abs(a), abs(b))


def alike(a, b):
    return a.keys() == b.keys() and all(
        a[k] == b[k] if isinstance(a[k], str) or isinstance(b[k], str) else same(a[k], b[k])
        for k in a)


def matern(distance, length):
    r = math.sqrt(3.0) * np.abs(distance) / length
    return (1.0 + r) * np.exp(-r)


def kinks(a, b, output_a, output_b):
    """A driver's slope walks along its label; over the output, which makes it a part of it."""
    s, t = np.minimum(a, b), np.maximum(a, b)
    return SLOPE_OF_REST ** 2 * s * s * (3.0 * t - s) / 6.0 / (output_a * output_b)


def sd_of_ln(u):
    if u.get('low95', 0.0) > 0.0 and 'high95' in u:
        return math.log(u['high95'] / u['low95']) / (2.0 * Z95)
    return u.get('u95', 0.0) / (Z95 * u['value']) if u['value'] > 0.0 else 0.0


def from_ln(ln, sd):
    low, high = math.exp(ln - Z95 * sd), math.exp(ln + Z95 * sd)
    return {'value': math.exp(ln), 'u95': (high - low) / 2, 'low95': low, 'high95': high}


def formed_level(labels, bend, zero):
    """(ln of the level but for a constant, its slope by the zero)"""
    if bend is None:
        return SPAN_OF_LOGARITHMIC * labels, np.zeros(len(labels))
    if bend == 1.0:
        above = np.maximum(1e-6, labels + zero)
        return np.log(above), 1.0 / above
    y = np.clip((labels + zero) / (1.0 + zero), 1e-6, 1.0)
    s = y ** bend / (y ** bend + (1.0 - y) ** bend)
    return np.log(s), bend * (1.0 - s) / (y * (1.0 + zero))


class Curve:
    """One number of a lamp from the states that were read; `at` is a row a state."""

    def __init__(self, kinds, target, at, values, sds):
        self.points = np.array(at, float)
        self.kinds = ['other' if kind == 'zoom' and self.points[:, i].min() <= 0.0 else kind
                      for i, kind in enumerate(kinds)]
        self.target = target
        self.values, self.sds = np.array(values), np.array(sds)
        plain = np.stack([self.plain(i, self.points[:, i]) for i in range(len(kinds))], axis=1)
        self.middle, self.least = plain.mean(axis=0), plain.min(axis=0)
        span = plain.max(axis=0) - plain.min(axis=0)
        self.span = np.where(span > 0.0, span, 1.0)
        self.average()

    def plain(self, control, labels):
        kind = self.kinds[control]
        if kind == 'level':
            return np.log(labels + LEVEL_FLOOR)
        if kind == 'zoom':
            return np.log(labels)
        return np.log(1e6 / labels) if kind == 'temperature' else labels

    def see(self, labels, form):
        """(coordinates, mean, ln of the formed level, its slope by the zero, labels,
        what a fade may add), a row a state."""
        control, bend, zero, _, power, _, _ = form
        along, count = [], len(labels)
        mean, ln_level, by_zero = np.zeros(count), np.zeros(count), np.zeros(count)
        faded = np.zeros(count)
        for i, kind in enumerate(self.kinds):
            x = self.plain(i, labels[:, i])
            if i == control:
                x, by_zero = formed_level(labels[:, i], bend, zero)
                ln_level, by_zero = x, power * by_zero
                mean = mean + power * ln_level
            elif kind == 'level':
                mean = mean + (x if self.target == 'light' else 0.0)
            else:
                if kind == 'temperature' and self.target == 'mired':
                    mean = mean + x
                if kind == 'zoom' and self.target == 'light':
                    mean = mean + POWER_OF_ZOOM * x
                if kind == 'temperature':
                    inside = (x - self.least[i]) / self.span[i]
                    scale = self.span[i] ** 2 if self.target == 'mired' else 1.0
                    fade = 4.0 * inside * (1.0 - inside) * scale
                    mean = mean + FADES[self.target][0] * fade
                    faded = faded + FADES[self.target][1] * fade
                x = (x - self.middle[i]) / self.span[i]
            along.append(x)
        return np.stack(along, axis=1), mean, ln_level, by_zero, labels, faded

    def covariance(self, form, rests, a, b):
        level_rest, other_rest, joint_rest, level_slope, other_slope = SCALES[self.target]
        control, bend, _, step, _, power_sd, _ = form
        level, level_length, by_label, other, joint, _ = rests
        total = CONSTANT_VARIANCE + np.outer(a[5], b[5])
        together = np.ones_like(total)
        for i, kind in enumerate(self.kinds):
            u, v = a[0][:, i][:, None], b[0][:, i][None, :]
            if kind == 'level':
                if i == control:
                    total += power_sd ** 2 * np.outer(a[2], b[2]) + step ** 2 * np.outer(a[3], b[3])
                else:
                    total += level_slope ** 2 * u * v
                at_a, at_b = a[4][:, i][:, None], b[4][:, i][None, :]
                if by_label and i == control and bend is not None:
                    rest = kinks(at_a, at_b, np.exp(a[2])[:, None], np.exp(b[2])[None, :])
                else:
                    rest = matern(at_a - at_b if by_label else u - v, level_length)
                total += (level_rest * level) ** 2 * rest
                together *= matern(u - v, 1.5)
            else:
                zoomed = kind == 'zoom' and self.target == 'light'
                slope = POWER_SD_OF_ZOOM * self.span[i] if zoomed else other_slope
                total += slope ** 2 * u * v + (other_rest * other) ** 2 * matern(
                    u - v, OTHER_LENGTH)
                together *= matern(u - v, 0.7)
        return total + (joint_rest * joint) ** 2 * together

    def solve(self, form, rests):
        """(ln evidence, what answers need), None where the matrix is none."""
        seen = self.see(self.points, form)
        off = self.values - seen[1]
        center = off.mean()
        off = off - center
        matrix = self.covariance(form, rests, seen, seen) + np.diag(self.sds ** 2)
        try:
            root = np.linalg.cholesky(matrix)
        except np.linalg.LinAlgError:
            return None
        inverse = np.linalg.inv(root)
        weights = inverse.T @ (inverse @ off)
        evidence = (-0.5 * off @ weights - np.log(np.diag(root)).sum() +
                    math.log(form[6] * rests[5]))
        return (evidence, form, rests, seen, center, inverse, weights)

    def forms(self):
        """(control, bend or None where logarithmic, zero, its step, power, its sd, weight): zeros a
        fifth of x_min + zero apart."""
        level = next((i for i, k in enumerate(self.kinds) if k == 'level'), None)
        if self.target != 'light' or level is None:
            return [(-1, 1.0, LEVEL_FLOOR, 0.0, 0.0, 0.0, 1.0)]
        least = self.points[:, level].min()
        smallest = max(least, 0.01)
        forms, straight = [], 0.0

        def zeros(low, high, step):
            for ln in np.arange(math.log(low), math.log(high), step):
                above = math.exp(ln)
                zero = above - least
                density = ZERO_SCALE / (math.pi * (ZERO_SCALE ** 2 + zero * zero))
                yield zero, 0.5 * step * above, density * above * step
        for zero, step, weight in zeros(max(0.04 * smallest, 2e-3), 12.0 * smallest + 0.3, 0.2):
            straight += weight
            forms.append((level, 1.0, zero, step, 1.0, 0.02, weight))
            forms.append((level, 1.0, zero, step, 2.0, 1.2, 0.5 * weight))
        for zero, step, weight in zeros(0.1 * smallest, 2.0 * smallest, 0.4):
            forms += [(level, bend, zero, step, 1.0, 0.15, 0.3 * weight)
                      for bend in (1.25, 1.5, 1.75, 2.1)]
        forms.append((level, None, 0.0, 0.0, 1.8, 0.5, WEIGHT_OF_LOGARITHMIC * straight))
        order = sorted(((-one[0], i) for i, one in enumerate(
            self.solve(form, (0.02, 0.8, False, 0.05, 0.01, 1.0)) for form in forms) if one))
        shares = np.exp([order[0][0] - cost for cost, _ in order])
        left = 1.0 - (np.cumsum(shares) - shares) / shares.sum()  # before each of them
        count = max(FEWEST_FORMS, int((left >= SHARE_LEFT_OUT).sum()))
        return [forms[i] for _, i in order[:min(count, MOST_FORMS)]]

    def rests(self):
        """(level, its length, whether that is of the label, other, joint, weight): drivers bend at
        labels; what lamps do goes with the logarithm."""
        level = 'level' in self.kinds
        others = any(kind != 'level' for kind in self.kinds)
        none = ((0.0, 1.0),)
        light = self.target == 'light'
        levels = ((0.25, False, SUDDEN if light else SMOOTH), (1.5, False, SMOOTH),
                  (0.3, True, BENDS if light else SMOOTH)) if level else ((1.0, False, none),)
        for length, by_label, sizes in levels:
            for a, by_a in sizes:
                for b, by_b in OTHER_RESTS if others else none:
                    for c, by_c in ((0.002, 1.5), (0.015, 1.0)) if len(self.kinds) > 1 else none:
                        yield (a, length, by_label, b, c, by_a * by_b * by_c)

    def average(self):
        """Rests that fall behind under the likeliest form are not tried with the others."""
        forms, rests, solved = self.forms(), list(self.rests()), []
        for form in forms:
            found = [one for one in (self.solve(form, one) for one in rests) if one]
            if form is forms[0]:
                best = max(one[0] for one in found)
                rests = [one[2] for one in found if one[0] >= best - LEAST_EVIDENCE]
            solved += found
        best = max(one[0] for one in solved)
        self.all = [one for one in solved if one[0] >= best - LEAST_EVIDENCE]
        shares = np.exp([one[0] - best for one in self.all])
        self.shares = shares / shares.sum()

    def at(self, labels):
        """(value, 1 sigma)"""
        mean = square = 0.0
        for share, (_, form, rests, seen, center, inverse, weights) in zip(self.shares, self.all):
            here = self.see(np.array([labels], float), form)
            row = self.covariance(form, rests, seen, here)[:, 0]
            value = here[1][0] + center + row @ weights
            down = inverse @ row
            variance = self.covariance(form, rests, here, here)[0, 0] - down @ down
            mean += share * value
            square += share * (max(0.0, variance) + value * value)
        return mean, math.sqrt(max(0.0, square - mean * mean))


@functools.lru_cache(maxsize=64)  # a slider asks one curve many times
def curve_of(kinds, target, at, values, sds):
    return Curve(kinds, target, at, values, sds)


# ---- colour ----

LOCUS_MIRED = np.linspace(1e6 / 25000, 1e6 / 1000, 2000)
LOCUS = np.array([laws.locus_uv(1e6 / m) for m in LOCUS_MIRED])


def uv_of(xy):
    x, y = xy
    return np.array([4 * x, 6 * y]) / (-2 * x + 12 * y + 3)


def nearest_locus(xy):
    """(mired, Duv): along the straight pieces between points of the locus."""
    uv = uv_of(xy)
    a, d = LOCUS[:-1], np.diff(LOCUS, axis=0)
    t = np.clip(((uv - a) * d).sum(axis=1) / (d * d).sum(axis=1), 0.0, 1.0)
    off = uv - (a + t[:, None] * d)
    far = (off * off).sum(axis=1)
    i = int(far.argmin())
    sign = 1.0 if off[i] @ np.array([-d[i][1], d[i][0]]) * -d[i][0] <= 0 else -1.0
    return LOCUS_MIRED[i] + t[i] * (LOCUS_MIRED[1] - LOCUS_MIRED[0]), sign * math.sqrt(far[i])


def xy_at(mired, duv):
    i = int(np.clip(np.searchsorted(LOCUS_MIRED, mired) - 1, 0, len(LOCUS) - 2))
    d = LOCUS[i + 1] - LOCUS[i]
    normal = np.array([-d[1], d[0]]) / math.hypot(*d)
    normal = normal if normal[1] > 0 else -normal
    u, v = np.array(laws.locus_uv(1e6 / mired)) + duv * normal
    return [3 * u / (2 * u - 8 * v + 4), 2 * v / (2 * u - 8 * v + 4)]


def duv_on_line(xys, mired):
    """(Duv, its sd) where two emitters mix: on the line through what was read; None = no line."""
    xys = np.array(xys)
    if len(xys) < 3:
        return None
    middle = xys.mean(axis=0)
    _, _, axes = np.linalg.svd(xys - middle)
    along, beside = (xys - middle) @ axes[0], (xys - middle) @ axes[1]
    scatter = math.sqrt((beside ** 2).sum() / (len(xys) - 2))
    if along.max() - along.min() < 0.005 or scatter > 0.0015:
        return None
    low, high = along.min(), along.max()
    found = nearest_locus(middle + low * axes[0])[0], nearest_locus(middle + high * axes[0])[0]
    if not min(found) <= mired <= max(found):
        return None
    for _ in range(50):
        half = 0.5 * (low + high)
        if (nearest_locus(middle + half * axes[0])[0] < mired) == (found[1] > found[0]):
            low = half
        else:
            high = half
    return (nearest_locus(middle + 0.5 * (low + high) * axes[0])[1],
            0.67 * scatter * math.sqrt(1 + 1 / len(xys)))


# ---- a light at a state ----

def controls_of(light):
    """{name: (least, most)} of what took several numbers, in the file's order; a word: ()."""
    states = light.get('states', [])
    if not states:
        return {}
    found = {}
    for name, value in states[0]['state'].items():
        if isinstance(value, str):
            found[name] = ()
            continue
        numbers = [one['state'][name] for one in states]
        if not same(min(numbers), max(numbers)):
            found[name] = (min(numbers), max(numbers))
    return found


def labels_of(state, axes):
    """Levels as parts of their largest, a dimmer of 100."""
    out = []
    for name, (_, most) in axes.items():
        unit = 1.0 if kind_of(name) != 'level' else 100.0 if name == 'dimmer' else most
        out.append(state[name] / unit if unit > 0 else state[name])
    return tuple(out)


def nearest(kept, axes, at):
    """The states nearest to full and to what is asked, as many as tell something."""
    def far_from(state):
        here = labels_of(state, axes)

        def far(one):
            total = 0.0
            for (name, (low, high)), a, b in zip(axes.items(), labels_of(one['state'], axes), here):
                level = kind_of(name) == 'level'
                off = (math.log((a + 0.03) / (b + 0.03)) / 3.0 if level else (a - b) / (high - low))
                total += off * off
            return total
        return far
    if len(kept) <= NEAREST + NEAREST_TO_FULL:
        return kept
    full = dict(at)
    if 'dimmer' in at:
        full['dimmer'] = axes.get('dimmer', (0, at['dimmer']))[1]
    else:
        full = max(kept, key=lambda one: one['relative']['value'])['state']
    kept = sorted(kept, key=far_from(full))
    rest = sorted(kept[NEAREST_TO_FULL:], key=far_from(at))
    return (kept[:NEAREST_TO_FULL] + rest)[:NEAREST + NEAREST_TO_FULL]


def mixable(xy, emitters):
    """What two emitters can make: the line through them; a colour .002 beside it strays as readings do."""
    ends = [np.array(one['xy']) for one in emitters.get('found', []) if 'xy' in one]
    if len(ends) != 2 or len(emitters['found']) != 2 or (ends[0] == ends[1]).all():
        return list(xy)
    along = ends[1] - ends[0]
    there = ends[0] + (np.array(xy) - ends[0]) @ along / (along @ along) * along
    return list(there if math.hypot(*(there - xy)) > 0.002 else xy)


def color_between(kept, axes, at, emitters):
    with_color = [one for one in kept if {'cct_K', 'duv', 'xy'} <= one.get('color', {}).keys()]
    if len(with_color) < 2:
        return {}
    labels = tuple(labels_of(one['state'], axes) for one in with_color)
    kinds = tuple(kind_of(name) for name in axes)
    colors = [one['color'] for one in with_color]
    here = labels_of(at, axes)
    count = len(colors)
    mireds = tuple(math.log(1e6 / c['cct_K']['value']) for c in colors)
    ln_mired, sd = curve_of(kinds, 'mired', labels, mireds, (REPEATS['mired'],) * count).at(here)
    # What the meter errs alike at every state; one chromaticity error is more kelvin to a cold lamp
    order = sorted(range(count), key=lambda i: mireds[i])
    shared = [np.interp(ln_mired, [mireds[i] for i in order], [
        math.sqrt(max(0.0, sds[i] ** 2 - REPEATS[what] ** 2)) for i in order]) for what, sds in (
            ('mired', [sd_of_ln(c['cct_K']) for c in colors]),
            ('duv', [c.get('duv_u95', 0.0) / Z95 for c in colors]))]
    duv = curve_of(kinds, 'duv', labels, tuple(c['duv'] for c in colors),
                   (REPEATS['duv'],) * count).at(here)
    mired = math.exp(ln_mired)
    # What Krystek's locus leaves is taken from the nearest colour that was read.
    near = min(colors, key=lambda c: abs(1e6 / c['cct_K']['value'] - mired))
    line = duv_on_line([c['xy'] for c in colors], mired)
    if line and line[1] < duv[1]:
        past_locus = near['duv'] - nearest_locus(near['xy'])[1]
        duv = line[0] + past_locus, max(line[1], REPEATS['duv'])
    past_krystek = [a - b for a, b in zip(near['xy'], xy_at(1e6 / near['cct_K']['value'],
                                                            near['duv']))]
    there = [a + b for a, b in zip(xy_at(mired, duv[0]), past_krystek)]
    made, duv_there = mixable(there, emitters), duv[0]
    if made != there:
        found, expected = nearest_locus(made), nearest_locus(there)
        ln_mired += math.log(found[0] / expected[0])
        duv_there += found[1] - expected[1]
    return {'cct_K': from_ln(math.log(1e6) - ln_mired, math.hypot(sd, shared[0])),
            'duv': duv_there, 'duv_u95': Z95 * math.hypot(duv[1], shared[1]), 'xy': made}


def between_neighbours(kept, axes, at, ln, sd):
    """Light does not fall as a dimmer rises: truncated to the states read below and above it."""
    if 'dimmer' not in axes or not sd > 0.0:
        return ln, sd
    others = [one for one in kept if all(
        name == 'dimmer' or same(one['state'][name], at[name]) for name in axes)]
    below = [one for one in others if one['state']['dimmer'] < at['dimmer']]
    above = [one for one in others if one['state']['dimmer'] > at['dimmer']]
    if not below or not above:
        return ln, sd
    lower = max(below, key=lambda one: one['state']['dimmer'])
    upper = min(above, key=lambda one: one['state']['dimmer'])
    low = math.log(lower['relative']['value']) - 2.0 * lower['repeatability']
    high = math.log(upper['relative']['value']) + 2.0 * upper['repeatability']
    if not low < high:
        return ln, sd
    a, b = (low - ln) / sd, (high - ln) / sd
    inside = 0.5 * (math.erfc(-b / math.sqrt(2.0)) - math.erfc(-a / math.sqrt(2.0)))
    if not inside > 1e-9:
        return 0.5 * (low + high), (high - low) / math.sqrt(12.0)
    at_a, at_b = (math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi) for z in (a, b))
    shift, narrower = (at_a - at_b) / inside, (a * at_a - b * at_b) / inside
    return ln + sd * shift, sd * math.sqrt(max(0.0, 1.0 + narrower - shift * shift))


def light_at(light, at):
    """The light as it is there: a state that was read, or one between. Raises Unknown."""
    states = light.get('states', [])
    if not states or alike(at, light.get('state', {})):
        return light
    kept = [one for one in states
            if all(one['state'].get(k) == v for k, v in at.items() if isinstance(v, str))]
    if not kept:
        raise Unknown('no state with these words was read')
    exact = next((one for one in kept if alike(one['state'], at)), None)
    axes = {}
    for name, value in at.items():
        if isinstance(value, str):
            continue
        numbers = [one['state'][name] for one in kept]
        low, high = min(numbers), max(numbers)
        if not (low <= value <= high or same(value, low) or same(value, high)):
            raise Unknown('%s was read from %g to %g' % (name, low, high))
        if not same(low, high):
            axes[name] = (low, high)
    changed = dict(light, state=dict(at))
    if exact:
        ln = math.log(exact['relative']['value'])
        changed.update({k: exact[k] for k in ('intensity_cd', 'illuminance_lx', 'color')
                        if k in exact})
    else:
        if not axes:
            raise Unknown('one state alone was read')
        if sum(kind_of(name) == 'level' for name in axes) > 1:
            raise Unknown('between its levels nothing is known')
        kept = nearest(kept, axes, at)
        curve = curve_of(tuple(kind_of(name) for name in axes), 'light',
                         tuple(labels_of(one['state'], axes) for one in kept),
                         tuple(math.log(one['relative']['value']) for one in kept),
                         tuple(max(1e-4, one['repeatability']) for one in kept))
        ln, sd = between_neighbours(kept, axes, at, *curve.at(labels_of(at, axes)))
        for key in ('intensity_cd', 'illuminance_lx', 'luminance_nits'):
            if key in light:
                changed[key] = from_ln(math.log(light[key]['value']) + ln,
                                       math.hypot(sd_of_ln(light[key]), sd))
        changed['color'] = (color_between(kept, axes, at, light.get('emitters', {})) or
                            light.get('color', {}))
    if 'distribution' in light:
        scale = math.exp(ln)
        table = light['distribution']
        changed['distribution'] = dict(table, candela=[scale * x for x in table['candela']])
    return changed
