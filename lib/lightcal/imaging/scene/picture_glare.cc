// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/picture_glare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/scene/glare_clusters.h"

namespace lightcal {
namespace {

constexpr double kLeastLuminance = 100.0;  // thresholds up to here are multiples
constexpr double kDefaultThreshold = 2000.0, kDefaultOverMean = 5.0;
constexpr double kHalfSphereSlack = 1e-6;

// The hemisphere in front, a pixel: its solid angle and that times the cosine; 0 behind.
struct FrontAngles {
  std::vector<float> plain, cosine;
};

FrontAngles AnglesInFront(const PixelSolidAngles& angles) {
  const int width = angles.view().width, height = angles.view().height;
  const bool latlong = angles.view().projection == Projection::kLatLong;
  FrontAngles front;
  front.plain.resize(static_cast<std::size_t>(width) * height);
  front.cosine.resize(front.plain.size());
  std::size_t at = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++at) {
      if (latlong) {  // whose own cosine is that of the zenith
        const double ahead = (*angles.Direction(x + 0.5, y + 0.5))[1];
        if (ahead <= 0.0) continue;
        const double plain = angles.SolidAngle(x, y);
        front.plain[at] = static_cast<float>(plain);
        front.cosine[at] = static_cast<float>(plain * ahead);
        continue;
      }
      const double cosine = angles.ProjectedSolidAngle(x, y);
      if (cosine <= 0.0 || angles.RimShare(x + 0.5, y + 0.5) > 1.0) continue;
      front.plain[at] = static_cast<float>(angles.SolidAngle(x, y));
      front.cosine[at] = static_cast<float>(cosine);
    }
  }
  return front;
}

struct Seen {
  double vertical = 0.0, solid_angle = 0.0, sum = 0.0, max = 0.0;  // sum of L dOmega
};

Seen LightOf(View2d<const float> nits, const FrontAngles& front, const Region& region) {
  Seen seen;
  for (int y = region.y; y < region.y + region.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * nits.width();
    for (int x = region.x; x < region.x + region.width; ++x) {
      const double l = nits(x, y);
      if (std::isnan(l)) continue;
      seen.vertical += l * front.cosine[row + x];
      seen.solid_angle += front.plain[row + x];
      seen.sum += l * front.plain[row + x];
      if (front.plain[row + x] > 0.0F) seen.max = std::max(seen.max, l);
    }
  }
  return seen;
}

Result<void> CheckGlareView(View2d<const float> nits, const PixelSolidAngles& angles,
                            const std::optional<Region>& task) {
  const PictureView& view = angles.view();
  if (view.width != nits.width() || view.height != nits.height()) {
    return Refused("bad_view", "projection", "picture and projection differ in size");
  }
  const bool half_sphere =
      view.projection == Projection::kLatLong ||
      (view.projection != Projection::kRectilinear &&
       view.field_of_view.value() >= std::numbers::pi * (1.0 - kHalfSphereSlack));
  if (half_sphere) return task ? CheckRegion(*task, nits.width(), nits.height()) : Result<void>();
  return Refused("bad_view", "projection",
                 "glare needs all light that reaches the eye: a fisheye of 180 degrees or a "
                 "lat-long panorama; this view sees less");
}

class GlareAnalysis {
 public:
  GlareAnalysis(View2d<const float> nits, const PixelSolidAngles& angles,
                const GlareSettings& settings)
      : nits_(nits),
        angles_(angles),
        settings_(settings),
        front_(AnglesInFront(angles)),
        seen_(LightOf(nits, front_, {0, 0, nits.width(), nits.height()})) {}

  [[nodiscard]] const Seen& seen() const { return seen_; }
  [[nodiscard]] const FrontAngles& front() const { return front_; }

  // of_mean: it moves with the picture's scale.
  void SetThreshold(Nits threshold, bool of_mean) {
    threshold_ = threshold;
    of_mean_ = of_mean;
  }

  // With all luminances `scale` times as high.
  [[nodiscard]] PictureGlare At(double scale) const {
    PictureGlare glare;
    const double limit = threshold_.value() / (of_mean_ ? 1.0 : scale);
    glare.source_of = GroupPixels(Above(limit, false), angles_, Reach());
    if (settings_.peak) TakePeaks(settings_.peak->value() / scale, glare.source_of);
    glare.sources = SourcesOf(glare.source_of, scale);
    glare.vertical_of_picture = Lux(seen_.vertical * scale);
    glare.light.vertical = settings_.vertical.value_or(glare.vertical_of_picture);
    double direct = 0.0;
    for (const FoundGlareSource& found : glare.sources) direct += found.vertical.value();
    glare.light.direct = Lux(direct);
    return glare;
  }

