// SPDX-License-Identifier: Apache-2.0
// What the marks of a plot mean: below it on the page, and inside the picture where it is a file of
// its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lightcal::report {

// `mark`: SVG in a box of 22 x 12.
struct PlotKey {
  std::string mark;
  std::string words;
};
[[nodiscard]] PlotKey LineKey(std::string_view css, std::string_view words);
[[nodiscard]] PlotKey BandKey(std::string_view css, std::string_view words);
[[nodiscard]] PlotKey DotKey(std::string_view words);
[[nodiscard]] PlotKey ReadingKey(std::string_view words);  // a dot with its interval
[[nodiscard]] PlotKey CrossKey(std::string_view words);

struct PlotCaption {
  std::vector<PlotKey> keys;
  std::string words;  // HTML after them
};

[[nodiscard]] std::string CaptionHtml(const PlotCaption& caption);

// The figure made taller by what it takes, the caption below its axes in lines of its width: it
// covers nothing.
[[nodiscard]] std::string WithCaption(std::string svg, const PlotCaption& caption);

}  // namespace lightcal::report
