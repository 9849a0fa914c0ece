// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/argyll_sp.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/spectrum_readings.h"

namespace lightcal::devices::files {
namespace {

constexpr double kMaxBands = 100000.0;

// The words of a CGATS text: blanks and line ends separate, double quotes join, '#' ends a line.
std::vector<std::string> CgatsWords(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == ' ' || c == '\t' || c == '\n') {
      ++at;
    } else if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '"') {
      const std::size_t end = std::min(text.find('"', at + 1), text.size());
      words.emplace_back(text.substr(at + 1, end - at - 1));
      at = end + 1;
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t\n\"", at), text.size());
      words.emplace_back(text.substr(at, end - at));
      at = end;
    }
  }
  return words;
}

struct CgatsTable {
  std::map<std::string, std::string> keywords;
  std::vector<std::string> fields;
  std::vector<std::string> data;
};

CgatsTable ParseCgats(std::string_view text) {
  const std::vector<std::string> words = CgatsWords(text);
  CgatsTable table;
  std::size_t at = 1;  // the file's type comes first
  const auto take_until = [&](std::string_view end, std::vector<std::string>& into) {
    for (++at; at < words.size() && words[at] != end; ++at) into.push_back(words[at]);
    ++at;
  };
  while (at < words.size()) {
    if (words[at] == "BEGIN_DATA_FORMAT") {
      take_until("END_DATA_FORMAT", table.fields);
    } else if (words[at] == "BEGIN_DATA") {
      take_until("END_DATA", table.data);
      break;  // one table
    } else {
      const std::string value = at + 1 < words.size() ? words[at + 1] : "";
      table.keywords.emplace(words[at], value);  // KEYWORD "X" declares X: harmless
      at += 2;
    }
  }
  return table;
}

struct Grid {
  std::size_t bands = 0;
  double start_nm = 0.0, end_nm = 0.0, norm = 1.0;
};

std::optional<double> KeywordNumber(const CgatsTable& table, const char* keyword) {
  const auto found = table.keywords.find(keyword);
  return found == table.keywords.end() ? std::nullopt : ParseNumber(found->second);
}

Result<Grid> GridOf(const CgatsTable& table, std::string_view name) {
  const auto bands = KeywordNumber(table, "SPECTRAL_BANDS");
  const auto start = KeywordNumber(table, "SPECTRAL_START_NM");
  const auto end = KeywordNumber(table, "SPECTRAL_END_NM");
  const double norm = KeywordNumber(table, "SPECTRAL_NORM").value_or(1.0);
  const bool sound = bands && start && end && *bands >= 2.0 && *bands <= kMaxBands &&
                     *bands == static_cast<double>(static_cast<int>(*bands)) && *end > *start &&
                     norm > 0.0;
  if (!sound) {
    return Refused("bad_spectrum", std::string(name),
                   "SPECTRAL_BANDS (2 or more), SPECTRAL_START_NM below SPECTRAL_END_NM and "
                   "SPECTRAL_NORM above 0 are needed; the file is damaged");
  }
  return Grid{static_cast<std::size_t>(*bands), *start, *end, norm};
}

enum class Measured { kAmbient, kColorOnly, kNoLight };
Measured MeasuredAs(const std::string& type) {
  if (type == "AMBIENT") return Measured::kAmbient;
  if (type.starts_with("REFLECT") || type.starts_with("TRANSMI")) return Measured::kNoLight;
  return Measured::kColorOnly;
}

// Where the samples stand within a set: after any other fields (SAMPLE_ID ...).
std::size_t FirstSampleField(const CgatsTable& table) {
  for (std::size_t i = 0; i < table.fields.size(); ++i) {
    if (table.fields[i].starts_with("SPEC_")) return i;
  }
  return 0;
}

Result<Spectrum> SpectrumOfSet(const CgatsTable& table, const Grid& grid, std::size_t first_word,
                               double unit, std::string_view name) {
  Spectrum spectrum;
  const double step = (grid.end_nm - grid.start_nm) / static_cast<double>(grid.bands - 1);
  for (std::size_t i = 0; i < grid.bands; ++i) {
    const std::string word = first_word + i < table.data.size() ? table.data[first_word + i] : "";
    const auto value = ParseNumber(word);
    if (!value) {
      return Refused("bad_spectrum", std::string(name),
                     "sample " + std::to_string(i + 1) + " of " + std::to_string(grid.bands) +
                         " is '" + word.substr(0, 40) + "', which is no number");
    }
    spectrum.wavelengths_nm.push_back(grid.start_nm + step * static_cast<double>(i));
    spectrum.values.push_back(*value / grid.norm * unit);
  }
  return spectrum;
}

}  // namespace

bool IsArgyllSp(std::string_view text) {
  const std::string_view beginning = TrimBlanks(text.substr(0, 4096));
  return beginning.starts_with("SPECT") && TrimBlanks(beginning.substr(0, 6)) == "SPECT";
}

Result<ImportedFile> ReadArgyllSp(std::string_view text, std::string_view name) {
  const CgatsTable table = ParseCgats(text);
  const auto grid = GridOf(table, name);
  if (!grid) return tl::unexpected(grid.error());
  const auto type = table.keywords.find("MEAS_TYPE");
  const std::string measured_type = type == table.keywords.end() ? "" : type->second;
  const Measured measured = MeasuredAs(measured_type);
  if (measured == Measured::kNoLight) {
    return Refused("bad_spectrum", std::string(name),
                   "its MEAS_TYPE is " + measured_type + ", which is no light");
  }
  const double unit = measured == Measured::kAmbient ? kMilliwatt : 1.0;
  const std::size_t per_set = std::max(table.fields.size(), grid->bands);
  const std::size_t sets = std::max<std::size_t>(1, table.data.size() / per_set);
  std::vector<FoundSpectrum> all;
  for (std::size_t set = 0; set < sets; ++set) {
    auto spectrum =
        SpectrumOfSet(table, *grid, set * per_set + FirstSampleField(table), unit, name);
    if (!spectrum) return Propagate(std::move(spectrum));
    FoundSpectrum found;
    found.imported.spectrum = std::move(*spectrum);
    found.imported.spectrum.quantity = measured == Measured::kAmbient
                                           ? SpectralQuantity::kIrradiance
                                           : SpectralQuantity::kRelative;
    found.imported.file_unit_W_m2_nm = unit;
    found.device = "argyll";
    found.where = name;
    all.push_back(std::move(found));
  }
  Warnings warnings;
  if (measured == Measured::kColorOnly && !measured_type.empty()) {
    warnings.push_back(
        {"relative_spectrum", std::string(name),
         "its MEAS_TYPE is " + measured_type + ", not AMBIENT, so only its colour is used"});
  }
  return ImportedFromSpectra("argyll_sp", std::move(all), std::move(warnings));
}

}  // namespace lightcal::devices::files
