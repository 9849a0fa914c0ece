// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/records/fill_masked.h"
#include "lightcal/records/stored_pixels.h"
#include "lightcal_devices/captures/exposure_tags.h"
#include "lightcal_devices/captures/frame_files_module.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/masked_picture.h"
#include "lightcal_devices/captures/memory_at_hand.h"
#include "lightcal_devices/captures/picture_module.h"
#include "lightcal_devices/captures/radiance_header.h"
#include "lightcal_devices/captures/radiance_pixels.h"
#include "lightcal_devices/captures/sample_check.h"
#include "lightcal_devices/captures/tiff_sensitivity.h"

namespace lightcal::devices {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  const char* format;
};
constexpr std::array kMagics = {Magic{"\x76\x2f\x31\x01"sv, "exr"}, Magic{"#?"sv, "hdr"},
                                Magic{"\x89PNG"sv, "png"},          Magic{"\xFF\xD8\xFF"sv, "jpeg"},
                                Magic{"II*\0"sv, "tiff"},           Magic{"MM\0*"sv, "tiff"},
                                Magic{"II+\0"sv, "tiff"},           Magic{"MM\0+"sv, "tiff"}};

std::optional<std::string> FormatOf(std::string_view bytes) {
  for (const Magic& magic : kMagics) {
    if (bytes.starts_with(magic.bytes)) return magic.format;
  }
  return std::nullopt;
}

std::optional<double> NumberOf(const OiioPicture& picture, std::string_view name) {
  for (const auto& [key, value] : picture.numbers) {
    if (key == name) return value;
  }
  return std::nullopt;
}
std::string TextOf(const OiioPicture& picture, std::string_view name) {
  for (const auto& [key, value] : picture.texts) {
    if (key == name) return value;
  }
  return "";
}

IsoTags IsoTagsOf(const OiioPicture& picture, const std::string& format, std::string_view bytes) {
  if (format == "tiff") return IsoTagsOfTiff(bytes);
  return {.photographic = NumberOf(picture, "Exif:PhotographicSensitivity"),
          .type = NumberOf(picture, "Exif:SensitivityType"),
          .standard_output = NumberOf(picture, "Exif:StandardOutputSensitivity"),
          .recommended = NumberOf(picture, "Exif:RecommendedExposureIndex"),
          .iso_speed = NumberOf(picture, "Exif:ISOSpeed")};
}

void TakeCameraTags(const OiioPicture& picture, const IsoTags& iso, FrameInfo& info) {
  WrittenExposure written;
  written.exposure_time_s = NumberOf(picture, "ExposureTime");
  written.shutter_apex = NumberOf(picture, "Exif:ShutterSpeedValue");
  written.f_number = NumberOf(picture, "FNumber");
  written.aperture_apex = NumberOf(picture, "Exif:ApertureValue");
  written.iso = IsoOfTags(iso);
  info.exposure = ExposureFromTags(written, info.file, info.warnings);
  const auto positive = [](std::optional<double> v) { return v && std::isfinite(*v) && *v > 0.0; };
  if (const auto focal = NumberOf(picture, "Exif:FocalLength"); positive(focal)) {
    info.focal_length = Metres(*focal * 1e-3);
  }
  if (const auto far = NumberOf(picture, "Exif:SubjectDistance"); positive(far) && *far < 4e9) {
    info.subject_distance = Metres(*far);
  }
  std::string time = TextOf(picture, "Exif:DateTimeOriginal");
  if (time.empty()) time = TextOf(picture, "DateTime");
  info.time = IsoTimeFromExif(time);
  const std::string make = TextOf(picture, "Make"), model = TextOf(picture, "Model");
  info.camera = model.starts_with(make) ? model : make + " " + model;
}

Result<void> TakeRadianceHeader(std::string_view bytes, FrameInfo& info) {
  auto header = ParseRadianceHeader(bytes, info.file);
  if (!header) return Propagate(std::move(header));
  info.radiance_exposure = header->exposure;
  info.chromaticities = header->primaries;
  if (header->xyz) info.channel_names = {"X", "Y", "Z"};
  info.view = header->view;
  if (header->unknown_view) {
    info.warnings.push_back({"unknown_view", info.file,
                             "its VIEW line names a projection other than -vta and -vtv; say how "
                             "it was projected ({view.projection})"});
  }
  return {};
}

