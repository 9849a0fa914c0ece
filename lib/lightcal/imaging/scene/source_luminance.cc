// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/source_luminance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "lightcal/core/statistics.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/bracket/encoded_errors.h"

namespace lightcal {
namespace {

constexpr double kPeakStandsOut = 3.0;  // peak over the rim's median
constexpr double kClippedSigma = 0.9;   // sigma / value of a sample that is a lower bound
constexpr int kLeastSkirt = 3;          // pixels of blur around the face that belong to it
constexpr double kSkirtShare = 0.1;     // the same, of the face's longer side
constexpr double kFaceFrom = 0.1;       // of the bright part's mean

// One pixel of the region.
struct Part {
  Vec3 direction{};
  double nits = 0.0, sigma = 0.0, solid_angle = 0.0;
  bool seen = false;
};

class Parts {
 public:
  Parts(View2d<const float> nits, View2d<const float> sigma, const PixelSolidAngles& angles,
        const Region& region)
      : width_(region.width), height_(region.height) {
    for (int y = region.y; y < region.y + region.height; ++y) {
      for (int x = region.x; x < region.x + region.width; ++x) {
        const auto direction = angles.Direction(x + 0.5, y + 0.5);
        parts_.push_back({direction.value_or(Vec3{}), double{nits(x, y)}, double{sigma(x, y)},
                          angles.SolidAngle(x, y), direction.has_value()});
      }
    }
  }

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::size_t size() const { return parts_.size(); }
  [[nodiscard]] const Part& operator[](std::size_t i) const { return parts_[i]; }
  // Of the pixel nearest to a direction.
  [[nodiscard]] double SolidAngleTowards(const Vec3& direction) const {
    const auto nearer = [&](const Part& a, const Part& b) {
      return (a.seen ? Dot(a.direction, direction) : -2.0) <
             (b.seen ? Dot(b.direction, direction) : -2.0);
    };
    return std::ranges::max_element(parts_, nearer)->solid_angle;
  }
  [[nodiscard]] bool OnRim(std::size_t i) const {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    return x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1;
  }

 private:
  int width_, height_;
  std::vector<Part> parts_;
};

double MedianOfRim(const Parts& parts) {
  std::vector<double> rim;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts.OnRim(i) && parts[i].seen) rim.push_back(parts[i].nits);
  }
  if (rim.empty()) return 0.0;
  return UpperMedian(rim);
}

// A tenth of the mean of what is brighter than half of the peak, above the rim; and half as much
// again as the rim.
double Threshold(const Parts& parts, double background, double peak) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].seen || parts[i].nits < background + 0.5 * (peak - background)) continue;
    sum += parts[i].nits - background;
    count += 1.0;
  }
  return background + std::max(kFaceFrom * sum / count, 0.5 * background);
}

// The face and as much around it as its blur may reach: a square brush.
std::vector<std::uint8_t> WithSkirt(const std::vector<std::uint8_t>& face, int width, int height) {
  int left = width, right = -1, top = height, bottom = -1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (face[static_cast<std::size_t>(y * width + x)] == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
  }
  const double side = std::max(right - left, bottom - top) + 1.0;
  const int reach = std::max(kLeastSkirt, static_cast<int>(std::lround(kSkirtShare * side)));
  const auto spread = [&](const std::vector<std::uint8_t>& from, int step, int count, int length) {
    std::vector<std::uint8_t> out(from.size(), 0);
    for (int line = 0; line < count; ++line) {
      const int base = step == 1 ? line * width : line;
      int last = -reach - 1;
      const auto mark = [&](int i) {
        const auto at = static_cast<std::size_t>(base + i * step);
        if (from[at] != 0) last = i;
        if (std::abs(i - last) <= reach) out[at] = 1;
      };
      for (int i = 0; i < length; ++i) mark(i);
      last = length + reach;
      for (int i = length - 1; i >= 0; --i) mark(i);
    }
    return out;
  };
  return spread(spread(face, 1, height, width), width, width, height);
}

