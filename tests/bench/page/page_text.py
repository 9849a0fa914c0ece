# SPDX-License-Identifier: Apache-2.0
"""Writes the measured part of tests/bench/README.md."""
import pathlib
import sys

import measure

TITLE = "# What speed costs\n"
BEGIN = "<!-- tests/bench/standing_page writes from here; its next run writes it anew. -->"
END = "<!-- To here. What follows is written by hand and stays. -->"
HEAD = """Error against time of what lightcal does beside public tools, measured in turns (A B A B).
Down and to the left is better. A mark is the median processor time (all cores added, so that what
else the machine does is left out) at the worst error; the bar across spans the quartiles of the
times, the thin line down reaches the median error (none: the lower edge). Blue and filled is
lightcal, orange and open public tools, grey methods written here as they were published. Compare
the ratios: the seconds are the machine's that is named. Every error is against what made the data,
or against the number itself worked out in 80 bits or by brute force; where a rival wins, the line
below the table says so. One command writes this part:

```sh
tests/bench/standing_page                 # root: installs what it compares with, builds, measures
tests/bench/standing_page --only cct      # one figure anew; the others stay as they were measured
tests/bench/standing_page --quick --no-install --own-only -o /tmp/page
```
"""


def seconds(row):
    low, high = (measure.duration(q) for q in row.quartiles)
    median = measure.duration(row.median)
    return median if low == high else f"{median} ({low} to {high})"


def table(figure):
    base = figure.base().median
    lines = [f"| method | setting | time | {figure.y_label} | median error | median (quartiles) |",
             "|---|---|---|---|---|---|"]
    for row in figure.rows:
        lines.append(f"| {row.method} | {row.setting} | {measure.times(row.median / base)} | "
                     f"{measure.off(row.error)} | {measure.off(row.usual)} | {seconds(row)} |")
    return "\n".join(lines)


def rivals(figure):
    """What of others nothing of lightcal beats in both time and error: one setting a method, the
    most accurate of those no slower than the baseline, else the cheapest."""
    own = [row for row in figure.rows if row.kind == measure.OWN]
    base = figure.base()
    best = {}
    for row in figure.rows:
        if row.kind == measure.OWN or any(
                mine.median <= row.median and mine.error <= row.error for mine in own):
            continue
        slow = row.median > base.median
        rank = (slow, row.median if slow else row.error)
        if row.method not in best or rank < best[row.method][0]:
            best[row.method] = (rank, row)
    if not best:
        return "No rival here is faster or nearer than every setting of lightcal."
    words = []
    for _, row in best.values():
        name = f"{row.method}{', ' + row.setting if row.setting else ''}"
        words.append(f"{name} ({measure.times(row.median / base.median)}, {measure.off(row.error)})")
    return "Nothing of lightcal beats in both time and error: " + "; ".join(words) + "."


def section(figure):
    method, setting = figure.baseline
    beside = "; ".join(figure.versions)
    left_out = f" Not there: {', '.join(figure.missing)}." if figure.missing else ""
    picture = f"![{figure.title}: error against time](figures/{figure.key}.svg)\n\n"
    return (f"## {figure.title}\n\n**{figure.sentence}**\n\n{picture}{figure.what}\n\n"
            f"{table(figure)}\n\n{rivals(figure)}\n\nTimes are multiples of {method}"
            f"{', ' + setting if setting else ''}. {figure.made}."
            f"{' Beside it: ' + beside + '.' if beside else ''}{left_out}\n")


def by_hand(path):
    """What stands before and after the measured part of a page that may not be there yet."""
    text = path.read_text(encoding="utf-8") if path.exists() else f"{TITLE}\n{BEGIN}\n{END}\n"
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"{path}: the marks of the measured part are not there; put back\n{BEGIN}\n{END}")
    before, rest = text.split(BEGIN)
    return before, rest.split(END)[1]


def write(figures, path):
    before, after = by_hand(path)
    part = "\n".join([BEGIN, "", HEAD, *(section(f) for f in figures), END])
    path.write_text(before + part + after, encoding="utf-8")
