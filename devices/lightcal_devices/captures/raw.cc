// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw.h"

#include <libraw/libraw.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/raw_info.h"

namespace lightcal {
namespace {

constexpr unsigned kMostDecodedMegabytes = 2048;
// No RAW packs more pixels into a byte; one that says so is damaged, and would cost minutes.
constexpr double kMostPixelsPerByte = 32.0;

// A LibRaw over a mapped file. It never moves: LibRaw keeps pointers into it.
struct OpenRaw {
  MappedFile file;
  RawTags tags;
  LibRaw raw;
  bool data_error = false;  // LibRaw goes on after damaged data; we do not
};

tl::unexpected<Error> CutShort(const std::string& path, const std::string& detail) {
  return Refused("bad_picture", path,
                 "the file is damaged or cut short" + detail + "; copy it from the card again");
}

Result<void> Checked(int error, const OpenRaw& open, const std::string& path) {
  if (error == LIBRAW_SUCCESS && !open.data_error) return {};
  switch (error) {
    case LIBRAW_FILE_UNSUPPORTED:
      return Refused("unknown_format", path, "no camera RAW that LibRaw knows");
    case LIBRAW_TOO_BIG:
    case LIBRAW_UNSUFFICIENT_MEMORY:
      return Refused("too_large", path, "its samples would need more than 2 GiB");
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

Result<std::shared_ptr<OpenRaw>> Open(const std::string& path) {
  auto mapped = MapFile(path);
  if (!mapped) return Propagate(std::move(mapped));
  auto open = std::make_shared<OpenRaw>();
  open->file = std::move(*mapped);
  LibRaw& raw = open->raw;
  raw.set_dataerror_handler([](void* flag, const char*, int) { *static_cast<bool*>(flag) = true; },
                            &open->data_error);
  raw.set_memerror_handler([](void*, const char*, const char*) {}, nullptr);
  CollectTags(raw, open->tags);
  raw.imgdata.params.raw_processing_options &=
      ~static_cast<unsigned>(LIBRAW_PROCESSING_CONVERTFLOAT_TO_INT);
  raw.imgdata.params.max_raw_memory_mb = kMostDecodedMegabytes;
  // LibRaw's own pick of a white level from the brightest pixel differs from frame to frame.
  raw.imgdata.params.adjust_maximum_thr = 0.0F;
  const int error =
      raw.open_buffer(const_cast<void*>(open->file.bytes.get()), open->file.size);  // only read
  if (error != LIBRAW_SUCCESS && open->tags.count == 0) {
    return Refused("unknown_format", path, "no camera RAW that LibRaw knows");
  }
  if (auto ok = Checked(error, *open, path); !ok) return Propagate(std::move(ok));
  const double pixels = 1.0 * raw.imgdata.sizes.raw_width * raw.imgdata.sizes.raw_height;
  if (pixels > kMostPixelsPerByte * static_cast<double>(open->file.size)) {
    return CutShort(path, "");
  }
  // LibRaw fills what is missing at the end of a compressed DNG with grey and says nothing.
  if (raw.imgdata.idata.dng_version != 0 &&
      open->tags.EndOfData() > static_cast<double>(open->file.size)) {
    return CutShort(path, "");
  }
  return open;
}

// Pixels of four or three colours LibRaw holds, as three channels of our own.
template <class Pixel>
std::pair<SampleView, std::shared_ptr<const void>> CopyColors(const Pixel* pixels,
                                                              const libraw_image_sizes_t& sizes,
                                                              int channels) {
  const std::size_t width = sizes.width, height = sizes.height;
  auto copy = std::make_shared<std::vector<std::uint16_t>>();
  copy->reserve(width * height * channels);
  for (std::size_t y = 0; y < height; ++y) {
    const Pixel* row = pixels + (y + sizes.top_margin) * sizes.raw_width + sizes.left_margin;
    for (std::size_t x = 0; x < width; ++x) copy->insert(copy->end(), row[x], row[x] + channels);
  }
  View2d<const std::uint16_t> view(copy->data(), sizes.width, sizes.height, channels);
  return {view, std::move(copy)};
}

Result<Frame> Samples(std::shared_ptr<OpenRaw> open, FrameInfo info) {
  const libraw_rawdata_t& data = open->raw.imgdata.rawdata;
  const libraw_image_sizes_t& sizes = open->raw.imgdata.sizes;
  const auto inside = [&](auto* samples) {
    using Sample = std::remove_pointer_t<decltype(samples)>;
    const std::ptrdiff_t stride = sizes.raw_pitch / sizeof(Sample);
    return View2d<const Sample>(samples + sizes.top_margin * stride + sizes.left_margin,
                                sizes.width, sizes.height, 1, stride);
  };
  Frame frame;
  frame.info = std::move(info);
  if (data.raw_image != nullptr) {
    frame.samples = inside(data.raw_image);
    frame.owner = std::move(open);
  } else if (data.float_image != nullptr && frame.info.channels == 1) {
    frame.samples = inside(data.float_image);
    frame.owner = std::move(open);
  } else if (data.color3_image != nullptr) {
    std::tie(frame.samples, frame.owner) =
        CopyColors(data.color3_image, sizes, frame.info.channels);
  } else if (data.color4_image != nullptr) {
    std::tie(frame.samples, frame.owner) =
        CopyColors(data.color4_image, sizes, frame.info.channels);
  } else {
    return Refused("unsupported_picture", frame.info.file,
                   "LibRaw gives no sensor values for this kind of RAW; convert it to a DNG");
  }
  return frame;
}

// The same samples in a scratch file; LibRaw's memory is given back with `frame`.
Result<Frame> Moved(Frame frame) {
  return std::visit(
      [&](const auto& view) -> Result<Frame> {
        using Sample = std::remove_const_t<std::remove_pointer_t<decltype(view.data())>>;
        const std::size_t row_bytes = view.row(0).size_bytes();
        auto scratch = MapScratchFile(row_bytes * view.height());
        if (!scratch) return Propagate(std::move(scratch));
        auto* const samples = static_cast<Sample*>(scratch->get());
        const View2d<const Sample> moved(samples, view.width(), view.height(), view.channels());
        for (int y = 0; y < view.height(); ++y) {
          std::memcpy(samples + y * moved.row_stride(), view.row(y).data(), row_bytes);
        }
        return Frame{std::move(frame.info), moved, std::move(*scratch)};
      },
      SampleView(frame.samples));
}

// LibRaw throws from a few of its readers.
template <class T, class Read>
Result<T> WithoutExceptions(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const std::exception& error) {
    return Refused("bad_picture", path, std::string("LibRaw cannot read it: ") + error.what());
  } catch (...) {
    return Refused("bad_picture", path, "LibRaw cannot read it");
  }
}

}  // namespace

bool LooksLikeRaw(const std::string& path) {
  static constexpr std::array kExtensions = {".dng", ".nef", ".nrw", ".cr2", ".cr3", ".crw", ".arw",
                                             ".srf", ".sr2", ".raf", ".rw2", ".orf", ".pef", ".srw",
                                             ".kdc", ".dcr", ".3fr", ".fff", ".iiq", ".rwl", ".mrw",
                                             ".x3f", ".erf", ".mef", ".mos", ".raw", ".gpr"};
  const std::string name = LowerAscii(path);
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](std::string_view extension) { return name.ends_with(extension); });
}

Result<FrameInfo> ReadRawInfo(const std::string& path) {
  return WithoutExceptions<FrameInfo>(path, [&]() -> Result<FrameInfo> {
    auto open = Open(path);
    if (!open) return Propagate(std::move(open));
    return FrameInfoOf((*open)->raw, (*open)->tags, path);
  });
}

Result<Frame> ReadRaw(const std::string& path, SampleStore store) {
  return WithoutExceptions<Frame>(path, [&]() -> Result<Frame> {
    auto open = Open(path);
    if (!open) return Propagate(std::move(open));
    OpenRaw& opened = **open;
    if (auto ok = Checked(opened.raw.unpack(), opened, path); !ok) return Propagate(std::move(ok));
    auto info = FrameInfoOf(opened.raw, opened.tags, path);
    if (!info) return Propagate(std::move(info));
    auto frame = Samples(std::move(*open), std::move(*info));
    if (!frame || store == SampleStore::kMemory) return frame;
    return Moved(std::move(*frame));
  });
}

}  // namespace lightcal
