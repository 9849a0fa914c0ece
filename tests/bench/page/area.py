# SPDX-License-Identifier: Apache-2.0
"""Figure: illuminance from a rectangular light."""
import json
import pathlib

import numpy

import measure

HALF_WIDTH, HALF_HEIGHT = 0.8, 0.6
AREA = 4 * HALF_WIDTH * HALF_HEIGHT


def scenes(count):
    """Meters 1.1 to 100 half diagonals away that see the whole rectangle."""
    random = numpy.random.default_rng(5)
    out = []
    while len(out) < count:
        direction = random.normal(size=3)
        direction[2] = abs(direction[2])
        position = direction / numpy.linalg.norm(direction) * 1.1 * (100 / 1.1) ** random.uniform()
        normal = random.normal(size=3)
        normal /= numpy.linalg.norm(normal)
        if -normal @ position > 1.05 and position[2] > 0.02 * numpy.linalg.norm(position):
            out.append((position, normal))
    return out


def lux_per_candela(position, normal):
    """The contour integral (Lambert) in 80 bit."""
    p, n = (numpy.asarray(a, numpy.longdouble) for a in (position, normal))
    corners = numpy.array([(-HALF_WIDTH, -HALF_HEIGHT, 0), (HALF_WIDTH, -HALF_HEIGHT, 0),
                           (HALF_WIDTH, HALF_HEIGHT, 0), (-HALF_WIDTH, HALF_HEIGHT, 0)],
                          numpy.longdouble) - p
    total = numpy.longdouble(0)
    for a, b in zip(corners, numpy.roll(corners, -1, axis=0)):
        across = numpy.cross(a, b)
        length = numpy.sqrt(across @ across)
        total += numpy.arctan2(length, a @ b) * (across @ n) / length
    return abs(total) / (2 * numpy.longdouble(AREA))


def scipy_tasks(meters, truth):
    from scipy import integrate

    def answer(i, tolerance):
        position, normal = meters[i]

        def at(y, x):
            to = numpy.array((x, y, 0.0)) - position
            return (normal @ to) * -to[2] / (to @ to) ** 2 / AREA
        return integrate.dblquad(at, -HALF_WIDTH, HALF_WIDTH, -HALF_HEIGHT, HALF_HEIGHT,
                                 epsabs=0, epsrel=tolerance)[0]
    for tolerance in ("1e-2", "1e-6", "1e-10"):
        yield measure.function_task("scipy dblquad", f"tolerance {tolerance}", measure.PUBLIC,
                                    lambda i, t=float(tolerance): answer(i, t), truth)


def blender_task(bench, meters, truth):
    """Cycles renders a small white card where the meter stands."""
    jobs, answers = bench.work / "blender_jobs.json", bench.work / "blender_answers.json"
    jobs.write_text(json.dumps({"meters": [[list(p), list(n)] for p, n in meters],
                                "size": [2 * HALF_WIDTH, 2 * HALF_HEIGHT],
                                "samples": [1, 16, 256, 4096]}))
    script = pathlib.Path(__file__).with_name("blender_area.py")

    def task():
        measure.run(["blender", "-b", "--factory-startup", "-P", script, "--", jobs, answers])
        for samples, seconds, lux in json.loads(answers.read_text()):
            errors = sorted(abs(e / t - 1) for e, t in zip(lux, truth))
            yield measure.Row("Blender Cycles", f"{samples} samples", measure.PUBLIC, [seconds],
                              errors[-1], errors[len(errors) // 2])
    return task


def made(bench):
    figure = measure.Figure(
        key="area", title="Illuminance from a rectangular light",
        x_label="processor time of one illuminance", y_label="worst relative error",
        what="A rectangle of 1.6 x 1.2 m seen whole from 1.1 to 100 half diagonals, meters turned "
             "any way; truth: Lambert's contour integral in 80 bit numbers. Blender renders "
             "16 pixels with each number of samples, and spends most of its time on setting up. "
             "Radiance (rtrace) is not in Debian 12.",
        baseline=("lightcal exact", "contour or quadrature"))
    meters = scenes(64 if bench.quick else 512)
    truth = [float(lux_per_candela(p, n)) for p, n in meters]
    table = bench.write_table("area.txt", [(*p, *n, t) for (p, n), t in zip(meters, truth)])
    tasks = [measure.program_task([bench.program("lightcal_page_own"), "area", table],
                                  lambda _: measure.OWN)]
    gsl = None if bench.own_only else bench.program("lightcal_page_gsl_area")
    if figure.takes(gsl, ("libgsl-dev", "GSL")):
        tasks.append(measure.program_task([gsl, table], lambda _: measure.PUBLIC))
    if figure.takes(not bench.own_only and bench.python_has("scipy"), measure.SCIPY):
        tasks += scipy_tasks(meters[:16], truth[:16])
    if not bench.own_only and not bench.quick and measure.is_there("blender"):
        tasks.append(blender_task(bench, meters[:8], truth[:8]))
        figure.versions.append(measure.version_of("blender"))
    else:
        figure.missing.append("Blender")
    measure.measure(figure, tasks, bench.rounds)
    ladder = figure.row("lightcal ladder", "tolerance 1e-3")
    base = figure.base()
    figure.sentence = (
        f"Ask the ladder for the tolerance you need: 0.1 % costs {measure.duration(ladder.median)} "
        f"({measure.times(ladder.median / base.median)} the exact form's time) and was wrong by at "
        f"most {measure.off(ladder.error)}")
    sampled = figure.row("plain Monte Carlo (GSL)", "1024 samples")
    if sampled:
        ratio = measure.times(sampled.median / ladder.median)
        figure.sentence += (f"; sampling is the wrong knob: 1024 samples cost {ratio} that and are "
                            f"wrong by up to {measure.off(sampled.error)}")
    figure.sentence += "."
    return figure
