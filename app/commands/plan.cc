// SPDX-License-Identifier: Apache-2.0
// lightcal plan: the next readings of a session; or the board that tells where a wall is, to print.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <string>

#include "board_page.h"
#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "one_of.h"
#include "output_files.h"
#include "picture_file.h"
#include "session_plan.h"

namespace lightcal::app {
namespace {

struct PlanOptions {
  SessionPlanOptions session;
  std::string board, paper = "a4", square, squares, dictionary;
};

// "9x6"
Result<void> ParseSquares(const std::string& text, CharucoBoard& board) {
  const char* const end = text.data() + text.size();
  const auto columns = std::from_chars(text.data(), end, board.columns);
  const bool divided = columns.ec == std::errc() && columns.ptr != end && *columns.ptr == 'x';
  if (divided) {
    const auto rows = std::from_chars(columns.ptr + 1, end, board.rows);
    if (rows.ec == std::errc() && rows.ptr == end) return {};
  }
  return WrongUsage("--squares", "takes COLUMNSxROWS, e.g. 9x6");
}

Result<CharucoBoard> BoardOf(const PlanOptions& options, const Paper& paper) {
  CharucoBoard board;
  if (!options.squares.empty()) {
    if (auto parsed = ParseSquares(options.squares, board); !parsed) {
      return Propagate(std::move(parsed));
    }
  }
  if (!options.dictionary.empty()) {
    const auto* const word = std::ranges::find(kMarkerDictionaryWords, options.dictionary);
    if (word == kMarkerDictionaryWords.end()) {
      return WrongUsage("--dictionary", "is one of 4x4_50, 4x4_100, 5x5_100, 6x6_250");
    }
    board.dictionary = static_cast<MarkerDictionary>(word - kMarkerDictionaryWords.begin());
  }
  const auto square =
      options.square.empty() ? LargestSquare(board, paper) : ParseLength(options.square);
  if (!square) return tl::unexpected(square.error());
  if (!(square->value() > 0.0)) return WrongUsage("--square", "must be above 0");
  board.square = *square;
  return board;
}

std::string SessionLines(const CharucoBoard& board) {
  std::string lines = "[capture.wall]\nsquare_m = " + RoundedText(board.square.value(), 6) + "\n";
  const CharucoBoard usual;
  if (board.columns != usual.columns || board.rows != usual.rows) {
    lines +=
        "squares = [" + std::to_string(board.columns) + ", " + std::to_string(board.rows) + "]\n";
  }
  if (board.dictionary != usual.dictionary) {
    lines += "dictionary = \"" +
             std::string(kMarkerDictionaryWords[static_cast<std::size_t>(board.dictionary)]) +
             "\"\n";
  }
  return lines;
}

Result<void> PrintBoard(const PlanOptions& options, Console& console) {
  const auto paper = PaperByName(options.paper);
  if (!paper) return tl::unexpected(paper.error());
  const auto board = BoardOf(options, *paper);
  if (!board) return tl::unexpected(board.error());
  const auto page = BoardPage(*board, *paper);
  if (!page) return tl::unexpected(page.error());
  const auto file = PrintFile(options.board, *page, paper->width_mm, paper->height_mm);
  if (!file) return tl::unexpected(file.error());
  if (auto written = WriteOutputs({*file}, options.session.force); !written) return written;
  console.Print("wrote " + options.board +
                "; print it at 100 % on matt paper, measure ten squares, correct square_m, and "
                "tape it flat to the wall beside the beam:\n\n" +
                SessionLines(*board));
  console.PrintDocument(
      {{"board",
        {{"file", options.board},
         {"paper", paper->name},
         {"square_m", board->square.value()},
         {"squares", {board->columns, board->rows}},
         {"dictionary", kMarkerDictionaryWords[static_cast<std::size_t>(board->dictionary)]}}}});
  return {};
}

Result<void> RunPlan(const PlanOptions& options, Console& console) {
  const bool session = !options.session.calibration.session.empty();
  if (session && !options.board.empty()) {
    return WrongUsage("plan", "takes a session or --board, not both");
  }
  if (session) return PlanSession(options.session, console);
  if (!options.board.empty()) return PrintBoard(options, console);
  return WrongUsage("plan", "give a session to plan the next readings of, or --board FILE");
}

}  // namespace

Run BuildPlan(CLI::App& parser) {
  auto options = std::make_shared<PlanOptions>();
  AddCalibrationOptions(parser, options->session.calibration);
  parser.get_option("session")->required(false);
  for (const char* name : {"--monte-carlo", "--without", "--lights"}) {
    parser.remove_option(parser.get_option(name));
  }
  parser.add_option("--light", options->session.light, "Only this light");
  parser.add_option("--steps", options->session.steps, "Readings to plan, one on top of the other")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  AddMinutesOptions(parser, options->session.minutes);
  parser.add_option("--board", options->board, "Write the board to print here, .pdf or .svg");
  parser.add_option("--paper", options->paper, "Of the board, landscape")
      ->check(OneOfAnyCase(PaperWords()))
      ->capture_default_str();
  parser.add_option("--square", options->square, "Side of a square, e.g. 30mm [what fits]");
  parser.add_option("--squares", options->squares, "COLUMNSxROWS [9x6]");
  parser.add_option("--dictionary", options->dictionary, "The markers' dictionary [4x4_50]")
      ->check(OneOf(kMarkerDictionaryWords));
  parser.add_flag("--force", options->session.force, "Replace a file that lightcal did not write");
  return [options, &parser](Console& console) {
    options->session.reach_stated = parser.count("--reach") > 0;
    for (const char* name : {"--minutes", "--reach", "--plot"}) {
      if (parser.count(name) > 0) options->session.with_minutes = true;
    }
    return RunPlan(*options, console);
  };
}

}  // namespace lightcal::app
