// SPDX-License-Identifier: Apache-2.0
// What a camera's exposure labels mean. A dial says 1/60 where the shutter makes 2^-6 s: labels are
// rounded by up to 6.7 % (time) and 5.5 % (the square of the aperture number), the mechanism keeps
// to third or half stops.
#pragma once

#include <optional>

#include "lightcal/core/units.h"

namespace lightcal {

// The exposure time that the label stands for: 2^(-k/3) s, or 2^(-k/2) s for the labels only half
// stop dials carry (1/45, 1/90, 1/180, ...). Absent when `label` is no such label (within 0.5 %):
// a time like 1/48 s is meant as it is written.   Holds from 1/32000 s to 30 s.
// Source: APEX (ANSI PH2.5-1960); labels as Canon, Nikon and Sony dials print them.
[[nodiscard]] std::optional<Seconds> TimeOfLabel(Seconds label);

// The label that third stop dials print for a time: the inverse, absent beyond their ends and more
// than 0.5 % off the grid.
[[nodiscard]] std::optional<Seconds> LabelOfTime(Seconds time);

// The f-number N = 2^(k/6), or 2^(k/4) for half stop labels, that the label stands for; absent when
// it is no such label.   Holds from f/1 to f/32.   Source: ISO 517:2008.
[[nodiscard]] std::optional<double> FNumberOfLabel(double label);

// The nearest third or half stop to an APEX value (Tv, Av) within 0.005, the digits APEX tags are
// written with; absent between.
[[nodiscard]] std::optional<double> ApexOnGrid(double apex);

// Illuminance on the sensor falls by (1 + m)^2 when a lens is focused near, m = f/(d - f) being the
// magnification of a subject at distance d from the lens: multiply luminance by it.
// 50 mm at 1 m: 1.108.   Holds for thin lenses of symmetric pupils, d > f.
// Source: ISO 12232:2019, annex A.   Absent: d <= f.
[[nodiscard]] std::optional<double> FocusFactor(Metres focal_length, Metres subject_distance);

}  // namespace lightcal
