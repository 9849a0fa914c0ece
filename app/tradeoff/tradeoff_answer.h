// SPDX-License-Identifier: Apache-2.0
// A study of accuracy against time as people and machines read it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/document.h"
#include "lightcal/tradeoff/against_truth.h"
#include "lightcal/tradeoff/study.h"
#include "output_files.h"

namespace lightcal::app {

// How settings compare with a synthetic twin's truth; empty where none was asked for.
using TruthRows = std::vector<tradeoff::TruthRow>;

// One row a setting of one knob, then the combinations, then what the truth says.
[[nodiscard]] std::string TradeoffTable(const tradeoff::Study& study, const TruthRows& truth);
// What a person can act on: "frames half: 1.9 times as fast, moves the strength of key by 0.02 %, a
// tenth of your u: free". The recommendation, then one sentence a setting that is free or safe and
// saves time.
[[nodiscard]] std::vector<std::string> TradeoffSentences(const tradeoff::Study& study,
                                                         const TruthRows& truth);
[[nodiscard]] records::Node TradeoffNode(const tradeoff::Study& study, const TruthRows& truth,
                                         double tolerance_relative);

// tradeoff.json, tradeoff.svg, tradeoff.png, tradeoff.html (figure, table, sentences) and
// profile.json, names relative to the output directory. Fails as PictureFile.
[[nodiscard]] Result<std::vector<OutputFile>> TradeoffFiles(const tradeoff::Study& study,
                                                            const TruthRows& truth,
                                                            double tolerance_relative,
                                                            const std::string& title);

}  // namespace lightcal::app
