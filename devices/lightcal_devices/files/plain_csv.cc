// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/plain_csv.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal_devices/files/csv_checks.h"
#include "lightcal_devices/files/csv_table.h"
#include "lightcal_devices/files/csv_times.h"
#include "lightcal_devices/files/spectrum_readings.h"

namespace lightcal::devices::files {
namespace {

// ---- one reading a row ----

std::optional<bool> YesOrNo(std::string_view text, std::string_view yes, std::string_view no) {
  const std::string lower = LowerAscii(text);
  if (lower == yes || lower == "true" || lower == "1") return true;
  if (lower == no || lower == "false" || lower == "0") return false;
  return std::nullopt;
}

// False where the word is not understood.
bool TakeWord(Reading& reading, CsvQuantity quantity, const std::string& word) {
  if (quantity == CsvQuantity::kLight) reading.light = word;
  if (quantity == CsvQuantity::kMeter) reading.meter = word;
  if (quantity == CsvQuantity::kTime) {
    reading.time = TimeOfCell(word);
    return !reading.time.empty();
  }
  if (quantity == CsvQuantity::kLamp) {
    const auto on = YesOrNo(word, "on", "off");
    reading.lamp = on.value_or(true) ? LampState::kOn : LampState::kOff;
    return on.has_value();
  }
  if (quantity == CsvQuantity::kShadowCard) {
    const auto shadow = YesOrNo(word, "yes", "no");
    reading.shadow_card = shadow.value_or(false);
    return shadow.has_value();
  }
  return true;
}

// False where no meter can have read such a value.
bool TakeNumber(Reading& reading, CsvQuantity quantity, double value) {
  switch (quantity) {
    case CsvQuantity::kDistance:
      reading.distance = Metres(value);
      return value > 0.0;
    case CsvQuantity::kIlluminance:
      reading.illuminance = Lux(value);
      return value >= 0.0;
    case CsvQuantity::kCct:
      if (value > 0.0) reading.cct = Kelvin(value);
      return value == 0.0 || IsTemperatureOfLamp(Kelvin(value));
    case CsvQuantity::kDuv:
      reading.duv = value;
      return value > -1.0 && value < 1.0;
    case CsvQuantity::kTilt:
      reading.tilt = RadiansFromDegrees(value);
      return value > -90.0 && value < 90.0;
    case CsvQuantity::kOffAxis:
      reading.off_axis = RadiansFromDegrees(value);
      return value > -180.0 && value < 180.0;
    case CsvQuantity::kSigma:
      reading.sigma_relative = value;
      return value > 0.0;
    default:
      return true;
  }
}

struct RowReading {
  Reading reading;
  std::optional<Lux> card;  // what the same place showed behind a shadow card
  std::optional<double> x;
  std::optional<double> y;
  std::array<std::optional<double>, 3> position, normal;
};

// True where the number is a coordinate of its place or of its normal.
bool TakeCoordinate(RowReading& taken, CsvQuantity quantity, double value) {
  const auto within = [&](CsvQuantity first, std::array<std::optional<double>, 3>& into) {
    const int axis = static_cast<int>(quantity) - static_cast<int>(first);
    if (axis < 0 || axis > 2) return false;
    into[static_cast<std::size_t>(axis)] = value;
    return true;
  };
  return within(CsvQuantity::kPositionX, taken.position) ||
         within(CsvQuantity::kNormalX, taken.normal);
}

// All three of a row or none.
Result<std::optional<Vec3>> VectorOf(const std::array<std::optional<double>, 3>& read,
                                     std::string_view what, const std::string& where) {
  const auto count = std::ranges::count_if(read, [](const auto& one) { return one.has_value(); });
  if (count == 0) return std::optional<Vec3>{};
  if (count < 3) {
    return Refused("bad_row", where,
                   "holds " + std::string(what) + " in part; it takes x, y and z");
  }
  return Vec3{*read[0], *read[1], *read[2]};
}

// What a control said with a decimal point, as everywhere but in files of decimal commas: 12,5 %.
std::string ControlCell(const std::string& cell, const NumberNotation& notation) {
  const std::size_t unit = std::min(cell.find_last_of("0123456789") + 1, cell.size());
  const auto number = NumberIn(std::string_view(cell).substr(0, unit), notation);
  return number ? ShortestText(*number) + cell.substr(unit) : cell;
}

Result<void> TakeCell(RowReading& taken, const CsvTable& table, const Row& row, std::size_t i) {
  const CsvColumn& column = table.columns[i];
  const std::string cell(TrimBlanks(CellAt(row, i)));
  if (cell.empty() || IsLeftOut(column.quantity)) return {};
  if (column.quantity == CsvQuantity::kState) {
    taken.reading.state.push_back(ParseControl(column.series, ControlCell(cell, table.notation)));
    return {};
  }
  if (IsWord(column.quantity)) {
    if (TakeWord(taken.reading, column.quantity, cell)) return {};
    return Refused("bad_row", AtLine(table.name, row.line),
                   "'" + cell.substr(0, 40) + "' in the column " + column.written +
                       " is not understood; lamp is on or off, shadow_card yes or no, time "
                       "2026-11-21T14:03:00");
  }
  const auto number = NumberAt(table, row, i);
  if (!number) return NotANumber(table, row, i, "bad_row");
  const double value = *number * column.scale;
  if (column.quantity == CsvQuantity::kX) taken.x = value;
  if (column.quantity == CsvQuantity::kY) taken.y = value;
  if (column.quantity == CsvQuantity::kIlluminance) {
    taken.reading.over_range = LimitSignOf(cell) == '>';
    taken.reading.under_range = LimitSignOf(cell) == '<';
  }
  if (column.quantity == CsvQuantity::kCard && value >= 0.0) {
    taken.card = Lux(value);
    return {};
  }
  if (TakeCoordinate(taken, column.quantity, value)) return {};
  if (column.quantity != CsvQuantity::kCard && TakeNumber(taken.reading, column.quantity, value)) {
    return {};
  }
  return Refused("bad_row", AtLine(table.name, row.line),
                 cell.substr(0, 40) + " is no possible " + column.written);
}

// The reading behind a shadow card at the place of another: what is left is of no lamp's colour.
Reading BehindCard(Reading reading, Lux card) {
  reading.illuminance = card;
  reading.shadow_card = true;
  reading.over_range = reading.under_range = false;
  reading.cct.reset();
  reading.duv.reset();
  reading.xy.reset();
  return reading;
}

// One reading, with a card's two; none where the meter left the row's cells empty.
Result<std::vector<Reading>> ReadingsFromRow(const CsvTable& table, const Row& row) {
  RowReading taken;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (auto cell = TakeCell(taken, table, row, i); !cell) return Propagate(std::move(cell));
  }
  Reading& reading = taken.reading;
  if (const std::string fault = FaultOfState(reading.state); !fault.empty()) {
    return Refused("bad_row", AtLine(table.name, row.line), fault);
  }
  SortState(reading.state);
  const std::string where = AtLine(table.name, row.line);
  auto position = VectorOf(taken.position, "a position", where);
  if (!position) return Propagate(std::move(position));
  reading.position_m = *position;
  auto normal = VectorOf(taken.normal, "a normal", where);
  if (!normal) return Propagate(std::move(normal));
  reading.normal = *normal;
  if (taken.x && taken.y) {
    const Xy xy{*taken.x, *taken.y};
    if (!(xy.x >= 0.0 && xy.y > 0.0 && xy.x + xy.y <= 1.0)) {
      return Refused("bad_row", where, "x and y are no chromaticity");
    }
    reading.xy = xy;
  }
  if (taken.card && (reading.shadow_card || reading.lamp == LampState::kOff)) {
    return Refused("bad_row", where,
                   "is a reading without the lamp's light and gives card_lx too; card_lx stands "
                   "beside a reading of the lamp");
  }
  std::vector<Reading> readings;
  if (reading.illuminance || reading.cct || reading.xy) readings.push_back(reading);
  if (taken.card) readings.push_back(BehindCard(std::move(reading), *taken.card));
  return readings;
}

Result<ImportedFile> ReadReadings(const CsvTable& table) {
  ImportedFile file;
  file.format = "csv";
  std::size_t empty = 0;
  int first_empty = 0;
  for (const Row& row : table.rows) {
    auto readings = ReadingsFromRow(table, row);
    if (!readings) return Propagate(std::move(readings));
    if (readings->empty() && empty++ == 0) first_empty = row.line;
    std::ranges::move(*readings, std::back_inserter(file.readings));
  }
  if (file.readings.empty()) {
    return Refused("bad_row", AtLine(table.name, first_empty),
                   "holds neither an illuminance nor a colour, as no row of the file does");
  }
  if (empty > 0) {
    file.warnings.push_back(
        {"rows_skipped", table.name,
         std::to_string(empty) + " of " + std::to_string(table.rows.size()) +
             " rows hold neither an illuminance nor a colour (the first is line " +
             std::to_string(first_empty) + "); they are left out"});
  }
  return file;
}

// ---- one spectral sample a row ----

// Whether the wavelengths increase once one of them is taken away: that one is mistyped.
bool IncreaseButForOne(const std::vector<double>& wavelengths) {
  const auto strictly = [](const std::vector<double>& w) {
    return std::ranges::adjacent_find(w, std::greater_equal<>()) == w.end();
  };
  const auto first = std::ranges::adjacent_find(wavelengths, std::greater_equal<>());
  const auto at = first - wavelengths.begin();
  for (const auto without : {at, at + 1}) {
    std::vector<double> rest = wavelengths;
    rest.erase(rest.begin() + without);
    if (strictly(rest)) return true;
  }
  return false;
}

// A table may list its samples from red to blue, or as they came.
void SortSamples(Spectrum& spectrum) {
  auto& wavelengths = spectrum.wavelengths_nm;
  if (std::ranges::is_sorted(wavelengths)) return;
  const bool falls = std::ranges::is_sorted(wavelengths, std::greater<>());
  if (!falls && IncreaseButForOne(wavelengths)) return;
  std::vector<std::pair<double, double>> samples;
  for (std::size_t i = 0; i < wavelengths.size(); ++i) {
    samples.emplace_back(wavelengths[i], spectrum.values[i]);
  }
  std::ranges::stable_sort(samples, {}, &std::pair<double, double>::first);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::tie(wavelengths[i], spectrum.values[i]) = samples[i];
  }
}

