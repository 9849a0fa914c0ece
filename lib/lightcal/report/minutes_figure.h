// SPDX-License-Identifier: Apache-2.0
// Accuracy against minutes: what the next minutes of measuring buy, as a picture.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lightcal/records/reading_plan.h"
#include "lightcal/report/plot_keys.h"

namespace lightcal::report {

// The 95 % uncertainty predicted after each step of a ladder against the minutes it takes in all,
// stairs going down; dashed what the calibration of the meter leaves however often it reads. One
// light's steps are named by what to do, several lights' stairs by the light. Empty where no ladder
// has a step. id must be unique in the page.
[[nodiscard]] std::string MinutesFigure(std::span<const MinutesLadder> ladders,
                                        std::string_view id);

// What its marks mean.
[[nodiscard]] PlotCaption MinutesCaption(std::span<const MinutesLadder> ladders);

// A whole SVG file: MinutesFigure with that caption and its style sheet inside.
[[nodiscard]] std::string MinutesPlot(std::span<const MinutesLadder> ladders);

}  // namespace lightcal::report
