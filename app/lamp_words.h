// SPDX-License-Identifier: Apache-2.0
// A lamp in the words of a set: numbers with the digits their interval leaves, stops, what to type.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lightcal/records/engine_answers.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// An angle as a person types it, to a tenth of a degree.
[[nodiscard]] std::string DegreesText(Radians angle);

// What says how bright a light is: intensity, else illuminance, else luminance, else flux.
struct Strength {
  const Uncertain* value = nullptr;
  std::string_view unit;
};
[[nodiscard]] Strength StrengthOf(const FittedLight& light);

// As many significant digits, the rest zeros: 39926 of three is 39900.
[[nodiscard]] std::string Rounded(double value, int digits);
// Value and ends with the digits that the interval leaves: "46", "36 … 59".
[[nodiscard]] std::string ValueText(const Uncertain& u);
[[nodiscard]] std::string RangeText(const Uncertain& u);

// "501 cd ± 12 %" where the interval is even about the value, "45 cd, 20 … 67" where it is not.
[[nodiscard]] std::string ValueAndInterval(const Uncertain& u, std::string_view unit);

// "2900 ± 60 K", "2900 K, 2500 … 3700" where it is not even.
[[nodiscard]] std::string KelvinText(const Uncertain& cct);

// The upper end of its interval, two digits: what "below" an upper limit names.
[[nodiscard]] std::string UpperEndText(const Uncertain& u);

// "± 0.37 stop"; "" where the interval reaches down to 0.
[[nodiscard]] std::string StopsText(const Uncertain& u);
[[nodiscard]] std::string StopsText(double stops);
// ".37"
[[nodiscard]] std::string BareStops(double stops);
// "look-dev" of an interval of so many stops; "" = of nothing yet.
[[nodiscard]] std::string EnoughFor(double stops);

// "Blender 1.61 W · Unity, glTF 87 cd + colour": three digits, engines of one number together.
[[nodiscard]] std::string TypeIn(const std::vector<EngineFigure>& figures);
// "Blender Spot Size 46.4°, Blend 0.65 · Unreal Inner Cone Angle 15°, Outer Cone Angle 25°"; "" of
// what is no spot.
[[nodiscard]] std::string Cones(const std::vector<EngineFigure>& figures);
[[nodiscard]] bool HasColor(const EngineFigure& figure);

// Words of a line behind a label of its own column, broken at 100 columns.
[[nodiscard]] std::string LabelledLine(const std::string& label, const std::string& text);

}  // namespace lightcal::app
