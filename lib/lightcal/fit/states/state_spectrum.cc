// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/states/state_spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/fit/states/emitters.h"
#include "lightcal/fit/states/ln_of.h"

namespace lightcal::fit {
namespace {

// Of what is wanted of amounts, against the wanted colour.
constexpr double kNearWeight = 1e-3;
// Below 0 by so much of the peak is noise of the emitters.
constexpr double kNoiseOfPeak = 0.005;
// Of a plane's slopes, against what a state one range away says.
constexpr double kSlopeRidge = 1e-4;

Xyz XyzOfIrradiance(const std::vector<double>& nm, std::vector<double> values) {
  const auto xyz = XyzFromSpectrum({nm, std::move(values), SpectralQuantity::kIrradiance});
  return xyz ? *xyz : Xyz{};
}

struct AmountsThere {
  std::vector<double> value, sd;
};

// The plane through the amounts of the states around, at the state asked for.
AmountsThere PlaneThrough(const std::vector<MixtureNear>& around, std::size_t emitters) {
  AmountsThere out{std::vector<double>(emitters, 0.0), std::vector<double>(emitters, 0.0)};
  const auto n = static_cast<Eigen::Index>(around.size());
  const auto controls = static_cast<Eigen::Index>(around.front().offset.size());
  Eigen::MatrixXd plane(n, controls + 1);
  Eigen::VectorXd weights(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<double>& offset = around[static_cast<std::size_t>(i)].offset;
    double square = 0.0;
    plane(i, 0) = 1.0;
    for (Eigen::Index c = 0; c < controls; ++c) {
      plane(i, c + 1) = offset[static_cast<std::size_t>(c)];
      square += plane(i, c + 1) * plane(i, c + 1);
    }
    weights[i] = 1.0 / ((square + 1e-4) * (square + 1e-4));
  }
  weights /= weights.sum();
  Eigen::MatrixXd normal = plane.transpose() * weights.asDiagonal() * plane;
  for (Eigen::Index c = 1; c <= controls; ++c) normal(c, c) += kSlopeRidge;
  const auto solver = normal.ldlt();
  for (std::size_t k = 0; k < emitters; ++k) {
    Eigen::VectorXd amounts(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      amounts[i] = around[static_cast<std::size_t>(i)].amounts[k];
    }
    const Eigen::VectorXd found = solver.solve(plane.transpose() * weights.asDiagonal() * amounts);
    const Eigen::VectorXd left = amounts - plane * found;
    out.value[k] = std::max(0.0, found[0]);
    out.sd[k] = std::sqrt(left.cwiseAbs2().dot(weights));
  }
  return out;
}

// Amounts of 1 lx towards a chromaticity, or those wanted alone.
class Mixer {
 public:
  explicit Mixer(const FixtureEmitters& emitters) : emitters_(emitters) {
    for (const FixtureEmitter& one : emitters.found) {
      each_.push_back(XyzOfIrradiance(emitters.wavelengths_nm, one.values));
    }
  }

  [[nodiscard]] std::vector<double> Towards(const std::optional<Xy>& wanted,
                                            const std::vector<double>& near) const {
    if (!wanted || !(wanted->y > 0.0)) return near;
    const std::size_t n = each_.size();
    const Xyz xyz{wanted->x / wanted->y, 1.0, (1.0 - wanted->x - wanted->y) / wanted->y};
    std::vector<double> gram;
    std::vector<double> product;
    for (std::size_t k = 0; k < n; ++k) {
      const Xyz& a = each_[k];
      const double own = kNearWeight * kNearWeight * (a.X * a.X + a.Y * a.Y + a.Z * a.Z);
      for (std::size_t j = 0; j < n; ++j) {
        const Xyz& b = each_[j];
        gram.push_back(a.X * b.X + a.Y * b.Y + a.Z * b.Z + (j == k ? own : 0.0));
      }
      product.push_back(a.X * xyz.X + a.Y * xyz.Y + a.Z * xyz.Z + own * near[k]);
    }
    const auto count = static_cast<Eigen::Index>(n);
    const Eigen::Map<const Eigen::MatrixXd> g(gram.data(), count, count);
    const Eigen::VectorXd any =
        g.ldlt().solve(Eigen::Map<const Eigen::VectorXd>(product.data(), count));
    const std::vector<double> amounts(any.data(), any.data() + count);
    return NowhereNegative(amounts) ? amounts : NonNegativeLeastSquares(gram, product);
  }

