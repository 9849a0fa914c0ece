// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/spectral_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cie_tables/tables.h"
#include "lightcal/colorimetry/continuous_light.h"
#include "lightcal/colorimetry/resample.h"

namespace lightcal {
namespace {

constexpr double kWidening = 1.6;
// The step of the truth: what it resolves, a spectrum of this step resolves too. A little above 1,
// as wavelengths are rounded.
constexpr double kResolvedStepNm = 1.05;
// Roughness of light without lines, and of CIE's lamps with them:
//   2 nm 0.0017 and 0.016, 3 nm 0.0043 and 0.024, 4 nm 0.011 and 0.042, 5 nm 0.022 and 0.056;
//   CIE daylight in 10 nm steps 0.030.
constexpr double kRoughestSmoothPerNm = 0.006;
constexpr double kRoughestSmooth = 0.032;
constexpr double kEdgeWindowNm = 15.0;
constexpr double kEdgeFactor = 1.5;
constexpr double kMostGrowth = 5.0;

// Changes of mireds, Duv and relative illuminance.
constexpr std::size_t kAnswers = 3;
using Changes = std::array<double, kAnswers>;

// To first order, what power at one wavelength does to each answer.
class Response {
 public:
  // xyz: unnormalised sums.
  explicit Response(const Xyz& xyz) {
    const Xy xy = XyFromXyz(xyz);
    const double sum = xyz.X + xyz.Y + xyz.Z;
    rows_[2] = {0.0, 1.0 / xyz.Y, 0.0};
    const auto j = CctFromXy(xy).valid() ? CctJacobianAt(xy) : std::nullopt;
    has_cct_ = j.has_value();
    if (!j) return;
    const auto row = [&](double by_x, double by_y) {
      const double common = by_x * xy.x + by_y * xy.y;
      return Row{(by_x - common) / sum, (by_y - common) / sum, -common / sum};
    };
    rows_[0] = row(j->dmired_dx, j->dmired_dy);
    rows_[1] = row(j->dduv_dx, j->dduv_dy);
  }
  [[nodiscard]] bool has_cct() const { return has_cct_; }
  [[nodiscard]] Changes At(double nm) const {
    const Xyz c = ColorMatchingAt(Nanometres(nm));
    Changes out{};
    for (std::size_t k = 0; k < kAnswers; ++k) {
      out[k] = rows_[k][0] * c.X + rows_[k][1] * c.Y + rows_[k][2] * c.Z;
    }
    return out;
  }

 private:
  using Row = std::array<double, 3>;
  std::array<Row, kAnswers> rows_{};
  bool has_cct_ = false;
};

struct Samples {
  const std::vector<double>& l;
  const std::vector<double>& s;
  std::vector<double> edges;

  [[nodiscard]] std::size_t size() const { return s.size(); }
  // The end samples go on outside.
  [[nodiscard]] double Value(std::size_t i, int offset) const {
    const auto at = static_cast<std::ptrdiff_t>(i) + offset;
    return s[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(s.size()) - 1))];
  }
  [[nodiscard]] double Width(std::size_t i) const { return edges[i + 1] - edges[i]; }
  // What a cubic through the four neighbours does not foretell of a sample.
  [[nodiscard]] double Unforetold(std::size_t i) const {
    const double foretold = (4.0 * (Value(i, -1) + Value(i, 1)) - Value(i, -2) - Value(i, 2)) / 6.0;
    return std::abs(Value(i, 0) - foretold);
  }
};

double Roughness(const Samples& samples) {
  double rough = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Xyz c = ColorMatchingAt(Nanometres(samples.l[i]));
    const double weight = (c.X + c.Y + c.Z) * samples.Width(i);
    rough += weight * samples.Unforetold(i);
    all += weight * std::abs(samples.s[i]);
  }
  return rough / all;
}

bool MayHideLines(const Spectrum& spectrum, double step_nm, double roughness) {
  if (step_nm <= kResolvedStepNm) return false;
  if (roughness > std::min(kRoughestSmoothPerNm * step_nm, kRoughestSmooth)) return true;
  return !IsContinuousLight(spectrum);
}

// Sums over one sample's bin.
struct BinChanges {
  Changes line{}, parabola{}, anywhere{};
};

BinChanges ChangesInBin(const Samples& samples, std::size_t i, const Response& response) {
  constexpr double kPieceNm = 0.5;
  const double width = samples.Width(i);
  const int pieces = std::max(4, static_cast<int>(std::ceil(width / kPieceNm)));
  const double piece = width / pieces;
  const double here = samples.Value(i, 0);
  const double left = samples.Value(i, -1);
  const double right = samples.Value(i, 1);
  const double slope = (right - left) / (2.0 * width);
  const double bend = (right - 2.0 * here + left) / (2.0 * width * width);
  const double loose = std::min(std::max(here, 0.0), samples.Unforetold(i)) * width;
  const Changes centre = response.At(samples.l[i]);
  BinChanges out;
  for (int j = 0; j < pieces; ++j) {
    const double nm = samples.edges[i] + (j + 0.5) * piece;
    const double off = nm - samples.l[i];
    const double line = here + (off < 0.0 ? here - left : right - here) * off / width;
    const double parabola = here + slope * off + bend * (off * off - width * width / 12.0);
    const Changes at = response.At(nm);
    for (std::size_t k = 0; k < kAnswers; ++k) {
      out.line[k] += (line * at[k] - here * centre[k]) * piece;
      out.parabola[k] += (parabola * at[k] - here * centre[k]) * piece;
      out.anywhere[k] = std::max(out.anywhere[k], loose * std::abs(at[k] - centre[k]));
    }
  }
  return out;
}

