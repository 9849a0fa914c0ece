// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/archive.h"

#include <utility>

#include "lightcal_devices/files/archive_module.h"
#include "lightcal_devices/transport/module_door.h"

namespace lightcal::devices::files {
namespace {

const Result<const ArchiveFunctions*>& Module() {
  static const auto module =
      OpenModuleFunctions<ArchiveFunctions>("lightcal_archive.so", kArchiveEntrySymbol,
                                            "no_archive_module", "the part that unpacks archives");
  return module;
}

// A zip ends with the record that tells where its directory is: 22 bytes and a comment.
Result<void> CheckDirectory(std::string_view bytes, std::string_view name) {
  constexpr std::size_t kRecord = 22;
  const std::size_t at = bytes.rfind("PK\x05\x06");
  if (at != std::string_view::npos && bytes.size() - at >= kRecord) return {};
  return Refused("bad_archive", std::string(name),
                 "is cut off: the directory that ends a zip is missing; copy it again");
}

}  // namespace

bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

Result<std::string> OnlyFileInZip(std::string_view bytes, std::string_view name) {
  if (auto whole = CheckDirectory(bytes, name); !whole) return Propagate(std::move(whole));
  const auto& module = Module();
  if (!module) return tl::unexpected(module.error());
  return (*module)->only_file(bytes, name);
}

Result<std::string> FileInZip(std::string_view bytes, std::string_view path, std::size_t most,
                              std::string_view name) {
  if (!IsZip(bytes)) {
    return Refused("bad_archive", std::string(name), "is no zip archive, or damaged");
  }
  if (auto whole = CheckDirectory(bytes, name); !whole) return Propagate(std::move(whole));
  const auto& module = Module();
  if (!module) return tl::unexpected(module.error());
  return (*module)->file(bytes, path, most, name);
}

}  // namespace lightcal::devices::files
