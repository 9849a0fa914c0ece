// SPDX-License-Identifier: Apache-2.0
// lightcal's merge as a profile sets it, which the command has no option for.
//   lightcal_page_merge PROFILE.json OUT.raw FRAME...
// Writes luminance as floats and prints width and height.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal_devices/disk_sources.h"

namespace {

template <class T>
T Require(lightcal::Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "%s: %s\n", result.error().subject.c_str(), result.error().message.c_str());
  std::exit(EXIT_FAILURE);
}

}  // namespace

int main(int count, char** words) {
  using namespace lightcal;
  if (count < 4) return EXIT_FAILURE;
  std::stringstream profile;
  profile << std::ifstream(words[1]).rdbuf();
  BracketMergeRequest request;
  request.work = Require(AccuracyProfileFromJson(profile.str(), words[1])).pictures;
  request.want_sigma = true;
  const std::vector<std::string> frames(words + 3, words + count);
  const Sources sources = devices::DiskSources();
  const Bracket bracket = Require(sources.open_bracket(frames, {}));
  const MergedBracket merged = Require(MergeBracket(bracket, sources, request));
  std::ofstream out(words[2], std::ios::binary);
  out.write(reinterpret_cast<const char*>(merged.picture.data()),
            static_cast<std::streamsize>(merged.picture.size() * sizeof(float)));
  std::printf("%d %d\n", merged.width, merged.height);
  return out ? EXIT_SUCCESS : EXIT_FAILURE;
}
