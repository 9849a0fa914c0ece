// SPDX-License-Identifier: Apache-2.0
// How far settings stayed from a synthetic twin's truth, as people and machines read it.
#pragma once

#include <string>
#include <vector>

#include "lightcal/records/document.h"
#include "lightcal/tradeoff/against_truth.h"
#include "lightcal/tradeoff/study.h"

namespace lightcal::app {

// The settings worth comparing with the truth: the strictest, which comes first, the usual one,
// every knob's level that changes time or answer, and the combinations measured.
[[nodiscard]] std::vector<tradeoff::Named> SettingsForTruth(const tradeoff::Study& study);

// A header and one row a setting: mean and rms error, how often the 95 % interval held the truth.
[[nodiscard]] std::vector<std::vector<std::string>> TruthCells(
    const std::vector<tradeoff::TruthRow>& rows);
// What the recommended setting is worth against the truth, beside the strictest.
[[nodiscard]] std::string TruthSentence(const tradeoff::Study& study,
                                        const std::vector<tradeoff::TruthRow>& rows);
[[nodiscard]] records::Node TruthNode(const tradeoff::TruthRow& row);

}  // namespace lightcal::app
