// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/model/data_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "lightcal/core/normal_mixture.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/beam/beam_rows.h"
#include "lightcal/fit/beam/stated_beam.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/light/beam_ensemble.h"
#include "lightcal/photometry/source_photometry.h"

namespace lightcal::fit {
namespace {

// Half widths of the 95 % interval of I/(Phi/Omega) where only the kind is known.
constexpr double kPointSpread = 0.30;
constexpr double kKindSpread = 0.15;

// Both ends come from the same printed flux, whose own tolerance widens them.
Uncertain FromInterval(double low, double high) {
  const double shape_sd = std::log(high / low) / (2.0 * kZ95);
  const double flux_sd = std::log1p(kFluxToleranceRelative) / kZ95;
  return UncertainFromLog(0.5 * std::log(low * high), std::hypot(shape_sd, flux_sd));
}

bool IsFlat(LightKind kind) { return kind == LightKind::kDisk || kind == LightKind::kRect; }

// Phi/I of the kind's own distribution, independent of its size.
double SolidAngleOfKind(const LightDescription& light) {
  constexpr double kPi = std::numbers::pi;
  if (light.distribution) {
    return light.distribution->Flux().value() / light.distribution->peak().intensity.value();
  }
  if (light.kind == LightKind::kSpot && light.outer) {
    return SolidAngleOfSpot({light.inner.value_or(Radians(0.0)), *light.outer},
                            SpotFalloff::kSquaredLinear)
        .value();
  }
  if (IsFlat(light.kind)) return kPi;
  if (light.kind == LightKind::kTube) return kPi * kPi;
  return 4.0 * kPi;
}

// A face shines by cos^n: at 120 degrees that is Lambert's law, as sure as of a face whose beam
// nobody states; as unsure as any beam where the angle halves its solid angle or doubles it.
Uncertain FlatByBeam(double flux, Radians beam, const BeamSolidAngles& beams) {
  const double n = std::log(0.5) / std::log(std::cos(0.5 * beam.value()));
  const double omega = 2.0 * std::numbers::pi / (n + 1.0);
  const double unlike = std::min(1.0, std::abs(std::log2(omega / std::numbers::pi)));
  const double any = 0.5 * std::log(beams.most.value() / beams.least.value());
  const double spread = std::max(std::log1p(kKindSpread), unlike * any);
  return FromInterval(flux / omega * std::exp(-spread), flux / omega * std::exp(spread));
}

// 1 sigma by which printed angles that are a tenth off move ln of such beams' solid angle: narrow
// ones go as the angle squared.
double SdByStatedAngle(const LightDescription& light) {
  const auto ln_middle = [&](double part) -> std::optional<double> {
    LightDescription off = light;
    off.beam = *light.beam * part;
    if (light.field) off.field = *light.field * part;
    const auto beams = BeamsOf(off);
    if (!beams) return std::nullopt;
    return 0.5 * std::log(beams->least.value() * beams->most.value());
  };
  const auto middle = ln_middle(1.0), narrow = ln_middle(1.0 / (1.0 + kSheetAngle));
  if (!middle || !narrow) return 0.0;
  const auto wide = ln_middle(1.0 + kSheetAngle);
  return wide ? 0.5 * (*wide - *narrow) : *middle - *narrow;
}

}  // namespace

FluxSpread FluxSpreadOf(const LightDescription& light) {
  constexpr FluxSpread kBulb = {0.71, 1.01};
  constexpr FluxSpread kFlat = {0.2, 1.0};
  constexpr FluxSpread kAny = {0.0089, 1.0};
  if (light.kind == LightKind::kSphere) return {1.0, 1.0};
  if (const auto beams = BeamsOf(light)) {
    const double of_shape = 0.5 * std::log(beams->most.value() / beams->least.value());
    const double ends = std::exp(std::hypot(of_shape, kZ95 * SdByStatedAngle(light)));
    return {1.0 / ends, ends};
  }
  if (light.kind != LightKind::kPoint) return {1.0 / (1.0 + kKindSpread), 1.0 + kKindSpread};
  if (!light.fixture) return kAny;
  switch (*light.fixture) {
    case Fixture::kBulb:
      return kBulb;
    case Fixture::kPanel:
    case Fixture::kSoftbox:
    case Fixture::kCobBare:
      return kFlat;
    default:
      return kAny;
  }
}

bool HasDataSheet(const LightDescription& light) {
  return light.flux && light.flux->value() > 0.0 && light.kind != LightKind::kDirectional &&
         light.kind != LightKind::kDome;
}

Result<Uncertain> IntensityFromDataSheet(const LightDescription& light) {
  if (!HasDataSheet(light)) {
    return Refused("no_readings", light.name, "neither readings nor flux_lm are given");
  }
  const double flux = light.flux->value();
  if (light.beam) {
    auto beams = BeamEnsemble(*light.beam, light.field);
    if (!beams) return Propagate(std::move(beams));
    if (IsFlat(light.kind) && !light.field) return FlatByBeam(flux, *light.beam, *beams);
    return FromInterval(flux / beams->most.value(), flux / beams->least.value());
  }
  if (light.kind == LightKind::kSpot && !light.outer && !light.distribution) {
    return Refused("no_readings", light.name,
                   "flux_lm says nothing of a spot's middle while its beam is unknown: give "
                   "{light.beam}, or a reading");
  }
  if (light.kind == LightKind::kSpot && light.outer && !light.inner && !light.distribution) {
    LightDescription hard = light;
    hard.inner = light.outer;
    return FromInterval(flux / SolidAngleOfKind(hard), flux / SolidAngleOfKind(light));
  }
  if (light.kind == LightKind::kPoint && light.fixture == Fixture::kBulb) {
    const FluxSpread spread = FluxSpreadOf(light);
    const double even = flux / SolidAngleOfKind(light);
    return FromInterval(even / spread.high, even / spread.low);
  }
  const double kind_spread = light.kind == LightKind::kPoint ? kPointSpread : kKindSpread;
  const double spread = light.distribution ? 0.0 : std::log1p(kind_spread);
  const double middle = flux / SolidAngleOfKind(light);
  return FromInterval(middle * std::exp(-spread), middle * std::exp(spread));
}

Result<void> FillFromDataSheet(const LightDescription& light, FittedLight& out) {
  auto intensity = IntensityFromDataSheet(light);
  if (!intensity) return tl::unexpected(std::move(intensity).error());
  out.intensity_cd = *intensity;
  out.fit.prior = {"intensity", "distance_offset", "ambient"};
  return {};
}

Uncertain FluxBeside(const Uncertain& by_readings, Lumens printed, double held) {
  const double low = std::log(*by_readings.low), high = std::log(*by_readings.high);
  const NormalPart read = {1.0 - held, 0.5 * (low + high), (high - low) / (2.0 * kZ95)};
  const double sd = std::log1p(kFluxToleranceRelative) / kZ95;
  const double share = read.sd * read.sd / (read.sd * read.sd + sd * sd);  // of the printed one
  const NormalPart both = {held, share * std::log(printed.value()) + (1.0 - share) * read.mean,
                           std::sqrt(share) * sd};
  return UncertainFromLogMixture(std::array{both, read});
}

bool Agrees(const SheetIntensity& sheet, double ln_cd, double sd) {
  constexpr double kConflict = 2.0;  // standard deviations of both
  return std::abs(ln_cd - sheet.ln_cd) <= kConflict * std::hypot(sd, sheet.sd);
}

void CheckDataSheet(const LightDescription& light, const std::optional<Uncertain>& measured,
                    Warnings& warnings) {
  if (!HasDataSheet(light) || !measured) return;
  const auto sheet = IntensityFromDataSheet(light);
  if (!sheet) return;
  const double low = LowEnd(*measured);
  const double high = HighEnd(*measured);
  if (high >= *sheet->low && low <= *sheet->high) return;
  warnings.push_back({"data_sheet_disagrees", light.name,
                      "measured " + RoundedText(measured->value, 4) + " cd, but its data sheet (" +
                          RoundedText(light.flux->value(), 4) + " lm) gives " +
                          RoundedText(*sheet->low, 3) + " to " + RoundedText(*sheet->high, 3) +
                          " cd; check distance, beam_deg and whether the lamp is dimmed"});
}

void CheckPrintedFlux(const LightDescription& light, const Uncertain& read, Warnings& warnings) {
  if (!HasDataSheet(light)) return;
  const double printed = light.flux->value();
  const double low = LowEnd(read);
  const double high = HighEnd(read);
  const double least = printed / (1.0 + kFluxToleranceRelative);
  const double most = printed * (1.0 + kFluxToleranceRelative);
  if (high >= least && low <= most) return;
  warnings.push_back({"data_sheet_disagrees", light.name,
                      "the readings give " + RoundedText(low, 3) + " to " + RoundedText(high, 3) +
                          " lm, its data sheet prints " + RoundedText(printed, 4) +
                          "; check distances and angles, and whether the lamp is dimmed"});
}

std::optional<SheetIntensity> SheetBeside(const Session& session, const Observations& observations,
                                          const LightDescription& light) {
  const auto own = [](const Observation& row) { return row.lit && !row.data_sheet; };
  const auto set = [&](const SessionReading& row) {
    return row.reading.light == light.name && !row.reading.state.empty();
  };
  if (!HasDataSheet(light) || std::ranges::none_of(observations.rows, own)) return std::nullopt;
  if (std::ranges::any_of(session.readings, set)) return std::nullopt;
  const auto sheet = IntensityFromDataSheet(light);
  if (!sheet) return std::nullopt;
  const double low = std::log(*sheet->low), high = std::log(*sheet->high);
  const double sd = (high - low) / (2.0 * kZ95);
  // A file is of one specimen at its rated current: others differ by driver, age, lamp and filter.
  // Where the kind's pattern is unknown its spread is the larger.
  constexpr double kFarOff = 2.5;
  return SheetIntensity{0.5 * (low + high), sd, light.distribution ? kFarOff * sd : 0.0};
}

std::optional<Uncertain> ByReadings(const LightEstimate& estimate, const FittedLight& out) {
  if (!estimate.ln_by_readings) return out.intensity_cd;
  const auto [low, high] = *estimate.ln_by_readings;
  return UncertainFromLog(0.5 * (low + high), (high - low) / (2.0 * kZ95));
}

void TellFlux(const LightEstimate& estimate, const LightDescription& light, FittedLight& out) {
  if (!(estimate.sheet_held > 0.0) || !out.flux_lm) return;
  Uncertain by_readings = *out.flux_lm;
  if (estimate.ln_by_readings) {
    FittedLight read;
    read.intensity_cd = ByReadings(estimate, out);
    AddDerivedQuantities(light, read);
    by_readings = *read.flux_lm;
  }
  out.flux_lm = FluxBeside(by_readings, *light.flux, estimate.sheet_held);
}

}  // namespace lightcal::fit
