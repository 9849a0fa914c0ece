// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw_decode.h"

#include <libraw/libraw.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/memory_at_hand.h"
#include "lightcal_devices/captures/raw_answer.h"

namespace lightcal::devices {
namespace {

// Samples stand once in LibRaw and once more in what is handed over.
unsigned MostDecodedMegabytes() {
  return static_cast<unsigned>(std::min(2048.0, MemoryAtHandBytes() / 2.0 / (1024.0 * 1024.0)));
}

// No RAW packs more pixels into a byte; one that says so is damaged, and would cost minutes.
constexpr double kMostPixelsPerByte = 32.0;

// A LibRaw over a mapped file. It never moves: LibRaw keeps pointers into it.
struct OpenRaw {
  const MappedFile& file;
  RawTagWalk walk{};
  LibRaw raw{};
  bool data_error = false;  // LibRaw goes on after damaged data; we do not
};

tl::unexpected<Error> CutShort(const std::string& path) {
  return Refused("bad_picture", path,
                 "the file is damaged or cut short; copy it from the card again");
}

Result<void> Checked(int error, const OpenRaw& open, const std::string& path) {
  if (error == LIBRAW_SUCCESS && !open.data_error) return {};
  switch (error) {
    case LIBRAW_FILE_UNSUPPORTED:
      return Refused("unknown_format", path, "no camera RAW that LibRaw knows");
    case LIBRAW_TOO_BIG:
    case LIBRAW_UNSUFFICIENT_MEMORY:
      return Refused("too_large", path,
                     MostDecodedMegabytes() < 2048 ? std::string(kSamplesNeedMemory)
                                                   : "its samples would need more than 2 GiB");
    case LIBRAW_REQUEST_FOR_NONEXISTENT_IMAGE:
    case LIBRAW_OUT_OF_ORDER_CALL:
    case LIBRAW_NOT_IMPLEMENTED:
      return Refused("unsupported_picture", path,
                     std::string("LibRaw cannot decode this kind of RAW (") +
                         libraw_strerror(error) + "); convert it to a DNG without compression");
    default:
      return Refused(
          "bad_picture", path,
          std::string("the file is damaged or cut short") +
              (error != LIBRAW_SUCCESS ? std::string(" (LibRaw: ") + libraw_strerror(error) + ")"
                                       : std::string()) +
              "; copy it from the card again");
  }
}

Result<void> Open(const std::string& path, OpenRaw& open) {
  LibRaw& raw = open.raw;
  raw.set_dataerror_handler([](void* flag, const char*, int) { *static_cast<bool*>(flag) = true; },
                            &open.data_error);
  raw.set_memerror_handler([](void*, const char*, const char*) {}, nullptr);
  CollectTags(raw, open.walk);
  raw.imgdata.params.raw_processing_options &=
      ~static_cast<unsigned>(LIBRAW_PROCESSING_CONVERTFLOAT_TO_INT);
  raw.imgdata.params.max_raw_memory_mb = MostDecodedMegabytes();
  // LibRaw's own pick of a white level from the brightest pixel differs from frame to frame.
  raw.imgdata.params.adjust_maximum_thr = 0.0F;
  const int error =
      raw.open_buffer(const_cast<void*>(open.file.bytes.get()), open.file.size);  // only read
  if (error != LIBRAW_SUCCESS && open.walk.count == 0) {
    return Refused("unknown_format", path, "no camera RAW that LibRaw knows");
  }
  if (auto ok = Checked(error, open, path); !ok) return ok;
  const double pixels = 1.0 * raw.imgdata.sizes.raw_width * raw.imgdata.sizes.raw_height;
  if (pixels > kMostPixelsPerByte * static_cast<double>(open.file.size)) return CutShort(path);
  // LibRaw fills what is missing at the end of a compressed DNG with grey and says nothing.
  if (raw.imgdata.idata.dng_version != 0 &&
      open.walk.EndOfData() > static_cast<double>(open.file.size)) {
    return CutShort(path);
  }
  return {};
}

Result<void> Write(int descriptor, std::size_t at, const void* data, std::size_t size) {
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = pwrite(descriptor, bytes, size, static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      return Failed("no_scratch_space", "samples",
                    std::string("cannot be kept (") + std::strerror(errno) +
                        "); set TMPDIR to a directory with room");
    }
    bytes += written;
    at += static_cast<std::size_t>(written);
    size -= static_cast<std::size_t>(written);
  }
  return {};
}

// Whole rows of one sample a pixel, as LibRaw holds them.
template <class Sample>
Result<void> WriteRows(const Sample* samples, const libraw_image_sizes_t& sizes, int descriptor,
                       RawAnswer& answer) {
  answer.samples = sizeof(Sample) == 2 ? RawAnswer::Samples::kUint16 : RawAnswer::Samples::kFloat;
  answer.row_bytes = sizes.raw_pitch;
  answer.left_bytes = static_cast<std::int64_t>(sizes.left_margin * sizeof(Sample));
  const auto* bytes = reinterpret_cast<const char*>(samples);
  return Write(descriptor, kSamplesAt, bytes + sizes.top_margin * std::size_t{sizes.raw_pitch},
               sizes.height * std::size_t{sizes.raw_pitch});
}

tl::unexpected<Error> OddDeltas(const std::string& path) {
  return Refused(
      "unsupported_picture", path,
      "its black levels by row or column (BlackLevelDeltaV, BlackLevelDeltaH) are not as "
      "many as its picture has rows or columns, or its picture is no mosaic; convert it "
      "to a DNG with one black level");
}

// The same as floats, each less what the black of its row and column is above that of the file.
Result<void> WriteLessDeltas(const std::uint16_t* samples, const libraw_image_sizes_t& sizes,
                             const RawTagWalk& walk, const std::string& path, int descriptor,
                             RawAnswer& answer) {
  const std::size_t width = sizes.width, height = sizes.height;
  const auto& columns = walk.black_of_columns;
  const auto& rows = walk.black_of_rows;
  if ((!columns.empty() && columns.size() != width) || (!rows.empty() && rows.size() != height)) {
    return OddDeltas(path);
  }
  answer.samples = RawAnswer::Samples::kFloat;
  answer.row_bytes = static_cast<std::int64_t>(width * sizeof(float));
  std::vector<float> out;
  out.reserve(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint16_t* row = samples +
                               (y + sizes.top_margin) * (sizes.raw_pitch / sizeof(std::uint16_t)) +
                               sizes.left_margin;
    for (std::size_t x = 0; x < width; ++x) {
      const double delta = (rows.empty() ? 0.0 : rows[y]) + (columns.empty() ? 0.0 : columns[x]);
      out.push_back(static_cast<float>(row[x] - delta));
    }
  }
  return Write(descriptor, kSamplesAt, out.data(), out.size() * sizeof(float));
}

// Pixels of four colours LibRaw holds, as the channels lightcal has.
template <class Pixel>
Result<void> WriteColors(const Pixel* pixels, const libraw_image_sizes_t& sizes, int channels,
                         int descriptor, RawAnswer& answer) {
  answer.samples = RawAnswer::Samples::kUint16;
  answer.channels = channels;
  std::vector<std::uint16_t> copy;
  copy.reserve(std::size_t{sizes.width} * sizes.height * static_cast<std::size_t>(channels));
  for (std::size_t y = 0; y < sizes.height; ++y) {
    const Pixel* row = pixels + (y + sizes.top_margin) * sizes.raw_width + sizes.left_margin;
    for (std::size_t x = 0; x < sizes.width; ++x) {
      copy.insert(copy.end(), row[x], row[x] + channels);
    }
  }
  answer.row_bytes =
      static_cast<std::int64_t>(2 * std::size_t{sizes.width} * static_cast<std::size_t>(channels));
  return Write(descriptor, kSamplesAt, copy.data(), 2 * copy.size());
}

// How often each number stands in the picture.
template <class Pixel>
std::vector<std::size_t> CountNumbers(const Pixel* pixels, std::size_t row_pixels,
                                      const libraw_image_sizes_t& sizes, int channels) {
  std::vector<std::size_t> counts(65536);
  for (std::size_t y = 0; y < sizes.height; ++y) {
    const Pixel* row = pixels + (y + sizes.top_margin) * row_pixels + sizes.left_margin;
    for (std::size_t x = 0; x < sizes.width; ++x) {
      const auto* const first = reinterpret_cast<const std::uint16_t*>(row + x);
      for (int c = 0; c < channels; ++c) ++counts[first[c]];
    }
  }
  return counts;
}

std::vector<std::size_t> CountNumbers(const libraw_data_t& data) {
  const libraw_rawdata_t& raw = data.rawdata;
  const libraw_image_sizes_t& sizes = data.sizes;
  const int channels = data.idata.colors == 1 ? 1 : 3;
  if (raw.raw_image != nullptr) {
    return CountNumbers(raw.raw_image, sizes.raw_pitch / sizeof(std::uint16_t), sizes, 1);
  }
  if (raw.color3_image != nullptr) {
    return CountNumbers(raw.color3_image, sizes.raw_width, sizes, channels);
  }
  if (raw.color4_image != nullptr) {
    return CountNumbers(raw.color4_image, sizes.raw_width, sizes, channels);
  }
  return {};
}

// A DNG without WhiteLevel is full at the largest number its bits hold (DNG 1.6, WhiteLevel), which
// LibRaw knows. Where its brightest samples are one number below that, it was full there.
Result<void> CheckUntoldWhite(const OpenRaw& open, const std::string& path) {
  constexpr double kFull = 0.99;
  constexpr std::size_t kLeastPile = 64, kNearShare = 64;
  constexpr std::size_t kFewLevels = 256;  // of a dark frame, whose noise is a level or two
  const libraw_data_t& data = open.raw.imgdata;
  if (data.idata.dng_version == 0 || open.walk.has_white_level) return {};
  const std::vector<std::size_t> counts = CountNumbers(data);
  const auto brightest = std::find_if(counts.rbegin(), counts.rend(), [](auto n) { return n > 0; });
  if (brightest == counts.rend() || *brightest < kLeastPile) return {};
  const auto top = static_cast<std::size_t>(counts.rend() - brightest) - 1;
  if (top < kFewLevels || static_cast<double>(top) >= kFull * data.color.maximum) return {};
  const auto at = counts.begin() + static_cast<std::ptrdiff_t>(top);
  const auto near = std::accumulate(at - static_cast<std::ptrdiff_t>(top / kNearShare), at, 0UL);
  if (*brightest <= near) return {};
  return Refused("unsupported_picture", path,
                 "it has no WhiteLevel tag, which means " + std::to_string(data.color.maximum) +
                     ", but its brightest samples are all " + std::to_string(top) +
                     ", as if the sensor were full there; write that into the tag");
}

Result<void> WriteSamples(OpenRaw& open, const std::string& path, int descriptor,
                          RawAnswer& answer) {
  if (auto ok = Checked(open.raw.unpack(), open, path); !ok) return ok;
  if (auto ok = CheckUntoldWhite(open, path); !ok) return ok;
  const libraw_rawdata_t& data = open.raw.imgdata.rawdata;
  const libraw_image_sizes_t& sizes = open.raw.imgdata.sizes;
  const int channels = open.raw.imgdata.idata.colors == 1 ? 1 : 3;
  if (open.walk.has_black_deltas()) {
    if (data.raw_image == nullptr) return OddDeltas(path);
    return WriteLessDeltas(data.raw_image, sizes, open.walk, path, descriptor, answer);
  }
  if (data.raw_image != nullptr) return WriteRows(data.raw_image, sizes, descriptor, answer);
  if (data.float_image != nullptr && (open.raw.imgdata.idata.filters != 0 || channels == 1)) {
    return WriteRows(data.float_image, sizes, descriptor, answer);
  }
  if (data.color3_image != nullptr) {
    return WriteColors(data.color3_image, sizes, channels, descriptor, answer);
  }
  if (data.color4_image != nullptr) {
    return WriteColors(data.color4_image, sizes, channels, descriptor, answer);
  }
  return Refused("unsupported_picture", path,
                 "LibRaw gives no sensor values for this kind of RAW; convert it to a DNG");
}

Result<void> Decode(const std::string& path, const MappedFile& file, bool with_samples,
                    int descriptor, RawAnswer& answer) {
  const std::unique_ptr<OpenRaw> open(new OpenRaw{file});
  if (auto ok = Open(path, *open); !ok) return ok;
  if (with_samples) {
    if (auto ok = WriteSamples(*open, path, descriptor, answer); !ok) return ok;
  }
  const libraw_data_t& data = open->raw.imgdata;
  answer.sizes = data.sizes;
  answer.camera = data.idata;
  answer.color = data.color;
  answer.other = data.other;
  answer.tags = open->walk.tags;
  return {};
}

template <std::size_t N>
void Copy(const std::string& text, std::array<char, N>& to) {
  std::copy_n(text.begin(), std::min(text.size(), N - 1), to.begin());
}

void Describe(const Error& error, RawAnswer& answer) {
  answer.is_error = true;
  answer.error_kind = error.kind;
  Copy(error.code, answer.code);
  Copy(error.message, answer.message);
}

}  // namespace

void DecodeRaw(const std::string& path, const MappedFile& file, bool with_samples,
               int descriptor) noexcept {
  const auto answer = std::make_unique<RawAnswer>();
  // LibRaw throws from a few of its readers.
  try {
    const auto done = Decode(path, file, with_samples, descriptor, *answer);
    if (!done) Describe(done.error(), *answer);
  } catch (const std::exception& error) {
    Describe({ErrorKind::kRefused, "bad_picture", path,
              std::string("LibRaw cannot read it: ") + error.what()},
             *answer);
  } catch (...) {
    Describe({ErrorKind::kRefused, "bad_picture", path, "LibRaw cannot read it"}, *answer);
  }
  static_cast<void>(Write(descriptor, 0, answer.get(), sizeof(RawAnswer)));
}

}  // namespace lightcal::devices
