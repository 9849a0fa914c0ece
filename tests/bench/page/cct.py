# SPDX-License-Identifier: Apache-2.0
"""Figure: correlated colour temperature of a chromaticity."""
import csv
import os
import pathlib
import re

import numpy

import measure

C2 = numpy.longdouble("1.4388e-2")
TABLE = (pathlib.Path(__file__).parents[3] /
         "lib/lightcal/colorimetry/cie_tables/cie_1931_2deg_cmf_1nm.csv")


class Locus:
    """The Planckian locus in 80 bit: (u, v) of CIE 1960 and its derivative by mired."""

    def __init__(self):
        with open(TABLE, encoding="utf-8") as file:
            rows = [line for line in csv.reader(file) if line and line[0].isdigit()]
        self.metres = numpy.array([numpy.longdouble(r[0]) for r in rows]) * numpy.longdouble(1e-9)
        self.cmf = numpy.array([[numpy.longdouble(x) for x in r[1:4]] for r in rows])

    def at(self, mireds):
        """u, v, du, dv at an array of mireds > 0."""
        m = numpy.asarray(mireds, numpy.longdouble)[:, None]
        x = C2 * m * numpy.longdouble(1e-6) / self.metres
        power = self.metres ** -5 / numpy.expm1(x)
        slope = -power * (x / m) / -numpy.expm1(-x)
        xyz, dxyz = power @ self.cmf, slope @ self.cmf
        d = xyz[:, 0] + 15 * xyz[:, 1] + 3 * xyz[:, 2]
        dd = dxyz[:, 0] + 15 * dxyz[:, 1] + 3 * dxyz[:, 2]
        u, v = 4 * xyz[:, 0] / d, 6 * xyz[:, 1] / d
        return u, v, (4 * dxyz[:, 0] - u * dd) / d, (6 * dxyz[:, 1] - v * dd) / d


def nearest_kelvins(x, y):
    """The locus's nearest point by brute force: every half mired from 10 to 700, then the root of
    the distance's derivative, in 80 bit."""
    x, y = numpy.asarray(x, numpy.longdouble), numpy.asarray(y, numpy.longdouble)
    d = -2 * x + 12 * y + 3
    cu, cv = 4 * x / d, 6 * y / d
    locus = Locus()
    grid = numpy.arange(10.0, 700.0, 0.5)
    gu, gv, _, _ = (a.astype(float) for a in locus.at(grid))
    nearest = numpy.array([((gu - float(a)) ** 2 + (gv - float(b)) ** 2).argmin()
                           for a, b in zip(cu, cv)])
    mireds = grid[nearest].astype(numpy.longdouble)
    for _ in range(40):
        u, v, du, dv = locus.at(mireds)
        step = ((cu - u) * du + (cv - v) * dv) / (du * du + dv * dv)
        mireds += step
        if numpy.abs(step / mireds).max() < 1e-17:
            break
    if numpy.abs(mireds - grid[nearest]).max() > 1.0:
        raise RuntimeError("the nearest point left its bracket")
    return numpy.longdouble(1e6) / mireds


def colors(count):
    """Chromaticities of 2000 to 20 000 K, |Duv| up to 0.02."""
    random = numpy.random.default_rng(3)
    mireds = random.uniform(50, 500, count)
    duv = random.uniform(-0.02, 0.02, count)
    u, v, du, dv = Locus().at(mireds)
    speed = numpy.hypot(du, dv)
    u, v = u + duv * dv / speed, v - duv * du / speed
    d = 2 * u - 8 * v + 4
    return (3 * u / d).astype(float), (2 * v / d).astype(float)


def argyll_file(path, power):
    """A spectrum as ArgyllCMS reads it: six decimals, no exponent."""
    nm = range(360, 831)
    path.write_text(
        "SPECT   \n\nORIGINATOR \"page\"\nSPECTRAL_BANDS \"471\"\n"
        "SPECTRAL_START_NM \"360.000000\"\nSPECTRAL_END_NM \"830.000000\"\n"
        "SPECTRAL_NORM \"100.000000\"\nNUMBER_OF_FIELDS 471\nBEGIN_DATA_FORMAT\n"
        + " ".join(f"SPEC_{k}" for k in nm) + "\nEND_DATA_FORMAT\nNUMBER_OF_SETS 1\nBEGIN_DATA\n"
        + " ".join(f"{p:.6f}" for p in power) + "\nEND_DATA\n")


