// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/core/file_name.h"
#include "lightcal/core/file_stem.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/half_range.h"
#include "lightcal/presets/environment_files.h"

namespace lightcal::preset_text {

std::string Numbers(std::span<const double> values, std::string_view between) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += between;
    text += ShortestText(values[i]);
  }
  return text;
}

std::string Quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20U || c == 0x7f;
    if (c == '"' || c == '\\') out += '\\';
    out += control ? ' ' : c;
  }
  return out + "\"";
}

std::string Identifier(std::string_view name, std::set<std::string>& taken) {
  std::string out;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    if (digit && out.empty()) out += '_';
    out += letter || digit ? c : '_';
  }
  if (out.empty()) out = "_";
  while (!taken.insert(out).second) out += '_';
  return out;
}

std::string UriOf(const std::string& name) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string uri;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || c == '.';
    if (plain) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += {'%', kHex[byte >> 4U], kHex[byte & 15U]};
  }
  return uri;
}

std::string UsdAssetPath(const std::string& path) {
  constexpr std::string_view kDelimiter = "@@@";
  if (path.find('@') == std::string::npos) return "@" + path + "@";
  std::string escaped;
  for (std::size_t i = 0; i < path.size();) {
    const bool delimiter = std::string_view(path).substr(i).starts_with(kDelimiter);
    escaped += delimiter ? "\\@@@" : std::string(1, path[i]);
    i += delimiter ? kDelimiter.size() : 1;
  }
  return std::string(kDelimiter) + escaped + std::string(kDelimiter);
}

std::string GeneratorOf(const LightFile& file) {
  return file.provenance.generator.empty() ? "lightcal" : file.provenance.generator;
}

PresetOptions InRec709(PresetOptions options, std::string_view engine, Warnings& warnings) {
  if (options.color.space == RgbSpace::kSrgb) return options;
  options.color.space = RgbSpace::kSrgb;
  warnings.push_back({"space_unsupported", std::string(engine),
                      "it does not know that space for its lights: written in Rec. 709"});
  return options;
}

PresetFile PictureFileOf(const PresetLight& light, const std::string& stem,
                         const PresetOptions& options, PictureEncoding encoding,
                         Warnings& warnings) {
  constexpr double kNothing = 1e-3;
  const std::string space = options.color.space == RgbSpace::kSrgb
                                ? ""
                                : "-" + std::string(RgbSpaceWord(options.color.space));
  struct Way {
    const char* ending;
    EncodedPicture (*encode)(const EnvironmentPicture&, const ColorTarget&);
  };
  constexpr Way kWays[] = {{".hdr", RadianceFile}, {".exr", ExrFile}, {".pfm", EqualAreaSquare}};
  const Way& way = kWays[static_cast<std::size_t>(encoding)];
  PresetFile file{stem + "-" + FileNamePart(light.name()) + space + way.ending, ""};
  if (options.written != Written::kAll) return file;
  EncodedPicture encoded = way.encode(*light.environment, options.color);
  if (encoded.cut_below > kNothing) {
    warnings.push_back({"picture_cut", light.name(),
                        RoundedText(100.0 * encoded.cut_below, 2) +
                            " % of the picture's light is of colours that " +
                            std::string(RgbSpaceWord(options.color.space)) +
                            " has not; a wider {color.space} keeps them"});
  }
  file.contents = std::move(encoded.bytes);
  return file;
}

void WarnOfHalfFloats(const PresetLight& light, std::string_view engine, Warnings& warnings) {
  double beyond = 0.0, whole = 0.0;
  const EnvironmentPicture& picture = *light.environment;
  for (int y = 0; y < picture.height; ++y) {
    const double zenith = std::numbers::pi * (y + 0.5) / picture.height;
    for (int x = 0; x < picture.width; ++x) {
      const float* p = picture.rgb.data() +
                       3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(x));
      const double top = std::max({p[0], p[1], p[2]});
      whole += std::sin(zenith) * top;
      beyond += std::sin(zenith) * std::max(0.0, top - kLargestHalf);
    }
  }
  if (!(beyond > 1e-4 * whole)) return;
  warnings.push_back(
      {"picture_cut", light.name(),
       RoundedText(100.0 * beyond / whole, 2) +
           " % of the picture's light is brighter "
           "than the half floats of " +
           std::string(engine) +
           " hold (65504 cd/m2) and is cut there; take the lamps out of the dome, so "
           "that they are lights"});
}

void WarnOfHarmonics(const std::string& light, const EnvironmentPicture& picture,
                     Warnings& warnings) {
  constexpr double kSaid = 0.01;
  constexpr int kDigits = 3;
  const HarmonicsError worst = WorstOfHarmonics(picture);
  const double off = worst.relative();
  if (std::abs(off) < kSaid) return;
  std::string facing;
  for (const double v : worst.normal) {
    facing += (facing.empty() ? "" : ", ") + RoundedText(std::abs(v) < 5e-3 ? 0.0 : v, 2);
  }
  warnings.push_back({"panorama_harmonics", light,
                      "matt surfaces get nine harmonics of the picture, at worst " +
                          RoundedText(100.0 * std::abs(off), 2) + " % too " +
                          (off < 0.0 ? "little" : "much") + ": facing (" + facing + "), Z up, " +
                          RoundedText(worst.harmonic_lx, kDigits) + " of its " +
                          RoundedText(worst.own_lx, kDigits) +
                          " lx. A lamp or a sun left in the picture does that: take it out as a "
                          "light",
                      std::abs(off)});
}

void PutSize(const PresetLight& light, DerivedLight& derived) {
  if (light.form == LightForm::kRect) {
    derived.Put("width", light.width_m);
    derived.Put("height", light.height_m);
    return;
  }
  derived.Put("radius", light.radius_m);
  if (light.form == LightForm::kTube) derived.Put("length", light.length_m);
}

std::string SubstitutionNote(const DerivedLight& derived) {
  return derived.substitution.empty() ? std::string() : "substituted: " + derived.substitution;
}

std::string SceneStem(const std::string& stem, const PresetOptions& options) {
  if (!options.rig) return stem;
  std::string name = stem + ".rig";
  if (!options.rig_place.light.empty()) name += "_" + FileStem(options.rig_place.light);
  if (options.rig_place.OnAxis()) return name;
  name += "_" + ShortestText(options.rig_place.off_axis_deg);
  if (options.rig_place.round_deg != 0.0) {
    name += "_" + ShortestText(options.rig_place.round_deg);
  }
  return name;
}

Result<void> CheckFinite(const DerivedLight& light, const std::string& subject) {
  for (const DerivedField& field : light.fields) {
    for (const double v : field.values) {
      if (std::isfinite(v)) continue;
      return Failed("not_finite", subject,
                    field.name + " is not a finite number; nothing exported");
    }
  }
  return {};
}

}  // namespace lightcal::preset_text
