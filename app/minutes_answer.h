// SPDX-License-Identifier: Apache-2.0
// What the next minutes of measuring buy: options, and ladders as people and machines read them.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/fit/plan/plan_readings.h"
#include "lightcal/records/document.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/records/session.h"
#include "output_files.h"

namespace CLI {
class App;
}

namespace lightcal::app {

struct MinutesOptions {
  std::string minutes;  // "reading=2,card=1,move=3", any of them
  std::string reach = "4m";
  std::string plot;  // FILE.svg or .png, "" = none
};

// Adds --minutes, --reach and --plot; `options` must outlive parsing.
void AddMinutesOptions(CLI::App& parser, MinutesOptions& options);
// Wrong usage: a word or a number that is none.
[[nodiscard]] Result<LadderWishes> LadderWishesOf(const MinutesOptions& options);

// Of every light that readings can still tell more of; those whose plan is refused are left out.
[[nodiscard]] std::vector<MinutesLadder> LaddersOf(const Session& session,
                                                   const FitSettings& settings,
                                                   const LadderWishes& wishes,
                                                   const Progress& progress = {});

// A header and one row a step: minutes in all, what to do, what is then left, what limits it.
[[nodiscard]] std::vector<std::vector<std::string>> MinutesCells(const MinutesLadder& ladder);
// One table a light that has a step.
[[nodiscard]] std::string MinutesTable(const std::vector<MinutesLadder>& ladders);
// "key: 6 more minutes (read ...) bring ± 12 % down to ± 8 %. The meter ...", one a light.
[[nodiscard]] std::vector<std::string> MinutesSentences(const std::vector<MinutesLadder>& ladders);
[[nodiscard]] records::Node PlannedReadingNode(const PlannedReading& reading);
[[nodiscard]] records::Node MinutesNode(const MinutesLadder& ladder);
// The figure as --plot asks for it; none where it does not. Refused: no_plot.
[[nodiscard]] Result<std::vector<OutputFile>> MinutesPictures(
    const MinutesOptions& options, const std::vector<MinutesLadder>& ladders);

}  // namespace lightcal::app
