// SPDX-License-Identifier: Apache-2.0
// The whole of lightcal_pictures.so: the one file that sees OpenImageIO.
#include "lightcal_devices/captures/oiio_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <exception>
#include <memory>

namespace {

using lightcal::devices::OiioBytes;
using lightcal::devices::OiioOutcome;
using lightcal::devices::OiioPicture;

constexpr double kMostSamples = 1 << 29;

void TakeAttributes(const OIIO::ImageSpec& spec, OiioPicture& picture) {
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    const OIIO::TypeDesc type = attribute.type();
    if (type == OIIO::TypeString) {
      picture.texts.emplace_back(attribute.name().string(), attribute.get_string());
    } else if (type.numelements() == 1 && type.aggregate == OIIO::TypeDesc::SCALAR) {
      picture.numbers.emplace_back(attribute.name().string(), attribute.get_float());
    }
  }
}

bool ReadSamples(OIIO::ImageInput& input, OiioPicture& picture) {
  const std::size_t samples =
      static_cast<std::size_t>(picture.width) * picture.height * picture.channels;
  const auto read = [&](OIIO::TypeDesc type, void* data) {
    return input.read_image(0, 0, 0, picture.channels, type, data);
  };
  if (picture.is_float) {
    picture.floats.resize(samples);
    return read(OIIO::TypeDesc::FLOAT, picture.floats.data());
  }
  picture.codes.resize(samples);
  if (picture.top_code == 0xFFFF) return read(OIIO::TypeDesc::UINT16, picture.codes.data());
  std::vector<std::uint8_t> bytes(samples);
  if (!read(OIIO::TypeDesc::UINT8, bytes.data())) return false;
  picture.codes.assign(bytes.begin(), bytes.end());
  return true;
}

OiioOutcome ReadOpened(OIIO::ImageInput& input, bool with_samples, double memory_bytes,
                       OiioPicture& picture, std::string& error) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.deep || spec.depth > 1 || spec.nchannels < 1 || spec.width < 1 || spec.height < 1) {
    return OiioOutcome::kNoColor;
  }
  const double samples = 1.0 * spec.width * spec.height * spec.nchannels;
  if (samples > kMostSamples) return OiioOutcome::kTooLarge;
  // OpenImageIO unpacks some formats whole before it hands out what was asked for.
  const double bytes = samples * static_cast<double>(spec.format.size() + sizeof(float));
  if (with_samples && bytes > memory_bytes) return OiioOutcome::kNoMemory;
  picture = {};
  picture.width = spec.width;
  picture.height = spec.height;
  picture.channels = spec.nchannels >= 3 ? 3 : 1;
  picture.is_float = spec.format.is_floating_point();
  picture.top_code = spec.format.size() > 1 ? 0xFFFF : 0xFF;
  for (int c = 0; c < picture.channels; ++c) picture.channel_names.push_back(spec.channel_name(c));
  TakeAttributes(spec, picture);
  picture.orientation = spec.get_int_attribute("Orientation", 1);
  if (with_samples && !ReadSamples(input, picture)) {
    error = input.geterror();
    return OiioOutcome::kBad;
  }
  return OiioOutcome::kRead;
}

OiioOutcome Read(const OiioBytes& file, bool with_samples, OiioPicture& picture,
                 std::string& error) {
  OIIO::ImageSpec config, header;
  config["oiio:UnassociatedAlpha"] = 1;  // alpha must not be multiplied into codes
  OIIO::Filesystem::IOMemReader reader(const_cast<void*>(file.bytes), file.size);  // only read
  const auto in_memory = OIIO::ImageInput::create(file.format);
  if (in_memory && in_memory->set_ioproxy(&reader) && in_memory->open(file.path, header, config)) {
    const OiioOutcome outcome =
        ReadOpened(*in_memory, with_samples, file.memory_bytes, picture, error);
    if (outcome != OiioOutcome::kBad || file.format == "png") return outcome;
  } else if (in_memory && file.format == "png") {
    error = in_memory->geterror();  // the same words as of a file; libpng speaks on stderr, too
    return OiioOutcome::kUnknownFormat;
  }
  // What is wrong in others is said in other words of memory than of a file.
  const auto on_disk = OIIO::ImageInput::open(file.path, &config);
  if (on_disk) return ReadOpened(*on_disk, with_samples, file.memory_bytes, picture, error);
  error = OIIO::geterror();
  return OiioOutcome::kUnknownFormat;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) OiioOutcome lightcal_oiio_read(
    const OiioBytes& file, bool with_samples, OiioPicture& picture, std::string& error) noexcept {
  try {
    return Read(file, with_samples, picture, error);
  } catch (const std::exception& thrown) {
    error = thrown.what();
  } catch (...) {
    error = "unknown error";
  }
  return OiioOutcome::kBad;
}
