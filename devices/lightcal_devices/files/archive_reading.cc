// SPDX-License-Identifier: Apache-2.0
// The whole of lightcal_archive.so: the one file that sees libarchive.

#include <archive.h>
#include <archive_entry.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "lightcal_devices/files/archive.h"
#include "lightcal_devices/files/archive_module.h"

namespace lightcal::devices::files {
namespace {

using ArchivePtr = std::unique_ptr<archive, decltype(&archive_read_free)>;

bool IsPayload(archive_entry* entry) {
  const char* path = archive_entry_pathname_utf8(entry);
  const std::string_view name = path == nullptr ? "" : path;
  const std::size_t slash = name.rfind('/');
  const std::string_view file = slash == std::string_view::npos ? name : name.substr(slash + 1);
  return archive_entry_filetype(entry) == AE_IFREG && !name.starts_with("__MACOSX/") &&
         !file.starts_with("._");
}

Result<std::string> ReadEntry(archive* zip, std::string_view name, std::size_t most) {
  std::string contents;
  std::array<char, 1 << 16> chunk{};
  for (;;) {
    const auto size = archive_read_data(zip, chunk.data(), chunk.size());
    if (size == 0) return contents;
    if (size < 0) {
      return Refused("bad_archive", std::string(name), "cannot be unpacked; it may be damaged");
    }
    contents.append(chunk.data(), static_cast<std::size_t>(size));
    if (contents.size() > most) {
      return Refused("too_large", std::string(name),
                     "unpacks to more than " + std::to_string(most >> 20U) + " MiB");
    }
  }
}

}  // namespace

Result<std::string> ReadOnlyFileInZip(std::string_view bytes, std::string_view name) {
  const ArchivePtr zip(archive_read_new(), &archive_read_free);
  archive_read_support_format_zip(zip.get());
  if (archive_read_open_memory(zip.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) {
    return Refused("bad_archive", std::string(name), "cannot be opened; it may be damaged");
  }
  std::optional<std::string> only;
  archive_entry* entry = nullptr;
  int status = ARCHIVE_OK;
  while ((status = archive_read_next_header(zip.get(), &entry)) == ARCHIVE_OK) {
    if (!IsPayload(entry)) continue;
    if (only) {
      return Refused("bad_archive", std::string(name),
                     "holds several files; unpack it and name the one you mean");
    }
    auto contents = ReadEntry(zip.get(), name, kMaxFileBytes);
    if (!contents) return Propagate(std::move(contents));
    only = std::move(*contents);
  }
  if (status != ARCHIVE_EOF || !only) {
    return Refused("bad_archive", std::string(name),
                   only ? "is cut short" : "holds no file that can be unpacked");
  }
  return std::move(*only);
}

Result<std::string> ReadFileInZip(std::string_view bytes, std::string_view path, std::size_t most,
                                  std::string_view name) {
  constexpr int kMostEntries = 10000;
  const ArchivePtr zip(archive_read_new(), &archive_read_free);
  archive_read_support_format_zip(zip.get());
  if (archive_read_open_memory(zip.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) {
    return Refused("bad_archive", std::string(name), "is no zip archive, or damaged");
  }
  archive_entry* entry = nullptr;
  for (int i = 0; i < kMostEntries; ++i) {
    if (archive_read_next_header(zip.get(), &entry) != ARCHIVE_OK) break;
    const char* found = archive_entry_pathname_utf8(entry);
    if (found != nullptr && path == found) return ReadEntry(zip.get(), name, most);
  }
  return Refused("bad_archive", std::string(name),
                 "holds no " + std::string(path) + " that can be unpacked; it may be damaged");
}

}  // namespace lightcal::devices::files

extern "C" __attribute__((visibility("default"))) const lightcal::devices::files::ArchiveFunctions*
lightcal_archive_functions() noexcept {
  using namespace lightcal::devices::files;
  static constexpr ArchiveFunctions kFunctions = {&ReadOnlyFileInZip, &ReadFileInZip};
  return &kFunctions;
}
