// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/gel_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/delimited_text.h"
#include "lightcal_devices/files/file_bytes.h"
#include "lightcal_devices/files/tm27_spdx.h"

namespace lightcal::devices {
namespace {

using files::CellAt;
using files::Row;

constexpr std::size_t kMostGelBytes = std::size_t{64} << 20U;
constexpr double kPercent = 0.01;

tl::unexpected<Error> BadGels(std::string_view where, const std::string& what) {
  return Refused("bad_gels", std::string(where), what);
}

constexpr const char* kGelForms =
    "a row a filter with columns filter, name, 405nm ... 700nm (transmittance 0 to 1), or a column "
    "a filter beside wavelength_nm, \"L204 transmittance\", or a TM-27 file of transmittance";

// "405nm" -> 405; "405nm_percent" -> 405 and a hundredth.
struct WavelengthColumn {
  double nm = 0.0, scale = 1.0;
};
std::optional<WavelengthColumn> WavelengthColumnOf(std::string_view name) {
  const std::string lower = LowerAscii(TrimBlanks(name));
  const std::size_t unit = lower.find("nm");
  if (unit == std::string::npos) return std::nullopt;
  const auto nm = ParseNumber(TrimBlanks(std::string_view(lower).substr(0, unit)));
  if (!nm) return std::nullopt;
  const std::string rest = lower.substr(unit + 2);
  const bool percent = rest.find("percent") != std::string::npos || rest.find('%') != rest.npos;
  if (!percent && !TrimBlanks(rest).empty()) return std::nullopt;
  return WavelengthColumn{*nm, percent ? kPercent : 1.0};
}

// Percentages that nobody called so are not guessed at.
Result<void> CheckGel(const Gel& gel, std::string_view where, bool percent_said) {
  if (!percent_said && !gel.transmittance.empty() &&
      *std::ranges::max_element(gel.transmittance) > 1.5) {
    return Refused("units_ambiguous", std::string(where) + ", " + GelTitle(gel),
                   "has values above 1; if they are percent, say so in the columns' names "
                   "(405nm_percent, \"L204 transmittance_percent\")");
  }
  if (const std::string fault = FaultOf(gel); !fault.empty()) {
    return BadGels(std::string(where) + ", " + GelTitle(gel), fault);
  }
  return {};
}

// ---- a row a filter ----

struct GelTable {
  std::optional<std::size_t> id, name;
  std::array<std::optional<std::size_t>, 6> claims;  // tungsten Y, x, y, daylight Y, x, y
  std::vector<std::pair<std::size_t, WavelengthColumn>> wavelengths;
  bool decimal_comma = false;
};

GelTable TableOf(const Row& header, bool decimal_comma) {
  constexpr std::array<std::string_view, 6> kClaims = {"tungsten_y_percent", "tungsten_x",
                                                       "tungsten_y",         "daylight_y_percent",
                                                       "daylight_x",         "daylight_y"};
  GelTable table;
  table.decimal_comma = decimal_comma;
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    const std::string name = LowerAscii(TrimBlanks(header.cells[i]));
    if (name == "filter" || name == "id" || name == "number" || name == "gel") table.id = i;
    if (name == "name") table.name = i;
    for (std::size_t c = 0; c < kClaims.size(); ++c) {
      if (name == kClaims[c]) table.claims[c] = i;
    }
    if (const auto column = WavelengthColumnOf(name)) table.wavelengths.emplace_back(i, *column);
  }
  return table;
}

std::optional<GelClaim> ClaimOf(const GelTable& table, const Row& row, std::size_t first) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto column = table.claims[first + i];
    const auto value =
        column ? ParseNumber(CellAt(row, *column), table.decimal_comma) : std::nullopt;
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return GelClaim{values[0], {values[1], values[2]}};
}

Result<GelSet> RowsOfGels(const std::vector<Row>& rows, bool decimal_comma, std::string_view name) {
  const GelTable table = TableOf(rows.front(), decimal_comma);
  GelSet set;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const Row& row = rows[r];
    const std::string where = files::AtLine(name, row.line);
    Gel gel;
    if (table.id) gel.id = TrimBlanks(CellAt(row, *table.id));
    if (table.name) gel.name = TrimBlanks(CellAt(row, *table.name));
    if (gel.id.empty()) gel.id = gel.name;
    if (gel.id.empty()) return BadGels(where, "has neither a filter's number nor a name");
    bool percent = false;
    for (const auto& [column, wavelength] : table.wavelengths) {
      const std::string_view cell = CellAt(row, column);
      if (TrimBlanks(cell).empty()) continue;  // the maker gives none there
      const auto value = ParseNumber(cell, decimal_comma);
      if (!value) {
        return BadGels(where, "'" + std::string(cell.substr(0, 40)) + "' in the column " +
                                  rows.front().cells[column] + " is no number");
      }
      percent = percent || wavelength.scale != 1.0;
      gel.wavelengths_nm.push_back(wavelength.nm);
      gel.transmittance.push_back(*value * wavelength.scale);
    }
    gel.tungsten = ClaimOf(table, row, 0);
    gel.daylight = ClaimOf(table, row, 3);
    if (auto checked = CheckGel(gel, where, percent); !checked)
      return Propagate(std::move(checked));
    set.gels.push_back(std::move(gel));
  }
  return set;
}

// ---- a column a filter ----

