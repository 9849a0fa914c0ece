// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/radiance_header.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices {
namespace {

// The numbers of a line, absent when something else is there.
std::optional<std::vector<double>> Numbers(std::string_view text) {
  std::vector<double> numbers;
  for (text = TrimBlanks(text); !text.empty(); text = TrimBlanks(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const auto number = ParseNumber(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text.remove_prefix(end);
  }
  return numbers;
}

tl::unexpected<Error> BadLine(std::string_view name, std::string_view line) {
  return Refused("bad_picture", std::string(name),
                 "its header line \"" + std::string(line.substr(0, 80)) + "\" is not understood");
}

constexpr double kViewDefaultDegrees = 45.0;  // Radiance's own

// The types and angles of "-vta -vh 180 -vv 180 -vp 0 0 0 ..." over what earlier lines said.
struct ViewWords {
  char type = 'v';
  double horizontal = kViewDefaultDegrees, vertical = kViewDefaultDegrees;
  bool seen = false;
};

void TakeView(std::string_view text, ViewWords& words) {
  const auto next = [&text] {
    text = TrimBlanks(text);
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    return word;
  };
  double* only = nullptr;  // one angle alone serves both ways
  bool both = false;
  for (std::string_view word = next(); !word.empty(); word = next()) {
    if (word.size() == 4 && word.starts_with("-vt")) words.type = word[3];
    if (word != "-vh" && word != "-vv") continue;
    double& angle = word == "-vh" ? words.horizontal : words.vertical;
    if (const auto number = ParseNumber(next())) {
      both = only != nullptr && only != &angle;
      only = &angle;
      angle = *number;
    }
  }
  if (only != nullptr && !both) words.horizontal = words.vertical = *only;
  words.seen = true;
}

void FinishView(const ViewWords& words, RadianceHeader& header) {
  if (!words.seen) return;
  const bool fisheye = words.type == 'a';
  const double angle = fisheye ? std::min(words.horizontal, words.vertical) : words.horizontal;
  const bool angle_fits = angle > 0.0 && (fisheye ? angle <= 360.0 : angle < 180.0);
  header.unknown_view = (!fisheye && words.type != 'v') || !angle_fits;
  if (header.unknown_view) return;
  header.view = WrittenView{fisheye ? Projection::kEquidistant : Projection::kRectilinear,
                            RadiansFromDegrees(angle)};
}

Result<void> TakeLine(std::string_view line, std::string_view name, RadianceHeader& header,
                      ViewWords& view) {
  const auto value_of = [&](std::string_view key) -> std::optional<std::string_view> {
    if (!line.starts_with(key)) return std::nullopt;
    return TrimBlanks(line.substr(key.size()));
  };
  if (const auto exposure = value_of("EXPOSURE=")) {
    const auto number = ParseNumber(*exposure);
    if (!number || !(*number > 0.0)) return BadLine(name, line);
    header.exposure *= *number;
  } else if (const auto colors = value_of("COLORCORR=")) {
    if (Numbers(*colors) != std::vector{1.0, 1.0, 1.0}) {
      return Refused("unsupported_picture", std::string(name),
                     "a COLORCORR line changed its channels; undo it with Radiance's pcomb");
    }
  } else if (const auto primaries = value_of("PRIMARIES=")) {
    const auto n = Numbers(*primaries);
    if (!n || n->size() != 8) return BadLine(name, line);
    if (std::all_of(n->begin(), n->end(), [](double v) { return v == 0.0; })) return {};
    const RgbPrimaries all{
        {(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}, {(*n)[4], (*n)[5]}, {(*n)[6], (*n)[7]}};
    if (!SpanColors(all)) return BadLine(name, line);
    header.primaries = all;
  } else if (const auto words = value_of("VIEW=")) {
    TakeView(*words, view);
  } else if (const auto format = value_of("FORMAT=")) {
    if (*format != "32-bit_rle_rgbe" && *format != "32-bit_rle_xyze") return BadLine(name, line);
    header.xyz = *format == "32-bit_rle_xyze";
  }
  return {};
}

}  // namespace

Result<RadianceHeader> ParseRadianceHeader(std::string_view bytes, std::string_view name) {
  RadianceHeader header;
  ViewWords view;
  if (!bytes.starts_with("#?")) return BadLine(name, bytes.substr(0, bytes.find('\n')));
  while (true) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) {
      return Refused("bad_picture", std::string(name), "its header has no end");
    }
    std::string_view line = bytes.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) break;
    if (auto ok = TakeLine(line, name, header, view); !ok) return Propagate(std::move(ok));
    bytes.remove_prefix(end + 1);
  }
  if (!std::isfinite(header.exposure) || header.exposure < 1e-30) {
    return Refused("bad_picture", std::string(name), "its EXPOSURE lines multiply to no number");
  }
  FinishView(view, header);
  return header;
}

}  // namespace lightcal::devices
