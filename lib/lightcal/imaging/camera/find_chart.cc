// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/find_chart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <opencv2/mcc.hpp>
#include <string>
#include <vector>

#include "lightcal/core/statistics.h"

namespace lightcal {
namespace {

constexpr int kLongestSide = 1200;    // pixels of the picture mcc looks at
constexpr double kWhiteShare = 0.99;  // of the samples of a channel lie below what becomes white
constexpr double kGamma = 1.0 / 2.2;

// The chart's outline and its patches in mcc's own units: 16.75 x 11.25, the first centre 1.5 from
// both edges, the next ones 2.75 apart.
constexpr float kOutlineWidth = 16.75F, kOutlineHeight = 11.25F, kFirst = 1.5F, kStep = 2.75F;

// The value that kWhiteShare of a channel's samples lie below.
float WhiteOf(const cv::Mat& channel) {
  std::vector<float> values(channel.begin<float>(), channel.end<float>());
  return AtRank(values,
                static_cast<std::size_t>(kWhiteShare * static_cast<double>(values.size() - 1)));
}

// Small, white balanced by the brightest samples, encoded as pictures for looking at are. Empty
// where a channel is dark.
cv::Mat PictureToLookAt(View2d<const float> rgb, double& scale) {
  const cv::Mat whole(rgb.height(), rgb.width(), CV_32FC3, const_cast<float*>(rgb.data()),
                      static_cast<std::size_t>(rgb.row_stride()) * sizeof(float));
  scale = std::min(1.0, static_cast<double>(kLongestSide) / std::max(rgb.width(), rgb.height()));
  cv::Mat small;
  cv::resize(whole, small, cv::Size(), scale, scale, cv::INTER_AREA);
  std::vector<cv::Mat> channels;
  cv::split(small, channels);
  for (cv::Mat& channel : channels) {
    const float white = WhiteOf(channel);
    if (!(white > 0.0F)) return {};
    channel = cv::max(cv::min(channel / white, 1.0F), 0.0F);
    cv::pow(channel, kGamma, channel);
  }
  std::swap(channels.front(), channels.back());  // OpenCV's order is blue, green, red
  cv::merge(channels, small);
  small.convertTo(small, CV_8UC3, 255.0);
  return small;
}

tl::unexpected<Error> NotFound(const std::string& why) {
  return Refused("chart_not_found", "colour chart",
                 why +
                     "; have the chart of 6 x 4 patches flat, evenly lit and 200 pixels wide or "
                     "more in the picture, or give the line corners,x,y,x,y,x,y,x,y");
}

}  // namespace

Result<std::array<double, 8>> FindColorChart(View2d<const float> rgb) {
  double scale = 1.0;
  const cv::Mat picture = PictureToLookAt(rgb, scale);
  if (picture.empty()) return NotFound("the picture is dark");
  std::vector<cv::Point2f> outline;
  try {
    const auto detector = cv::mcc::CCheckerDetector::create();
    const auto settings = cv::mcc::DetectorParameters::create();
    settings->minImageSize = std::min(picture.rows, picture.cols);  // it was made small already
    if (!detector->process(picture, cv::mcc::MCC24, 1, false, settings)) {
      return NotFound("OpenCV sees none");
    }
    outline = detector->getBestColorChecker()->getBox();
  } catch (const cv::Exception& error) {
    return NotFound("OpenCV stopped (" + error.err + ")");
  }
  const std::vector<cv::Point2f> model = {
      {0.0F, 0.0F}, {kOutlineWidth, 0.0F}, {kOutlineWidth, kOutlineHeight}, {0.0F, kOutlineHeight}};
  const float right = kFirst + kStep * (kChartColumns - 1);
  const float bottom = kFirst + kStep * (kChartRows - 1);
  const std::vector<cv::Point2f> centres = {
      {kFirst, kFirst}, {right, kFirst}, {right, bottom}, {kFirst, bottom}};
  std::vector<cv::Point2f> seen;
  cv::perspectiveTransform(centres, seen, cv::getPerspectiveTransform(model, outline));
  std::array<double, 8> corners{};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    corners[2 * i] = double{seen[i].x} / scale;
    corners[2 * i + 1] = double{seen[i].y} / scale;
  }
  return corners;
}

}  // namespace lightcal
