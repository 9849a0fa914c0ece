// SPDX-License-Identifier: Apache-2.0
// Parts of JSON documents that several exporters write.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/presets/derived_light.h"
#include "lightcal/presets/preset.h"
#include "lightcal/presets/preset_light.h"
#include "lightcal/presets/rig.h"
#include "lightcal/records/document.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// -0 is written 0.
template <std::size_t N>
[[nodiscard]] records::Node NodeOf(const std::array<double, N>& values) {
  return records::Node::List(values, [](double v) { return records::Node(v == 0.0 ? 0.0 : v); });
}
[[nodiscard]] records::Node NodeOf(const Rgb& color);
[[nodiscard]] records::Node NodeOf(const RigExposure& exposure);
// In the frame the rig is given in.
[[nodiscard]] records::Node NodeOf(const Rig& rig);
[[nodiscard]] records::Node NodeOf(const Provenance& provenance);
// Absent where there is none.
[[nodiscard]] records::Node NodeOf(const std::optional<Uncertain>& value);

// What an engine multiplies with: the lamp's colour at most 1; white of a picture, which has its
// own.
[[nodiscard]] records::Node ColorNode(const PresetLight& light);

// What a person who opens the file in an engine can still read of the measurement.
[[nodiscard]] records::Node MeasuredNode(const FittedLight& lamp, const PresetLight& light);

// The numbers of an exported light, for audit: those of its members that are one or up to four.
[[nodiscard]] DerivedLight DerivedFrom(const records::Node& light);

// The rig in an engine's axes: every place and direction through `map`, which is linear.
[[nodiscard]] Rig Turned(Rig rig, Vec3 (*map)(const Vec3&));

// Indented text with a final newline; empty of figures alone.   Fails: not_finite, rather than
// write null for a number.
[[nodiscard]] Result<std::string> JsonText(const records::Node& document,
                                           const std::string& subject,
                                           Written written = Written::kAll);

}  // namespace lightcal