Changes StepBound(const Samples& samples, const Response& response) {
  BinChanges sum;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const BinChanges bin = ChangesInBin(samples, i, response);
    for (std::size_t k = 0; k < kAnswers; ++k) {
      sum.line[k] += bin.line[k];
      sum.parabola[k] += bin.parabola[k];
      sum.anywhere[k] += bin.anywhere[k];
    }
  }
  Changes bound{};
  for (std::size_t k = 0; k < kAnswers; ++k) {
    bound[k] = std::max(std::abs(sum.line[k]), std::abs(sum.parabola[k])) + sum.anywhere[k];
  }
  return bound;
}

// The greatest sample between two wavelengths, at least 0.
double Greatest(const Samples& samples, double from, double to) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.edges[i + 1] > from && samples.edges[i] < to) {
      greatest = std::max(greatest, samples.s[i]);
    }
  }
  return greatest;
}

// The most that light beyond one end may add; direction -1 is the blue end.
Changes LightBeyond(const Samples& samples, const Response& response, int direction) {
  const double edge = direction < 0 ? samples.edges.front() : samples.edges.back();
  const auto inside = [&](double near, double far) {
    const double a = edge - direction * near;
    const double b = edge - direction * far;
    return Greatest(samples, std::min(a, b), std::max(a, b));
  };
  const double level = inside(0.0, kEdgeWindowNm);
  Changes out{};
  for (int nm = kCmfFirstNm; nm <= kCmfLastNm; ++nm) {
    const double distance = direction * (nm - edge);
    if (distance <= 0.0) continue;
    const double mirrored = inside(distance, distance + kEdgeWindowNm);
    const double growth =
        mirrored * kMostGrowth > level ? std::max(1.0, level / mirrored) : kMostGrowth;
    const Changes at = response.At(nm);
    for (std::size_t k = 0; k < kAnswers; ++k) out[k] += kEdgeFactor * level * growth * at[k];
  }
  return out;
}

Changes RangeBound(const Samples& samples, const Response& response) {
  const Changes blue = LightBeyond(samples, response, -1);
  const Changes red = LightBeyond(samples, response, 1);
  Changes bound{};
  for (std::size_t k = 0; k < kAnswers; ++k) {
    bound[k] = std::max(std::max(blue[k], 0.0) + std::max(red[k], 0.0),
                        -std::min(blue[k], 0.0) - std::min(red[k], 0.0));
  }
  return bound;
}

SpectralErrorBound BoundOf(const Samples& samples, const Response& response, Kelvin temperature) {
  const Changes step = StepBound(samples, response);
  const Changes range = RangeBound(samples, response);
  SpectralErrorBound bound;
  bound.illuminance_relative = kWidening * (step[2] + range[2]);
  if (!response.has_cct()) return bound;
  const double mireds = 1e6 / temperature.value();
  const double off = kWidening * (step[0] + range[0]);
  if (off >= mireds) return bound;
  bound.temperature = Kelvin(1e6 / (mireds - off)) - temperature;  // the wider side
  bound.duv = kWidening * (step[1] + range[1]);
  return bound;
}

}  // namespace

Result<SpectralError> SpectralErrorOf(const Spectrum& spectrum, Sampling sampling) {
  Spectrum unscaled = spectrum;
  unscaled.quantity = SpectralQuantity::kIrradiance;
  auto xyz = XyzFromSpectrum(unscaled);
  if (!xyz) return Propagate(std::move(xyz));
  for (double* each : {&xyz->X, &xyz->Y, &xyz->Z}) *each /= kMaximumLuminousEfficacy;
  const Samples samples = {spectrum.wavelengths_nm, spectrum.values, BinEdgesNm(spectrum)};
  SpectralError error;
  error.first = Nanometres(samples.l.front());
  error.last = Nanometres(samples.l.back());
  for (std::size_t i = 1; i < samples.size(); ++i) {
    error.step = Nanometres(std::max(error.step.value(), samples.l[i] - samples.l[i - 1]));
  }
  error.roughness = Roughness(samples);
  error.undersampled = sampling != Sampling::kBandAverage &&
                       MayHideLines(spectrum, error.step.value(), error.roughness);
  if (error.undersampled) return error;
  error.bound = BoundOf(samples, Response(*xyz), CctFromXy(XyFromXyz(*xyz)).temperature);
  return error;
}

}  // namespace lightcal
