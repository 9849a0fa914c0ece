// SPDX-License-Identifier: Apache-2.0
// The door to OpenImageIO: what the module lightcal_pictures.so answers. Nothing of OpenImageIO
// shows; both sides are built together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lightcal::devices {

struct OiioPicture {
  int width = 0, height = 0;
  int channels = 0;       // colour channels: 1 or 3
  int orientation = 1;    // 1 to 8, of TIFF 6.0 and EXIF
  bool is_float = false;  // scene-linear floats, else codes
  std::uint16_t top_code = 0;
  std::vector<std::string> channel_names;
  std::vector<std::pair<std::string, double>> numbers;  // attributes, by OpenImageIO's names
  std::vector<std::pair<std::string, std::string>> texts;
  std::vector<float> floats;         // interleaved, when is_float
  std::vector<std::uint16_t> codes;  // else; 8 bit ones as 0..255
};

enum class OiioOutcome { kRead, kUnknownFormat, kTooLarge, kNoMemory, kNoColor, kBad };

// A file that was read or mapped.
struct OiioBytes {
  const void* bytes = nullptr;
  std::size_t size = 0;
  std::string path;           // for messages
  std::string format;         // OpenImageIO's word: "png" "jpeg" "tiff" "hdr"
  double memory_bytes = 0.0;  // what its samples may take
};

// Samples only where asked. `error` says what OpenImageIO says.
using OiioRead = OiioOutcome (*)(const OiioBytes& file, bool with_samples, OiioPicture& picture,
                                 std::string& error) noexcept;
inline constexpr const char* kOiioReadSymbol = "lightcal_oiio_read";
inline constexpr const char* kOiioModuleName = "lightcal_pictures.so";

}  // namespace lightcal::devices
