// SPDX-License-Identifier: Apache-2.0
// EULUMDAT, as photometric_codec.h says; its grammar is read in eulumdat_codec.cc.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/photometric_text.h"

namespace lightcal {
namespace {

constexpr int kEulumdatDigits = 10;

std::string EulumdatNumber(double value) { return records::PlainNumber(value, kEulumdatDigits); }

// Part of the flux below the horizon.
double DownwardPart(const IntensityTable& table) {
  const IntensityGrid& grid = table.grid();
  IntensityGrid lower{GoniometerType::kC, grid.horizontal_deg, {}, {}};
  for (const double g : grid.vertical_deg) {
    if (g < 90.0) lower.vertical_deg.push_back(g);
  }
  if (lower.vertical_deg.empty()) return 0.0;
  if (grid.vertical_deg.back() >= 90.0) lower.vertical_deg.push_back(90.0);
  for (const double c : lower.horizontal_deg) {
    for (const double g : lower.vertical_deg) {
      lower.candela.push_back(table.At(RadiansFromDegrees(c), RadiansFromDegrees(g)).value());
    }
  }
  const auto made = IntensityTable::Make(std::move(lower), "");
  return made ? made->Flux() / table.Flux() : 0.0;
}

// A table's planes as EULUMDAT counts and orders them.
struct Planes {
  int symmetry = 0;
  std::vector<double> all_c;        // the whole turn, from 0, without 360
  std::vector<std::size_t> stored;  // indices of grid planes in writing order
};

Planes PlanesFrom(const IntensityTable& table) {
  Planes out;
  const std::vector<double>& c = table.grid().horizontal_deg;
  const std::size_t n = c.size();
  for (std::size_t i = 0; i < n; ++i) out.stored.push_back(i);
  out.all_c = c;
  const auto mirror = [&](double about) {
    for (std::size_t i = out.all_c.size(); i-- > 0;) {
      const double image = std::fmod(2.0 * about - out.all_c[i] + 720.0, 360.0);
      out.all_c.push_back(image);
    }
  };
  switch (table.symmetry()) {
    case TableSymmetry::kAxial:
      out.symmetry = 1;
      break;
    case TableSymmetry::kBilateral:
      out.symmetry = 2;
      mirror(180.0);
      break;
    case TableSymmetry::kBilateral90:
      out.symmetry = 3;
      mirror(90.0);
      std::reverse(out.stored.begin(), out.stored.end());
      break;
    case TableSymmetry::kQuadrant:
      out.symmetry = 4;
      mirror(90.0);
      mirror(180.0);
      break;
    case TableSymmetry::kNone:
      if (c.back() > 360.0 - 1e-6) {
        out.all_c.pop_back();
        out.stored.pop_back();
      }
      break;
  }
  std::sort(out.all_c.begin(), out.all_c.end());
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-6; };
  out.all_c.erase(std::unique(out.all_c.begin(), out.all_c.end(), same), out.all_c.end());
  return out;
}

double EvenStep(const std::vector<double>& angles) {
  if (angles.size() < 2) return 0.0;
  const double step = angles[1] - angles[0];
  for (std::size_t i = 2; i < angles.size(); ++i) {
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return 0.0;
  }
  return step;
}

}  // namespace

Result<std::string> EulumdatText(const PhotometricFile& file) {
  const PhotometricHeader& header = file.header;
  const IntensityGrid& grid = file.table.grid();
  if (grid.type != GoniometerType::kC) {
    return Refused("needs_type_c", header.luminaire,
                   "EULUMDAT knows type C only; sample the table as type C first");
  }
  const double table_flux = file.table.Flux().value();
  const double lamp_flux = header.lamp_flux.value_or(Lumens(table_flux)).value();
  const bool absolute = header.absolute || !header.lamp_flux;
  const Planes planes = PlanesFrom(file.table);
  std::string out;
  const auto line = [&](const std::string& text) { out += text + "\r\n"; };
  const auto text = [&](const std::string& utf8) { line(records::Latin1FromUtf8(utf8)); };
  const auto millimetres = [](Metres m) { return records::PlainNumber(m.value() * 1000.0, 6); };

  text(header.manufacturer);
  line(planes.symmetry == 1 ? "1" : "3");
  line(std::to_string(planes.symmetry));
  line(std::to_string(planes.all_c.size()));
  line(EulumdatNumber(EvenStep(planes.all_c)));
  line(std::to_string(grid.vertical_deg.size()));
  line(EulumdatNumber(EvenStep(grid.vertical_deg)));
  text(header.report);
  text(header.luminaire);
  text(header.catalogue);
  line("written by lightcal");
  const std::string date = header.date.empty() ? "unknown" : header.date;
  text(header.laboratory.empty() ? header.date
                                 : date + std::string(records::kEulumdatLab) + header.laboratory);
  const LuminousOpening& opening = header.opening;
  const bool round =
      opening.shape == OpeningShape::kRound || opening.shape == OpeningShape::kSphere;
  for (int luminous = 0; luminous < 2; ++luminous) {
    line(millimetres(opening.along_c90));
    line(round ? "0" : millimetres(opening.along_c0));
    if (luminous == 0) line(millimetres(opening.height));
  }
  for (int side = 0; side < 4; ++side) line(millimetres(opening.height));
  line(records::PlainNumber(100.0 * DownwardPart(file.table), 6));
  line(records::PlainNumber(absolute ? 100.0 : 100.0 * table_flux / lamp_flux, 6));
  line("1");
  line("0");
  std::vector<LampSet> lamps = header.lamps;
  if (lamps.empty()) lamps.resize(1);
  if (!header.lamp_flux) {
    lamps.resize(1);
    lamps.front().flux = Lumens(lamp_flux);
  }
  line(std::to_string(lamps.size()));
  for (const LampSet& set : lamps) {
    line(std::to_string(absolute ? -set.count : set.count));
    text(set.type);
    line(EulumdatNumber(set.flux.value()));
    text(set.color);
    text(set.rendering);
    line(EulumdatNumber(set.power.value()));
  }
  for (int i = 0; i < records::kEulumdatDirectRatios; ++i) line("0");
  for (const double c : planes.all_c) line(EulumdatNumber(c));
  for (const double g : grid.vertical_deg) line(EulumdatNumber(g));
  // What is printed as the lamps' flux is what divides.
  double printed_flux = 0.0;
  for (const LampSet& set : lamps)
    printed_flux += records::NumberEitherWay(EulumdatNumber(set.flux.value())).value_or(0.0);
  const double candela_to_printed = printed_flux > 0.0 ? 1000.0 / printed_flux : 0.0;
  if (!(candela_to_printed > 0.0) ||
      !std::isfinite(candela_to_printed * file.table.peak().intensity.value())) {
    return Refused("bad_table", header.luminaire,
                   "its luminous flux is no number of lumens that EULUMDAT can print, and its "
                   "candela are per 1000 of them");
  }
  for (const std::size_t plane : planes.stored) {
    for (std::size_t g = 0; g < grid.vertical_deg.size(); ++g) {
      line(EulumdatNumber(grid.candela[plane * grid.vertical_deg.size() + g] * candela_to_printed));
    }
  }
  return out;
}

}  // namespace lightcal