 private:
  [[nodiscard]] Radians Reach() const { return Radians(settings_.search_radius.value() / 2.0); }

  [[nodiscard]] std::vector<char> Above(double limit, bool or_at) const {
    std::vector<char> picked(front_.plain.size(), 0);
    std::size_t at = 0;
    for (int y = 0; y < nits_.height(); ++y) {
      for (const float l : nits_.row(y)) {
        picked[at] = front_.plain[at] > 0.0F && (or_at ? l >= limit : l > limit) ? 1 : 0;
        ++at;
      }
    }
    return picked;
  }

  void TakePeaks(double limit, std::vector<int>& source_of) const {
    const std::vector<int> peaks = GroupPixels(Above(limit, true), angles_, Reach());
    const int groups = *std::ranges::max_element(source_of);
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      if (peaks[i] > 0 && source_of[i] > 0) source_of[i] = groups + peaks[i];
    }
  }

  // Renumbers source_of to the order of what is returned.
  [[nodiscard]] std::vector<FoundGlareSource> SourcesOf(std::vector<int>& source_of,
                                                        double scale) const {
    struct Sum {
      double solid_angle = 0.0, light = 0.0, vertical = 0.0, x = 0.0, y = 0.0;
      float max = 0.0F;
      std::int64_t pixels = 0;
    };
    std::vector<Sum> sums(static_cast<std::size_t>(*std::ranges::max_element(source_of)));
    for (int y = 0; y < nits_.height(); ++y) {
      const std::size_t row = static_cast<std::size_t>(y) * nits_.width();
      for (int x = 0; x < nits_.width(); ++x) {
        const int source = source_of[row + x];
        if (source == 0) continue;
        Sum& sum = sums[static_cast<std::size_t>(source - 1)];
        const double w = front_.plain[row + x];
        const float l = nits_(x, y);
        sum.solid_angle += w;
        sum.light += w * l;
        sum.vertical += static_cast<double>(front_.cosine[row + x]) * l;
        sum.x += w * (x + 0.5);
        sum.y += w * (y + 0.5);
        sum.max = std::max(sum.max, l);
        ++sum.pixels;
      }
    }
    std::vector<std::pair<FoundGlareSource, int>> found;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const Sum& sum = sums[i];
      if (sum.pixels == 0) continue;  // all of it are peaks
      FoundGlareSource one;
      one.at = {sum.x / sum.solid_angle, sum.y / sum.solid_angle};
      one.direction = *angles_.Direction(one.at[0], one.at[1]);
      one.source = {Nits(scale * sum.light / sum.solid_angle), Steradians(sum.solid_angle),
                    PositionIndex(one.direction)};
      one.vertical = Lux(scale * sum.vertical);
      one.max = Nits(scale * sum.max);
      one.pixels = sum.pixels;
      found.emplace_back(one, static_cast<int>(i));
    }
    std::ranges::stable_sort(found, [](const auto& a, const auto& b) {
      return Weight(a.first.source) > Weight(b.first.source);
    });
    return Numbered(found, static_cast<int>(sums.size()), source_of);
  }

  [[nodiscard]] static double Weight(const GlareSource& source) {
    const double seen = source.luminance.value() / source.position_index;
    return seen * seen * source.solid_angle.value();
  }

  [[nodiscard]] static std::vector<FoundGlareSource> Numbered(
      const std::vector<std::pair<FoundGlareSource, int>>& found, int groups,
      std::vector<int>& source_of) {
    std::vector<FoundGlareSource> sources;
    std::vector<int> number(static_cast<std::size_t>(groups) + 1, 0);
    for (const auto& [source, group] : found) {
      sources.push_back(source);
      number[static_cast<std::size_t>(group) + 1] = static_cast<int>(sources.size());
    }
    for (int& source : source_of) source = number[static_cast<std::size_t>(source)];
    return sources;
  }

  View2d<const float> nits_;
  const PixelSolidAngles& angles_;
  const GlareSettings& settings_;
  Nits threshold_;
  bool of_mean_ = false;
  FrontAngles front_;
  Seen seen_;
};

