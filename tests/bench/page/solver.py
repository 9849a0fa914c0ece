# SPDX-License-Identifier: Apache-2.0
"""Figure: the optimum of a fit of three parameters to six readings."""
import numpy

import measure

SIGMA, OFFSET_SD, AMBIENT_SD = 0.014, 0.05, 0.2
TOLERANCES = ("1e-2", "1e-4", "1e-8", "1e-14")


def lux_and_slopes(distance, theta):
    """E and its derivatives by (ln I, d0, E0); works in any precision."""
    r = distance + theta[1]
    direct = numpy.exp(theta[0]) / (r * r)
    return direct + theta[2], numpy.array([direct, -2 * direct / r, numpy.ones_like(direct)])


def residuals(theta, distance, measured):
    lux, _ = lux_and_slopes(distance, theta)
    return numpy.concatenate(((numpy.log(measured) - numpy.log(lux)) / SIGMA,
                              [theta[1] / OFFSET_SD, theta[2] / AMBIENT_SD]))


def jacobian(theta, distance, _):
    lux, slopes = lux_and_slopes(distance, theta)
    priors = numpy.zeros((2, 3), slopes.dtype)
    priors[0, 1], priors[1, 2] = 1 / OFFSET_SD, 1 / AMBIENT_SD
    return numpy.vstack((-(slopes / lux).T / SIGMA, priors))


def optimum(distance, measured, start):
    """Gauss-Newton in 80 bit until the step is below 1e-17; the normal equations' matrix may be
    double, since only the gradient decides where it ends."""
    exact = [numpy.asarray(a, numpy.longdouble) for a in (distance, measured, start)]
    theta = exact[2]
    for _ in range(300):
        r, j = residuals(theta, *exact[:2]), jacobian(theta, *exact[:2])
        step = numpy.linalg.solve((j.T @ j).astype(float), (j.T @ r).astype(float))
        size = min(1.0, 0.5 / max(abs(step)))
        theta = theta - size * step
        if max(abs(step)) < 1e-17:
            return theta
    raise RuntimeError("the truth did not converge")


def problems(count):
    random = numpy.random.default_rng(11)
    distance = 0.35 * 8 ** (numpy.arange(6) / 5)
    for _ in range(count):
        offset, ambient = random.uniform(-0.04, 0.04), random.uniform(0.05, 0.15)
        lux = 1 / (distance + offset) ** 2 + ambient
        measured = lux * numpy.exp(random.normal(0, SIGMA, 6))
        start = float(numpy.mean(numpy.log(measured * distance ** 2)))
        yield distance, measured, start, float(optimum(distance, measured, (start, 0, 0))[0])


def scipy_tasks(all_problems):
    from scipy.optimize import least_squares
    truth = [p[3] for p in all_problems]

    def answer(i, method, tolerance):
        distance, measured, start, _ = all_problems[i]
        return least_squares(residuals, (start, 0.0, 0.0), jacobian, method=method, ftol=tolerance,
                             xtol=tolerance, gtol=tolerance, args=(distance, measured)).x[0]
    for method in ("lm", "trf"):
        for word in TOLERANCES:
            yield measure.function_task(
                f"scipy {method}", f"tolerance {word}", measure.PUBLIC,
                lambda i, m=method, t=max(float(word), 4e-16): answer(i, m, t), truth,
                relative=False)


def made(bench):
    figure = measure.Figure(
        key="solver", title="The optimum of a fit, six readings",
        x_label="processor time of one fit", y_label="worst error of ln I",
        what="Intensity, distance offset and ambient light from six readings of 1.4 % and two "
             "priors; every solver gets the same start, cost, derivatives and data; truth: "
             "Gauss-Newton in 80 bit numbers to a step of 1e-17.",
        baseline=("lightcal", "quick"), unordered=["lightcal"])
    rows = list(problems(16 if bench.quick else 128))
    table = bench.write_table("solver.txt", [
        (*numpy.column_stack((d, m)).ravel(), SIGMA, OFFSET_SD, AMBIENT_SD, start, truth)
        for d, m, start, truth in rows])
    tasks = [measure.program_task([bench.program("lightcal_page_own"), "solver", table],
                                  lambda _: measure.OWN)]
    public = None if bench.own_only else bench.program("lightcal_page_solvers")
    if figure.takes(public, ("libgsl-dev", "GSL"), ("libeigen3-dev", "Eigen"),
                    ("libcminpack-dev", "cminpack")):
        tasks.append(measure.program_task([public, table], lambda _: measure.PUBLIC))
    if figure.takes(not bench.own_only and bench.python_has("scipy"), measure.SCIPY):
        tasks += scipy_tasks(rows[:32])
    measure.measure(figure, tasks, bench.rounds)
    base, full = figure.base(), figure.row("lightcal", "full")
    figure.sentence = (
        f"Leave the solver on quick: {measure.duration(base.median)} a fit, off by at most "
        f"{measure.off(base.error)}; full takes {measure.times(full.median / base.median)} as long "
        f"for {measure.off(full.error)}")
    scipy = figure.row("scipy lm", "tolerance 1e-8")
    if scipy:
        figure.sentence += (f", scipy's least_squares {measure.times(scipy.median / base.median)} "
                            f"for {measure.off(scipy.error)}")
    figure.sentence += "."
    return figure
