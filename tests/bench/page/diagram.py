# SPDX-License-Identifier: Apache-2.0
"""Draws a figure's rows as a work-precision diagram: error against time, both logarithmic.

Colours are those of the page the picture stands on, light or dark; lines differ in dash and mark as
well, so they are told apart without colour. Names stand beside their lines, never on one another.
"""
import collections
import math
import pathlib

import matplotlib

import measure
from place_names import place

matplotlib.use("Agg")
import matplotlib.pyplot  # noqa: E402  (after the choice of the canvas)

# Stand-ins that matplotlib writes and the style sheet below takes the place of.
INK, SOFT, RULE, OWN, OTHER, PAGE = (f"#0{i}0{i}0{i}" for i in range(1, 7))
STYLE = """<style>
:root { color-scheme: light dark; --page: #ffffff; --ink: #15181c; --soft: #565d67; --rule: #e1dfda;
  --own: #0067a8; --other: #b84300; }
@media (prefers-color-scheme: dark) { :root { --page: #101214; --ink: #eff1f3; --soft: #a9b1ba;
  --rule: #2f343a; --own: #63b8ee; --other: #f0954a; } }
svg { background: var(--page); }
</style>
"""
VARIABLES = {INK: "var(--ink)", SOFT: "var(--soft)", RULE: "var(--rule)", OWN: "var(--own)",
             OTHER: "var(--other)", PAGE: "var(--page)"}
COLORS = {measure.OWN: OWN, measure.PUBLISHED: SOFT, measure.PUBLIC: OTHER}
MARKS = {measure.OWN: "oDv", measure.PUBLISHED: "s^<P>", measure.PUBLIC: "s^vDP<X>*"}
DASHES = ["-", (0, (5, 2)), (0, (1, 1.5)), (0, (6, 2, 1, 2)), (0, (3, 1, 1, 1, 1, 1))]
NAME_PX, SETTING_PX = 9.5, 7.5


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


def axes_of(figure):
    """The empty frame, and how an error is shown: without any it stands on the lower edge."""
    picture, axes = matplotlib.pyplot.subplots(figsize=(8.6, 5.6), dpi=100)
    axes.set_xscale("log")
    axes.set_yscale("log")
    all_errors = [e for row in figure.rows for e in (row.error, row.usual) if math.isfinite(e)]
    least = min((e for e in all_errors if e > 0), default=1.0)

    def shown(error):
        return error if error > 0 else least / 10
    axes.set_xlim(limits([q for row in figure.rows for q in row.quartiles], 0.06, 0.1))
    axes.set_ylim(limits([shown(e) for e in all_errors], 0.05, 0.08))
    axes.xaxis.set_major_formatter(lambda x, _: measure.duration(x * 1.0000001))
    axes.yaxis.set_major_formatter(lambda y, _: measure.off(y * 1.0000001))
    for axis, ends in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
        axis.set_major_locator(ticks(*ends))
        axis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.grid(color=RULE, linewidth=0.8)
    axes.tick_params(colors=SOFT, which="both", labelsize=9)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(SOFT)
    axes.set_xlabel(figure.x_label, color=INK)
    axes.set_ylabel(figure.y_label, color=INK)
    picture.tight_layout()
    return picture, axes, shown


def draw_method(axes, kind, number, rows, points, line):
    """One method's line, marks and spreads. points: (time, shown error, shown median error)."""
    color, own = COLORS[kind], kind == measure.OWN
    axes.plot(*zip(*line), color=color, linewidth=2.2 if own else 1.3,
              linestyle=DASHES[number % len(DASHES)], zorder=3)
    axes.plot(*zip(*(point[:2] for point in points)), color=color, linestyle="none",
              marker=MARKS[kind][number % len(MARKS[kind])], markersize=7 if own else 6,
              markerfacecolor=color if own else PAGE, zorder=5 if own else 4)
    for row, (x, worst, usual) in zip(rows, points):
        axes.plot(row.quartiles, (worst, worst), color=color, linewidth=1, zorder=2)
        axes.plot((x, x), (usual, worst), color=color, linewidth=0.8, alpha=0.5, zorder=1)


def draw(figure, path):
    """Writes the SVG; returns its labels."""
    picture, axes, shown = axes_of(figure)
    size = text_sizes(picture)
    methods = {}
    for row in figure.rows:
        if math.isfinite(row.error):
            methods.setdefault((row.kind, row.method), []).append(row)
    wishes, marks, lines = [], [], []
    seen = collections.Counter()

    def on_page(*points):
        return [tuple(point) for point in axes.transData.transform(points)]
    for (kind, method), rows in methods.items():
        points = [(row.median, shown(row.error), shown(row.usual)) for row in rows]
        ends = [point[:2] for point in points]
        line = best_of(ends) if method in figure.unordered else ends
        draw_method(axes, kind, seen[kind], rows, points, line)
        seen[kind] += 1
        pixels, drawn = on_page(*ends), on_page(*line)
        marks += [(x - 4, y - 4, x + 4, y + 4) for x, y in pixels]
        lines += zip(drawn, drawn[1:])
        lines += [on_page(*((q, worst) for q in row.quartiles))
                  for row, (_, worst) in zip(rows, ends)]
        ends_first = pixels[:1] + pixels[-1:] + pixels[1:-1]
        wishes.append((method, size(method, NAME_PX), ends_first, True))
        if len(rows) > 1:
            wishes += [(row.setting, size(row.setting, SETTING_PX), [pixel], False)
                       for row, pixel in zip(rows, pixels)]
    frame = axes.get_window_extent().padded(-3)
    labels = place(wishes, marks, lines, (frame.x0, frame.y0, frame.x1, frame.y1))
    write_names(axes, labels, {method: COLORS[kind] for kind, method in methods})
    save(picture, path, figure)
    return labels


def write_names(axes, labels, colors):
    inverse = axes.transData.inverted().transform
    for label in labels:
        if label.leader:
            axes.plot(*zip(*map(inverse, label.leader)), color=SOFT, linewidth=0.7, zorder=2)
        axes.text(*inverse((label.x, label.y)), label.text, zorder=6, va="bottom",
                  fontsize=NAME_PX if label.must else SETTING_PX,
                  color=colors[label.text] if label.must else SOFT,
                  fontweight="bold" if label.must else "normal")


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
