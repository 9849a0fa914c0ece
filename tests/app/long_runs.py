#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sessions of many readings and many states: what they cost, what a person sees meanwhile, and how
soon they end when they are told to.

    long_runs.py LIGHTCAL
"""
import json
import os
import pathlib
import pty
import resource
import select
import signal
import subprocess
import sys
import time

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from built_command import HOME, LIGHTCAL, answer  # noqa: E402


def session(folder, distances, lux, sigmas):
    text = ('lightcal = 1\n[room]\ndark = true\n'
            '[[light]]\nname = "key"\nkind = "point"\nfixture = "bulb"\n')
    for d, e, sigma in zip(distances, lux, sigmas):
        text += (f'[[reading]]\nlight = "key"\ndistance_m = {d:.6g}\nilluminance_lx = {e:.9g}\n'
                 f'sigma_relative = {sigma:.9g}\n')
    (HOME / folder).mkdir()
    (HOME / folder / "session.toml").write_text(text)
    return folder


def processor_seconds(*words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    document = answer(*words)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime, document


def samples_of_many_readings_cost_as_those_of_their_means():
    random = np.random.default_rng(11)
    places = np.array([0.5, 1.0, 2.0, 4.0])
    each, sigma = 100, 0.05
    distances = np.repeat(places, each)
    lux = 500.0 / (distances + 0.02)**2 * np.exp(sigma * random.standard_normal(distances.size))
    # The mean of ln E of each place says of the lamp all that its readings do.
    means = np.exp(np.log(lux).reshape(4, each).mean(axis=1))
    session("many", distances, lux, np.full(distances.size, sigma))
    session("means", places, means, np.full(4, sigma / np.sqrt(each)))
    many_s, many = processor_seconds("fit", "many", "--monte-carlo", "-o", "many.json")
    means_s, means = processor_seconds("fit", "means", "--monte-carlo", "-o", "means.json")
    one, other = (d["lights"][0]["intensity_cd"] for d in (many, means))
    half = (one["high95"] - one["low95"]) / 2
    for key in ("low95", "value", "high95"):
        # Two digits of a standard deviation, of two sets of draws; and the readings' own scatter,
        # which the means no longer show (Birge).
        assert abs(one[key] - other[key]) < 0.15 * half, (key, one, other)
    # 100 times the readings; each draw once cost as much as there are.
    assert many_s < 5.0 * means_s + 1.0, (many_s, means_s)


def a_signal_ends_a_study_at_once():
    random = np.random.default_rng(12)
    distances = np.exp(random.uniform(np.log(0.5), np.log(4.0), 2000))
    lux = 500.0 / (distances + 0.02)**2 * np.exp(0.05 * random.standard_normal(2000))
    session("long", distances, lux, np.full(2000, 0.05))
    for sent in (signal.SIGTERM, signal.SIGINT):
        study = subprocess.Popen([LIGHTCAL, "tradeoff", "long", "-o", "study"], cwd=HOME,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        time.sleep(2.0)
        assert study.poll() is None, "too quick to be told"
        told = time.monotonic()
        study.send_signal(sent)
        said = study.communicate(timeout=60)[1]
        assert time.monotonic() - told < 1.0, sent
        # Before the study, while the session is fitted once, as any command.
        stopped = study.returncode == 1 and "stopped; nothing was written" in said
        assert stopped or study.returncode == -sent, said
        assert not (HOME / "study").exists()


def a_terminal_is_told_how_far(words, what, within_s=30.0):
    parent, child = pty.openpty()
    run = subprocess.Popen([LIGHTCAL, *words], cwd=HOME, stdout=subprocess.DEVNULL, stderr=child)
    os.close(child)
    said, end = b"", time.monotonic() + within_s
    while b"%" not in said and time.monotonic() < end:
        if select.select([parent], [], [], 0.1)[0]:
            try:
                said += os.read(parent, 4096)
            except OSError:  # it ended
                break
    run.kill()
    run.wait()
    os.close(parent)
    assert f"{what} ".encode() in said and b" %" in said, said


def many_lamps(name, count):
    session("one", [0.5, 1.0], [400.0, 100.0], [0.01, 0.01])
    document = answer("fit", "one")
    [lamp] = document["lights"]
    document["lights"] = [{**lamp, "name": f"lamp {i}"} for i in range(count)]
    (HOME / name).write_text(json.dumps({k: v for k, v in document.items() if k != "warnings"}))


samples_of_many_readings_cost_as_those_of_their_means()
a_signal_ends_a_study_at_once()
a_terminal_is_told_how_far(["fit", "long", "--monte-carlo", "-o", "l.json"], "sampling intervals")
many_lamps("set.json", 12000)
a_terminal_is_told_how_far(["export", "set.json", "-o", "presets"], "writing presets")
