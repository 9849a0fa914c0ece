// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/reader_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/records/photometric_codec.h"

namespace lightcal {

void TakeTable(EngineLight& light, const std::string& photometric) {
  auto read = PhotometricFromText(photometric, light.name);
  if (!read) throw std::runtime_error(read.error().message);
  light.kind = EngineLightKind::kTable;
  light.table = std::move(read->file.table);
  if (light.name.empty()) light.name = read->file.header.luminaire;
}

double LuminanceOfSpace(std::string_view space, const Vec3& rgb) {
  // The middle rows of their matrices to XYZ: SMPTE EG 432-1, Rec. BT.2020, S-2014-004.
  struct Weights {
    std::string_view space;
    Vec3 of;
  };
  constexpr std::array kWeights = {Weights{"p3", {0.2289746, 0.6917385, 0.0792869}},
                                   Weights{"rec2020", {0.2627002, 0.6779981, 0.0593017}},
                                   Weights{"acescg", {0.2722287, 0.6740818, 0.0536895}}};
  const auto known = std::ranges::find(kWeights, space, &Weights::space);
  return known == kWeights.end() ? Rec709Luminance(rgb) : Dot(known->of, rgb);
}

Vec3 Rec709OfSpace(std::string_view space, const Vec3& rgb) {
  // Rows of their matrices to Rec. 709; ACEScg's white adapted to D65 (Bradford). Source: SMPTE EG
  // 432-1, ITU-R BT.2407-0, ACES (AP1 to Rec. 709).
  struct Matrix {
    std::string_view space;
    std::array<Vec3, 3> rows;
  };
  constexpr std::array kMatrices = {Matrix{"p3",
                                           {{{1.2249402, -0.2249402, 0.0},
                                             {-0.0420570, 1.0420570, 0.0},
                                             {-0.0196376, -0.0786361, 1.0982736}}}},
                                    Matrix{"rec2020",
                                           {{{1.6604910, -0.5876411, -0.0728499},
                                             {-0.1245505, 1.1328999, -0.0083494},
                                             {-0.0181508, -0.1005789, 1.1187297}}}},
                                    Matrix{"acescg",
                                           {{{1.7050515, -0.6217907, -0.0832587},
                                             {-0.1302571, 1.1408029, -0.0105482},
                                             {-0.0240033, -0.1289688, 1.1529717}}}}};
  const auto known = std::ranges::find(kMatrices, space, &Matrix::space);
  if (known == kMatrices.end()) return rgb;
  return {Dot(known->rows[0], rgb), Dot(known->rows[1], rgb), Dot(known->rows[2], rgb)};
}

void RequireFinite(const std::vector<EngineLight>& lights) {
  const auto finite = [](const Vec3& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
  };
  for (const EngineLight& light : lights) {
    const std::array numbers = {light.emitted, light.inner_rad,  light.outer_rad,
                                light.decay,   light.cone_power, light.range_m,
                                light.width_m, light.height_m,   light.offset_m};
    if (std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); }) &&
        finite(light.position_m) && finite(light.aim) && finite(light.x) && finite(light.y) &&
        finite(light.rgb.value_or(Vec3{}))) {
      continue;
    }
    throw std::runtime_error(light.name + ": its numbers lead beyond all numbers");
  }
}

double Above0(const std::string& what, double value) {
  if (!(value > 0.0)) throw std::runtime_error(what + " is not above 0");
  return value;
}

std::vector<double> NumbersIn(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  bool in_word = false;  // the 3 of Vector3 is no number
  while (at < end) {
    const bool letter = (*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z') || *at == '_';
    const bool digit = *at >= '0' && *at <= '9';
    double value = 0.0;
    if (!in_word && (digit || *at == '-' || *at == '.')) {
      const auto [next, error] = std::from_chars(at, end, value);
      // "-inf" and "-nan" are words.
      if (error == std::errc() && std::isfinite(value)) numbers.push_back(value);
      at = std::max(next, at + 1);
      continue;
    }
    in_word = letter || (in_word && digit);
    ++at;
  }
  return numbers;
}

double OneNumber(const std::string& what, std::string_view text) {
  const std::string_view trimmed = TrimBlanks(text);
  double value = 0.0;
  const char* const end = trimmed.data() + trimmed.size();
  const auto [next, error] = std::from_chars(trimmed.data(), end, value);
  if (error != std::errc() || next != end || !std::isfinite(value)) {
    throw std::runtime_error(what + " is no number: " + std::string(trimmed));
  }
  return value;
}

std::vector<double> NumbersOf(const std::string& what, std::string_view text, std::size_t count) {
  const std::size_t open = std::min(text.find('('), text.size());
  std::string_view rest = text.substr(std::min(open + 1, text.size()));
  std::vector<double> numbers;
  const std::size_t close = rest.rfind(')');
  if (close == std::string_view::npos) throw std::runtime_error(what + " is no list of numbers");
  rest = rest.substr(0, close);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    numbers.push_back(OneNumber(what, rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  if (numbers.size() != count) {
    throw std::runtime_error(what + " has not " + std::to_string(count) + " numbers");
  }
  return numbers;
}

std::string ObjectFrom(const std::string& text, std::size_t from) {
  const std::size_t start = text.find('{', from);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = start; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == '{') ++depth;
    if (c == '}' && --depth == 0) return text.substr(start, i - start + 1);
  }
  return {};
}

std::vector<EngineLight> ReadPhotometricTable(const std::string& text, const FileText& /*beside*/) {
  EngineLight light;
  TakeTable(light, text);
  light.emitted = 1.0;
  light.placed = false;
  return {light};
}

}  // namespace lightcal