Result<GelSet> ColumnsOfGels(const std::vector<Row>& rows, bool decimal_comma,
                             std::size_t wavelength, std::string_view name) {
  constexpr std::string_view kQuantity = "transmittance";
  GelSet set;
  const Row& header = rows.front();
  for (std::size_t column = 0; column < header.cells.size(); ++column) {
    const std::string written(TrimBlanks(header.cells[column]));
    const std::string lower = LowerAscii(written);
    const std::size_t quantity = lower.find(kQuantity);
    if (column == wavelength) continue;
    if (quantity == std::string::npos) {
      return Refused("units_ambiguous", std::string(name) + ", column " + written,
                     "does not say what it holds; write \"" + written + " transmittance\" or \"" +
                         written + " transmittance_percent\"");
    }
    const bool percent = lower.find("percent") != lower.npos || lower.find('%') != lower.npos;
    Gel gel;
    gel.id = TrimBlanks(written.substr(0, quantity));
    while (!gel.id.empty() && (gel.id.back() == '_' || gel.id.back() == ' ')) gel.id.pop_back();
    if (gel.id.empty()) gel.id = std::filesystem::path(name).stem().string();
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const auto nm = ParseNumber(CellAt(rows[r], wavelength), decimal_comma);
      const auto value = ParseNumber(CellAt(rows[r], column), decimal_comma);
      if (!nm || !value) {
        return BadGels(files::AtLine(name, rows[r].line), "holds no number for " + written);
      }
      gel.wavelengths_nm.push_back(*nm);
      gel.transmittance.push_back(*value * (percent ? kPercent : 1.0));
    }
    if (auto checked = CheckGel(gel, name, percent); !checked) return Propagate(std::move(checked));
    set.gels.push_back(std::move(gel));
  }
  return set;
}

Result<GelSet> SpdxGels(std::string_view text, std::string_view name) {
  auto distributions = files::Tm27Distributions(text, name);
  if (!distributions) return Propagate(std::move(distributions));
  GelSet set;
  for (files::Tm27Distribution& one : *distributions) {
    if (LowerAscii(one.quantity) != "transmittance") {
      return BadGels(name, "its SpectralQuantity is '" + one.quantity +
                               "'; a filter's file says transmittance");
    }
    Gel gel;
    gel.name = one.found.imported.name;
    gel.id = gel.name.empty() ? std::filesystem::path(name).stem().string() : gel.name;
    gel.wavelengths_nm = std::move(one.found.imported.spectrum.wavelengths_nm);
    gel.transmittance = std::move(one.found.imported.spectrum.values);
    if (auto checked = CheckGel(gel, name, false); !checked) return Propagate(std::move(checked));
    set.gels.push_back(std::move(gel));
  }
  return set;
}

Result<GelSet> GelsOfTable(std::string_view text, std::string_view name) {
  const char delimiter = files::DelimiterOf(text.substr(0, text.find('\n')));
  auto rows = files::ReadRows(text, delimiter);
  if (!rows) return Propagate(std::move(rows));
  std::erase_if(*rows, [](const Row& row) {
    return row.cells.empty() || row.cells.front().starts_with('#') ||
           std::ranges::all_of(row.cells, [](const auto& c) { return TrimBlanks(c).empty(); });
  });
  if (rows->size() < 2)
    return BadGels(name, "holds no filter; understood are " + std::string(kGelForms));
  const bool decimal_comma = files::HasDecimalComma(std::span<const Row>(*rows).subspan(1),
                                                    delimiter, [](std::size_t) { return true; });
  const auto& header = rows->front().cells;
  const auto wavelength = std::ranges::find_if(header, [](const std::string& cell) {
    const std::string lower = LowerAscii(TrimBlanks(cell));
    return lower == "wavelength_nm" || lower == "nm" || lower == "wavelength [nm]";
  });
  if (wavelength != header.end()) {
    return ColumnsOfGels(*rows, decimal_comma,
                         static_cast<std::size_t>(wavelength - header.begin()), name);
  }
  const bool by_row = std::ranges::any_of(
      header, [](const std::string& cell) { return WavelengthColumnOf(cell).has_value(); });
  if (by_row) return RowsOfGels(*rows, decimal_comma, name);
  return BadGels(name, "is no table of filters; understood are " + std::string(kGelForms));
}

}  // namespace

Result<GelSet> GelsFromText(std::string_view text, std::string_view name) {
  const auto plain = files::TextFromBytes(text, name);
  if (!plain) return tl::unexpected(plain.error());
  auto set = files::IsTm27Spdx(*plain) ? SpdxGels(*plain, name) : GelsOfTable(*plain, name);
  if (!set) return set;
  set->source = name;
  for (std::size_t i = 0; i < set->gels.size(); ++i) {
    const auto same =
        std::ranges::find(set->gels.begin(), set->gels.begin() + static_cast<std::ptrdiff_t>(i),
                          set->gels[i].id, &Gel::id);
    if (same == set->gels.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    return BadGels(name, "names the filter " + set->gels[i].id + " twice");
  }
  return set;
}

Result<GelSet> ReadGelFile(const std::string& path) {
  const files::FileBytes file = files::ReadFileBytes(path, kMostGelBytes);
  switch (file.fault) {
    case files::FileFault::kMissing:
      return Failed("not_found", path, "there is no such file");
    case files::FileFault::kTooLarge:
      return Refused("bad_gels", path, "is larger than 64 MiB, which no catalogue of filters is");
    case files::FileFault::kDirectory:
    case files::FileFault::kUnreadable:
      return Failed("unreadable", path, "is a directory, or not yours to read");
    case files::FileFault::kNone:
      break;
  }
  return GelsFromText(file.bytes, std::filesystem::path(path).filename().string());
}

}  // namespace lightcal::devices