// Finished pictures stand as their Orientation says they are shown. Codes stay where the sensor has
// them, as its flat fields and masks do.
void TurnAsShown(OiioPicture& picture) {
  const int tag = picture.orientation;
  if (!picture.is_float || tag < 2 || tag > 8) return;
  picture.orientation = 1;
  const int stored_width = picture.width, stored_height = picture.height;
  const auto [rows_for_columns, from_right, from_below] = ShownTurnOf(tag);
  if (rows_for_columns) std::swap(picture.width, picture.height);
  if (picture.floats.empty()) return;
  std::vector<float> shown;
  shown.reserve(picture.floats.size());
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      int column = rows_for_columns ? y : x, row = rows_for_columns ? x : y;
      if (from_right) column = stored_width - 1 - column;
      if (from_below) row = stored_height - 1 - row;
      const auto at = (std::ptrdiff_t{row} * stored_width + column) * picture.channels;
      const auto pixel = picture.floats.begin() + at;
      shown.insert(shown.end(), pixel, pixel + picture.channels);
    }
  }
  picture.floats = std::move(shown);
}

struct Opened {
  MappedFile file;
  std::string format;
  [[nodiscard]] std::string_view bytes() const {
    return {static_cast<const char*>(file.bytes.get()), file.size};
  }
  [[nodiscard]] OiioBytes ForModule(const std::string& path) const {
    return {file.bytes.get(), file.size, path, format, MemoryAtHandBytes()};
  }
};

// Radiance's samples need no library, and OpenImageIO leaves out their half step.
Result<OiioPicture> ReadRadiance(const Opened& opened, const std::string& path, bool with_samples) {
  auto pixels = ReadRadiancePixels(opened.bytes(), path, with_samples);
  if (!pixels) return Propagate(std::move(pixels));
  OiioPicture picture;
  picture.width = pixels->width;
  picture.height = pixels->height;
  picture.channels = 3;
  picture.is_float = true;
  picture.channel_names = {"R", "G", "B"};
  picture.floats = std::move(pixels->samples);
  return picture;
}

Result<OiioPicture> ReadThroughModule(const Opened& opened, const std::string& path,
                                      bool with_samples) {
  if (opened.format == "hdr") return ReadRadiance(opened, path, with_samples);
  auto module = PictureModule();
  if (!module) return Propagate(std::move(module));
  OiioPicture picture;
  std::string error;
  switch ((*module)(opened.ForModule(path), with_samples, picture, error)) {
    case OiioOutcome::kRead:
      TurnAsShown(picture);
      return picture;
    case OiioOutcome::kTooLarge:
      return Refused("too_large", path, "it has more than 5e8 samples");
    case OiioOutcome::kNoMemory:
      return Refused("too_large", path, kSamplesNeedMemory);
    case OiioOutcome::kNoColor:
      return Refused("unsupported_picture", path, "it is no flat picture with pixels");
    case OiioOutcome::kUnknownFormat:
    case OiioOutcome::kBad:
      break;
  }
  while (error.ends_with('\n')) error.pop_back();
  return Refused("bad_picture", path,
                 "the file is damaged or cut short (" + error + "); copy it again");
}

Result<FrameInfo> Describe(const OiioPicture& picture, const std::string& path,
                           const std::string& format, std::string_view bytes) {
  FrameInfo info;
  info.file = path;
  info.format = format;
  info.width = picture.width;
  info.height = picture.height;
  info.channels = picture.channels;
  info.orientation = picture.orientation;
  info.channel_names = picture.channel_names;
  info.meaning = picture.is_float ? SampleMeaning::kLinear : SampleMeaning::kEncoded;
  if (!picture.is_float) {
    SensorLevels levels;
    levels.black.values = {0.0F};
    levels.maximum = picture.top_code;
    levels.white.fill(levels.maximum);
    info.levels = levels;
  }
  TakeCameraTags(picture, IsoTagsOf(picture, format, bytes), info);
  if (format == "hdr") {
    if (auto ok = TakeRadianceHeader(bytes, info); !ok) return Propagate(std::move(ok));
  }
  return info;
}

// JPEG readers fill in grey what is missing at the end. A whole file has its end marker behind the
// start of its scan; thumbnails, with end markers of their own, lie in segments before that.
bool JpegIsCut(std::string_view bytes) {
  constexpr char kMarker = '\xFF', kStartOfScan = '\xDA';
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == kMarker && bytes[at + 1] != kStartOfScan) {
    at += 2 + (static_cast<unsigned char>(bytes[at + 2]) << 8 |
               static_cast<unsigned char>(bytes[at + 3]));
  }
  const std::size_t end = bytes.rfind("\xFF\xD9"sv);
  return end == std::string_view::npos || end < at;
}

