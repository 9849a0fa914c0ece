// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/wall_capture_codec.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lightcal::records {
namespace {

constexpr NumberRule kVignettingRule{
    [](double v) { return v >= 0.0 && v <= 8.0; },
    "must be an exponent from 0 (corrected already) to 8: cos^n of the angle off the lens's axis"};

void ReadSquares(FieldReader& reader, CharucoBoard& board) {
  std::vector<int> squares;
  reader.Integers("squares", squares);
  if (!reader.Has("squares") || reader.Failed()) return;
  if (squares.size() != 2 || squares[0] < 3 || squares[1] < 3) {
    reader.Fail("squares", "squares = [columns, rows] of the chessboard, 3 or more each");
    return;
  }
  board.columns = squares[0];
  board.rows = squares[1];
}

// x, y, width, height of rectangles, one after the other. The reader keeps `key`.
std::vector<std::array<int, 4>> ReadRectangles(FieldReader& reader, std::string_view key) {
  std::vector<int> numbers;
  reader.Integers(key, numbers);
  std::vector<std::array<int, 4>> out;
  for (std::size_t i = 0; i + 3 < numbers.size(); i += 4) {
    out.push_back({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]});
  }
  if (!reader.Failed() && numbers.size() % 4 != 0) {
    reader.Fail(key, std::string(key) +
                         " = [x, y, width, height] in pixels, from the upper left corner" +
                         (key != "anchor_rect" ? ", again and again" : ""));
  }
  return out;
}

void ReadPaint(FieldReader& reader, WallDescription& wall) {
  std::vector<int> codes;
  reader.Integers("paint_srgb", codes);
  if (!reader.Has("paint_srgb") || reader.Failed()) return;
  const auto code = [](int v) { return v >= 1 && v <= 255; };
  if (codes.size() != 3 || !std::ranges::all_of(codes, code)) {
    reader.Fail("paint_srgb",
                "paint_srgb = [red, green, blue], 1 to 255, as the paint's maker prints it");
    return;
  }
  wall.paint_srgb = {codes[0], codes[1], codes[2]};
}

}  // namespace

void ReadWall(FieldReader& reader, WallDescription& wall) {
  std::optional<Metres> square;
  reader.Number("square_m", square, kPositive);
  wall.board.square = square.value_or(wall.board.square);
  ReadSquares(reader, wall.board);
  reader.Word("dictionary", wall.board.dictionary, kMarkerDictionaryWords);
  reader.Text("board_frame", wall.board_frame);
  reader.Text("board_views", wall.board_views);
  reader.Text("off_frames", wall.off_frames);
  reader.Number("position_sigma_m", wall.position_sigma_m, kPositive);
  reader.Number("vignetting", wall.vignetting, kVignettingRule);
  reader.Number("sensor_width_m", wall.sensor_width, kPositive);
  wall.masks = ReadRectangles(reader, "masks");
  wall.shadows = ReadRectangles(reader, "shadows");
  ReadPaint(reader, wall);
  const auto anchors = ReadRectangles(reader, "anchor_rect");
  if (!anchors.empty()) wall.anchor_rect = anchors.front();
  reader.Require({"square_m"});
}

}  // namespace lightcal::records
