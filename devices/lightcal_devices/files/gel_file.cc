// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/gel_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
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

bool SaysPercent(std::string_view lower) {
  return lower.find("percent") != lower.npos || lower.find('%') != lower.npos;
}

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
  const bool percent = SaysPercent(rest);
  const bool fraction = rest == "_fraction";
  if (!percent && !fraction && !TrimBlanks(rest).empty()) return std::nullopt;
  return WavelengthColumn{*nm, percent ? kPercent : 1.0};
}

// "45.2%" -> 45.2, and that its sign says so.
struct GelCell {
  double value = 0.0;
  bool percent = false;
};
std::optional<GelCell> GelCellOf(std::string_view cell, bool decimal_comma) {
  std::string_view content = TrimBlanks(cell);
  const bool percent = content.ends_with('%');
  if (percent) content.remove_suffix(1);
  const auto value = ParseNumber(content, decimal_comma);
  return value ? std::optional(GelCell{*value, percent}) : std::nullopt;
}

// Cells with and without a percent sign in one filter: which of the two the others are, nobody
// says.
tl::unexpected<Error> PartlyPercent(std::string_view where, const Gel& gel) {
  return Refused("units_ambiguous", std::string(where) + ", " + GelTitle(gel),
                 "has a percent sign in some of its cells only; write it in all or in none");
}

// A table may list its wavelengths from red to blue.
void ReverseFalling(Gel& gel) {
  const auto& nm = gel.wavelengths_nm;
  const bool falls =
      nm.size() > 1 && std::ranges::adjacent_find(nm, std::less_equal<>()) == nm.end();
  if (!falls) return;
  std::ranges::reverse(gel.wavelengths_nm);
  std::ranges::reverse(gel.transmittance);
}

// Percentages that nobody called so are not guessed at.
Result<void> CheckGel(Gel& gel, std::string_view where, bool percent_said) {
  if (!percent_said && !gel.transmittance.empty() &&
      *std::ranges::max_element(gel.transmittance) > 1.5) {
    return Refused("units_ambiguous", std::string(where) + ", " + GelTitle(gel),
                   "has values above 1; if they are percent, say so in the columns' names "
                   "(405nm_percent, \"L204 transmittance_percent\")");
  }
  ReverseFalling(gel);
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
    std::size_t signs = 0;
    for (const auto& [column, wavelength] : table.wavelengths) {
      const std::string_view cell = CellAt(row, column);
      if (TrimBlanks(cell).empty()) continue;  // the maker gives none there
      const auto value = GelCellOf(cell, decimal_comma);
      if (!value) {
        return BadGels(where, "'" + std::string(cell.substr(0, 40)) + "' in the column " +
                                  rows.front().cells[column] + " is no number");
      }
      if (value->percent) ++signs;
      percent = percent || wavelength.scale != 1.0 || value->percent;
      gel.wavelengths_nm.push_back(wavelength.nm);
      gel.transmittance.push_back(value->value * (value->percent ? kPercent : wavelength.scale));
    }
    if (signs > 0 && signs < gel.transmittance.size()) return PartlyPercent(where, gel);
    gel.tungsten = ClaimOf(table, row, 0);
    gel.daylight = ClaimOf(table, row, 3);
    if (auto checked = CheckGel(gel, where, percent); !checked)
      return Propagate(std::move(checked));
    set.gels.push_back(std::move(gel));
  }
  return set;
}

// ---- a column a filter ----

// Where in a column's name what it holds begins: "transmittance", or a "T%", "%T", "T (%)" or "%"
// that ends it.
std::optional<std::size_t> QuantityIn(std::string_view lower) {
  constexpr std::string_view kQuantity = "transmittance";
  if (const std::size_t at = lower.find(kQuantity); at != lower.npos) return at;
  for (const std::string_view ending : {"t%", "%t", "t (%)", "t [%]", "t(%)", "t[%]"}) {
    if (!lower.ends_with(ending)) continue;
    const std::size_t at = lower.size() - ending.size();
    const bool own_word = at == 0 || lower[at - 1] == ' ' || lower[at - 1] == '_';
    if (own_word) return at;
  }
  for (const std::string_view ending : {"(%)", "[%]", "%"}) {
    if (lower.ends_with(ending)) return lower.size() - ending.size();
  }
  return std::nullopt;
}

