// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/import_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
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

namespace lightcal::devices {
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

}  // namespace

Result<ImportedFile> ImportFile(const std::string& path) {
  return ImportRead(files::ReadFileBytes(path, files::kMaxFileBytes), path);
}

Result<ImportedFile> ImportRead(const files::FileBytes& file, const std::string& path) {
  switch (file.fault) {
    case files::FileFault::kMissing:
      return Failed("not_found", path, "there is no such file");
    case files::FileFault::kDirectory:
      return Failed("unreadable", path, "is a directory; name the file in it");
    case files::FileFault::kTooLarge:
      return Refused("too_large", path, "is larger than 256 MiB, which no meter's export is");
    case files::FileFault::kUnreadable:
      return Failed("unreadable", path, "cannot be read; check its permissions");
    case files::FileFault::kNone:
      break;
  }
  return ImportBytes(file.bytes, std::filesystem::path(path).filename().string());
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

}  // namespace lightcal::devices
