// SPDX-License-Identifier: Apache-2.0
// The part of reading a RAW that foreign code does, in the module of frame_files_module.h. It runs
// in a process of its own: LibRaw 0.20.2 reads outside its memory on damaged files (see
// lib/DECISIONS.md).
#pragma once

#include <string>

#include "lightcal_devices/captures/mapped_file.h"

namespace lightcal::devices {

// Reads the RAW of that path, which is mapped, with LibRaw and writes a RawAnswer, and where asked
// its samples, to the file descriptor. Never throws; what goes wrong is in the answer, as raw.h
// says.
void DecodeRaw(const std::string& path, const MappedFile& file, bool with_samples,
               int descriptor) noexcept;

}  // namespace lightcal::devices
