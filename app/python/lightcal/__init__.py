# SPDX-License-Identifier: Apache-2.0
"""lightcal: measure real lamps, bring them into renderers, and say how sure it is.

    import lightcal
    lamp = lightcal.quick("192lx@0.5m", "52lx@1m,card=5lx", cct=2900)
    lamp["lights"][0]["intensity_cd"]            # {"value": 46.8, "u95": 5.9, ...}
    lightcal.export(lamp, to=["blender", "unreal"], output="presets")

Every function answers with the document that the command of its name prints with --json, as plain
dicts, and with numpy arrays where there are pixels. Values are SI numbers or texts with their unit
("20in", "17.8fc", "1/60"). Nothing is written unless `output` names a folder, and nothing of yours
is overwritten. Other Python threads run while a function works.

A question without an answer raises lightcal.Error(kind, code, subject, message); what an answer
survives is a lightcal.DataWarning and stands in the answer under "warnings".
"""
from __future__ import annotations

import json as _json
import os as _os
import warnings as _warnings
from typing import (TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Sequence, Tuple,
                    Union, cast)

from . import _native
from ._documents import (ColorAnswer, ExportAnswer, Light, LightDocument, MergeAnswer, QuickAnswer,
                         Remark, RunAnswer, Uncertain)
from ._error import DataWarning, Error

if TYPE_CHECKING:
    _Path = Union[str, _os.PathLike[str]]

__all__ = ["run", "quick", "color", "merge", "export", "Error", "DataWarning", "RunAnswer",
           "QuickAnswer", "ColorAnswer", "MergeAnswer", "ExportAnswer", "LightDocument", "Light",
           "Uncertain", "Remark"]
__version__ = _native.generator.split()[-1]

Value = Union[str, float]  # "0.5m", "20in", or SI
Targets = Union[str, Iterable[str]]
Reading = Union[str, Mapping[str, float]]


def _said(answer: Dict[str, Any]) -> Dict[str, Any]:
    for remark in answer.get("warnings", []):
        where = f"{remark['subject']}: " if remark["subject"] else ""
        _warnings.warn(where + remark["message"], DataWarning, stacklevel=3)
    return answer


def _words(to: Targets) -> List[str]:
    return [word for word in to.split(",") if word] if isinstance(to, str) else list(to)