// The variance of the pixels around (x, y), those outside left out.
double VarianceAround(View2d<const float> nits, int x, int y) {
  double sum = 0.0, square = 0.0, count = 0.0;
  for (int j = std::max(0, y - 1); j <= std::min(nits.height() - 1, y + 1); ++j) {
    for (int i = std::max(0, x - 1); i <= std::min(nits.width() - 1, x + 1); ++i) {
      const double own = double{nits(i, j)} - double{nits(x, y)};
      sum += own;
      square += own * own;
      count += 1.0;
    }
  }
  return square / count - sum / count * (sum / count);
}

// A lower bound's sigma is its value. That of a code beside an edge may be as large by what its
// neighbours are, which says nothing of clipping.
bool IsClipped(View2d<const float> nits, View2d<const float> sigma, int x, int y) {
  const double least = kClippedSigma * double{nits(x, y)};
  const double hidden = kHiddenDetail * kHiddenDetail * VarianceAround(nits, x, y);
  return double{sigma(x, y)} * double{sigma(x, y)} - hidden >= least * least;
}

Vec3 MiddleOf(const Parts& parts, const std::vector<std::uint8_t>& lamp, double background) {
  Vec3 sum{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (lamp[i] == 0) continue;
    sum = sum + parts[i].direction * ((parts[i].nits - background) * parts[i].solid_angle);
  }
  return sum * (1.0 / Length(sum));
}

// How much of each pixel the face covers: one inside, and along its edge what the pixel holds of
// the level inside, nearby; of lamps too thin to have an inside, or if asked, of their brightest
// nearby.
class Coverage {
 public:
  Coverage(const Parts& parts, const SourceLuminance& source, bool by_brightest)
      : parts_(parts), face_(source.face), background_(source.background.value()) {
    inside_.assign(face_.size(), 0);
    near_.assign(face_.size(), 0);
    for (std::size_t i = 0; i < face_.size(); ++i) {
      if (!by_brightest) {
        inside_[i] = CountAround(i, kEdge, face_) == (2 * kEdge + 1) * (2 * kEdge + 1) ? 1 : 0;
      }
      near_[i] = CountAround(i, kEdge, face_) > 0 ? 1 : 0;
    }
  }

  [[nodiscard]] double At(std::size_t i) const {
    if (inside_[i] != 0) return 1.0;
    if (near_[i] == 0) return 0.0;
    double sum = 0.0, brightest = 0.0;
    int count = 0;
    ForAround(i, 2 * kEdge + 1, [&](std::size_t j) {
      brightest = std::max(brightest, parts_[j].nits - background_);
      if (inside_[j] == 0) return;
      sum += parts_[j].nits - background_;
      ++count;
    });
    const double level = count > 0 ? sum / count : brightest;
    return std::clamp((parts_[i].nits - background_) / level, 0.0, 1.0);
  }

 private:
  static constexpr int kEdge = 3;  // pixels of blur on either side

  template <class Visit>
  void ForAround(std::size_t i, int reach, const Visit& visit) const {
    const int x = static_cast<int>(i) % parts_.width(), y = static_cast<int>(i) / parts_.width();
    for (int ny = std::max(0, y - reach); ny <= std::min(parts_.height() - 1, y + reach); ++ny) {
      for (int nx = std::max(0, x - reach); nx <= std::min(parts_.width() - 1, x + reach); ++nx) {
        visit(static_cast<std::size_t>(ny * parts_.width() + nx));
      }
    }
  }
  [[nodiscard]] int CountAround(std::size_t i, int reach,
                                const std::vector<std::uint8_t>& marks) const {
    int count = 0;
    ForAround(i, reach, [&](std::size_t j) { count += marks[j]; });
    return count;
  }

  const Parts& parts_;
  const std::vector<std::uint8_t>& face_;
  double background_;
  std::vector<std::uint8_t> inside_, near_;
};