Result<FoundSpectrum> ReadSeries(const CsvTable& table, std::size_t wavelength,
                                 std::size_t series) {
  const CsvColumn& column = table.columns[series];
  FoundSpectrum found;
  found.imported.name = column.series;
  Spectrum& spectrum = found.imported.spectrum;
  spectrum.quantity = column.quantity == CsvQuantity::kIrradiance ? SpectralQuantity::kIrradiance
                                                                  : SpectralQuantity::kRelative;
  for (const Row& row : table.rows) {
    const auto nm = NumberAt(table, row, wavelength);
    if (!nm) return NotANumber(table, row, wavelength, "bad_spectrum");
    const auto value = NumberAt(table, row, series);
    if (!value) return NotANumber(table, row, series, "bad_spectrum");
    spectrum.wavelengths_nm.push_back(*nm * table.columns[wavelength].scale);
    spectrum.values.push_back(*value * column.scale);
  }
  SortSamples(spectrum);
  found.imported.file_unit_W_m2_nm = column.scale;
  found.where = table.name + (column.series.empty() ? "" : ", column " + column.written);
  return found;
}

Result<ImportedFile> ReadSpectra(const CsvTable& table, std::size_t wavelength) {
  std::vector<FoundSpectrum> all;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvQuantity quantity = table.columns[i].quantity;
    if (i == wavelength || IsLeftOut(quantity)) continue;
    if (quantity != CsvQuantity::kIrradiance && quantity != CsvQuantity::kRelative) {
      return Refused("units_ambiguous", table.name + ", column " + table.columns[i].written,
                     "does not go with wavelength_nm; beside it stand irradiance_W_m2_nm, "
                     "irradiance_mW_m2_nm, irradiance_uW_cm2_nm or relative");
    }
    auto found = ReadSeries(table, wavelength, i);
    if (!found) return Propagate(std::move(found));
    all.push_back(std::move(*found));
  }
  if (all.empty()) {
    return Refused("no_rows", table.name, "has wavelengths and no column of values");
  }
  return ImportedFromSpectra("csv", std::move(all));
}

