# SPDX-License-Identifier: Apache-2.0
"""Figure: merging a bracket, by lightcal and its knobs, HDRMerge, pfstools and OpenCV."""
import importlib.machinery
import importlib.util
import json
import pathlib

import numpy

import measure

FRAMES = 7
KNOBS = {
    "as usual": ({}, 1),
    "no frame checks": ({"check_frames": False}, 1),
    "ratios of the labels": ({"measure_ratios": False}, 1),
    "half size": ({"pixel_stride": 2}, 1),
    "quarter size": ({"pixel_stride": 4}, 1),
    "every second frame": ({}, 2),
    "half size, every second frame": ({"pixel_stride": 2}, 2),
}


def side_by_side():
    """merge_side_by_side as a module: it knows how to call everybody and to read their files."""
    path = str(pathlib.Path(__file__).parents[1] / "merge_side_by_side")
    loader = importlib.machinery.SourceFileLoader("merge_side_by_side", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def errors_of(means, truth):
    """Span of the patches, the scale set on one of them, and the median of their errors."""
    ratio = means / truth
    error = ratio / ratio[len(ratio) // 2] - 1
    return float(error.max() - error.min()), float(numpy.median(abs(error)))


def knob_task(bench, tool, name, truth):
    profile_keys, stride = KNOBS[name]
    stride_px = profile_keys.get("pixel_stride", 1)
    profile = bench.work / f"{name.replace(' ', '_').replace(',', '')}.json"
    profile.write_text(json.dumps({"schema": "lightcal.profile/1", "pictures": profile_keys}))
    picture = bench.work / "knob.raw"
    frames = [bench.work / f"f{i}.dng" for i in range(0, FRAMES, stride)]
    command = [str(bench.program("lightcal_page_merge")), str(profile), str(picture),
               *map(str, frames)]

    def task():
        seconds = tool.timed(command)[1]
        size = bench.width // stride_px, bench.height // stride_px
        pixels = numpy.fromfile(picture, numpy.float32).reshape(size[::-1])
        yield measure.Row("lightcal's knobs", name, measure.OWN, [seconds],
                          *errors_of(tool.patch_means(pixels, False), truth))
    return task


def program_task(tool, bench, name, kind, truth):
    command, read = tool.programs(bench.build, bench.work)[name]

    def task():
        seconds = tool.timed(command)[1]
        picture, mosaic = read(bench.width, bench.height)
        yield measure.Row(name, "", kind, [seconds],
                          *errors_of(tool.patch_means(picture, mosaic), truth))
    return task


def made(bench):
    tool = side_by_side()
    bench.width, bench.height = (768, 512) if bench.quick else (6000, 4000)
    figure = measure.Figure(
        key="merge", title="Merging a bracket of seven frames",
        x_label="processor time from files to file", y_label="span of 48 patches' errors",
        what=f"A synthetic bracket of {bench.width} x {bench.height} pixels, 2 EV apart, shutters "
             "off by 3 %, a 1 % knee, unequal pixels, row noise; whole processes, files in memory; "
             "truth: the luminances that made it; each program's scale is set on one patch. "
             "OpenCV gets 8 bit frames, more it does not take.",
        baseline=("lightcal", ""), unordered=["lightcal's knobs"])
    measure.run([bench.program("lightcal_bench_bracket"), bench.work, bench.width, bench.height])
    truth = numpy.loadtxt(bench.work / "truth.txt")
    tasks = [program_task(tool, bench, "lightcal", measure.OWN, truth)]
    knobs = ["half size"] if bench.quick else KNOBS
    tasks += [knob_task(bench, tool, name, truth) for name in knobs]
    for name, program, package, word in (
            ("HDRMerge", "hdrmerge", "hdrmerge", "HDRMerge"),
            ("pfstools", "pfsinme", "pfstools", "pfstools"),
            ("OpenCV Robertson", None, "libopencv-photo-dev", "OpenCV"),
            ("OpenCV Debevec", None, "libopencv-photo-dev", "OpenCV")):
        there = (measure.is_there(program) if program
                 else bench.program("lightcal_bench_opencv_merge") is not None)
        if there and not bench.own_only:
            tasks.append(program_task(tool, bench, name, measure.PUBLIC, truth))
            version = measure.version_of(package, word)
            figure.versions += [version] if version not in figure.versions else []
        else:
            figure.missing.append(name)
    measure.measure(figure, tasks, 2 if bench.quick else 3)
    base, half = figure.base(), figure.row("lightcal's knobs", "half size")
    figure.sentence = (
        f"Merge at half size where patches are what you read: "
        f"{measure.times(base.median / half.median)} faster, and the patches span "
        f"{measure.off(half.error)} instead of {measure.off(base.error)}")
    rival = figure.row("HDRMerge")
    if rival:
        figure.sentence += (f"; HDRMerge takes {measure.times(rival.median / base.median)} "
                            f"lightcal's time and spans {measure.off(rival.error)}")
    figure.sentence += "."
    return figure
