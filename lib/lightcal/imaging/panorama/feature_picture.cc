// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/feature_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lightcal/core/parallel.h"
#include "lightcal/core/statistics.h"
#include "lightcal/core/units.h"
#include "lightcal/imaging/panorama/aimed_picture.h"

namespace lightcal {
namespace {

constexpr double kWidestTheta = 115.0 * kRadiansPerDegree;
constexpr double kBlackShare = 1e-3;  // of the median: added before the logarithm
constexpr int kMeanShare = 24;        // radius of the local mean, as a share of the longer side
// Of ln L: what is flatter stays flat. Where little is noise, bare sky is no flat thing.
constexpr double kFlatLn = 0.04, kFlatQuietLn = 0.01, kFlatOverNoise = 2.5;
constexpr double kGreyMiddle = 127.0, kGreySpread = 45.0;
constexpr double kRimMargin = 0.985;  // of RimShare: a fisheye's rim is no thing of the scene

double FarthestTheta(const PixelSolidAngles& angles) {
  const PictureView& view = angles.view();
  if (view.projection != Projection::kRectilinear) {
    return std::min(kWidestTheta, view.field_of_view.value() / 2.0);
  }
  return std::acos((*angles.Direction(0.0, 0.0))[1]);
}

// Standard deviation of ln L that neighbours do not share, by second differences along rows.
double NoiseOfLn(const std::vector<float>& ln, const std::vector<std::uint8_t>& seen, int width) {
  constexpr std::size_t kStep = 7;
  const double of_difference = std::sqrt(6.0);  // 1 + 4 + 1 variances
  std::vector<float> differences;
  for (std::size_t i = 1; i + 1 < ln.size(); i += kStep) {
    const std::size_t x = i % static_cast<std::size_t>(width);
    if (x == 0 || x + 1 == static_cast<std::size_t>(width)) continue;
    if (seen[i - 1] == 0 || seen[i] == 0 || seen[i + 1] == 0) continue;
    differences.push_back(std::abs(ln[i - 1] - 2.0F * ln[i] + ln[i + 1]));
  }
  if (differences.empty()) return 0.0;
  return double{UpperMedian(differences)} / kNormalQuartile / of_difference;
}

// Sums over [0, x) x [0, y) of values that are seen, and of 1.
class SeenSums {
 public:
  SeenSums(const std::vector<float>& values, const std::vector<std::uint8_t>& seen, int width,
           int height)
      : stride_(static_cast<std::size_t>(width) + 1),
        width_(width),
        height_(height),
        sums_(stride_ * (static_cast<std::size_t>(height) + 1)) {
    for (int y = 0; y < height; ++y) {
      Sum row;
      for (int x = 0; x < width; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x);
        if (seen[at] != 0)
          row.Add(1.0, double{values[at]}, double{values[at]} * double{values[at]});
        Sum& here = At(x + 1, y + 1);
        here = At(x + 1, y);
        here.Add(row.count, row.value, row.square);
      }
    }
  }
  struct Moments {
    double mean = 0.0, spread = 0.0;
  };
  [[nodiscard]] Moments Around(int x, int y, int radius) {
    const int x0 = std::max(0, x - radius), x1 = std::min(width_, x + radius + 1);
    const int y0 = std::max(0, y - radius), y1 = std::min(height_, y + radius + 1);
    Sum sum = At(x1, y1);
    for (const auto& [corner, sign] : {std::pair(&At(x0, y1), -1.0), std::pair(&At(x1, y0), -1.0),
                                       std::pair(&At(x0, y0), 1.0)}) {
      sum.Add(sign * corner->count, sign * corner->value, sign * corner->square);
    }
    if (!(sum.count > 0.5)) return {};
    const double mean = sum.value / sum.count;
    return {mean, std::sqrt(std::max(0.0, sum.square / sum.count - mean * mean))};
  }

 private:
  struct Sum {
    double count = 0.0, value = 0.0, square = 0.0;
    void Add(double c, double v, double s) {
      count += c;
      value += v;
      square += s;
    }
  };
  Sum& At(int x, int y) { return sums_[static_cast<std::size_t>(y) * stride_ + x]; }

  std::size_t stride_;
  int width_, height_;
  std::vector<Sum> sums_;
};

}  // namespace

