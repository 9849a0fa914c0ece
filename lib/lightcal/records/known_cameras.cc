// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/known_cameras.h"

#include <algorithm>
#include <string>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/embedded_cameras.h"

namespace lightcal {
namespace {

std::vector<std::string> CameraWords(std::string_view text) {
  std::vector<std::string> words;
  bool in_word = false;
  for (const char c : LowerAscii(text)) {
    const bool part = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z');
    if (part && !in_word) words.emplace_back();
    if (part) words.back() += c;
    in_word = part;
  }
  return words;
}

}  // namespace

const std::vector<CameraSensitivities>& KnownCameras() {
  static const std::vector<CameraSensitivities> cameras = [] {
    std::vector<CameraSensitivities> all;
    for (const records::EmbeddedCamera& file : records::EmbeddedCameras()) {
      auto camera = CameraSensitivitiesFromJson(file.text, file.name);
      if (camera) all.push_back(*std::move(camera));
    }
    std::ranges::sort(all, {}, &CameraSensitivities::camera);
    return all;
  }();
  return cameras;
}

Result<CameraSensitivities> KnownCamera(std::string_view words) {
  const std::vector<std::string> wanted = CameraWords(words);
  std::vector<const CameraSensitivities*> found;
  for (const CameraSensitivities& camera : KnownCameras()) {
    const std::vector<std::string> own = CameraWords(camera.camera);
    if (own == wanted) return camera;
    const bool holds = !wanted.empty() && std::ranges::all_of(wanted, [&](const std::string& word) {
      return std::ranges::find(own, word) != own.end();
    });
    if (holds) found.push_back(&camera);
  }
  if (found.size() == 1) return *found.front();
  const std::string typed(words);
  if (found.size() > 1) {
    return Refused(
        "ambiguous_camera", typed,
        "may be " + Joined(found, ", ", &CameraSensitivities::camera) + "; write its whole name");
  }
  std::vector<std::string> lower;
  for (const CameraSensitivities& camera : KnownCameras()) {
    lower.push_back(LowerAscii(camera.camera));
  }
  const std::vector<std::string_view> views(lower.begin(), lower.end());
  const auto at = std::ranges::find(lower, NearestWord(LowerAscii(words), views));
  const std::string hint =
      at == lower.end()
          ? " (" + Joined(KnownCameras(), ", ", &CameraSensitivities::camera) + ")"
          : "; did you mean " +
                KnownCameras()[static_cast<std::size_t>(at - lower.begin())].camera + "?";
  return Refused("unknown_camera", typed,
                 "is none of the " + std::to_string(KnownCameras().size()) + " that ship" + hint);
}

}  // namespace lightcal