std::vector<GlareSource> SourceList(const PictureGlare& glare) {
  std::vector<GlareSource> sources;
  for (const FoundGlareSource& found : glare.sources) sources.push_back(found.source);
  return sources;
}

struct Indices {
  double dgp = 0.0;
  std::array<std::optional<double>, 3> ratings;  // UGR, DGI, CGI
};

Indices IndicesOf(const GlareLight& light, const std::vector<GlareSource>& sources, bool dim) {
  return {DaylightGlareProbability(light, sources, dim),
          {UnifiedGlareRating(light, sources), DaylightGlareIndex(light, sources),
           CieGlareIndex(light, sources)}};
}

// The variance that independent errors of pixels leave in E_v, E_d and each source's luminance.
struct PixelNoise {
  double vertical = 0.0, indirect = 0.0;
  std::vector<double> luminance;
};

PixelNoise NoiseOf(const PictureGlare& glare, const FrontAngles& front, View2d<const float> sigma) {
  PixelNoise noise;
  noise.luminance.resize(glare.sources.size());
  if (sigma.empty()) return noise;
  for (int y = 0; y < sigma.height(); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * sigma.width();
    for (int x = 0; x < sigma.width(); ++x) {
      const double s = sigma(x, y);
      if (!std::isfinite(s)) continue;
      const double lux = s * front.cosine[row + x];
      noise.vertical += lux * lux;
      const int source = glare.source_of[row + x];
      if (source == 0) {
        noise.indirect += lux * lux;
        continue;
      }
      const auto i = static_cast<std::size_t>(source - 1);
      const double share = s * front.plain[row + x] / glare.sources[i].source.solid_angle.value();
      noise.luminance[i] += share * share;
    }
  }
  return noise;
}

// First order, one part at a time, into the squares of the indices' standard deviations.
std::array<double, 4> VarianceOf(const PictureGlare& glare, const PixelNoise& noise,
                                 const GlareSettings& settings) {
  const bool dim = settings.dim_correction;
  const bool stated = settings.vertical.has_value();
  const std::vector<GlareSource> sources = SourceList(glare);
  const Indices best = IndicesOf(glare.light, sources, dim);
  std::array<double, 4> variance{};
  const auto add = [&](const GlareLight& light, const std::vector<GlareSource>& moved) {
    const Indices other = IndicesOf(light, moved, dim);
    variance[0] += (other.dgp - best.dgp) * (other.dgp - best.dgp);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!best.ratings[i] || !other.ratings[i]) continue;
      const double d = *other.ratings[i] - *best.ratings[i];
      variance[i + 1] += d * d;
    }
  };
  GlareLight brighter = glare.light;
  if (!stated) brighter.vertical = brighter.vertical + Lux(std::sqrt(noise.indirect));
  add(brighter, sources);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    std::vector<GlareSource> moved = sources;
    const double more = std::sqrt(noise.luminance[i]);
    moved[i].luminance = moved[i].luminance + Nits(more);
    GlareLight light = glare.light;
    const Lux lux(glare.sources[i].vertical.value() * more /
                  std::max(sources[i].luminance.value(), 1e-30));
    if (!stated) light.vertical = light.vertical + lux;
    light.direct = light.direct + lux;
    add(light, moved);
  }
  return variance;
}

// The value, all that the scale's interval leads to, and the pixels' noise beside.
Uncertain WithEnds(double value, double low, double high, double variance) {
  const double noise = kZ95 * std::sqrt(variance);
  const double below = std::hypot(value - std::min(low, value), noise);
  const double above = std::hypot(std::max(high, value) - value, noise);
  return {value, (below + above) / 2.0, value - below, value + above};
}

