// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/find_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <opencv2/features2d.hpp>

namespace lightcal {
namespace {

constexpr int kFields = 8;                // on each side
constexpr int kShareOfField = 30;         // of `most`
constexpr double kLeastContrast = 0.004;  // the pictures' local contrast is normalised before
constexpr double kMostEdge = 10.0;
constexpr int kOctaveLayers = 3;
// OpenCV's places count from the first pixel's centre, and lie a quarter of a pixel too far right
// and down: it doubles the picture first, and halves places without the half pixel between both
// grids.
constexpr float kFeatureShift = 0.5F - 0.25F;
constexpr double kSigma = 1.6;

cv::Mat Whole(View2d<const std::uint8_t> view) {
  return {view.height(), view.width(), CV_8UC1, const_cast<std::uint8_t*>(view.data()),
          static_cast<std::size_t>(view.row_stride())};
}

std::vector<cv::KeyPoint> SpreadOver(std::vector<cv::KeyPoint> found, cv::Size size, int most) {
  std::ranges::stable_sort(
      found, [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  std::map<int, int> taken;
  std::vector<cv::KeyPoint> chosen;
  for (const cv::KeyPoint& at : found) {
    const int column = static_cast<int>(at.pt.x) * kFields / size.width;
    const int row = static_cast<int>(at.pt.y) * kFields / size.height;
    if (taken[row * kFields + column]++ >= std::max(1, most / kShareOfField)) continue;
    chosen.push_back(at);
    if (static_cast<int>(chosen.size()) == most) break;
  }
  return chosen;
}

}  // namespace

std::vector<PictureFeature> FindFeatures(View2d<const std::uint8_t> grey,
                                         View2d<const std::uint8_t> seen, int most) {
  const cv::Mat picture = Whole(grey);
  const auto sift = cv::SIFT::create(0, kOctaveLayers, kLeastContrast, kMostEdge, kSigma);
  std::vector<cv::KeyPoint> points;
  sift->detect(picture, points, Whole(seen));
  points = SpreadOver(std::move(points), picture.size(), most);
  cv::Mat descriptors;
  sift->compute(picture, points, descriptors);
  std::vector<PictureFeature> features;
  for (int i = 0; i < descriptors.rows; ++i) {
    const cv::KeyPoint& at = points[static_cast<std::size_t>(i)];
    PictureFeature feature;
    feature.x = at.pt.x + kFeatureShift;
    feature.y = at.pt.y + kFeatureShift;
    feature.size = at.size;
    feature.strength = at.response;
    const float* const row = descriptors.ptr<float>(i);
    double sum = 0.0;
    for (int k = 0; k < descriptors.cols; ++k) sum += std::max(0.0, double{row[k]});
    if (!(sum > 0.0)) continue;
    // Square roots of shares: the Euclidean distance becomes Hellinger's.
    // Source: Arandjelovic & Zisserman, CVPR 2012.
    for (std::size_t k = 0; k < feature.descriptor.size(); ++k) {
      feature.descriptor[k] = static_cast<float>(std::sqrt(std::max(0.0, double{row[k]}) / sum));
    }
    features.push_back(feature);
  }
  return features;
}

}  // namespace lightcal