// The face on the plane at distance 1 facing the camera: dA = dOmega / cos^3.
struct FaceMoments {
  double area = 0.0, solid_angle = 0.0, flux = 0.0;
  double longer = 0.0, shorter = 0.0;  // variances along its axes
  bool longer_is_right = true;         // the longer side lies nearer to right than to up
};

FaceMoments MomentsOf(const Parts& parts, const SourceLuminance& out, const Coverage& coverage) {
  const Vec3 middle = out.direction;
  const Vec3 side = Cross(middle, std::abs(middle[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
  const Vec3 right = side * (1.0 / Length(side)), up = Cross(right, middle);
  double area = 0.0, flux = 0.0, solid = 0.0, u1 = 0.0, v1 = 0.0, uu = 0.0, vv = 0.0, uv = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double covered = coverage.At(i);
    if (!parts[i].seen || covered <= 0.0) continue;
    const Part& part = parts[i];
    const double cosine = Dot(part.direction, middle);
    const double patch = covered * part.solid_angle / (cosine * cosine * cosine);
    const double u = Dot(part.direction, right) / cosine, v = Dot(part.direction, up) / cosine;
    area += patch;
    solid += covered * part.solid_angle;
    flux += (part.nits - out.background.value()) * part.solid_angle;
    u1 += patch * u;
    v1 += patch * v;
    uu += patch * u * u;
    vv += patch * v * v;
    uv += patch * u * v;
  }
  const double su = uu / area - u1 * u1 / area / area, sv = vv / area - v1 * v1 / area / area;
  const double mixed = uv / area - u1 * v1 / area / area;
  const double half = std::hypot((su - sv) / 2.0, mixed), mean = (su + sv) / 2.0;
  return {area, solid, flux, mean + half, std::max(1e-30, mean - half), su >= sv};
}

// How much higher the brightest place is than the brightest pixel: between the pixels, by the
// parabola through the logarithms of three in each direction, which is a Gaussian's.
double PeakOverPixel(const Parts& parts, double background) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].seen && (!parts[at].seen || parts[i].nits > parts[at].nits)) at = i;
  }
  if (parts.OnRim(at)) return 1.0;
  const auto ln = [&](std::size_t i) {
    return std::log(std::max(parts[i].nits - background, 1e-3 * parts[at].nits));
  };
  double ln_gain = 0.0;
  for (const std::size_t step : {std::size_t{1}, static_cast<std::size_t>(parts.width())}) {
    const double slope = ln(at + step) - ln(at - step);
    const double bend = ln(at + step) + ln(at - step) - 2.0 * ln(at);
    if (bend < 0.0) ln_gain -= slope * slope / (8.0 * bend);
  }
  return std::exp(ln_gain);
}

// How sure the sharp face is, relative: by the picture's blur, which is no Gaussian alone, and the
// wall behind, either of which makes the area seen a little another.
double SdOfSharp(const BlurredFace& seen, FaceShape shape, const SharpFace& sharp) {
  constexpr double kSeenSd = 0.03;
  const auto moved = [&](double by) {
    BlurredFace other = seen;
    other.area *= by;
    const auto face = Sharpened(other, shape);
    return face ? face->area : 0.0;
  };
  return 0.5 * std::abs(moved(1.0 + kSeenSd) - moved(1.0 - kSeenSd)) / sharp.area;
}

