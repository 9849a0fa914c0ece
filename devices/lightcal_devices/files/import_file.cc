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

// Null where none recognises the text.
const Format* FormatOf(std::string_view text) {
  const auto format = std::ranges::find_if(
      kFormats, [&](const Format& candidate) { return candidate.recognise(text); });
  return format == kFormats.end() ? nullptr : &*format;
}

// The file's text and what messages call it.
struct NamedText {
  std::string text;
  std::string name;
};

Result<NamedText> TextOf(std::string_view bytes, std::string_view name) {
  std::string unpacked;
  if (files::IsZip(bytes)) {
    auto only = files::OnlyFileInZip(bytes, name);
    if (!only) return Propagate(std::move(only));
    unpacked = std::move(*only);
    bytes = unpacked;
  }
  auto text = files::TextFromBytes(bytes, name);
  if (!text) return Propagate(std::move(text));
  if (TrimBlanks(*text).empty()) {
    return Refused("no_rows", std::string(name), "is empty; export it again");
  }
  return NamedText{*std::move(text), std::string(name)};
}

Result<void> CheckReadable(const files::FileBytes& file, const std::string& path) {
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
  return {};
}

std::string FileNameOf(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

Result<ImportedFile> ImportFile(const std::string& path, const TableWords& words) {
  if (words.columns.empty() && words.decimals == DecimalSign::kUnsaid) return ImportFile(path);
  const auto file = files::ReadFileBytes(path, files::kMaxFileBytes);
  if (auto readable = CheckReadable(file, path); !readable) return Propagate(std::move(readable));
  const auto named = TextOf(file.bytes, FileNameOf(path));
  if (!named) return tl::unexpected(named.error());
  if (!words.columns.empty()) {
    return files::ReadCsvOfColumns(named->text, named->name, words);
  }
  if (const Format* const format = FormatOf(named->text);
      format == nullptr || format->read != files::ReadPlainCsv) {
    return Refused("unknown_format", named->name,
                   "is no table under names of columns, of which alone one says what parts "
                   "decimals; leave {import.decimals} out, or name the columns: "
                   "{import.columns}");
  }
  return files::ReadCsvUnderHeader(named->text, named->name, words.decimals);
}

Result<ImportedFile> ImportFile(const std::string& path) {
  return ImportRead(files::ReadFileBytes(path, files::kMaxFileBytes), path);
}

Result<ImportedFile> ImportRead(const files::FileBytes& file, const std::string& path) {
  if (auto readable = CheckReadable(file, path); !readable) return Propagate(std::move(readable));
  return ImportBytes(file.bytes, FileNameOf(path));
}

Result<ImportedFile> ImportBytes(std::string_view bytes, std::string_view name) {
  const auto named = TextOf(bytes, name);
  if (!named) return tl::unexpected(named.error());
  const std::string& text = named->text;
  if (const Format* const format = FormatOf(text)) return format->read(text, name);
  return Refused("unknown_format", std::string(name),
                 "its format is not recognised; of a table say what every column is: "
                 "{import.columns}. Understood are " +
                     Joined(kFormats, ", ", &Format::name) + " (" + files::PlainCsvColumns() + ")");
}

}  // namespace lightcal::devices
