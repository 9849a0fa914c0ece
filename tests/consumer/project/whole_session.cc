// SPDX-License-Identifier: Apache-2.0
// What a program outside lightcal does with its library: a session in, lights, presets and the
// luminance of a bracket out, as the command line gives them.
//   whole_session SESSION LIGHT_JSON PRESET_FOLDER MERGED_EXR FRAME...
// writes light.json and presets, and compares the frames, merged, with the picture in MERGED_EXR.
#include <cstdio>
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "lightcal/calibrate/calibrate_session.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/disk_sources.h"

using namespace lightcal;

namespace {

int Fail(const Error& error) {
  std::printf("%s: %s: %s\n", error.code.c_str(), error.subject.c_str(), error.message.c_str());
  return 1;
}

void Write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

bool SameSamples(const MergedBracket& merged, const Frame& picture) {
  const auto* const samples = std::get_if<View2d<const float>>(&picture.samples);
  if (samples == nullptr || samples->width() != merged.width) return false;
  for (int y = 0; y < merged.height; ++y) {
    for (int x = 0; x < merged.width; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(merged.width) +
                      static_cast<std::size_t>(x);
      if ((*samples)(x, y) != merged.picture[at]) return false;
    }
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 6) return 2;
  const auto done = CalibrateSession(argv[1], devices::DiskSources(), {});
  if (!done) return Fail(done.error());
  for (const Warning& warning : done->remarks.warnings) {
    std::printf("warning: %s: %s\n", warning.subject.c_str(), warning.message.c_str());
  }
  const auto json = LightFileToJson(done->lights);
  if (!json) return Fail(json.error());
  Write(argv[2], *json);

  const auto files = ExportPresets(done->lights, {"gltf", "unreal"}, done->session.stem);
  if (!files) return Fail(files.error());
  for (const PresetFile& file : files->files) {
    Write(std::string(argv[3]) + "/" + file.name, file.contents);
  }

  const std::vector<std::string> frames(argv + 5, argv + argc);
  const auto luminance = MergeBracket(frames, devices::DiskSources(), {});
  if (!luminance) return Fail(luminance.error());
  const auto picture = devices::DiskSources().read_frame(argv[4]);
  if (!picture) return Fail(picture.error());
  std::puts(SameSamples(*luminance, *picture) ? "the same luminance" : "another luminance");
}
