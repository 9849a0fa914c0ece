// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/exr.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfRationalAttribute.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/photometry/half_range.h"
#include "lightcal_devices/captures/exposure_tags.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/memory_at_hand.h"

namespace lightcal::devices {
namespace {

constexpr double kMostSamples = 1 << 29;
constexpr float kMostHalf{kLargestHalf};
constexpr std::string_view kOurPrefix = "lightcal:";

Xy XyOf(const Imath::V2f& v) { return {v.x, v.y}; }

Result<void> TakeColor(const Imf::Header& header, FrameInfo& info) {
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    info.chromaticities = RgbPrimaries{XyOf(c.red), XyOf(c.green), XyOf(c.blue), XyOf(c.white)};
    if (!SpanColors(*info.chromaticities)) {
      return Refused("unsupported_picture", info.file,
                     "its chromaticities make no RGB space; write the file anew");
    }
  }
  if (Imf::hasWhiteLuminance(header)) {
    const float nits = Imf::whiteLuminance(header);
    if (nits > 0.0F && std::isfinite(nits)) info.white_luminance = Nits(nits);
  }
  info.environment_latlong = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_LATLONG;
  return {};
}

// A finite number of any of the types such attributes have.
std::optional<double> NumberOf(const Imf::Header& header, const char* name) {
  double number = std::numeric_limits<double>::quiet_NaN();
  if (const auto* real = header.findTypedAttribute<Imf::FloatAttribute>(name)) {
    number = real->value();
  } else if (const auto* whole = header.findTypedAttribute<Imf::IntAttribute>(name)) {
    number = whole->value();
  } else if (const auto* ratio = header.findTypedAttribute<Imf::RationalAttribute>(name);
             ratio != nullptr && ratio->value().d != 0) {
    number = static_cast<double>(ratio->value());
  }
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

void TakeExposure(const Imf::Header& header, FrameInfo& info) {
  WrittenExposure written;
  if (Imf::hasExpTime(header)) written.exposure_time_s = Imf::expTime(header);
  if (Imf::hasAperture(header)) written.f_number = Imf::aperture(header);
  if (Imf::hasIsoSpeed(header)) written.iso = Imf::isoSpeed(header);
  // Standard attributes of OpenEXR 3.2 that 3.1 reads as any other; the frame rate is older.
  written.t_stop = NumberOf(header, "tStop");
  written.shutter_angle_deg = NumberOf(header, "shutterAngle");
  written.frames_per_second = NumberOf(header, "captureRate");
  if (!written.frames_per_second) {
    written.frames_per_second = NumberOf(header, "framesPerSecond");
  }
  info.exposure = ExposureFromTags(written, info.file, info.warnings);
  auto focal_mm = NumberOf(header, "effectiveFocalLength");
  if (!focal_mm) focal_mm = NumberOf(header, "nominalFocalLength");
  if (focal_mm && *focal_mm > 0.0) info.focal_length = Metres(*focal_mm * 1e-3);
  if (const auto counter = NumberOf(header, "imageCounter")) {
    info.image_counter = static_cast<int>(*counter);
  }
  if (Imf::hasFocus(header) && Imf::focus(header) > 0.0F && std::isfinite(Imf::focus(header))) {
    info.subject_distance = Metres(Imf::focus(header));
  }
  if (Imf::hasCapDate(header)) info.time = IsoTimeFromExif(Imf::capDate(header));
}

void TakeOurAttributes(const Imf::Header& header, FrameInfo& info) {
  for (auto at = header.begin(); at != header.end(); ++at) {
    const std::string_view name = at.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&at.attribute());
    if (text == nullptr || !name.starts_with(kOurPrefix)) continue;
    info.lightcal_attributes.emplace_back(name.substr(kOurPrefix.size()), text->value());
  }
}

// Which channels are the picture.
struct Chosen {
  std::vector<std::string> names;  // in the file
  bool luminance_chroma = false;   // Y, RY, BY
};

std::vector<std::string> NamesOf(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (auto at = channels.begin(); at != channels.end(); ++at) names.emplace_back(at.name());
  return names;
}

// The first layer that has all of R, G, B; "" is the bare one.
std::vector<std::string> ColorLayer(const std::vector<std::string>& names) {
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (has("R") && has("G") && has("B")) return {"R", "G", "B"};
  for (const std::string& name : names) {
    if (!name.ends_with(".R")) continue;
    const std::string layer = name.substr(0, name.size() - 1);
    if (has(layer + "G") && has(layer + "B")) return {layer + "R", layer + "G", layer + "B"};
  }
  return {};
}

Result<Chosen> ChooseChannels(const Imf::Header& header, FrameInfo& info) {
  const std::vector<std::string> names = NamesOf(header.channels());
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  Chosen chosen;
  if (has("Y") && has("RY") && has("BY")) return Chosen{{"R", "G", "B"}, true};
  chosen.names = ColorLayer(names);
  if (chosen.names.empty() && has("Y")) chosen.names = {"Y"};
  if (chosen.names.empty()) {
    return Refused("no_color_channels", info.file,
                   "it holds " + (names.empty() ? "no channels" : Joined(names)) +
                       "; R, G, B or Y are needed");
  }
  for (const std::string& name : chosen.names) {
    const Imf::Channel& channel = header.channels()[name];
    if (channel.xSampling != 1 || channel.ySampling != 1) {
      return Refused("unsupported_picture", info.file, "channel " + name + " is subsampled");
    }
  }
  if (chosen.names.front().size() > 1) {
    info.warnings.push_back({"layer_chosen", info.file,
                             "the first layer with R, G, B is taken: " + chosen.names.front()});
  }
  return chosen;
}

Result<Chosen> DescribeHeader(const Imf::Header& header, FrameInfo& info) {
  const Imath::Box2i window = header.dataWindow();
  const double width = 1.0 + window.max.x - window.min.x;
  const double height = 1.0 + window.max.y - window.min.y;
  auto chosen = ChooseChannels(header, info);
  if (!chosen) return chosen;
  info.channel_names = chosen->names;
  info.channels = static_cast<int>(chosen->names.size());
  if (width * height * info.channels > kMostSamples) {
    return Refused("too_large", info.file, "it has more than 5e8 samples");
  }
  info.width = static_cast<int>(width);
  info.height = static_cast<int>(height);
  info.meaning = SampleMeaning::kLinear;
  info.format = "exr";
  if (auto ok = TakeColor(header, info); !ok) return Propagate(std::move(ok));
  TakeExposure(header, info);
  TakeOurAttributes(header, info);
  return chosen;
}

// Where the samples go, all of one picture.
struct Floats {
  std::shared_ptr<void> owner;
  float* data = nullptr;
};

std::size_t SamplesOf(const FrameInfo& info) {
  return static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height) *
         static_cast<std::size_t>(info.channels);
}