  // Of 1 lx; nothing of a mixture without light.
  [[nodiscard]] std::optional<Spectrum> Of(const std::vector<double>& amounts) const {
    Spectrum out{emitters_.wavelengths_nm, {}, SpectralQuantity::kIrradiance};
    out.values.assign(out.wavelengths_nm.size(), 0.0);
    double lux = 0.0;
    for (std::size_t k = 0; k < amounts.size(); ++k) {
      lux += amounts[k] * each_[k].Y;
      for (std::size_t i = 0; i < out.values.size(); ++i) {
        out.values[i] += amounts[k] * emitters_.found[k].values[i];
      }
    }
    if (!(lux > 0.0)) return std::nullopt;
    for (double& value : out.values) value = std::max(0.0, value / lux);
    return out;
  }

 private:
  // Within what the emitters themselves are sure of.
  [[nodiscard]] bool NowhereNegative(const std::vector<double>& amounts) const {
    double least = 0.0;
    double peak = 0.0;
    for (std::size_t i = 0; i < emitters_.wavelengths_nm.size(); ++i) {
      double value = 0.0;
      for (std::size_t k = 0; k < amounts.size(); ++k) {
        value += amounts[k] * emitters_.found[k].values[i];
      }
      least = std::min(least, value);
      peak = std::max(peak, value);
    }
    return least >= -kNoiseOfPeak * peak;
  }