Result<ImportedFile> ReadTable(const CsvTable& table) {
  const auto wavelength =
      std::ranges::find(table.columns, CsvQuantity::kWavelength, &CsvColumn::quantity);
  const bool spectral = wavelength != table.columns.end();
  auto warnings = CheckColumns(table);
  if (!warnings) return Propagate(std::move(warnings));
  if (auto once = CheckNoQuantityTwice(table, spectral); !once) return Propagate(std::move(once));
  auto file = spectral
                  ? ReadSpectra(table, static_cast<std::size_t>(wavelength - table.columns.begin()))
                  : ReadReadings(table);
  if (file) file->warnings.insert(file->warnings.begin(), warnings->begin(), warnings->end());
  return file;
}

}  // namespace

bool IsPlainCsv(std::string_view text) { return IsTableUnderHeader(text); }

Result<ImportedFile> ReadPlainCsv(std::string_view text, std::string_view name) {
  return ReadCsvUnderHeader(text, name, DecimalSign::kUnsaid);
}

Result<ImportedFile> ReadCsvUnderHeader(std::string_view text, std::string_view name,
                                        DecimalSign decimals) {
  const auto table = TableUnderHeader(text, name, decimals);
  if (!table) return tl::unexpected(table.error());
  return ReadTable(*table);
}

Result<ImportedFile> ReadCsvOfColumns(std::string_view text, std::string_view name,
                                      const TableWords& words) {
  const auto table = TableOfColumns(text, name, words);
  if (!table) return tl::unexpected(table.error());
  return ReadTable(*table);
}

std::string PlainCsvColumns() { return KnownColumnNames(); }

}  // namespace lightcal::devices::files
