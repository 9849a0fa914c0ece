// SPDX-License-Identifier: Apache-2.0
// Pieces of text that several exporters write.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "lightcal/presets/preset.h"
#include "lightcal/presets/preset_light.h"

namespace lightcal::preset_text {

// "1, 2.5, 3": shortest numbers that read back the same.
[[nodiscard]] std::string Numbers(std::span<const double> values, std::string_view between = ", ");

// Between double quotes: backslash, quote and control characters escaped as C and Python read them.
[[nodiscard]] std::string Quoted(std::string_view text);

// Letters, digits and underscores, no digit first, not in `taken` yet (and then in it).
[[nodiscard]] std::string Identifier(std::string_view name, std::set<std::string>& taken);

// What begins the name of a preset itself: <stem>, of a rig <stem>.rig. Files beside it, which both
// name, go by <stem>.
[[nodiscard]] std::string SceneStem(const std::string& stem, const PresetOptions& options);

// A file's name as a relative URI.
[[nodiscard]] std::string UriOf(const std::string& name);

// A file as USD's text names it: between @, or between @@@ where the name holds an @, with a
// backslash before an @@@ of its own.   Source: OpenUSD, Sdf text file format, asset paths.
[[nodiscard]] std::string UsdAssetPath(const std::string& path);

// "lightcal 0.1.0"
[[nodiscard]] std::string GeneratorOf(const LightFile& file);

// For engines whose colours are Rec. 709 only: the same options in that space, with the warning
// space_unsupported when another was asked for.
[[nodiscard]] PresetOptions InRec709(PresetOptions options, std::string_view engine,
                                     Warnings& warnings);

// <stem>-<light>.hdr (or .exr, .pfm) of a dome's picture as an engine of that colour gets it, with
// a warning of what had to be cut (picture_cut).
enum class PictureEncoding : std::uint8_t { kRadiance, kOpenExr, kEqualAreaSquare };
[[nodiscard]] PresetFile PictureFileOf(const PresetLight& light, const std::string& stem,
                                       const PresetOptions& options, PictureEncoding encoding,
                                       Warnings& warnings);
// Where engines take half floats: what is brighter than they hold is said (picture_cut).
void WarnOfHalfFloats(const PresetLight& light, std::string_view engine, Warnings& warnings);

// Where engines light matt surfaces by nine harmonics of a picture (PanoramaLaw): by how much those
// stray from it on the plane where they do most, above 1 % (panorama_harmonics).
void WarnOfHarmonics(const std::string& light, const EnvironmentPicture& picture,
                     Warnings& warnings);

// width and height of a rectangle, else the radius, and the length of a tube, for audit.
void PutSize(const PresetLight& light, DerivedLight& derived);

// What a light does otherwise than the lamp, as one line of a comment; "" = nothing.
[[nodiscard]] std::string SubstitutionNote(const DerivedLight& derived);

// Fails: not_finite, rather than write "inf" or "nan".
[[nodiscard]] Result<void> CheckFinite(const DerivedLight& light, const std::string& subject);

}  // namespace lightcal::preset_text