  const FixtureEmitters& emitters_;
  std::vector<Xyz> each_;
};

// Chromaticities one standard deviation of CCT and of Duv away.
std::vector<Xy> ColorsBeside(const FittedColor& color) {
  std::vector<Xy> out;
  if (!color.cct_K || !color.duv) return out;
  const double factor = std::exp(SdOfLn(*color.cct_K));
  out.push_back(XyFromCct(Kelvin(color.cct_K->value * factor), color.duv->value));
  out.push_back(XyFromCct(Kelvin(color.cct_K->value), color.duv->value + color.duv->u95 / kZ95));
  return out;
}

// As sure as it was.
void TakeColor(Xy made, FittedColor& color) {
  color.xy = made;
  const CctResult found = CctFromXy(made);
  if (!found.valid()) {
    color.cct_K.reset();
    color.duv.reset();
  } else if (color.cct_K && color.duv) {
    const double sd = SdOfLn(*color.cct_K);
    color.cct_K = UncertainFromLog(std::log(found.temperature.value()), sd);
    color.duv = UncertainFromNormal(found.duv, color.duv->u95 / kZ95);
  }
}

// A spectrum of 1 lx, for as many as the answer has, and as unsure as that is.
StateSpectrum SpectrumFor(const StateAnswer& answer, Spectrum of_one, std::vector<double> u95,
                          const FixtureEmitters* emitters, const std::vector<double>& amounts) {
  const auto& light = answer.intensity_cd ? answer.intensity_cd : answer.illuminance_lx;
  const Uncertain& level = light ? *light : answer.relative;
  const double lux = level.value;
  StateSpectrum out{std::move(of_one), std::move(u95), {}};
  for (double& value : out.spectrum.values) value *= lux;
  for (std::size_t i = 0; i < out.u95.size(); ++i) {
    out.u95[i] = std::hypot(out.u95[i] * lux, level.u95 / lux * out.spectrum.values[i]);
  }
  if (emitters == nullptr) return out;
  double sum = 0.0;
  for (std::size_t k = 0; k < amounts.size(); ++k) {
    const auto xyz = XyzFromSpectrum(
        {emitters->wavelengths_nm, emitters->found[k].values, SpectralQuantity::kIrradiance});
    out.shares.push_back(xyz ? std::max(0.0, amounts[k] * xyz->Y) : 0.0);
    sum += out.shares.back();
  }
  for (double& share : out.shares) share /= sum > 0.0 ? sum : 1.0;
  return out;
}

}  // namespace

Xy OnLineOf(Xy a, Xy b, Xy wanted) {
  const double square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  if (!(square > 0.0)) return wanted;
  const double t = ((wanted.x - a.x) * (b.x - a.x) + (wanted.y - a.y) * (b.y - a.y)) / square;
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

Spectrum SpectrumOfLux(Spectrum spectrum, double lux) {
  spectrum.quantity = SpectralQuantity::kIrradiance;
  const double shines = XyzOfIrradiance(spectrum.wavelengths_nm, spectrum.values).Y;
  for (double& value : spectrum.values) value *= shines > 0.0 ? lux / shines : 0.0;
  return spectrum;
}

std::optional<MixedSpectrum> MixEmitters(const FixtureEmitters& emitters, const FittedColor& color,
                                         const std::vector<MixtureNear>& around) {
  if (around.empty()) return std::nullopt;
  const AmountsThere near = PlaneThrough(around, emitters.found.size());
  const Mixer mixer(emitters);
  MixedSpectrum out;
  out.amounts = mixer.Towards(color.xy, near.value);
  const auto spectrum = mixer.Of(out.amounts);
  if (!spectrum) return std::nullopt;
  out.spectrum = *spectrum;
  double square = 0.0;
  for (const double value : spectrum->values) square += value * value;
  const double left =
      emitters.residual * emitters.residual * square / static_cast<double>(spectrum->values.size());
  std::vector<double> variance(spectrum->values.size(), left);
  const auto add = [&](const std::vector<double>& amounts) {
    const auto beside = mixer.Of(amounts);
    if (!beside) return;
    for (std::size_t i = 0; i < variance.size(); ++i) {
      const double moved = beside->values[i] - spectrum->values[i];
      variance[i] += moved * moved;
    }
  };
  if (color.xy) {
    for (const Xy& beside : ColorsBeside(color)) add(mixer.Towards(beside, near.value));
  }
  for (std::size_t k = 0; k < near.value.size(); ++k) {
    std::vector<double> moved = near.value;
    moved[k] += near.sd[k];
    add(mixer.Towards(color.xy, moved));
  }
  for (const double v : variance) out.u95.push_back(kZ95 * std::sqrt(v));
  return out;
}

void AddSpectrumRead(const FittedLight& light, const MeasuredState& read, StateAnswer& answer) {
  if (!read.spectrum) return;
  const bool told = light.emitters && !read.emitter_amounts.empty();
  Spectrum of_one = SpectrumOfLux(*read.spectrum, 1.0);
  std::vector<double> u95;
  if (told) {
    double square = 0.0;
    for (const double value : of_one.values) square += value * value;
    const double rms = std::sqrt(square / static_cast<double>(of_one.values.size()));
    u95.assign(of_one.values.size(), kZ95 * light.emitters->residual * rms);
  }
  answer.spectrum = SpectrumFor(answer, std::move(of_one), std::move(u95),
                                told ? &*light.emitters : nullptr, read.emitter_amounts);
}

void AddSpectrumBetween(const FittedLight& light, const std::vector<MixtureNear>& around,
                        StateAnswer& answer) {
  // A chromaticity this far off is still what the emitters make: readings stray as much.
  constexpr double kStrays = 0.002;
  if (!light.emitters) return;
  FittedColor& color = answer.color;
  const std::vector<FixtureEmitter>& found = light.emitters->found;
  if (color.xy && found.size() == 2 && found[0].xy && found[1].xy) {
    const Xy made = OnLineOf(*found[0].xy, *found[1].xy, *color.xy);
    if (std::hypot(color.xy->x - made.x, color.xy->y - made.y) > kStrays) TakeColor(made, color);
  }
  auto mixed = MixEmitters(*light.emitters, color, around);
  if (!mixed) return;
  if (!color.xy) {
    const Spectrum& made = mixed->spectrum;
    TakeColor(XyFromXyz(XyzOfIrradiance(made.wavelengths_nm, made.values)), color);
  }
  answer.spectrum = SpectrumFor(answer, std::move(mixed->spectrum), std::move(mixed->u95),
                                &*light.emitters, mixed->amounts);
}

}  // namespace lightcal::fit

namespace lightcal {

Result<StateSpectrum> SpectrumOf(const FittedLight& light, const StateAnswer& answer) {
  if (answer.spectrum) return *answer.spectrum;
  const auto read = std::ranges::count_if(
      light.states, [](const MeasuredState& one) { return one.spectrum.has_value(); });
  if (read == 0) {
    return Refused("no_spectra", light.name,
                   "was read at its states without spectra; give their readings spectrum = "
                   "\"file\", and fit again");
  }
  if (light.emitters) {
    return Refused("state_spectrum", light.name,
                   "no state with the words of " + StateText(answer.state) +
                       " has a spectrum; what its front does to the emitters is not known: read " +
                       "one there");
  }
  return Refused("spectra_too_few", light.name,
                 "has spectra of " + std::to_string(read) + (read == 1 ? " state" : " states") +
                     ", too few to show which emitters it mixes; read the spectrum at " +
                     StateText(answer.state) + ", or at more states between");
}

}  // namespace lightcal
