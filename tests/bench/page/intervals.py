# SPDX-License-Identifier: Apache-2.0
"""Figure: the standard uncertainty of an intensity."""
import numpy

import measure

SIGMA = 0.08
STEPS = 30


def estimate(distance, log_measured, offset_prior, offset_sd, start):
    """ln I of many draws at once: of the two unknowns ln I is linear, so Newton runs over d0 alone.
    distance: (6,); log_measured: (draws, 6); offset_prior, start: (draws,)."""
    offset = start.copy()
    for _ in range(STEPS):
        r = distance + offset[:, None]
        model = -2 * numpy.log(r)
        slope = -2 / r
        left = log_measured - model
        left -= left.mean(axis=1, keepdims=True)
        bent = slope - slope.mean(axis=1, keepdims=True)
        gradient = (-(left * bent).sum(axis=1) / SIGMA ** 2
                    + (offset - offset_prior) / offset_sd ** 2)
        step = gradient / ((bent * bent).sum(axis=1) / SIGMA ** 2 + 1 / offset_sd ** 2)
        offset -= step
        if numpy.abs(step).max() < 1e-12:
            break
    return (log_measured + 2 * numpy.log(distance + offset[:, None])).mean(axis=1), offset


def sampled_u(problem, draws, random, control):
    """u(ln I) by the JCGM 101's draws. control: the part that is linear in the draws is put in
    exactly and only what is left is sampled, which divides the scatter by ten and more."""
    distance, measured, offset_sd = problem
    normal = random.normal(size=(draws, 7))
    log_measured = numpy.log(measured) + SIGMA * normal[:, :6]
    prior = offset_sd * normal[:, 6]
    zeros = numpy.zeros(1)
    centre, at = estimate(distance, numpy.log(measured)[None, :], zeros, offset_sd, zeros)
    ln_i, _ = estimate(distance, log_measured, prior, offset_sd, numpy.full(draws, at[0]))
    if not control:
        return ln_i.std(ddof=1)
    weights = []
    for k in range(7):  # derivative by each draw
        ends = []
        for h in (1e-5, -1e-5):
            one = numpy.log(measured) + SIGMA * h * (numpy.arange(6) == k)
            ends.append(estimate(distance, one[None, :], numpy.array([offset_sd * h * (k == 6)]),
                                 offset_sd, at)[0][0])
        weights.append((ends[0] - ends[1]) / 2e-5)
    weights = numpy.array(weights)
    linear = normal @ weights
    rest = ln_i - centre[0] - linear
    # Var(linear + rest) = |w|^2 + 2 Cov(linear, rest) + Var(rest); the first is exact. The normal
    # draws' own covariance with rest is known only by sampling, but rest is small.
    return float(numpy.sqrt(weights @ weights + 2 * numpy.cov(linear, rest)[0, 1]
                            + rest.var(ddof=1)))


def problems(count):
    random = numpy.random.default_rng(13)
    for _ in range(count):
        distance = 0.3 * 6 ** (numpy.arange(6) / 5)
        offset_sd = 0.05
        lux = 1 / (distance + random.uniform(-0.04, 0.04)) ** 2
        yield distance, lux * numpy.exp(random.normal(0, SIGMA, 6)), offset_sd


def by_uncertainties(problem):
    """Linear propagation through the fit, derivatives by the package itself."""
    import uncertainties
    distance, measured, offset_sd = problem

    def fit(*numbers):
        ln_i, _ = estimate(distance, numpy.array([numbers[:6]]), numpy.array([numbers[6]]),
                           offset_sd, numpy.zeros(1))
        return float(ln_i[0])
    inputs = [uncertainties.ufloat(x, SIGMA) for x in numpy.log(measured)]
    inputs.append(uncertainties.ufloat(0.0, offset_sd))
    return uncertainties.wrap(fit)(*inputs).std_dev


def by_scipy(problem, draws, random):
    """What a careful person writes: least_squares once a draw."""
    from scipy.optimize import least_squares
    distance, measured, offset_sd = problem
    values = []
    for _ in range(draws):
        log_measured = numpy.log(measured) + SIGMA * random.normal(size=6)
        prior = offset_sd * random.normal()

        def residuals(theta, log_measured=log_measured, prior=prior):
            left = log_measured - theta[0] + 2 * numpy.log(distance + theta[1])
            return numpy.append(left / SIGMA, (theta[1] - prior) / offset_sd)
        values.append(least_squares(residuals, (0.0, 0.0), method="lm").x[0])
    return numpy.std(values, ddof=1)


def made(bench):
    figure = measure.Figure(
        key="intervals", title="The uncertainty of an intensity",
        x_label="processor time of one uncertainty", y_label="worst relative error of u(ln I)",
        what="Intensity and distance offset from six rough readings of 8 % and a prior; truth: "
             "draws of JCGM 101 with their linear part put in exactly. lightcal's covariance is "
             "the inverse of J^T J, its draws solve the general problem; numpy's use that ln I is "
             "linear here; uncertainties differentiates the whole fit numerically.",
        baseline=("lightcal covariance", "linear"))
    rows = list(problems(2 if bench.quick else 8))
    random = numpy.random.default_rng(19)
    draws = 50_000 if bench.quick else 1_000_000
    truth = [numpy.mean([sampled_u(p, 50_000, random, True) for _ in range(draws // 50_000)])
             for p in rows]
    table = bench.write_table("intervals.txt", [
        (*numpy.column_stack((d, m)).ravel(), SIGMA, offset_sd, u)
        for (d, m, offset_sd), u in zip(rows, truth)])
    tasks = [measure.program_task([bench.program("lightcal_page_own"), "intervals", table],
                                  lambda _: measure.OWN)]
    if not bench.quick:
        tasks.append(measure.program_task([bench.program("lightcal_page_own"), "million_draws",
                                           table], lambda _: measure.OWN))
    if not bench.own_only:
        for draws in (1000, 10_000, 100_000) + (() if bench.quick else (1_000_000,)):
            tasks.append(measure.function_task(
                "numpy, all draws at once", f"{draws} draws", measure.PUBLIC,
                lambda i, n=draws: sampled_u(rows[i], n, numpy.random.default_rng((n, i)), False),
                truth))
    if figure.takes(not bench.own_only and bench.python_has("scipy"), measure.SCIPY):
        tasks += [measure.function_task("scipy, draw by draw", f"{n} draws", measure.PUBLIC,
                                        lambda i, n=n: by_scipy(
                                            rows[i], n, numpy.random.default_rng((n, i))), truth)
                  for n in ((100,) if bench.quick else (100, 1000))]
    if figure.takes(not bench.own_only and bench.python_has("uncertainties"),
                    ("python3-uncertainties", "uncertainties")):
        tasks.append(measure.function_task("python3-uncertainties", "linear", measure.PUBLIC,
                                           lambda i: by_uncertainties(rows[i]), truth))
    measure.measure(figure, tasks, 3)
    base, drawn = figure.base(), figure.row("lightcal draws", "100000 draws")
    figure.sentence = (
        f"The covariance is enough unless the last percents of the interval matter: with readings "
        f"as rough as these it is off by {measure.off(base.error)} of u in "
        f"{measure.duration(base.median)}; 100 000 draws are off by {measure.off(drawn.error)} in "
        f"{measure.duration(drawn.median)}")
    loop = figure.row("scipy, draw by draw", "1000 draws")
    if loop:
        figure.sentence += (f", where a thousand draws by scipy take "
                            f"{measure.duration(loop.median)} for {measure.off(loop.error)}")
    figure.sentence += "."
    return figure
