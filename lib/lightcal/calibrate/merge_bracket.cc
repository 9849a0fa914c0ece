// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/merge_bracket.h"

namespace lightcal {

Result<ResponseCurves> ReadResponse(const std::string& name, const std::string& path,
                                    const Sources& sources) {
  if (IsResponseWord(name)) return ResponseNamed(name);
  const auto text = sources.read_text(path);
  if (!text) return tl::unexpected(text.error());
  return ResponseFromText(*text, path);
}

Result<MergedBracket> MergeBracket(const Bracket& bracket, const Sources& sources,
                                   const BracketMergeRequest& request) {
  return MergeFrames(bracket, sources.load_masked_frame, request);
}

Result<MergedBracket> MergeBracket(const std::vector<std::string>& files, const Sources& sources,
                                   const BracketMergeRequest& request) {
  const auto bracket = sources.open_bracket(files, {});
  if (!bracket) return tl::unexpected(bracket.error());
  return MergeBracket(*bracket, sources, request);
}

}  // namespace lightcal
