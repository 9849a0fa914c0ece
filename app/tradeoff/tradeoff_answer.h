// SPDX-License-Identifier: Apache-2.0
// A study of accuracy against time as people and machines read it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"
#include "lightcal/records/reading_plan.h"
#include "lightcal/tradeoff/against_truth.h"
#include "lightcal/tradeoff/study.h"
#include "output_files.h"

namespace lightcal::app {

struct TradeoffAnswer {
  tradeoff::Study study;
  // How settings compare with a synthetic twin's truth; empty where none was asked for.
  std::vector<tradeoff::TruthRow> truth;
  std::vector<MinutesLadder> ladders;  // the other time, the person's
  double tolerance_relative = 0.0;
};

// One row a setting that is in play, then the combinations, then what the truth says, then what the
// next minutes of measuring buy.
[[nodiscard]] std::string TradeoffTable(const TradeoffAnswer& answer);
// What a person can act on: "frames half: 1.9 times as fast, moves the strength of key by 0.02 %, a
// tenth of your u: free". The recommendation, or that there is nothing to trade; which knobs are
// not in play; one sentence a setting that is free or safe and saves time; one a light's minutes.
[[nodiscard]] std::vector<std::string> TradeoffSentences(const TradeoffAnswer& answer);
[[nodiscard]] records::Node TradeoffNode(const TradeoffAnswer& answer);

// tradeoff.json, tradeoff.html (figures, tables, sentences), profile.json, and tradeoff and minutes
// as .svg and .png, names relative to the output directory; no minutes where no reading would help.
// Fails as PictureFile.
[[nodiscard]] Result<std::vector<OutputFile>> TradeoffFiles(const TradeoffAnswer& answer,
                                                            const std::string& title);

}  // namespace lightcal::app