// The samples, in their own memory or moved to a scratch file; they are given up here.
template <class Sample>
Result<Frame> Kept(std::vector<Sample> samples, FrameInfo info, SampleStore store) {
  const auto view_of = [&info](const Sample* data) {
    return View2d<const Sample>(data, info.width, info.height, info.channels);
  };
  if (store == SampleStore::kScratchFile) {
    auto scratch = MapScratchFile(samples.size() * sizeof(Sample));
    if (!scratch) return Propagate(std::move(scratch));
    auto* const data = static_cast<Sample*>(scratch->get());
    std::copy(samples.begin(), samples.end(), data);
    const View2d<const Sample> view = view_of(data);
    return Frame{std::move(info), view, std::move(*scratch), true};
  }
  auto owner = std::make_shared<std::vector<Sample>>(std::move(samples));
  const View2d<const Sample> view = view_of(owner->data());
  return Frame{std::move(info), view, std::move(owner)};
}

Result<Frame> FrameOf(OiioPicture picture, FrameInfo info, SampleStore store) {
  if (!picture.is_float) return Kept(std::move(picture.codes), std::move(info), store);
  return Kept(std::move(picture.floats), std::move(info), store);
}

Result<Opened> Open(const std::string& path, OpenFiles* files) {
  auto file = MapFile(path, files);
  if (!file) return Propagate(std::move(file));
  Opened opened{std::move(*file), ""};
  const auto format = FormatOf(opened.bytes());
  if (!format) {
    return Refused("unknown_format", path,
                   "no picture lightcal reads: OpenEXR, Radiance HDR, TIFF, PNG, JPEG, camera RAW");
  }
  opened.format = *format;
  if (opened.format == "jpeg" && JpegIsCut(opened.bytes())) {
    return Refused("bad_picture", path, "the file is cut short; copy it again");
  }
  return opened;
}

// The whole picture, whatever its samples are.
Result<Frame> ReadUnchecked(const std::string& path, SampleStore store, OpenFiles* files) {
  auto opened = Open(path, files);
  if (!opened) return Propagate(std::move(opened));
  if (opened->format == "exr") {
    const auto module = FrameFilesModule();
    if (!module) return tl::unexpected(module.error());
    return (*module)->read_exr(path, opened->file, store);
  }
  auto picture = ReadThroughModule(*opened, path, true);
  if (!picture) return Propagate(std::move(picture));
  auto info = Describe(*picture, path, opened->format, opened->bytes());
  if (!info) return Propagate(std::move(info));
  return FrameOf(std::move(*picture), std::move(*info), store);
}

}  // namespace

Result<FrameInfo> ReadPictureInfo(const std::string& path, OpenFiles* files) {
  auto opened = Open(path, files);
  if (!opened) return Propagate(std::move(opened));
  if (opened->format == "exr") {
    const auto module = FrameFilesModule();
    if (!module) return tl::unexpected(module.error());
    return (*module)->read_exr_info(path, opened->file);
  }
  auto picture = ReadThroughModule(*opened, path, false);
  if (!picture) return Propagate(std::move(picture));
  return Describe(*picture, path, opened->format, opened->bytes());
}

Result<Frame> ReadPicture(const std::string& path, SampleStore store, OpenFiles* files) {
  auto frame = ReadUnchecked(path, store, files);
  if (!frame) return frame;
  const auto* const floats = std::get_if<View2d<const float>>(&frame->samples);
  if (floats == nullptr) return frame;
  if (auto ok = CheckSamples(*floats, path); !ok) return Propagate(std::move(ok));
  return frame;
}

Result<MaskedPicture> ReadMaskedPicture(const std::string& path, SampleStore store,
                                        OpenFiles* files) {
  auto frame = ReadUnchecked(path, store, files);
  if (!frame) return Propagate(std::move(frame));
  const auto* const floats = std::get_if<View2d<const float>>(&frame->samples);
  if (floats == nullptr || CheckSamples(*floats, path)) return MaskedPicture{std::move(*frame), {}};
  const auto channels = static_cast<std::size_t>(floats->channels());
  std::vector<float> samples;
  std::vector<std::size_t> masked;
  for (int y = 0; y < floats->height(); ++y) {
    const std::span<const float> row = floats->row(y);
    samples.insert(samples.end(), row.begin(), row.end());
  }
  for (std::size_t i = 0; i < samples.size(); i += channels) {
    const std::span<float> pixel = std::span(samples).subspan(i, channels);
    if (std::any_of(pixel.begin(), pixel.end(), IsBadSample)) masked.push_back(i / channels);
  }
  FillMasked(masked, static_cast<std::size_t>(floats->width()), channels, samples);
  auto whole = Kept(std::move(samples), std::move(frame->info), store);
  if (!whole) return Propagate(std::move(whole));
  return MaskedPicture{std::move(*whole), std::move(masked)};
}

Result<void> WriteExr(const std::string& path, const ExrPicture& picture) {
  const auto module = FrameFilesModule();
  if (!module) return tl::unexpected(module.error());
  return (*module)->write_exr(path, picture);
}

}  // namespace lightcal::devices
