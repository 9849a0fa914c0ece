// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/stored_pixels.h"

#include <utility>

namespace lightcal {
namespace {

std::string BoxText(const PixelBox& box) {
  std::string text;
  for (const int number : box) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return "[" + text + "]";
}

std::string HowShown(int orientation) {
  switch (orientation) {
    case 3:
      return "upside down";
    case 6:
      return "turned a quarter clockwise";
    case 8:
      return "turned a quarter counterclockwise";
    default:
      return "mirrored";
  }
}

}  // namespace

bool IsInside(const PixelBox& box, int width, int height) {
  return box[0] >= 0 && box[1] >= 0 && box[2] > 0 && box[3] > 0 && box[0] <= width - box[2] &&
         box[1] <= height - box[3];
}

ShownTurn ShownTurnOf(int orientation) {
  const int tag = orientation >= 1 && orientation <= 8 ? orientation : 1;
  return {tag >= 5, tag == 2 || tag == 3 || tag == 7 || tag == 8,
          tag == 3 || tag == 4 || tag == 6 || tag == 7};
}

std::optional<PixelBox> StoredFromShown(const PixelBox& shown, const FrameInfo& info) {
  const ShownTurn turn = ShownTurnOf(info.orientation);
  auto [column, row, width, height] = shown;
  if (turn.rows_for_columns) {
    std::swap(column, row);
    std::swap(width, height);
  }
  if (turn.from_right) column = info.width - column - width;
  if (turn.from_below) row = info.height - row - height;
  const PixelBox stored{column, row, width, height};
  return IsInside(stored, info.width, info.height) ? std::optional(stored) : std::nullopt;
}

Result<void> CheckTurned(const std::string& subject, const FrameInfo& info, const PixelBox& box,
                         Warnings& warnings) {
  if (info.orientation < 2 || info.orientation > 8) return {};
  const auto stored = StoredFromShown(box, info);
  if (!stored || *stored == box) return {};
  const auto size = [](int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height);
  };
  const std::string shown = ShownTurnOf(info.orientation).rows_for_columns
                                ? size(info.height, info.width)
                                : size(info.width, info.height);
  std::string message = "viewers show these frames " + HowShown(info.orientation) +
                        " (their Orientation tag), as " + shown +
                        "; places in pixels are taken as stored, " + size(info.width, info.height);
  const std::string instead = BoxText(box) + " was read off a viewer: write " + BoxText(*stored);
  if (!IsInside(box, info.width, info.height)) {
    return Refused("bad_region", subject, message + "; " + instead);
  }
  warnings.push_back({"turned_frames", subject, std::move(message) + ". If " + instead});
  return {};
}

}  // namespace lightcal
