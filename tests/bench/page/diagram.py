# SPDX-License-Identifier: Apache-2.0
"""Draws a figure's rows as a work-precision diagram: error against time, both logarithmic.

Colours are those of the page the picture stands on, light or dark; lines differ in dash and mark as
well, so they are told apart without colour. Names stand beside their lines, never on one another.
"""
import collections
import itertools
import math
import pathlib

import matplotlib

import measure

matplotlib.use("Agg")
import matplotlib.pyplot  # noqa: E402  (after the choice of the canvas)

# Stand-ins that matplotlib writes and the style sheet below takes the place of.
INK, SOFT, RULE, OWN, OTHER = "#010101", "#020202", "#030303", "#040404", "#050505"
STYLE = """<style>
:root { color-scheme: light dark; --page: #ffffff; --ink: #15181c; --soft: #565d67; --rule: #e1dfda;
  --own: #0067a8; --other: #b84300; }
@media (prefers-color-scheme: dark) { :root { --page: #101214; --ink: #eff1f3; --soft: #a9b1ba;
  --rule: #2f343a; --own: #63b8ee; --other: #f0954a; } }
svg { background: var(--page); }
</style>
"""
VARIABLES = {INK: "var(--ink)", SOFT: "var(--soft)", RULE: "var(--rule)", OWN: "var(--own)",
             OTHER: "var(--other)", "#060606": "var(--page)"}
PAGE = "#060606"
COLORS = {measure.OWN: OWN, measure.PUBLISHED: SOFT, measure.PUBLIC: OTHER}
MARKS = {measure.OWN: "oDv", measure.PUBLISHED: "s^<P>", measure.PUBLIC: "s^vDP<X>*"}
DASHES = ["-", (0, (5, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2)), (0, (3, 1, 1, 1, 1, 1))]
NAME_PX, SETTING_PX = 9.5, 7.5

Label = collections.namedtuple("Label", "text x y box must leader")


def overlap(a, b):
    """Of boxes (left, bottom, right, top)."""
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def crosses(p, q, box):
    """Whether the segment from p to q passes through the box."""
    enter, leave = 0.0, 1.0
    for axis in (0, 1):
        along, low, high = q[axis] - p[axis], box[axis] - p[axis], box[axis + 2] - p[axis]
        if along == 0:
            if low >= 0 or high <= 0:
                return False
            continue
        enter = max(enter, min(low / along, high / along))
        leave = min(leave, max(low / along, high / along))
    return enter < leave


def place(wishes, marks, lines, area):
    """wishes: (text, size, points, must), the points any of which the name may stand at. Those that
    must be shown may stand far off at the end of a line; the others stand beside or nowhere.
    Deterministic; boxes are disjoint."""
    placed = []
    for text, (width, height), points, must in sorted(wishes, key=lambda wish: not wish[3]):
        best, least = None, math.inf
        for ring in range(24 if must else 1):
            if best and 10.0 * ring > least:
                break
            for (x, y), k in itertools.product(points, range(16)):
                angle, distance = math.tau * k / 16, 7.0 + 10.0 * ring
                c, s = math.cos(angle), math.sin(angle)
                left = x + distance * c - width * (1 - max(-1, min(1, 1.5 * c))) / 2
                bottom = y + distance * s - height * (1 - max(-1, min(1, 1.5 * s))) / 2
                box = (left, bottom, left + width, bottom + height)
                wide = (left - 2, bottom - 1, left + width + 2, bottom + height + 1)
                if not (box[0] >= area[0] and box[1] >= area[1] and box[2] <= area[2]
                        and box[3] <= area[3]):
                    continue
                if any(overlap(wide, other.box) for other in placed) or any(
                        overlap(box, mark) for mark in marks):
                    continue
                cost = 10.0 * ring + 25.0 * sum(crosses(p, q, box) for p, q in lines)
                cost += 50.0 * sum(crosses(*other.leader, box) for other in placed if other.leader)
                if cost < least and (must or cost == 0):
                    end = (min(max(x, box[0]), box[2]), min(max(y, box[1]), box[3]))
                    best = Label(text, left, bottom, box, must, ((x, y), end) if ring > 1 else None)
                    least = cost
        if best:
            placed.append(best)
    return placed


def limits(values, low_margin, high_margin):
    low, high = min(values), max(values)
    decades = max(0.3, math.log10(high / low))
    return low / 10 ** (decades * low_margin), high * 10 ** (decades * high_margin)


def best_of(points):
    """Those that none beats in both, by time."""
    out = []
    for point in sorted(points):
        if not out or point[1] < out[-1][1]:
            out.append(point)
    return out


def ticks(low, high):
    """1, 2, 5 of each decade where there are few decades, else as many decades as have room."""
    decades = math.log10(high / low)
    if decades < 2.5:
        return matplotlib.ticker.LogLocator(subs=(1, 2, 5))
    return matplotlib.ticker.LogLocator(numticks=9)