Result<Floats> Room(const FrameInfo& info, SampleStore store) {
  const std::size_t samples = SamplesOf(info);
  if (store == SampleStore::kMemory) {
    // Not cleared: what a damaged file promises but does not hold costs no memory.
    auto memory = std::make_shared_for_overwrite<float[]>(samples);
    float* const data = memory.get();
    return Floats{std::move(memory), data};
  }
  auto scratch = MapScratchFile(samples * sizeof(float));
  if (!scratch) return Propagate(std::move(scratch));
  auto* const data = static_cast<float*>(scratch->get());
  return Floats{std::move(*scratch), data};
}

void ReadPlain(Imf::InputFile& file, const Chosen& chosen, const FrameInfo& info, float* samples) {
  const Imath::Box2i window = file.header().dataWindow();
  const std::size_t pixel = sizeof(float) * info.channels;
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < chosen.names.size(); ++c) {
    buffer.insert(chosen.names[c], Imf::Slice::Make(Imf::FLOAT, samples + c, window, pixel,
                                                    pixel * static_cast<std::size_t>(info.width)));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
}

// The most that half floats hold stands for all that is more, as does infinity: such samples are
// clipped.
void FindHalfClip(const Imf::ChannelList& channels, const Chosen& chosen, FrameInfo& info,
                  std::span<float> samples) {
  const bool half =
      chosen.luminance_chroma ||
      std::any_of(chosen.names.begin(), chosen.names.end(),
                  [&](const std::string& name) { return channels[name].type == Imf::HALF; });
  if (!half) return;
  std::size_t clipped = 0;
  for (float& sample : samples) {
    if (!(sample >= kMostHalf)) continue;
    sample = std::isinf(sample) ? kMostHalf : sample;
    ++clipped;
  }
  if (clipped == 0) return;
  SensorLevels levels;
  levels.black.values = {0.0F};
  levels.white.fill(kMostHalf);
  levels.maximum = kMostHalf;
  info.levels = levels;
  info.warnings.push_back(
      {"clipped", info.file,
       std::to_string(clipped) +
           " samples hold the most that a half float can, 65504, or more: there the picture is "
           "a lower bound; write it with 32-bit floats"});
}

