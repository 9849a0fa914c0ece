// SPDX-License-Identifier: Apache-2.0
// IES LM-63-2002, as photometric_codec.h says; its grammar is read in ies_codec.cc.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/photometric_text.h"

namespace lightcal {
namespace {

constexpr int kIesDigits = 8;
constexpr std::size_t kLongestLine = 120;

std::string IesNumber(double value) { return records::PlainNumber(value, kIesDigits); }

void AppendNumbers(std::string& out, const double* values, std::size_t count) {
  std::string line, number;
  for (std::size_t i = 0; i < count; ++i) {
    // A lamp without optics is as bright in the next direction.
    const bool again = i > 0 && std::bit_cast<std::uint64_t>(values[i]) ==
                                    std::bit_cast<std::uint64_t>(values[i - 1]);
    if (!again) number = IesNumber(values[i]);
    if (!line.empty() && line.size() + 1 + number.size() > kLongestLine) {
      out += line + "\r\n";
      line.clear();
    }
    if (!line.empty()) line += ' ';
    line += number;
  }
  out += line + "\r\n";
}

// Loaders look for "TILT" anywhere; a keyword's text must not hold it.
std::string KeywordText(const std::string& text) {
  std::string ascii = records::AsciiFromUtf8(text);
  for (std::string lower = LowerAscii(ascii); lower.find("tilt") != std::string::npos;
       lower = LowerAscii(ascii)) {
    ascii.replace(lower.find("tilt"), 4, "t-lt");
  }
  return ascii;
}

void AppendKeyword(std::string& out, std::string_view key, const std::string& text) {
  if (text.empty()) return;
  constexpr std::size_t kLongestKeywordLine = 254;  // 256 with its line end
  std::string line = "[" + std::string(key) + "] " + KeywordText(text);
  line.resize(std::min(line.size(), kLongestKeywordLine));
  out += std::string(TrimBlanks(line)) + "\r\n";
}

std::string OpeningText(const LuminousOpening& opening) {
  const auto size = [](Metres m, bool negative) {
    return (negative && m.value() > 0.0 ? "-" : "") + records::PlainNumber(m.value(), 6);
  };
  const bool round = opening.shape == OpeningShape::kRound;
  const bool sphere = opening.shape == OpeningShape::kSphere;
  return size(opening.along_c90, round || sphere) + " " + size(opening.along_c0, round || sphere) +
         " " + size(opening.height, sphere);
}

std::vector<double> PlaneAt(const IntensityTable& table, double c_deg) {
  std::vector<double> candela;
  for (const double gamma : table.grid().vertical_deg) {
    candela.push_back(table.At(RadiansFromDegrees(c_deg), RadiansFromDegrees(gamma)).value());
  }
  return candela;
}

// Its planes as LM-63-2002 has them: type C from 0 to 0, 90, 180 or 360. A lamp that is mirrored in
// C90-C270 is written whole (90 to 270 is of 1995 only, and Cycles and three.js take its first
// plane for C0), and a turn is closed. Same interpolant: from plane to plane it is linear.
IntensityGrid WholePlanes(const IntensityTable& table) {
  constexpr double kTurn = 360.0, kSame = 1e-6;
  IntensityGrid grid = table.grid();
  const bool mirrored = table.symmetry() == TableSymmetry::kBilateral90;
  const bool open =
      table.symmetry() == TableSymmetry::kNone && grid.horizontal_deg.back() < kTurn - kSame;
  if (grid.type != GoniometerType::kC || !(mirrored || open)) return grid;
  const std::size_t nv = grid.vertical_deg.size();
  std::map<double, std::vector<double>> planes;
  for (std::size_t i = 0; i < grid.horizontal_deg.size(); ++i) {
    const double c = grid.horizontal_deg[i];
    const auto from = grid.candela.begin() + static_cast<std::ptrdiff_t>(i * nv);
    const std::vector<double> candela(from, from + static_cast<std::ptrdiff_t>(nv));
    const bool inside = i > 0 && i + 1 < grid.horizontal_deg.size();
    if (mirrored && inside) planes[std::fmod(1.5 * kTurn - c, kTurn)] = candela;
    planes[c] = candela;
  }
  if (!planes.contains(0.0)) planes[0.0] = PlaneAt(table, 0.0);
  planes[kTurn] = planes[0.0];
  grid.horizontal_deg.clear();
  grid.candela.clear();
  for (const auto& [c, candela] : planes) {
    grid.horizontal_deg.push_back(c);
    grid.candela.insert(grid.candela.end(), candela.begin(), candela.end());
  }
  return grid;
}

}  // namespace

std::string IesText(const PhotometricFile& file) {
  const PhotometricHeader& header = file.header;
  const IntensityGrid grid = WholePlanes(file.table);
  int count = 0;
  for (const LampSet& set : header.lamps) count += set.count;
  if (!header.lamp_flux || count < 1) count = 1;
  const double flux = header.lamp_flux.value_or(file.table.Flux()).value();
  const auto or_unknown = [](const std::string& text) { return text.empty() ? "unknown" : text; };

  std::string out = "IESNA:LM-63-2002\r\n";
  AppendKeyword(out, "TEST", or_unknown(header.report));
  AppendKeyword(out, "TESTLAB", or_unknown(header.laboratory));
  AppendKeyword(out, "ISSUEDATE", or_unknown(header.date));
  AppendKeyword(out, "MANUFAC", or_unknown(header.manufacturer));
  AppendKeyword(out, "LUMCAT", header.catalogue);
  AppendKeyword(out, "LUMINAIRE", header.luminaire);
  AppendKeyword(out, "LAMP", header.lamps.empty() ? "" : header.lamps.front().type);
  AppendKeyword(out, "OTHER", "written by lightcal");
  out += "TILT=NONE\r\n";
  out += std::to_string(count) + " " + IesNumber(flux / count) + " 1 " +
         std::to_string(grid.vertical_deg.size()) + " " +
         std::to_string(grid.horizontal_deg.size()) + " " +
         std::to_string(static_cast<int>(grid.type) + 1) + " 2 " + OpeningText(header.opening) +
         "\r\n";
  out += "1 1 " + IesNumber(header.power.value()) + "\r\n";
  AppendNumbers(out, grid.vertical_deg.data(), grid.vertical_deg.size());
  AppendNumbers(out, grid.horizontal_deg.data(), grid.horizontal_deg.size());
  for (std::size_t h = 0; h < grid.horizontal_deg.size(); ++h) {
    AppendNumbers(out, &grid.candela[h * grid.vertical_deg.size()], grid.vertical_deg.size());
  }
  return out;
}

}  // namespace lightcal
