// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/stored_zip.h"

#include <cstdint>

#include "lightcal/core/crc32.h"

namespace lightcal {
namespace {

constexpr std::uint16_t kZipVersion = 20, kUtf8Names = 0x0800, kFirstOfJanuary1980 = 0x0021;

void PutLittle(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>((value >> (8 * i)) & 0xFFU);
}

// What the entry itself and the central directory say alike, from the version needed on.
void PutEntryFields(std::string& out, const PresetFile& file) {
  const auto size = static_cast<std::uint32_t>(file.contents.size());
  PutLittle(out, kZipVersion, 2);
  PutLittle(out, kUtf8Names, 2);
  PutLittle(out, 0, 2);  // stored
  PutLittle(out, 0, 2);  // midnight
  PutLittle(out, kFirstOfJanuary1980, 2);
  PutLittle(out, Crc32(file.contents), 4);
  PutLittle(out, size, 4);
  PutLittle(out, size, 4);
  PutLittle(out, static_cast<std::uint32_t>(file.name.size()), 2);
  PutLittle(out, 0, 2);  // no extra field
}

}  // namespace

std::string StoredZip(std::span<const PresetFile> files) {
  std::string out;
  std::string directory;
  for (const PresetFile& file : files) {
    const auto place = static_cast<std::uint32_t>(out.size());
    PutLittle(out, 0x04034b50, 4);
    PutEntryFields(out, file);
    out += file.name + file.contents;
    PutLittle(directory, 0x02014b50, 4);
    PutLittle(directory, kZipVersion, 2);
    PutEntryFields(directory, file);
    PutLittle(directory, 0, 2);  // no comment
    PutLittle(directory, 0, 2);  // disk
    PutLittle(directory, 0, 2);  // internal attributes
    PutLittle(directory, 0, 4);  // external attributes
    PutLittle(directory, place, 4);
    directory += file.name;
  }
  const auto count = static_cast<std::uint32_t>(files.size());
  const auto start = static_cast<std::uint32_t>(out.size());
  out += directory;
  PutLittle(out, 0x06054b50, 4);
  PutLittle(out, 0, 4);  // one disk
  PutLittle(out, count, 2);
  PutLittle(out, count, 2);
  PutLittle(out, static_cast<std::uint32_t>(directory.size()), 4);
  PutLittle(out, start, 4);
  PutLittle(out, 0, 2);  // no comment
  return out;
}

}  // namespace lightcal