void MeasureFace(const Parts& parts, FaceShape shape, SourceLuminance& out) {
  constexpr double kSmallFace = 8.0;   // pixels across: below it the blur reaches the middle
  constexpr double kLargestSd = 0.12;  // of the area, relative: beyond, it is not resolved
  constexpr double kEdgeSd = 0.03;     // pixels, of where each side's edges lie
  constexpr double kShareSd = 0.3;     // of what the blur took, for its shape and the mosaic
  FaceMoments face = MomentsOf(parts, out, Coverage(parts, out, false));
  // A pixel of the face's middle, on the plane at distance 1.
  const double pixel = std::sqrt(parts.SolidAngleTowards(out.direction));
  double share = 1.0, blur_sd = 0.0, ratio = std::sqrt(face.longer / face.shorter);
  out.pixels_across = std::sqrt(face.area / ratio) / pixel;
  out.pixels_long = std::sqrt(face.area * ratio) / pixel;
  if (out.pixels_across < kSmallFace) {
    face = MomentsOf(parts, out, Coverage(parts, out, true));
    const double gain = PeakOverPixel(parts, out.background.value());
    face.area /= gain;
    face.solid_angle /= gain;
    const BlurredFace seen{face.area, face.longer, face.shorter};
    const auto sharp = Sharpened(seen, shape);
    const double sd =
        sharp ? std::hypot(SdOfSharp(seen, shape, *sharp), kShareSd * (1.0 - sharp->share)) : 1.0;
    out.resolved = sd < kLargestSd;
    if (out.resolved) {
      share = sharp->share;
      ratio = sharp->longer / sharp->shorter;
      blur_sd = sd;
    }
  }
  out.area = share * face.area;
  const double longer = std::sqrt(out.area * ratio), shorter = std::sqrt(out.area / ratio);
  out.width = face.longer_is_right ? longer : shorter;
  out.height = face.longer_is_right ? shorter : longer;
  out.solid_angle = Steradians(share * face.solid_angle);
  out.luminance = Nits(face.flux / out.solid_angle.value());
  const double edges = 2.0 * kEdgeSd * pixel * (1.0 / longer + 1.0 / shorter);
  out.area_sd_relative = std::hypot(edges, blur_sd);
}

std::string PlaceText(const Region& region) {
  return std::to_string(region.x) + "," + std::to_string(region.y) + "," +
         std::to_string(region.width) + "," + std::to_string(region.height);
}

}  // namespace

Result<SourceLuminance> MeasureSource(View2d<const float> nits, View2d<const float> sigma,
                                      const PixelSolidAngles& angles, const Region& region,
                                      FaceShape shape) {
  if (auto ok = CheckRegion(region, nits.width(), nits.height()); !ok) {
    return Propagate(std::move(ok));
  }
  if (angles.view().width != nits.width() || angles.view().height != nits.height()) {
    return Refused("bad_view", "projection", "picture and projection differ in size");
  }
  const Parts parts(nits, sigma, angles, region);
  SourceLuminance out;
  const double background = MedianOfRim(parts);
  out.background = Nits(background);
  double peak = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].seen) peak = std::max(peak, parts[i].nits);
  }
  if (!(peak > kPeakStandsOut * background) || !(peak > 0.0)) {
    return Refused("no_source", PlaceText(region),
                   "nothing stands three times above what surrounds it; the lamp must be lit, and "
                   "the region (rect) hold it and some of the dark around it");
  }
  const double threshold = Threshold(parts, background, peak);
  out.face.assign(parts.size(), 0);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!parts[i].seen || parts[i].nits <= threshold) continue;
    out.face[i] = 1;
    if (parts.OnRim(i)) {
      return Refused(
          "source_cut", PlaceText(region),
          "the lamp reaches the rim of the region; give one (rect) that holds all of it");
    }
    const int column = static_cast<int>(i) % region.width, row = static_cast<int>(i) / region.width;
    if (IsClipped(nits, sigma, region.x + column, region.y + row)) {
      return Refused("source_clipped", PlaceText(region),
                     "the lamp is saturated in every frame, so its luminance is a lower bound; "
                     "expose shorter, stop down or use an ND filter");
    }
  }
  const auto lamp = WithSkirt(out.face, parts.width(), parts.height());
  out.direction = MiddleOf(parts, lamp, background);
  double lux = 0.0, variance = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (lamp[i] == 0 || !parts[i].seen) continue;
    const double weight = parts[i].solid_angle * Dot(parts[i].direction, out.direction);
    lux += weight * (parts[i].nits - background);
    variance += weight * weight * parts[i].sigma * parts[i].sigma;
  }
  out.illuminance = Lux(lux);
  out.noise_sd_relative = std::sqrt(variance) / lux;
  MeasureFace(parts, shape, out);
  return out;
}

}  // namespace lightcal
