// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/import_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/actlumus_log.h"
#include "lightcal_devices/files/archive.h"
#include "lightcal_devices/files/argyll_sp.h"
#include "lightcal_devices/files/delimited_text.h"
#include "lightcal_devices/files/jeti_csv.h"
#include "lightcal_devices/files/plain_csv.h"
#include "lightcal_devices/files/sekonic_csv.h"
#include "lightcal_devices/files/tm27_spdx.h"
#include "lightcal_devices/files/uprtek_xls.h"

namespace lightcal {
namespace {

// Every format, the first that recognises the text reads it. A new one is one file and one line.
struct Format {
  std::string_view name;
  bool (*recognise)(std::string_view text);
  Result<ImportedFile> (*read)(std::string_view text, std::string_view file_name);
};
constexpr std::array kFormats = {
    Format{"IES TM-27 .spdx", files::IsTm27Spdx, files::ReadTm27Spdx},
    Format{"Argyll .sp", files::IsArgyllSp, files::ReadArgyllSp},
    Format{"ActLumus log", files::IsActlumusLog, files::ReadActlumusLog},
    Format{"JETI CSV", files::IsJetiCsv, files::ReadJetiCsv},
    Format{"Sekonic CSV", files::IsSekonicCsv, files::ReadSekonicCsv},
    Format{"UPRtek .xls text", files::IsUprtekXls, files::ReadUprtekXls},
    Format{"CSV whose column names carry units", files::IsPlainCsv, files::ReadPlainCsv},
};

Result<std::string> ReadBytes(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Failed("not_found", path, "there is no such file");
  }
  if (std::filesystem::is_directory(path, ignored)) {
    return Failed("unreadable", path, "is a directory; name the file in it");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  std::array<char, 1 << 16> chunk{};
  while (stream.read(chunk.data(), chunk.size()) || stream.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > files::kMaxFileBytes) {
      return Refused("too_large", path, "is larger than 256 MiB, which no meter's export is");
    }
  }
  if (!stream.eof()) return Failed("unreadable", path, "cannot be read; check its permissions");
  return bytes;
}

}  // namespace

Result<ImportedFile> ImportFile(const std::string& path) {
  auto bytes = ReadBytes(path);
  if (!bytes) return Propagate(std::move(bytes));
  return ImportBytes(*bytes, std::filesystem::path(path).filename().string());
}

Result<ImportedFile> ImportBytes(std::string_view bytes, std::string_view name) {
  std::string unpacked;
  if (files::IsZip(bytes)) {
    auto only = files::OnlyFileInZip(bytes, name);
    if (!only) return Propagate(std::move(only));
    unpacked = std::move(*only);
    bytes = unpacked;
  }
  const auto text = files::TextFromBytes(bytes, name);
  if (!text) return tl::unexpected(text.error());
  if (TrimBlanks(*text).empty()) {
    return Refused("no_rows", std::string(name), "is empty; export it again");
  }
  const auto format = std::ranges::find_if(
      kFormats, [&](const Format& candidate) { return candidate.recognise(*text); });
  if (format != kFormats.end()) return format->read(*text, name);
  return Refused("unknown_format", std::string(name),
                 "its format is not recognised; understood are " +
                     Joined(kFormats, ", ", &Format::name) + " (" + files::PlainCsvColumns() + ")");
}

Result<std::size_t> FindSpectrum(const ImportedFile& file, std::string_view column) {
  const auto named = std::ranges::find(file.spectra, column, &ImportedSpectrum::name);
  if (named != file.spectra.end()) {
    return static_cast<std::size_t>(named - file.spectra.begin());
  }
  const auto number = ParseNumber(column);
  const auto count = static_cast<double>(file.spectra.size());
  if (number && *number >= 1.0 && *number <= count && *number == std::floor(*number)) {
    return static_cast<std::size_t>(*number) - 1;
  }
  std::string names;
  for (const ImportedSpectrum& spectrum : file.spectra) {
    if (!spectrum.name.empty()) names += (names.empty() ? "" : ", ") + spectrum.name;
  }
  return Refused("unknown_column", std::string(column),
                 "the file has " + std::to_string(file.spectra.size()) +
                     " spectra; name one by its number from 1" +
                     (names.empty() ? "" : " or its name: " + names));
}

Warnings WarningsAbout(const ImportedFile& file, std::size_t spectrum) {
  const std::string& where = file.spectra[spectrum].where;
  Warnings about = file.warnings;
  std::erase_if(about, [&](const Warning& warning) {
    const bool of_a_spectrum = std::ranges::find(file.spectra, warning.subject,
                                                 &ImportedSpectrum::where) != file.spectra.end();
    return of_a_spectrum && warning.subject != where;
  });
  return about;
}

}  // namespace lightcal
