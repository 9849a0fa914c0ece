// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/charuco.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <opencv2/aruco/charuco.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

using OpenCvBoard = cv::Ptr<cv::aruco::CharucoBoard>;

constexpr int kFewestSquares = 3, kMostSquares = 100;
constexpr std::size_t kFewestCorners = 6;
constexpr double kSmallestSquare = 8.0;      // pixels
constexpr double kSmallestPerimeter = 32.0;  // of a marker, pixels
constexpr int kLargePicture = 2000;
constexpr double kWidestEdge = 0.2;    // squares, where that is more than
constexpr double kSharpEdge = 3.0;     // pixels
constexpr int kNeighbourhood = 6;      // of the longer side: what local contrast is relative to
constexpr double kMiddleCode = 100.0;  // of 255, for what is as bright as its neighbourhood
constexpr double kPixelCentre = 0.5;   // OpenCV counts from the centre of the first pixel

// OpenCV's board in units of squares: its X is ours, its Y runs down from the upper edge (since
// 4.6.0; up from the lower one before).
Result<OpenCvBoard> MakeBoard(const CharucoBoard& board) {
  const auto index = static_cast<std::size_t>(board.dictionary);
  const bool sized = std::min(board.columns, board.rows) >= kFewestSquares &&
                     std::max(board.columns, board.rows) <= kMostSquares;
  if (!sized || MarkersOn(board) > kMarkersInDictionary[index]) {
    return Refused("bad_board",
                   std::to_string(board.columns) + " x " + std::to_string(board.rows) + " squares",
                   "a board has 3 x 3 squares or more, and no more markers (half as many) than "
                   "its dictionary: " +
                       std::string(kMarkerDictionaryWords[index]) + " has " +
                       std::to_string(kMarkersInDictionary[index]));
  }
  constexpr std::array<int, kMarkerDictionaryWords.size()> kNames = {
      cv::aruco::DICT_4X4_50, cv::aruco::DICT_4X4_100, cv::aruco::DICT_5X5_100,
      cv::aruco::DICT_6X6_250};
  return cv::aruco::CharucoBoard::create(board.columns, board.rows, 1.0F,
                                         static_cast<float>(kMarkerPerSquare),
                                         cv::aruco::getPredefinedDictionary(kNames[index]));
}

// The white cells of a marker whose lower left corner is (x, z).
void AddWhiteCells(const cv::Mat& cells, double x, double z, double cell,
                   std::vector<BoardRectangle>& out) {
  for (int row = 0; row < cells.rows; ++row) {
    const double bottom = z + cell * (cells.rows - 1 - row);
    for (int first = 0; first < cells.cols; ++first) {
      if (cells.at<unsigned char>(row, first) == 0) continue;
      int end = first + 1;
      while (end < cells.cols && cells.at<unsigned char>(row, end) != 0) ++end;
      out.push_back({x + cell * first, bottom, cell * (end - first), cell, false});
      first = end;
    }
  }
}

// Luminance over that of its neighbourhood, as 8 bit codes: markers are then equally black and
// white wherever the lamp shines.
cv::Mat LocalContrast(View2d<const float> luminance) {
  cv::Mat linear(luminance.height(), luminance.width(), CV_32F);
  for (int y = 0; y < linear.rows; ++y) {
    const auto row = luminance.row(y);
    std::ranges::transform(row, linear.ptr<float>(y), [](float v) { return std::max(v, 0.0F); });
  }
  const int side = std::max({linear.rows, linear.cols, kNeighbourhood}) / kNeighbourhood | 1;
  cv::Mat mean;
  cv::boxFilter(linear, mean, CV_32F, {side, side}, {-1, -1}, true, cv::BORDER_REFLECT);
  cv::Mat codes(linear.size(), CV_8U);
  for (int y = 0; y < linear.rows; ++y) {
    const auto* value = linear.ptr<float>(y);
    const auto* around = mean.ptr<float>(y);
    auto* code = codes.ptr<unsigned char>(y);
    for (int x = 0; x < linear.cols; ++x) {
      const double ratio = around[x] > 0.0F ? double{value[x]} / double{around[x]} : 0.0;
      code[x] = cv::saturate_cast<unsigned char>(kMiddleCode * ratio);
    }
  }
  return codes;
}

// Corners by OpenCV's number: row by row, columns - 1 in a row.
using CornersByNumber = std::map<int, cv::Point2f>;

// The picture is enlarged where it is small: markers of 15 pixels read well then.
CornersByNumber Detect(const cv::Mat& picture, const OpenCvBoard& board) {
  const int enlarge = std::max(picture.cols, picture.rows) < kLargePicture ? 2 : 1;
  cv::Mat codes = picture;
  if (enlarge > 1) cv::resize(picture, codes, {}, enlarge, enlarge, cv::INTER_CUBIC);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> numbers;
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->minMarkerPerimeterRate = kSmallestPerimeter / std::max(codes.cols, codes.rows);
  cv::aruco::detectMarkers(codes, board->dictionary, markers, numbers, parameters);
  CornersByNumber found;
  if (numbers.empty()) return found;
  std::vector<cv::Point2f> corners;
  std::vector<int> corner_numbers;
  cv::aruco::interpolateCornersCharuco(markers, numbers, codes, board, corners, corner_numbers);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    // Both count from the centre of their first pixel.
    const cv::Point2f half(0.5F, 0.5F);
    found.emplace(corner_numbers[i], (corners[i] + half) / enlarge - half);
  }
  return found;
}

