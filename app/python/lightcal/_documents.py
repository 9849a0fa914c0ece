# SPDX-License-Identifier: Apache-2.0
"""What answers hold: the JSON documents of the command line (light.json is described by
light.schema.json), as dicts. A key whose value does not apply is absent. Units stand in the names;
angles of cones are half angles."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Literal, TypedDict, Union

if TYPE_CHECKING:
    import numpy
    import numpy.typing

    Samples = numpy.typing.NDArray[numpy.float32]


class Uncertain(TypedDict, total=False):
    """value ± u95 holds the truth 95 times of 100; low95 and high95 where the interval is not even."""

    value: float
    u95: float
    low95: float
    high95: float


class Remark(TypedDict):
    """What the answer survives but a person should know."""

    code: str
    subject: str
    message: str


class Cone(TypedDict, total=False):
    """Half angles of a spot in degrees."""

    inner_deg: float
    outer_deg: float
    inner_u95_deg: float
    outer_u95_deg: float


class ColorMeter(TypedDict):
    """The one named instrument that read a colour; 1 sigma of what it is off by in x and in y."""

    name: str
    sigma_xy: float


class FittedColor(TypedDict, total=False):
    """CIE 1931 xy; correlated colour temperature and Duv of CIE 1960 uv."""

    cct_K: Uncertain
    duv: float
    duv_u95: float
    duv_low95: float
    duv_high95: float
    xy: List[float]
    meter: ColorMeter


class Fit(TypedDict, total=False):
    """How readings and model agree; `rejected` are 0-based indices of the light's readings."""

    readings: int
    used: int
    rejected: List[int]
    rms_relative: float
    chi2_dof: float
    degrees_of_freedom: int
    leave_one_out: float
    condition: float
    learned: List[str]
    prior: List[str]


class Light(TypedDict, total=False):
    """One lamp. E = I / (d + d0)^2 + E0: intensity_cd is I on the axis, distance_offset_m is d0,
    ambient_lx is E0; flux_lm is the integral of the model over all directions."""

    name: str
    kind: Literal["directional", "point", "spot", "sphere", "disk", "rect", "tube", "photometric",
                  "dome"]
    intensity_cd: Uncertain
    flux_lm: Uncertain
    illuminance_lx: Uncertain
    luminance_nits: Uncertain
    distance_offset_m: Uncertain
    ambient_lx: Uncertain
    cone: Cone
    diameter_m: float
    angular_diameter_deg: float
    width_m: float
    height_m: float
    length_m: float
    radius_m: float
    position_m: List[float]
    position_u95_m: List[float]
    aim: List[float]
    axis: List[float]
    aim_u95_deg: float
    color: FittedColor
    environment: Dict[str, Any]
    beam: Dict[str, Any]
    distribution: Dict[str, Any]
    fit: Fit
    effects: List[Dict[str, Any]]
    budget: List[Dict[str, Any]]
    residuals: List[Dict[str, Any]]
    covariance_lnI_d0_E0: List[float]
    meter: Dict[str, Any]
    of_file: Uncertain
    in_room: List[Dict[str, Any]]
    located: Dict[str, Any]
    uneven: Dict[str, Any]
    spectrum: Dict[str, Any]
    state: Dict[str, Union[float, str]]
    states: List[Dict[str, Any]]
    emitters: Dict[str, Any]


class LightDocument(TypedDict, total=False):
    """A light.json."""

    schema: str
    lights: List[Light]
    provenance: Dict[str, Any]
    warnings: List[Remark]


class RunAnswer(LightDocument, total=False):
    """next_steps: what to measure next, a sentence a lamp; files: what was written."""

    next_steps: Dict[str, str]
    files: List[str]


class Prediction(TypedDict, total=False):
    """What the lamp alone gives at a distance, and what a meter there would read."""

    distance_m: float
    model_lx: Uncertain
    reading_lx: Uncertain
    in_room_lx: Uncertain
    in_room_reading_lx: Uncertain
    walls_lx: Uncertain


class TypeIn(TypedDict, total=False):
    """What to type into one engine; note: its colour, and what else to set."""

    engine: str
    field: str
    value: str
    unit: str
    note: str


class QuickAnswer(LightDocument, total=False):
    """One lamp; predictions: one a distance asked for; type_in: one an engine."""

    next_step: str
    type_in: List[TypeIn]
    through: Dict[str, Any]
    predictions: List[Prediction]
    minutes: List[Dict[str, Any]]


class ColorAnswer(TypedDict, total=False):
    """One colour: CIE 1931 xy, 1960 uv, 1976 u'v'; rgb: linear, at luminance Y = 1, by space. Of a
    file of several spectra only `spectra`."""

    name: str
    xy: List[float]
    uv1960: List[float]
    uv1976: List[float]
    cct_K: float
    duv: float
    cct_valid: bool
    cct_status: str
    rgb: Dict[str, List[float]]
    XYZ: List[float]
    illuminance_lx: float
    ler_lm_per_W: float
    melanopic: Dict[str, float]
    cri: Dict[str, Any]
    cie2017_rf: float
    tm30: Dict[str, Any]
    tm30_2015: Dict[str, Any]
    ssi: Any
    tlci: Dict[str, Any]
    reported: Dict[str, Any]
    through: Dict[str, Any]
    uncertainty: Dict[str, Any]
    spectral_error: Dict[str, Any]
    rgb_gamut: Dict[str, Any]
    rgb_white: Any
    engines: Any
    adobe: Any
    refused: str
    spectra: List[ColorAnswer]
    warnings: List[Remark]


class MergeAnswer(TypedDict, total=False):
    """luminance: (height, width) in cd/m2, or (height, width, 3) RGB of the space asked for, whose
    (1, 1, 1) is 1 cd/m2; sigma: (height, width), one standard deviation of the luminance in cd/m2."""

    luminance: Samples
    sigma: Samples
    frames: List[Dict[str, Any]]
    scale: Dict[str, Any]
    clipped_fraction: float
    noise: Dict[str, Any]
    crop: List[int]
    masked_pixels: int
    camera: Dict[str, Any]
    width: int
    height: int
    warnings: List[Remark]


class ExportAnswer(TypedDict, total=False):
    """files: names, or paths where they were written; contents: of each, where they were not;
    paste: what to type into an engine to open them."""

    files: List[str]
    contents: Dict[str, bytes]
    paste: List[str]
    warnings: List[Remark]