// OpenEXR's own reconstruction of chroma.
void ReadLuminanceChroma(Imf::IStream& bytes, const FrameInfo& info, float* samples) {
  bytes.seekg(0);
  Imf::RgbaInputFile file(bytes);
  const Imath::Box2i window = file.dataWindow();
  Imf::Array2D<Imf::Rgba> pixels(info.height, info.width);
  // OpenEXR wants the address pixel (0, 0) would have; it may lie outside the array.
  const auto origin =
      reinterpret_cast<std::uintptr_t>(&pixels[0][0]) -
      sizeof(Imf::Rgba) * (window.min.x + static_cast<std::intptr_t>(window.min.y) * info.width);
  file.setFrameBuffer(reinterpret_cast<Imf::Rgba*>(origin), 1, info.width);
  file.readPixels(window.min.y, window.max.y);
  for (int y = 0; y < info.height; ++y) {
    for (int x = 0; x < info.width; ++x) {
      const Imf::Rgba& p = pixels[y][x];
      for (const float channel : {float(p.r), float(p.g), float(p.b)}) *samples++ = channel;
    }
  }
}

// A mapped file as OpenEXR reads files, with the words that its own stream has for a file that is
// cut short.
class MappedStream final : public Imf::IStream {
 public:
  MappedStream(const std::string& path, const MappedFile& file)
      : Imf::IStream(path.c_str()), file_(file) {}

  bool read(char bytes[], int count) override {
    const std::uint64_t left = file_.size - std::min<std::uint64_t>(at_, file_.size);
    const std::uint64_t wanted = static_cast<std::uint64_t>(count);
    if (left < wanted) {
      throw Iex::InputExc("Early end of file: read " + std::to_string(left) + " out of " +
                          std::to_string(wanted) + " requested bytes.");
    }
    std::memcpy(bytes, static_cast<const char*>(file_.bytes.get()) + at_, wanted);
    at_ += wanted;
    return at_ < file_.size;
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  const MappedFile& file_;
  std::uint64_t at_ = 0;
};

// Runs `read(file, stream, chosen, info)` over the opened file; OpenEXR speaks in exceptions.
template <class T, class Read>
Result<T> WithFile(const std::string& path, const MappedFile& mapped, const Read& read) {
  try {
    MappedStream stream(path, mapped);
    Imf::InputFile file(stream);
    FrameInfo info;
    info.file = path;
    auto chosen = DescribeHeader(file.header(), info);
    if (!chosen) return Propagate(std::move(chosen));
    return read(file, stream, *chosen, std::move(info));
  } catch (const std::exception& error) {
    return Refused("bad_picture", path,
                   std::string("the file is damaged or cut short (OpenEXR: ") + error.what() + ")");
  }
}

}  // namespace

Result<FrameInfo> ReadExrInfo(const std::string& path, const MappedFile& file) {
  return WithFile<FrameInfo>(path, file,
                             [](Imf::InputFile&, Imf::IStream&, const Chosen&,
                                FrameInfo info) -> Result<FrameInfo> { return info; });
}

Result<Frame> ReadExr(const std::string& path, const MappedFile& mapped, SampleStore store) {
  return WithFile<Frame>(
      path, mapped,
      [&](Imf::InputFile& file, Imf::IStream& stream, const Chosen& chosen,
          FrameInfo info) -> Result<Frame> {
        const double pixels = 1.0 * info.width * info.height;
        const double held = store == SampleStore::kMemory ? sizeof(float) * info.channels : 0.0;
        const double decoded = chosen.luminance_chroma ? sizeof(Imf::Rgba) : 0.0;
        if (auto ok = CheckFitsMemory(pixels * (held + decoded), path); !ok) {
          return Propagate(std::move(ok));
        }
        auto room = Room(info, store);
        if (!room) return Propagate(std::move(room));
        if (chosen.luminance_chroma) {
          ReadLuminanceChroma(stream, info, room->data);
        } else {
          ReadPlain(file, chosen, info, room->data);
        }
        ReleasePages(mapped);
        FindHalfClip(file.header().channels(), chosen, info, {room->data, SamplesOf(info)});
        const View2d<const float> view(room->data, info.width, info.height, info.channels);
        return Frame{std::move(info), view, std::move(room->owner),
                     store == SampleStore::kScratchFile};
      });
}

}  // namespace lightcal::devices
