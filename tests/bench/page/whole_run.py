# SPDX-License-Identifier: Apache-2.0
"""Figure: a session of three lights to presets, by `lightcal run` and by a script by hand."""
import json
import math
import pathlib
import shutil

import numpy

import measure

LAMPS = {"bulb": ('kind = "point"\n', 180.0, 0.0),
         "panel": ('kind = "rect"\nsize_m = [0.6, 0.3]\naim = [1, 0, 0]\n', 900.0, 0.018),
         "disk": ('kind = "disk"\ndiameter_m = 0.2\naim = [1, 0, 0]\n', 2500.0, 0.01)}
PROFILES = {  # strictest first: the errors of all are against it
    "strictest": {"effects": "all", "estimator": {"solver": "full", "bounce_patches": 48}},
    "as usual": {},
    "no effects": {"effects": "none"},
    "lamps as points": {"estimator": {"exact_source": False}},
    "coarse walls": {"estimator": {"bounce_patches": 2}},
    "loose solver": {"estimator": {"solver": "loose"}},
    "cheapest": {"effects": "none", "cct_method": "mccamy",
                 "estimator": {"solver": "loose", "reject": False, "leave_one_out": False,
                               "exact_source": False}},
}


def session_text():
    random = numpy.random.default_rng(23)
    text = 'lightcal = 1\nname = "page"\n[room]\nsize_m = [6.0, 5.0, 2.8]\nreflectance = 0.3\n'
    text += '[[meter]]\nname = "m"\nsigma_relative = 0.02\n'
    for name, (keys, _, _) in LAMPS.items():
        text += f'[[light]]\nname = "{name}"\n{keys}'
    for name, (_, intensity, area) in LAMPS.items():
        for i in range(6):
            d = 0.5 * 1.3 ** i
            lux = intensity / ((d + 0.01) ** 2 + area) * math.exp(random.normal(0, 0.02))
            text += (f'[[reading]]\nlight = "{name}"\nmeter = "m"\ndistance_m = {d}\n'
                     f'illuminance_lx = {lux}\nxy = [0.4369, 0.4041]\n')
    return text


def intensities(path):
    lights = json.loads(path.read_text())["lights"]
    def value(light):
        number = light["intensity_cd"]
        return number["value"] if isinstance(number, dict) else number
    return numpy.array([value(light) for light in lights])


def made(bench):
    from merge import side_by_side
    timed = side_by_side().timed
    figure = measure.Figure(
        key="whole_run", title="A session of three lights, from readings to presets",
        x_label="processor time of the whole process",
        y_label="worst relative error of an intensity",
        what="A bulb, a panel and a disk in a room, six readings each. lightcal writes 13 presets "
             "and a report; the script by hand (page/whole_run_by_hand.py: numpy and scipy, point "
             "law with offset and prior, McCamy) writes glTF and CSV. Error: against lightcal's "
             "strictest setting, so that of the strictest is none.",
        baseline=("lightcal run", "as usual"), unordered=["lightcal run"])
    session = bench.work / "session"
    session.mkdir()
    (session / "session.toml").write_text(session_text())
    reference = []

    def own(name):
        profile, out = bench.work / "run.json", bench.work / "out"
        command = [str(bench.lightcal()), "run", str(session), "--profile", str(profile), "-o",
                   str(out), "--quiet"]

        def task():
            profile.write_text(json.dumps({"schema": "lightcal.profile/1", **PROFILES[name]}))
            shutil.rmtree(out, ignore_errors=True)
            seconds = timed(command)[1]
            answer = intensities(out / "light.json")
            if not reference:
                reference.append(answer)
            off = sorted(abs(numpy.log(answer / reference[0])))
            yield measure.Row("lightcal run", name, measure.OWN, [seconds], float(off[-1]),
                              float(off[len(off) // 2]))
        return task

    def by_hand():
        out = bench.work / "by_hand"
        script = pathlib.Path(__file__).with_name("whole_run_by_hand.py")
        seconds = timed(["/usr/bin/python3", "-B", str(script), str(session / "session.toml"),
                         str(out)])[1]
        off = sorted(abs(numpy.log(intensities(out / "light.json") / reference[0])))
        yield measure.Row("numpy and scipy by hand", "point law", measure.PUBLIC, [seconds],
                          float(off[-1]), float(off[len(off) // 2]))

    tasks = [own(name) for name in PROFILES]
    if figure.takes(not bench.own_only and bench.python_has("scipy"), measure.SCIPY):
        tasks.append(by_hand)
    measure.measure(figure, tasks, bench.rounds if bench.quick else 15)
    base, without = figure.base(), figure.row("lightcal run", "no effects")
    least = min(row.median for row in figure.rows if row.kind == measure.OWN)
    saved = max(0.0, 1 - least / base.median)
    figure.sentence = (
        f"Leave `run` as it is: {measure.duration(base.median)} for everything, off by "
        f"{measure.off(base.error)}; no setting saves more than {measure.off(saved)} of that, and "
        f"leaving out the effects moves a lamp by {measure.off(without.error)}")
    hand = figure.row("numpy and scipy by hand")
    if hand:
        figure.sentence += (f"; a script by hand takes {measure.times(hand.median / base.median)} "
                            f"the time and is off by {measure.off(hand.error)}")
    figure.sentence += "."
    return figure