Result<GelSet> ColumnsOfGels(const std::vector<Row>& rows, bool decimal_comma,
                             std::size_t wavelength, std::string_view name) {
  GelSet set;
  const Row& header = rows.front();
  for (std::size_t column = 0; column < header.cells.size(); ++column) {
    const std::string written(TrimBlanks(header.cells[column]));
    const std::string lower = LowerAscii(written);
    const auto quantity = QuantityIn(lower);
    if (column == wavelength) continue;
    if (!quantity) {
      return Refused("units_ambiguous", std::string(name) + ", column " + written,
                     "does not say what it holds; write \"" + written + " transmittance\" or \"" +
                         written + " transmittance_percent\"");
    }
    bool percent = SaysPercent(lower);
    std::size_t signs = 0;
    Gel gel;
    gel.id = TrimBlanks(written.substr(0, *quantity));
    while (!gel.id.empty() && (gel.id.back() == '_' || gel.id.back() == ' ')) gel.id.pop_back();
    if (gel.id.empty()) gel.id = std::filesystem::path(name).stem().string();
    for (std::size_t r = 1; r < rows.size(); ++r) {
      const auto nm = ParseNumber(CellAt(rows[r], wavelength), decimal_comma);
      const auto value = GelCellOf(CellAt(rows[r], column), decimal_comma);
      if (!nm || !value) {
        return BadGels(files::AtLine(name, rows[r].line), "holds no number for " + written);
      }
      gel.wavelengths_nm.push_back(*nm);
      if (value->percent) ++signs;
      gel.transmittance.push_back(value->value * (percent || value->percent ? kPercent : 1.0));
    }
    if (signs > 0 && signs < gel.transmittance.size()) return PartlyPercent(name, gel);
    percent = percent || signs > 0;
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
  std::vector<Row> unsigned_cells(rows->begin() + 1, rows->end());
  for (Row& row : unsigned_cells) {
    for (std::string& cell : row.cells) {
      if (cell.ends_with('%')) cell.pop_back();
    }
  }
  const bool decimal_comma =
      files::HasDecimalComma(unsigned_cells, delimiter, [](std::size_t) { return true; });
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

// Dark filters under names that say neither percent nor fraction may be either: it is said.
void SayIfReadAsFractions(std::string_view text, std::string_view name, GelSet& set) {
  constexpr double kDark = 0.5;
  const std::string lower = LowerAscii(text);
  if (SaysPercent(lower) || lower.find("fraction") != lower.npos) return;
  double largest = 0.0;
  for (const Gel& gel : set.gels) largest = std::max(largest, std::ranges::max(gel.transmittance));
  if (largest >= kDark) return;
  set.warnings.push_back(
      {"gels_as_fractions", std::string(name),
       "its columns do not say whether they are percent; read as parts of 1, its brightest filter "
       "passes " +
           PercentText(largest, 3) +
           " at most. If they are percent, say so in the columns' names (405nm_percent, \"L204 "
           "transmittance_percent\"), else write transmittance_fraction, 405nm_fraction"});
}

}  // namespace

Result<GelSet> GelsFromText(std::string_view text, std::string_view name) {
  const auto plain = files::TextFromBytes(text, name);
  if (!plain) return tl::unexpected(plain.error());
  const bool spdx = files::IsTm27Spdx(*plain);
  auto set = spdx ? SpdxGels(*plain, name) : GelsOfTable(*plain, name);
  if (!set) return set;
  if (!spdx) SayIfReadAsFractions(*plain, name, *set);
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
