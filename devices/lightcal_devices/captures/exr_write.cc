// SPDX-License-Identifier: Apache-2.0
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstddef>
#include <exception>
#include <thread>

#include "lightcal_devices/captures/exr.h"
#include "lightcal_devices/captures/sample_check.h"

namespace lightcal::devices {
namespace {

Imath::V2f V2fOf(Xy c) { return {static_cast<float>(c.x), static_cast<float>(c.y)}; }

Imf::Header HeaderOf(const ExrPicture& picture) {
  Imf::Header header(picture.samples.width(), picture.samples.height());
  header.compression() = picture.compressed ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
  for (const std::string& name : picture.channel_names) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  if (picture.chromaticities) {
    const RgbPrimaries& p = *picture.chromaticities;
    Imf::addChromaticities(
        header, Imf::Chromaticities(V2fOf(p.red), V2fOf(p.green), V2fOf(p.blue), V2fOf(p.white)));
  }
  if (picture.white_luminance) {
    Imf::addWhiteLuminance(header, static_cast<float>(picture.white_luminance->value()));
  }
  if (picture.environment_latlong) Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  for (const auto& [name, text] : picture.attributes) {
    header.insert("lightcal:" + name, Imf::StringAttribute(text));
  }
  return header;
}

void Write(const std::string& path, const ExrPicture& picture) {
  const auto& samples = picture.samples;
  const int threads = static_cast<int>(std::thread::hardware_concurrency());
  Imf::OutputFile file(path.c_str(), HeaderOf(picture), picture.compressed ? threads : 0);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < picture.channel_names.size(); ++c) {
    // OpenEXR only reads from what it is given here.
    char* const base = reinterpret_cast<char*>(const_cast<float*>(samples.data() + c));
    buffer.insert(picture.channel_names[c],
                  Imf::Slice(Imf::FLOAT, base, sizeof(float) * samples.channels(),
                             sizeof(float) * static_cast<std::size_t>(samples.row_stride())));
  }
  file.setFrameBuffer(buffer);
  file.writePixels(samples.height());
}

}  // namespace

Result<void> WriteExrFile(const std::string& path, const ExrPicture& picture) {
  if (picture.samples.empty() ||
      picture.channel_names.size() != static_cast<std::size_t>(picture.samples.channels())) {
    return Failed("unwritable", path, "a picture needs pixels, and a name for each channel");
  }
  if (auto ok = CheckSamples(picture.samples, path); !ok) return ok;
  try {
    Write(path, picture);
  } catch (const std::exception& error) {
    return Failed("unwritable", path, error.what());
  }
  return {};
}

}  // namespace lightcal::devices