void FillIntervals(const GlareAnalysis& analysis, const GlareSettings& settings,
                   View2d<const float> sigma, PictureGlare& glare) {
  const bool dim = settings.dim_correction;
  const Indices best = IndicesOf(glare.light, SourceList(glare), dim);
  Indices low = best, high = best;
  for (const double part : {-1.0, -0.5, 0.5, 1.0}) {
    const double scale = 1.0 + part * settings.scale_u95;
    if (settings.scale_u95 <= 0.0 || scale <= 0.0) continue;
    const PictureGlare other = analysis.At(scale);
    const Indices found = IndicesOf(other.light, SourceList(other), dim);
    low.dgp = std::min(low.dgp, found.dgp);
    high.dgp = std::max(high.dgp, found.dgp);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!best.ratings[i] || !found.ratings[i]) continue;
      low.ratings[i] = std::min(*low.ratings[i], *found.ratings[i]);
      high.ratings[i] = std::max(*high.ratings[i], *found.ratings[i]);
    }
  }
  const PixelNoise noise = NoiseOf(glare, analysis.front(), sigma);
  const std::array<double, 4> variance = VarianceOf(glare, noise, settings);
  const double ev = glare.light.vertical.value();
  const double u95 = settings.vertical ? 0.0 : settings.scale_u95;
  glare.vertical =
      WithEnds(ev, ev * (1.0 - u95), ev * (1.0 + u95), settings.vertical ? 0.0 : noise.vertical);
  glare.dgp = WithEnds(best.dgp, low.dgp, high.dgp, variance[0]);
  glare.dgp.low = std::max(0.0, *glare.dgp.low);
  glare.dgp.high = std::min(1.0, *glare.dgp.high);
  const std::array<std::optional<Uncertain>*, 3> ratings = {&glare.ugr, &glare.dgi, &glare.cgi};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!best.ratings[i]) continue;
    *ratings[i] = WithEnds(*best.ratings[i], *low.ratings[i], *high.ratings[i], variance[i + 1]);
  }
}

void RateOverMean(GlareAnalysis& analysis, const GlareSettings& settings, View2d<const float> sigma,
                  PictureGlare& glare) {
  if (!glare.sources.empty() || settings.threshold || settings.task) return;
  const Nits threshold(kDefaultOverMean * glare.mean.value());
  analysis.SetThreshold(threshold, true);
  PictureGlare over_mean = analysis.At(1.0);
  FillIntervals(analysis, settings, sigma, over_mean);
  glare.ugr = over_mean.ugr;
  if (glare.ugr) glare.ugr_threshold = threshold;
  if (over_mean.sources.empty()) glare.brightest = Nits(analysis.seen().max);
}

}  // namespace

Result<PictureGlare> MeasureGlare(View2d<const float> nits, const PixelSolidAngles& angles,
                                  const GlareSettings& settings, View2d<const float> sigma) {
  if (auto ok = CheckGlareView(nits, angles, settings.task); !ok) return Propagate(std::move(ok));
  if (!sigma.empty() && (sigma.width() != nits.width() || sigma.height() != nits.height())) {
    return Refused("bad_view", "sigma", "the picture and its sigma differ in size");
  }
  GlareAnalysis analysis(nits, angles, settings);
  const Seen& seen = analysis.seen();
  if (!(seen.vertical > 0.0)) {
    return Refused("no_light", "illuminance", "no light reaches the eye in this picture");
  }
  const double mean = seen.sum / seen.solid_angle;
  std::optional<Nits> task;
  if (settings.task) {
    const Seen part = LightOf(nits, analysis.front(), *settings.task);
    if (!(part.sum > 0.0)) {
      return Refused("bad_region", "glare.task", "the task lies outside the view, or is black");
    }
    task = Nits(part.sum / part.solid_angle);
  }
  double threshold = settings.threshold.value_or(task ? kDefaultOverMean : kDefaultThreshold);
  const bool of_mean = threshold <= kLeastLuminance;
  if (of_mean) threshold *= task ? task->value() : mean;
  analysis.SetThreshold(Nits(threshold), of_mean);
  PictureGlare glare = analysis.At(1.0);
  if (settings.vertical && !(*settings.vertical > glare.light.direct)) {
    return Refused("bad_vertical", "glare.vertical",
                   "the glare sources alone make " + RoundedText(glare.light.direct.value(), 4) +
                       " lx at the eye, more than the " +
                       RoundedText(settings.vertical->value(), 4) +
                       " lx of {glare.vertical}: picture and meter saw different light, or the "
                       "picture's scale is wrong");
  }
  glare.threshold = Nits(threshold);
  glare.mean = Nits(mean);
  glare.task = task;
  glare.background = glare.light.background();
  FillIntervals(analysis, settings, sigma, glare);
  RateOverMean(analysis, settings, sigma, glare);
  return glare;
}

}  // namespace lightcal