// Pairs of corners that are the ends of one square's side.
template <class Visit>
void ForEachSide(const CornersByNumber& corners, const CharucoBoard& board, const Visit& visit) {
  const int in_row = board.columns - 1;
  for (const auto& [number, corner] : corners) {
    for (const int step : {1, in_row}) {
      if (step == 1 && (number + 1) % in_row == 0) continue;
      const auto other = corners.find(number + step);
      if (other != corners.end()) visit(corner, other->second);
    }
  }
}

double SquareInPixels(const CornersByNumber& corners, const CharucoBoard& board) {
  std::vector<double> sides;
  ForEachSide(corners, board, [&](const cv::Point2f& a, const cv::Point2f& b) {
    sides.push_back(cv::norm(b - a));
  });
  return sides.empty() ? 0.0 : UpperMedian(sides);
}

double CodeAt(const cv::Mat& codes, double x, double y) {
  const int left = std::clamp(static_cast<int>(std::floor(x)), 0, codes.cols - 2);
  const int top = std::clamp(static_cast<int>(std::floor(y)), 0, codes.rows - 2);
  const double u = std::clamp(x - left, 0.0, 1.0), v = std::clamp(y - top, 0.0, 1.0);
  const auto at = [&](int dx, int dy) {
    return double{static_cast<double>(codes.at<unsigned char>(top + dy, left + dx))};
  };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

// Contrast over steepest slope across the middles of squares' sides, in squares. On the white side
// a marker begins after an eighth of a square, so the profile stops there, whichever side it is.
double EdgeWidth(const cv::Mat& codes, const CornersByNumber& corners, const CharucoBoard& board) {
  constexpr int kSteps = 24;
  constexpr double kReach = (1.0 - kMarkerPerSquare) / 2.0;
  std::vector<double> widths;
  ForEachSide(corners, board, [&](const cv::Point2f& a, const cv::Point2f& b) {
    const cv::Point2d middle = (cv::Point2d(a) + cv::Point2d(b)) * 0.5;
    const cv::Point2d across(double{b.y} - double{a.y}, double{a.x} - double{b.x});
    double low = 255.0, high = 0.0, steepest = 0.0, before = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const cv::Point2d at = middle + across * (kReach * (2.0 * i / kSteps - 1.0));
      const double code = CodeAt(codes, at.x, at.y);
      low = std::min(low, code);
      high = std::max(high, code);
      if (i > 0) steepest = std::max(steepest, std::abs(code - before));
      before = code;
    }
    if (steepest > 0.0) widths.push_back((high - low) / steepest * 2.0 * kReach / kSteps);
  });
  return widths.empty() ? 0.0 : UpperMedian(widths);
}

tl::unexpected<Error> NotFound(std::size_t corners, std::size_t all) {
  return Refused("board_not_found", "ChArUco board",
                 (corners == 0 ? std::string("no marker of it is readable")
                               : "only " + std::to_string(corners) + " of its " +
                                     std::to_string(all) + " corners are readable") +
                     "; have the whole board in the picture, sharp, unsaturated and not in the "
                     "dark, and give its squares, rows and dictionary as they were printed");
}

}  // namespace

Result<std::vector<BoardRectangle>> LayOutBoard(const CharucoBoard& board) {
  const auto known = MakeBoard(board);
  if (!known) return tl::unexpected(known.error());
  const double square = board.square.value();
  const double marker = square * kMarkerPerSquare;
  std::vector<BoardRectangle> out;
  for (int row = 0; row < board.rows; ++row) {
    for (int column = row % 2; column < board.columns; column += 2) {
      out.push_back({square * column, square * (board.rows - 1 - row), square, square, true});
    }
  }
  const cv::aruco::Dictionary& dictionary = *(*known)->dictionary;
  const int side = dictionary.markerSize + 2;  // with its black border
  for (std::size_t i = 0; i < (*known)->ids.size(); ++i) {
    const cv::Point3f lower_left = (*known)->objPoints[i][3];  // clockwise from the upper left
    const double x = square * double{lower_left.x};
    const double z = square * (board.rows - double{lower_left.y});
    out.push_back({x, z, marker, marker, true});
    cv::Mat cells;
    dictionary.drawMarker((*known)->ids[i], side, cells, 1);
    AddWhiteCells(cells, x, z, marker / side, out);
  }
  return out;
}

Result<std::vector<BoardCorner>> FindBoard(View2d<const float> luminance,
                                           const CharucoBoard& board) {
  const auto known = MakeBoard(board);
  if (!known) return tl::unexpected(known.error());
  const cv::Mat codes = LocalContrast(luminance);
  const CornersByNumber corners = Detect(codes, *known);
  const auto& all = (*known)->chessboardCorners;
  if (corners.empty()) return NotFound(0, all.size());
  const double square = SquareInPixels(corners, board);
  if (square > 0.0 && square < kSmallestSquare) {
    return Refused("board_too_small", "ChArUco board",
                   "its squares are " + RoundedText(square, 2) +
                       " pixels wide in the picture; 8 are needed: go nearer, or print it larger");
  }
  if (corners.size() < kFewestCorners) return NotFound(corners.size(), all.size());
  const double edge = EdgeWidth(codes, corners, board);
  if (edge > kWidestEdge && edge * square > kSharpEdge) {
    return Refused("board_blurred", "ChArUco board",
                   "its edges are " + PercentText(edge) +
                       " of a square wide; focus on the wall and use a tripod");
  }
  std::vector<BoardCorner> out;
  for (const auto& [number, pixel] : corners) {
    const cv::Point3f at = all[static_cast<std::size_t>(number)];
    out.push_back(
        {{board.square.value() * double{at.x}, board.square.value() * (board.rows - double{at.y})},
         {double{pixel.x} + kPixelCentre, double{pixel.y} + kPixelCentre}});
  }
  return out;
}

}  // namespace lightcal
