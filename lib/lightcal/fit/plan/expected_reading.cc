// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/plan/expected_reading.h"

#include <algorithm>
#include <cmath>

#include "lightcal/fit/fit_light.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/plan/reading_candidates.h"
#include "lightcal/fit/predicted_parts.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal::fit {
namespace {

// Before anything is read: what its box says, or a film lamp's.
double NominalCandela(const LightDescription& light) {
  constexpr double kAny = 1000.0;
  if (!HasDataSheet(light)) return kAny;
  const auto sheet = IntensityFromDataSheet(light);
  return sheet ? sheet->value : kAny;
}

double AmbientOf(const FittedLight* now) {
  return now != nullptr && now->ambient_lx ? std::max(0.0, now->ambient_lx->value) : 0.0;
}

double LuxPerCandelaAt(LightDescription light, const FittedLight* now,
                       const PlannedReading& planned) {
  if (now != nullptr && now->position_m) light.position_m = now->position_m;
  if (now != nullptr && now->aim) light.aim = now->aim;
  if (now != nullptr && now->outer_deg) {
    light.outer = RadiansFromDegrees(*now->outer_deg);
    light.inner = RadiansFromDegrees(now->inner_deg.value_or(0.0));
  }
  if (!light.position_m) return -1.0;
  const Vec3 from = *planned.position_m - *light.position_m;
  const double distance = Length(from);
  if (!(distance > 0.0)) return -1.0;
  const Vec3 normal = planned.normal.value_or(from * (-1.0 / distance));
  if (const auto source = PlacedSourceOf(light)) {
    const OffAxisPose pose{source->model, {source->frame.Of(from), source->frame.Of(normal)}};
    return LuxPerCandela(pose, 0.0);
  }
  return -Dot(from, normal) / (distance * distance * distance);
}

// Of what the fit predicts for a lit reading, what is neither the lamp's own nor ambient; 0 where
// that is what two roundings leave, none where the fit left the reading out.
std::optional<double> WallsAt(const LightDescription& light, const FittedLight* now, int index,
                              const PlannedReading& planned) {
  constexpr double kRounding = 1e-9;
  if (now == nullptr || !now->intensity_cd) return std::nullopt;
  double own = -1.0;
  if (planned.distance) {
    const auto predicted = PredictIlluminance(*now, *planned.distance, 0.05);
    if (predicted) own = predicted->model_lx.value;
  } else if (planned.position_m) {
    const double per_candela = LuxPerCandelaAt(light, now, planned);
    if (per_candela > 0.0) own = now->intensity_cd->value * per_candela + AmbientOf(now);
  }
  for (const ResidualRow& row : now->residuals) {
    if (own >= 0.0 && row.index == index) {
      const double other = row.predicted_lx - own;
      return other > kRounding * row.predicted_lx ? other : 0.0;
    }
  }
  return std::nullopt;
}

// A shadow card leaves what the fit did not give to the lamp; a hundredth where it says nothing. A
// reading with other lamps lit, which the fit may have left out, is asked where no other stands.
double BehindCard(const Session& session, const FittedLight* now, const PlannedReading& planned) {
  constexpr double kShare = 0.01;
  int index = -1;
  double least = 0.0;  // of this lamp's own readings there
  for (const SessionReading& row : session.readings) {
    ++index;
    if (!IsLit(row.reading) || row.reading.distance != planned.distance ||
        row.reading.position_m != planned.position_m) {
      continue;
    }
    const auto other = WallsAt(session.lights.front(), now, index, planned);
    if (other && (*other > 0.0 || AmbientOf(now) > 0.0)) return *other;
    const double lux = row.reading.illuminance->value();
    if (row.others_lit.empty() || least == 0.0) least = kShare * lux;
  }
  return least;
}

}  // namespace

Lux ExpectedIlluminance(const Session& session, const FittedLight* now,
                        const PlannedReading& planned) {
  const double ambient = AmbientOf(now);
  if (planned.action == PlannedAction::kLampOff) return Lux(ambient);
  if (planned.action == PlannedAction::kShadowCard) {
    return Lux(ambient + BehindCard(session, now, planned));
  }
  const bool has_intensity = now != nullptr && now->intensity_cd;
  const double candela =
      has_intensity ? now->intensity_cd->value : NominalCandela(session.lights.front());
  if (now != nullptr && now->illuminance_lx) return Lux(now->illuminance_lx->value + ambient);
  if (planned.distance && now != nullptr && now->distribution && !OfStatedBeam(*now)) {
    const double d =
        planned.distance->value() + (now->distance_offset_m ? now->distance_offset_m->value : 0.0);
    const Radians off = planned.off_axis.value_or(Radians(0.0));
    const auto towards = now->distribution->table.At(Radians(0.0), Radians(std::abs(off.value())));
    return Lux(towards.value() / (d * d) + ambient);
  }
  if (planned.distance && has_intensity) {
    const auto predicted = PredictIlluminance(*now, *planned.distance, 0.05);
    return predicted ? Lux(predicted->model_lx.value) : Lux(-1.0);
  }
  if (planned.distance) {
    const double d = planned.distance->value();
    return Lux(candela / (d * d));
  }
  if (!planned.position_m) return Lux(candela);
  return Lux(candela * LuxPerCandelaAt(session.lights.front(), now, planned) + ambient);
}

std::optional<std::array<Lux, 3>> LikelyIlluminances(const Session& session, const FittedLight* now,
                                                     const PlannedReading& planned,
                                                     const Reading& like) {
  const bool told = planned.distance && !planned.off_axis && now != nullptr && now->intensity_cd &&
                    (!now->distribution || OfStatedBeam(*now)) &&
                    planned.action != PlannedAction::kLampOff;
  if (!told) return std::nullopt;
  const bool card = planned.action == PlannedAction::kShadowCard;
  const PredictedParts predicted = PredictParts(*now, *planned.distance);
  std::vector<NormalPart> parts = card ? predicted.walls : predicted.whole;
  if (parts.empty()) return std::nullopt;
  // What the meter's calibration makes of the lamp it makes of the next reading too.
  const bool same = now->meter && now->meter->name == InstrumentOf(like);
  const double shared = same ? now->meter->calibration_relative : 0.0;
  const double own = std::hypot(RepeatabilityRelative(session, like),
                                same ? 0.0 : CalibrationRelative(session, like));
  for (NormalPart& part : parts) {
    part.sd = std::sqrt(std::max(0.0, part.sd * part.sd - shared * shared) + own * own);
  }
  const double beside = card ? AmbientOf(now) : 0.0;
  const auto at = [&](double probability) {
    return Lux(std::exp(QuantileOf(parts, probability)) + beside);
  };
  return std::array<Lux, 3>{at(1.0 / 6.0), at(0.5), at(5.0 / 6.0)};
}

}  // namespace lightcal::fit
