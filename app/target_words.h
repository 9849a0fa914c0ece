// SPDX-License-Identifier: Apache-2.0
// The words of --to.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/presets/preset_table.h"
#include "one_of.h"

namespace lightcal::app {

[[nodiscard]] inline std::vector<std::string> TargetWords() {
  std::vector<std::string> words = NamesOf(PresetTargets());
  words.emplace_back("all");
  return words;
}

// "all" is every target; of lights that are in a scene, every one that sets them.
inline void SpellOutAll(std::vector<std::string>& targets, bool into_scene = false) {
  if (std::ranges::find(targets, "all") == targets.end()) return;
  targets.clear();
  for (const PresetTarget& target : PresetTargets()) {
    if (target.only_if_named) continue;
    if (target.into_scene || !into_scene) targets.emplace_back(target.name);
  }
}

// A target among the inputs: "--to gltf usd" for "--to gltf,usd".
[[nodiscard]] inline Result<void> CheckNoTargetAmong(const std::vector<std::string>& inputs) {
  const std::vector<std::string> words = TargetWords();
  for (const std::string& input : inputs) {
    if (std::ranges::find(words, input) == words.end()) continue;
    return WrongUsage("--to", "several targets are parted by commas: --to gltf," + input);
  }
  return {};
}

}  // namespace lightcal::app
