# SPDX-License-Identifier: Apache-2.0
"""The quick page of lightcal's own methods is whole, leaves what was written by hand, draws the
same bytes again, lets no name lie on another, and is not written where a bench fails.

    quick_page_test.py BUILD
"""
import itertools
import math
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent
COMMAND = [sys.executable, "-B", HERE.parent / "standing_page", "--quick", "--no-install",
           "--no-build", "--own-only"]
sys.path.insert(0, str(HERE))
import diagram  # noqa: E402
import measure  # noqa: E402
import page_text  # noqa: E402
import place_names  # noqa: E402

HAND = f"# Title\n\n{page_text.BEGIN}\nold\n{page_text.END}\n\nby hand\n"
FIGURES = ("merge", "cct", "area", "solver", "intervals", "whole_run")


def demand(condition, text):
    if not condition:
        sys.exit(text)


def check_names(labels, key):
    for a, b in itertools.combinations(labels, 2):
        demand(not place_names.overlap(a.box, b.box), f"{key}: {a.text} lies on {b.text}")


def check_page(folder):
    text = (folder / "README.md").read_text(encoding="utf-8")
    demand(text.startswith("# Title\n") and text.endswith(f"{page_text.END}\n\nby hand\n")
           and "old" not in text.splitlines(), "what was written by hand did not stay")
    for key in FIGURES:
        figure = measure.load(folder / f"figures/{key}.json")
        demand(f"## {figure.title}\n" in text and figure.sentence in text, f"{key}: not there")
        demand(f"figures/{key}.svg" in text, f"{key}: its picture is not shown")
        for row in figure.rows:
            demand(row.kind != measure.PUBLIC, f"{key}: {row.method} was measured")
            demand(row.median > 0 and math.isfinite(row.error), f"{key}: {row} is no measurement")
        drawn = (folder / f"figures/{key}.svg").read_bytes()
        again = folder / f"{key}.again.svg"
        labels = diagram.draw(figure, again)
        demand(drawn == again.read_bytes(), f"{key}: drawn again it has other bytes")
        xml.etree.ElementTree.fromstring(drawn)
        check_names(labels, key)
        names = {label.text for label in labels}
        demand({row.method for row in figure.rows} <= names, f"{key}: a method has no name")


def check_a_crowd(folder):
    """Fourteen methods that lie within a factor of two of one another."""
    figure = measure.Figure("crowd", "A crowd", "time", "error", "", ("method 0", "a"))
    for i in range(14):
        figure.rows += [
            measure.Row(f"method {i}", f"setting {k}", (measure.OWN, measure.PUBLIC)[i % 2],
                        [1e-6 * (1 + 0.05 * i + 0.1 * k)] * 3, 1e-3 * (1 + 0.04 * i) / (1 + k),
                        1e-4) for k in range(3)]
    labels = diagram.draw(figure, folder / "crowd.svg")
    check_names(labels, "crowd")
    demand(len({label.text for label in labels if label.must}) == 14, "a method has no name")


def check_a_failing_bench(build, folder):
    """A build whose programs are all there, one of which fails."""
    broken, out = folder / "broken", folder / "none"
    (broken / "tests/bench").mkdir(parents=True)
    (broken / "app").symlink_to(build / "app")
    for program in (build / "tests/bench").glob("lightcal_*"):
        if program.is_file() and program.name != "lightcal_page_own":
            (broken / "tests/bench" / program.name).symlink_to(program)
    (broken / "tests/bench/lightcal_page_own").symlink_to("/bin/false")
    done = subprocess.run([*COMMAND, "--only", "cct", "--build", broken, "-o", out], check=False,
                          stderr=subprocess.DEVNULL)
    demand(done.returncode != 0, "a failing bench went unseen")
    demand(not (out / "README.md").exists(), "a page was written although a bench failed")


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_a_crowd(folder)
        check_a_failing_bench(build, folder)
        (folder / "README.md").write_text(HAND, encoding="utf-8")
        subprocess.run([*COMMAND, "--build", build, "-o", folder], check=True)
        check_page(folder)


if __name__ == "__main__":
    main()
