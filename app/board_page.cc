// SPDX-License-Identifier: Apache-2.0
#include "board_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/board_module.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

constexpr std::array kPapers = {Paper{"a4", 297.0, 210.0}, Paper{"a3", 420.0, 297.0},
                                Paper{"letter", 279.4, 215.9}};
constexpr double kMargin = 10.0, kBelow = 18.0;  // mm
constexpr double kSmallestSquare = 5.0;
constexpr double kBar = 100.0;

std::string Number(double value) { return RoundedText(value, 8); }

std::string Rectangle(const BoardRectangle& r) {
  return std::string("<rect class=\"") + (r.black ? "black" : "white") + "\" x=\"" + Number(r.x) +
         "\" y=\"" + Number(r.z) + "\" width=\"" + Number(r.width) + "\" height=\"" +
         Number(r.height) + "\" fill=\"" + (r.black ? "#000" : "#fff") + "\"/>\n";
}

std::string LinePath(double x1, double y1, double x2, double y2) {
  return "<path d=\"M" + Number(x1) + " " + Number(y1) + "L" + Number(x2) + " " + Number(y2) +
         "\" stroke=\"#000\" stroke-width=\"0.2\" fill=\"none\"/>\n";
}

std::string Text(double x, double y, const std::string& text) {
  return "<text x=\"" + Number(x) + "\" y=\"" + Number(y) +
         "\" font-family=\"sans-serif\" font-size=\"3\">" + text + "</text>\n";
}

std::string Title(const CharucoBoard& board) {
  return "lightcal board: " + std::to_string(board.columns) + " x " + std::to_string(board.rows) +
         " squares of " + Number(1000.0 * board.square.value()) + " mm, dictionary " +
         std::string(kMarkerDictionaryWords[static_cast<std::size_t>(board.dictionary)]);
}

}  // namespace

std::vector<std::string> PaperWords() {
  std::vector<std::string> words;
  for (const Paper& paper : kPapers) words.emplace_back(paper.name);
  return words;
}

Result<Paper> PaperByName(const std::string& name) {
  const auto* const found = std::ranges::find(kPapers, LowerAscii(name), &Paper::name);
  if (found != kPapers.end()) return *found;
  return WrongUsage("--paper", "\"" + name + "\" is none of a4, a3, letter");
}

Result<Metres> LargestSquare(const CharucoBoard& board, const Paper& paper) {
  const double side = std::floor(std::min((paper.width_mm - 2.0 * kMargin) / board.columns,
                                          (paper.height_mm - kMargin - kBelow) / board.rows));
  if (side >= kSmallestSquare) return Metres(side / 1000.0);
  return WrongUsage("--squares", "so many squares of 5 mm or more do not fit on the paper");
}

Result<std::string> BoardPage(const CharucoBoard& board, const Paper& paper) {
  const auto module = devices::BoardModule();
  if (!module) return tl::unexpected(module.error());
  const auto layout = (*module)->lay_out(board);
  if (!layout) return tl::unexpected(layout.error());
  const double square = 1000.0 * board.square.value();
  const double width = square * board.columns, height = square * board.rows;
  if (width > paper.width_mm - 2.0 * kMargin || height > paper.height_mm - kMargin - kBelow) {
    return WrongUsage("--square", "the board of " + Number(width) + " x " + Number(height) +
                                      " mm does not fit on " + std::string(paper.name) +
                                      "; take smaller squares or larger paper");
  }
  const double left = 0.5 * (paper.width_mm - width);
  const double bottom =
      paper.height_mm - kBelow - 0.5 * (paper.height_mm - kMargin - kBelow - height);
  const std::string size =
      "width=\"" + Number(paper.width_mm) + "mm\" height=\"" + Number(paper.height_mm) + "mm\"";
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " +
                    Number(paper.width_mm) + " " + Number(paper.height_mm) + "\">\n<!-- " +
                    GeneratorName() + " -->\n";
  svg += "<g transform=\"translate(" + Number(left) + " " + Number(bottom) +
         ") scale(1000 -1000)\">\n";
  for (const BoardRectangle& rectangle : *layout) svg += Rectangle(rectangle);
  svg += "</g>\n";
  // Ticks that point at the origin of wall coordinates.
  svg += LinePath(left - 6.0, bottom, left - 1.5, bottom) +
         LinePath(left, bottom + 1.5, left, bottom + 6.0);
  const double line = paper.height_mm - 7.0;
  svg += Text(left + 2.0, bottom + 5.0, "0: x to the right, z up, y into the wall [m]");
  svg += Text(left, line,
              Title(board) + ". Print at 100 %, matt; then measure: the bar is 100 mm long.");
  const double end = left + width;
  svg += LinePath(end - kBar, line - 5.0, end, line - 5.0) +
         LinePath(end - kBar, line - 6.5, end - kBar, line - 3.5) +
         LinePath(end, line - 6.5, end, line - 3.5);
  return svg + "</svg>\n";
}

}  // namespace lightcal::app