def draw(figure, path):
    """Writes the SVG; returns its labels."""
    methods = {}
    for row in figure.rows:
        methods.setdefault((row.kind, row.method), []).append(row)
    picture, axes = matplotlib.pyplot.subplots(figsize=(8.6, 5.6), dpi=100)
    axes.set_xscale("log")
    axes.set_yscale("log")
    least = min(e for row in figure.rows for e in (row.error, row.usual) if e > 0)
    shown = lambda error: error if error > 0 else least / 10  # noqa: E731  (none: the lower edge)
    times = [q for row in figure.rows for q in row.quartiles]
    errors = [shown(e) for row in figure.rows for e in (row.error, row.usual) if math.isfinite(e)]
    axes.set_xlim(limits(times, 0.06, 0.1))
    axes.set_ylim(limits(errors, 0.05, 0.08))
    axes.xaxis.set_major_formatter(lambda x, _: measure.duration(x * 1.0000001))
    axes.yaxis.set_major_formatter(lambda y, _: measure.off(y * 1.0000001))
    axes.xaxis.set_major_locator(ticks(*axes.get_xlim()))
    axes.yaxis.set_major_locator(ticks(*axes.get_ylim()))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.grid(color=RULE, linewidth=0.8)
    axes.tick_params(colors=SOFT, which="both", labelsize=9)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(SOFT)
    axes.set_xlabel(figure.x_label, color=INK)
    axes.set_ylabel(figure.y_label, color=INK)

    picture.tight_layout()
    at = lambda x, y: tuple(axes.transData.transform((x, y)))  # noqa: E731
    size = text_sizes(picture)
    wishes, marks, lines = [], [], []
    seen = collections.Counter()
    for (kind, method), rows in methods.items():
        color, number = COLORS[kind], seen[kind]
        seen[kind] += 1
        finite = [row for row in rows if math.isfinite(row.error)]
        points = [(row.median, shown(row.error)) for row in finite]
        own = kind == measure.OWN
        line = best_of(points) if method in figure.unordered else points
        axes.plot(*zip(*line), color=color, linewidth=2.2 if own else 1.3,
                  linestyle=DASHES[number % len(DASHES)], zorder=3)
        axes.plot(*zip(*points), color=color, linestyle="none",
                  marker=MARKS[kind][number % len(MARKS[kind])], markersize=7 if own else 6,
                  markerfacecolor=color if own else PAGE, zorder=5 if own else 4)
        for row, (x, y) in zip(finite, points):
            axes.plot(row.quartiles, (y, y), color=color, linewidth=1, zorder=2)
            axes.plot((x, x), (shown(row.usual), y), color=color, linewidth=0.8, alpha=0.5,
                      zorder=1)
            px, py = at(x, y)
            marks.append((px - 4, py - 4, px + 4, py + 4))
        pixels = [at(*point) for point in points]
        drawn = [at(*point) for point in line]
        lines += list(zip(drawn, drawn[1:]))
        lines += [(at(q[0], y), at(q[1], y)) for q, (_, y) in
                  zip((row.quartiles for row in finite), points)]
        one_setting = len(finite) == 1 or not finite[0].setting
        ends_first = pixels[:1] + pixels[-1:] + pixels[1:-1]
        wishes.append((method, size(method, NAME_PX), ends_first, True))
        if not one_setting:
            wishes += [(row.setting, size(row.setting, SETTING_PX), [pixel], False)
                       for row, pixel in zip(finite, pixels)]
    frame = axes.get_window_extent()
    labels = place(wishes, marks, lines, (frame.x0 + 3, frame.y0 + 3, frame.x1 - 3, frame.y1 - 3))
    kinds = {method: kind for kind, method in methods}
    inverse = axes.transData.inverted().transform
    for label in labels:
        if label.leader:
            axes.plot(*zip(*map(inverse, label.leader)), color=SOFT, linewidth=0.7, zorder=2)
        axes.text(*inverse((label.x, label.y)), label.text, zorder=6,
                  fontsize=NAME_PX if label.must else SETTING_PX, va="bottom",
                  color=COLORS[kinds[label.text]] if label.must else SOFT,
                  fontweight="bold" if label.must else "normal")
    save(picture, path, figure)
    return labels


def text_sizes(picture):
    renderer = picture.canvas.get_renderer()

    def size(text, points):
        probe = picture.text(0, 0, text, fontsize=points, fontweight="bold")
        box = probe.get_window_extent(renderer)
        probe.remove()
        return box.width, box.height
    return size


def save(picture, path, figure):
    """Without a date and with fixed identifiers: the same rows give the same bytes."""
    matplotlib.rcParams["svg.hashsalt"] = "lightcal"
    matplotlib.rcParams["svg.fonttype"] = "none"
    picture.savefig(path, format="svg", transparent=True,
                    metadata={"Date": None, "Creator": None, "Title": figure.title})
    matplotlib.pyplot.close(picture)
    text = pathlib.Path(path).read_text(encoding="utf-8")
    for color, variable in VARIABLES.items():
        text = text.replace(color, variable)
    start = text.index(">", text.index("<svg")) + 1
    text = text[:start] + "\n" + STYLE + text[start:]
    pathlib.Path(path).write_text("\n".join(line.rstrip() for line in text.splitlines()) + "\n",
                                  encoding="utf-8")