Vec3 FeaturePicture::DirectionOf(double x, double y) const {
  const double right = (x - width / 2.0) / pixels_per_radian;
  const double up = (height / 2.0 - y) / pixels_per_radian;
  const double rho = std::hypot(right, up), theta = 2.0 * std::atan(rho / 2.0);
  const double aside = rho > 0.0 ? std::sin(theta) / rho : 0.0;
  return {right * aside, std::cos(theta), up * aside};
}

FeaturePicture MakeFeaturePicture(View2d<const float> nits, const PixelSolidAngles& angles,
                                  int longest) {
  const PictureView& view = angles.view();
  const double reach = 2.0 * std::tan(FarthestTheta(angles) / 2.0);
  const bool rect = view.projection == Projection::kRectilinear;
  const double diagonal = std::hypot(view.width, view.height);
  // Half sides of the picture on the stereographic plane; a rect's edges bulge less than its
  // corner.
  const double half_x = rect ? reach * view.width / diagonal * 1.1 : reach;
  const double half_y = rect ? reach * view.height / diagonal * 1.1 : reach;
  FeaturePicture picture;
  picture.pixels_per_radian =
      std::min(1.0 / angles.MiddlePitch().value(), longest / (2.0 * std::max(half_x, half_y)));
  picture.width = std::max(16, static_cast<int>(2.0 * half_x * picture.pixels_per_radian));
  picture.height = std::max(16, static_cast<int>(2.0 * half_y * picture.pixels_per_radian));
  const std::size_t count =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  picture.grey.assign(count, 0);
  picture.seen.assign(count, 0);

  std::vector<float> some;
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.width) * view.height; i += 97) {
    if (nits.data()[i] > 0.0F) some.push_back(nits.data()[i]);
  }
  if (some.empty()) return picture;
  const double black = kBlackShare * double{UpperMedian(some)};
  // Where the view is finer, means of side x side points.
  const int side = std::max(1, static_cast<int>(std::lround(1.0 / (angles.MiddlePitch().value() *
                                                                   picture.pixels_per_radian))));
  std::vector<float> ln(count, 0.0F);
  ParallelFor(picture.height, [&](int y) {
    for (int x = 0; x < picture.width; ++x) {
      double sum = 0.0;
      bool whole = true;
      for (int i = 0; i < side * side && whole; ++i) {
        const auto point = angles.PointOf(
            picture.DirectionOf(x + (i % side + 0.5) / side, y + (i / side + 0.5) / side));
        whole = point && (rect || angles.RimShare((*point)[0], (*point)[1]) < kRimMargin);
        if (!whole) break;
        const PictureTap tap = TapAt(view, *point);
        for (std::size_t k = 0; k < 4; ++k) {
          sum += double{tap.weight[k]} * double{nits.data()[tap.pixel[k]]};
        }
      }
      if (!whole) continue;
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x);
      picture.seen[at] = 255;
      ln[at] = static_cast<float>(std::log(std::max(0.0, sum) / (side * side) + black));
    }
  });
  SeenSums sums(ln, picture.seen, picture.width, picture.height);
  const double flat = std::clamp(kFlatOverNoise * NoiseOfLn(ln, picture.seen, picture.width),
                                 kFlatQuietLn, kFlatLn);
  const int radius = std::max(4, std::max(picture.width, picture.height) / kMeanShare);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x);
      const auto local = sums.Around(x, y, radius);
      // Beyond the view its own edge goes on, as flat as its surroundings.
      const double off = picture.seen[at] != 0 ? double{ln[at]} - local.mean : 0.0;
      const double grey = kGreyMiddle + kGreySpread * off / std::hypot(local.spread, flat);
      picture.grey[at] = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
    }
  }
  return picture;
}

std::vector<PictureFeature> FeaturesInView(std::vector<PictureFeature> features,
                                           const FeaturePicture& picture,
                                           const PixelSolidAngles& angles) {
  std::vector<PictureFeature> inside;
  for (PictureFeature& feature : features) {
    const auto point = angles.PointOf(picture.DirectionOf(double{feature.x}, double{feature.y}));
    if (!point) continue;
    feature.x = static_cast<float>((*point)[0]);
    feature.y = static_cast<float>((*point)[1]);
    inside.push_back(feature);
  }
  return inside;
}

}  // namespace lightcal