def _number(where: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise Error("usage", "usage", where, f"{value!r} is no number") from None


def _anchor(anchor: Sequence[float]) -> str:
    if len(anchor) != 5:
        raise Error("usage", "usage", "anchor", "takes x, y, width, height in pixels, and cd/m2")
    *sides, nits = (_number("anchor", value) for value in anchor)
    if not all(side.is_integer() for side in sides):
        raise Error("usage", "usage", "anchor", "x, y, width and height are whole pixels")
    return ",".join(str(int(side)) for side in sides) + f"={nits!r}"


def _typed(reading: Reading) -> str:
    if isinstance(reading, str):
        return reading
    units = {"card_lx": ("card=", "lx"), "off_lx": ("off=", "lx"), "angle_deg": ("", "deg"),
             "cct_K": ("", "K")}
    known = {"illuminance_lx", "distance_m", *units}
    for key in reading:
        if key not in known:
            raise Error("usage", "usage", key, f"a reading holds {', '.join(sorted(known))}")
    for key in ("illuminance_lx", "distance_m"):
        if key not in reading:
            raise Error("usage", "usage", "readings", f"a reading needs {key}")
    lux, metres = (_number(key, reading[key]) for key in ("illuminance_lx", "distance_m"))
    text = f"{lux!r}lx@{metres!r}m"
    for key, (before, unit) in units.items():
        if key in reading:
            text += f",{before}{_number(key, reading[key])!r}{unit}"
    return text


def run(session: _Path, *, to: Targets = (), output: Optional[_Path] = None,
        tol: Optional[Value] = None, effects: Optional[str] = None, monte_carlo: bool = False,
        full_angles: bool = False, profile: Optional[_Path] = None, rig: bool = False,
        force: bool = False, allow_outside: bool = False,
        lights: Union[None, str, Iterable[str]] = None,
        without: Union[None, str, Iterable[str]] = None) -> RunAnswer:
    """Fits every lamp of a session (a folder with session.toml, or a .toml file).

    E = I / (d + d0)^2 + E0 on the axis of a point (lux, candela, metres; CIE S 017 "inverse square
    law"), and each other kind by its own model; intervals are 95 %.

    to, output     with `output` a folder: light.json, report.html and the presets named by `to`
                   (all of them where it is empty) are written there; without it nothing is written
    tol            what effects may be left out together, relative [.01]
    effects        "auto", "all", "none", or "+name,-name"
    monte_carlo    intervals by sampling (JCGM 101) instead of the covariance
    full_angles    the session's cone angles are full angles
    profile        a profile.json of `lightcal tradeoff`
    allow_outside  the session may name files outside of its folder
    lights         only these of its lights, a list or "key,fill"
    without        all but these, such as those that cannot be fitted

    Raises Error: "underdetermined", "not_found", "outside_session", "exists" and others.
    """
    given = dict(to=_words(to), output=output, tol=tol, effects=effects, monte_carlo=monte_carlo,
                 full_angles=full_angles, profile=profile, rig=rig, force=force,
                 allow_outside=allow_outside, lights=_words(lights or ()),
                 without=_words(without or ()))
    return cast(RunAnswer, _said(_native.run(_os.fspath(session), given)))


def quick(*readings: Reading, name: str = "light", kind: Optional[str] = None,
          cct: Optional[Value] = None, fixture: Optional[str] = None,
          room: Union[None, str, Sequence[float]] = None, meter: Optional[Value] = None,
          sigma: Optional[Value] = None, diameter: Optional[Value] = None,
          size: Optional[str] = None, length: Optional[Value] = None,
          radius: Optional[Value] = None, inner: Optional[Value] = None,
          outer: Optional[Value] = None, full_angles: bool = False,
          lumens: Optional[Value] = None, beam: Optional[Value] = None,
          field: Optional[Value] = None, watts: Optional[Value] = None,
          at: Union[None, Value, Sequence[Value]] = None, gel: Optional[str] = None,
          gels: Optional[_Path] = None, spectrum: Optional[_Path] = None,
          plan: bool = False) -> QuickAnswer:
    """One lamp from typed readings, or from a data sheet's figures; no session needed.

    readings  "192lx@0.5m", "17.8fc@20in", "52lx@1m,card=5lx" (with a card in the direct beam),
              ",off=2lx" (lamp off), ",15deg" (off the axis); or dicts of illuminance_lx, distance_m
              and, where known, card_lx, off_lx, angle_deg, cct_K
    kind      point, spot, sphere, disk, rect, tube, directional
    cct       colour temperature in kelvin
    fixture   how the lamp is built: bulb, cob_bare, reflector, fresnel, panel, softbox, luminaire
    room      (5, 4, 2.6) in metres, with the walls' reflectance as a fourth; "dark"; "outdoors"
    meter     "phone", "hobby", "lab", or the maker's share at 95 %, "3%" or .03
    sigma     one standard deviation of a reading instead, relative
    lumens, beam, field, watts   a data sheet's figures (full angles in degrees): priors
    at        distances in metres to predict a meter's reading at
    plan      what the next minutes of measuring buy, under "minutes"

    E = I / (d + d0)^2 + E0, fitted with priors of the fixture and the room; intervals are 95 %.
    Raises Error: "usage" for what cannot be read, "underdetermined" and others.
    """
    if room is not None and not isinstance(room, str):
        room = ",".join(repr(float(side)) for side in room)
    given = dict(name=name, kind=kind, cct=cct, fixture=fixture, room=room, meter=meter,
                 sigma=sigma, diameter=diameter, size=size, length=length, radius=radius,
                 inner=inner, outer=outer, full_angles=full_angles, lumens=lumens, beam=beam,
                 field=field, watts=watts, at=at, gel=gel, gels=gels, spectrum=spectrum, plan=plan)
    return cast(QuickAnswer, _said(_native.quick([_typed(one) for one in readings], given)))


def color(*, xy: Optional[Tuple[float, float]] = None,
          xyz: Optional[Tuple[float, float, float]] = None, cct: Optional[Value] = None,
          duv: Optional[float] = None, locus: str = "planck", spectrum: Optional[_Path] = None,
          column: Union[None, int, str] = None, through: Optional[str] = None,
          gels: Optional[_Path] = None, sigma: Optional[Value] = None,
          white: Optional[str] = None, gamut: str = "keep", sampling: str = "auto",
          engines: bool = False, adobe: bool = False, tlci: bool = False) -> ColorAnswer:
    """One colour: CIE 1931 xy, CIE 1976 u'v', CCT and Duv, linear RGB in four spaces; of a spectrum
    also XYZ, efficacy, CRI (CIE 13.3), Rf (CIE 224), TM-30, SSI, melanopic DER (CIE S 026).

    Give one of
    xy        CIE 1931 chromaticity
    xyz       tristimulus values
    cct       kelvin, on the Planckian locus (`duv` off it) or the daylight `locus`
    spectrum  a spectrometer's export or a table; "illuminant:FL11", "led:4000", "gaussian:530:30"

    column    which spectrum of the file, by name or number from 1; without it all are answered
              under "spectra" where there are several
    through   a gel or a stack of `gels` before the lamp
    sigma     one standard deviation of X, Y and Z each, relative: adds "uncertainty"

    CCT is valid for |Duv| <= .05 and from 1000 K. Raises Error: "bad_chromaticity", "no_spectrum" ...
    """
    given = dict(xy=xy, xyz=xyz, cct=cct, duv=duv, locus=locus, spectrum=spectrum, column=column,
                 through=through, gels=gels, sigma=sigma, white=white, gamut=gamut,
                 sampling=sampling, engines=engines, adobe=adobe, tlci=tlci)
    return cast(ColorAnswer, _said(_native.color(given)))


def merge(frames: Union[_Path, Iterable[_Path]], *, sigma: bool = True,
          exposures: Optional[Sequence[Value]] = None, f_number: Optional[Value] = None,
          t_stop: Optional[Value] = None, iso: Optional[float] = None,
          anchor: Union[None, str, Tuple[int, int, int, int, float]] = None,
          anchor_sigma: Optional[Value] = None, noise: Optional[Tuple[float, float]] = None,
          space: Optional[str] = None, white: Optional[str] = None,
          camera: Optional[_Path] = None, nd: Optional[str] = None,
          lamp_class: Optional[str] = None, no_flat: bool = False, cos4: Optional[Value] = None,
          align: str = "off", mains: Optional[str] = None,
          pwm: Optional[str] = None) -> MergeAnswer:
    """A bracket of frames (RAW, DNG, EXR, HDR, TIFF, PNG, JPEG; wildcards) -> luminance.

    L = (code - black) / exposure, each pixel the mean of all frames where it is not clipped,
    weighted by the variance that the sensor's noise leaves (cd/m2; ISO 12232 gives the scale where
    no `anchor` or `camera` does).

    answer["luminance"]  float32, (height, width) in cd/m2, or (height, width, 3) with `space`
    answer["sigma"]      float32, (height, width), one standard deviation in cd/m2, unless sigma=False
    Both own their samples; none is copied.

    exposures   seconds, or texts as "1/60", in the order of the files [from the files]
    anchor      a luminance meter's reading of pixels, (x, y, width, height, cd/m2)
    camera      a camera.json of `lightcal camera`
    noise       (scale, offset) of Var(x) = scale x + offset, x = 1 at full scale

    Raises Error: "no_exposure_metadata", "all_saturated", "bad_anchor" and others.
    """
    several: Iterable[_Path]
    several = [frames] if isinstance(frames, (str, _os.PathLike)) else frames
    if anchor is not None and not isinstance(anchor, str):
        anchor = _anchor(anchor)
    given = dict(exposures=exposures, f_number=f_number, t_stop=t_stop, iso=iso, anchor=anchor,
                 anchor_sigma=anchor_sigma, noise=noise, space=space, white=white, camera=camera,
                 nd=nd, lamp_class=lamp_class, no_flat=no_flat, cos4=cos4, align=align,
                 mains=mains, pwm=pwm)
    names = [_os.fspath(frame) for frame in several]
    return cast(MergeAnswer, _said(_native.merge(names, sigma, given)))


def export(lights: Union[_Path, Mapping[str, Any]], to: Targets = (), *,
           output: Optional[_Path] = None, stem: str = "lights",
           states: Union[None, str, Sequence[str]] = None, space: Optional[str] = None,
           white: Optional[str] = None, range: Optional[Value] = None,
           spots: Optional[str] = None, renderer: Optional[str] = None,
           engine: Optional[_Path] = None, into: Optional[_Path] = None, rig: bool = False,
           force: bool = False) -> ExportAnswer:
    """Lights as the files of engines.

    lights  what run() or quick() answered (its presets are named after `stem`), or a path: a
            light.json, a preset.json, a session that was run
    to      "gltf,usd,unreal,unity,godot,blender,filament,three,mitsuba,pbrt,ies,ldt,json" or a
            list of them; all where it is empty
    output  a folder to write them to; without it they are the answer's "contents", as bytes
    states  lamps at states of their controls, "key:dimmer=18,cct_K=4500"
    into    sets lights that are in your scene, by a pattern of names or a map.csv
    engine  an engine.json of `lightcal engine learn`

    Raises Error: "usage", "exists", "no_states" and others.
    """
    given = dict(to=_words(to), states=states, space=space, white=white, range=range, spots=spots,
                 renderer=renderer, engine=engine, into=into, rig=rig, force=force)
    path, document = "", ""
    if isinstance(lights, Mapping):
        kept = {key: lights[key] for key in ("schema", "lights", "provenance") if key in lights}
        document = _json.dumps(kept, allow_nan=False)
    else:
        path = _os.fspath(lights)
    folder = "" if output is None else _os.fspath(output)
    return cast(ExportAnswer, _said(_native.export(path, document, stem, folder, given)))
