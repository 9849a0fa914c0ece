// SPDX-License-Identifier: Apache-2.0
#include "match/match_sheet_of.h"

#include <utility>
#include <vector>

#include "match/match_answer.h"

namespace lightcal::app {

match::MatchRequest RequestBetween(const MatchLight& lamp, const MatchLight& target,
                                   std::vector<CameraSensitivities> cameras) {
  match::MatchRequest request;
  request.lamp = lamp.spectrum;
  request.target = target.spectrum;
  request.lamp_measured = lamp.measured;
  request.target_measured = target.measured;
  request.cameras = std::move(cameras);
  return request;
}

Result<report::MatchSheet> SheetOf(const match::MatchRequest& request, const match::Match& match,
                                   const std::string& gels, const MatchLight& lamp,
                                   const MatchLight& target) {
  const auto seen = match::ViewMatch(request, match);
  if (!seen) return tl::unexpected(seen.error());
  report::MatchSheet sheet;
  sheet.title = lamp.title + " to " + target.title;
  sheet.viewer = seen->viewer;
  sheet.lamp = {lamp.title, seen->lamp.samples, seen->lamp.difference, lamp.spectrum};
  sheet.target = {target.title, seen->target, {}, target.spectrum};
  sheet.gelled = {gels, seen->gelled.samples, seen->gelled.difference,
                  SpectrumBehind(lamp.spectrum, match.transmittance)};
  sheet.transmittance = match.transmittance;
  sheet.has_gels = !match.gels.empty();
  return sheet;
}

Result<std::vector<report::MatchSheet>> SheetsOf(const std::vector<MatchLight>& lamps,
                                                 const CameraViewWords& words, Console& console) {
  MatchLightWords target_words;
  target_words.source = words.target;
  target_words.may_assume = true;
  const auto target = ReadMatchLight(target_words, console);
  if (!target) return tl::unexpected(target.error());
  const auto set = ReadGels(words.gels, console);
  if (!set) return tl::unexpected(set.error());
  auto cameras = ReadCameras(words.camera);
  if (!cameras) return Propagate(std::move(cameras));
  std::vector<report::MatchSheet> sheets;
  for (const MatchLight& lamp : lamps) {
    match::MatchRequest request = RequestBetween(lamp, *target, *cameras);
    request.count = 1;
    request.reach = 1.0;  // the page shows the nearest, however far it is
    const auto answer = match::MatchLights(request, set->gels);
    if (!answer) return tl::unexpected(answer.error());
    const match::Match& best = answer->matches.front();
    auto sheet = SheetOf(request, best, StackTitle(best.gels, *set), lamp, *target);
    if (!sheet) return Propagate(std::move(sheet));
    sheets.push_back(*std::move(sheet));
  }
  return sheets;
}

}  // namespace lightcal::app