def argyll_task(bench):
    """specplot takes spectra: black bodies tinted green or magenta, all in one call."""
    random = numpy.random.default_rng(7)
    locus = Locus()
    tint = numpy.exp(-((locus.metres * 1e9 - 545) / 40) ** 2)
    files, powers = [], []
    for i in range(16):
        kelvins = 1e6 / random.uniform(50, 500)
        power = locus.metres ** -5 / numpy.expm1(C2 / (locus.metres * kelvins))
        power *= 1 + random.uniform(-0.08, 0.08) * tint
        powers.append(numpy.round((100 * power / power.max()).astype(float), 6))
        files.append(bench.work / f"{i}.sp")
        argyll_file(files[-1], powers[-1])
    xyz = numpy.array(powers, numpy.longdouble) @ locus.cmf
    truth = nearest_kelvins(*(xyz[:, :2] / xyz.sum(axis=1, keepdims=True)).T)

    def task():
        before = os.times()
        printed = measure.run(["specplot", "-s", *files])
        after = os.times()
        spent = after.children_user + after.children_system
        seconds = (spent - before.children_user - before.children_system) / len(files)
        answers = [float(x) for x in re.findall(r"CCT = ([0-9.]+)", printed)]
        errors = sorted(float(e) for e in abs(numpy.array(answers) / truth - 1))
        yield measure.Row("ArgyllCMS specplot", "", measure.PUBLIC, [seconds], errors[-1],
                          errors[len(errors) // 2])
    return task


def made(bench):
    figure = measure.Figure(
        key="cct", title="Colour temperature of a chromaticity",
        x_label="processor time of one colour", y_label="worst relative error",
        what="2000 to 20 000 K, |Duv| up to 0.02; truth: the nearest point of the Planckian locus "
             "(CIE 1931, 1 nm, c2 = 1.4388e-2 m K) by brute force in 80 bit numbers. Robertson's "
             "and Ohno's methods are written here from their papers, LittleCMS is called; "
             "ArgyllCMS takes spectra (tinted black bodies), prints six decimals, and also works "
             "out CRI and TLCI.",
        baseline=("lightcal", "side by side"))
    x, y = colors(64 if bench.quick else 1000)
    truth = nearest_kelvins(x, y).astype(float)
    table = bench.write_table("cct.txt", zip(x, y, truth))
    own = {"lightcal"}
    tasks = [measure.program_task(
        [bench.program("lightcal_page_own"), "cct", table],
        lambda method: measure.OWN if method in own else measure.PUBLISHED)]
    public = None if bench.own_only else bench.program("lightcal_page_lcms")
    if figure.takes(public, ("liblcms2-dev", "LittleCMS")):
        tasks.append(measure.program_task([public, table], lambda _: measure.PUBLIC))
    if figure.takes(not bench.own_only and measure.is_there("specplot"), ("argyll", "ArgyllCMS")):
        tasks.append(argyll_task(bench))
    measure.measure(figure, tasks, bench.rounds)
    one, mccamy = figure.row("lightcal", "one by one"), figure.row("McCamy")
    robertson = figure.row("LittleCMS") or figure.row("Robertson")
    figure.sentence = (
        f"Take the exact answer always: it costs {measure.duration(one.median)} "
        f"({measure.duration(figure.base().median)} in a batch) and is wrong by at most "
        f"{measure.off(one.error)}, where {robertson.method} is wrong by up to "
        f"{measure.off(robertson.error)} in {measure.duration(robertson.median)} and McCamy's "
        f"polynomial by up to {measure.off(mccamy.error)} in {measure.duration(mccamy.median)}.")
    return figure
