// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_text.h"

#include <cmath>

#include "lightcal/core/numbers_text.h"

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

std::string XmlEscaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
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
