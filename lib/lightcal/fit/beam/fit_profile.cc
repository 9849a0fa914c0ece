// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/fit_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/beam/beam_light.h"
#include "lightcal/fit/beam/beam_rows.h"
#include "lightcal/fit/beam/spot_beam.h"
#include "lightcal/fit/model/asked_sampling.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/meter_calibration.h"
#include "lightcal/fit/model/reading_times.h"
#include "lightcal/fit/plan/plan_forward.h"
#include "lightcal/photometry/spot_cone.h"
#include "lightcal/photometry/spot_profile.h"

namespace lightcal::fit {
namespace {

// Calibration is one factor on every reading.
void WidenBeam(double calibration, BeamLight& found) {
  AddCalibration(calibration, found.estimate);
  WidenPeak(1.0, calibration, found.estimate);
  for (LampInRoom& one : found.estimate.in_room) one.covariance[0] += calibration * calibration;
  WidenInLn(found.flux_lm, 1.0, calibration);
  WidenInLn(*found.beam.axial, 1.0, calibration);
}

Result<BeamLight> ShapeByAll(const Session& session, const LightDescription& light,
                             const Observations& observations, const FitSettings& settings,
                             ForwardPlan& plan) {
  LightDescription seen = light;
  seen.beam = RoughBeam(observations, light);
  Result<ForwardPlan> planned = PlanForward(session, seen, observations, settings);
  if (!planned) return Propagate(std::move(planned));
  plan = *std::move(planned);
  return FitBeamLight(observations, light, plan.model);
}

// Full angles; their 1 sigma is of ln.
bool Differs(double printed_deg, const Uncertain& read) {
  constexpr double kConflict = 2.0;  // standard deviations of both
  if (!(*read.low > 0.0)) return false;
  const double sd = std::log(*read.high / *read.low) / (2.0 * kZ95);
  const double middle = std::sqrt(*read.high * *read.low);
  return std::abs(std::log(printed_deg / middle)) > kConflict * std::hypot(sd, kSheetAngle);
}

// Whether it does, and then says so.
bool Contradicted(const std::string& light, const char* key, const std::optional<Radians>& printed,
                  const std::optional<Uncertain>& read, Warnings& warnings) {
  if (!printed || !read || !Differs(DegreesFromRadians(*printed), *read)) return false;
  warnings.push_back({"data_sheet_disagrees", light,
                      "the readings say " + std::string(key) + " is " + RoundedText(*read->low, 2) +
                          " to " + RoundedText(*read->high, 2) + ", the data sheet " +
                          RoundedText(DegreesFromRadians(*printed), 3) +
                          ": the readings alone are believed; check that it is a full angle and "
                          "of this zoom"});
  return true;
}

// By the readings and a data sheet's angles; by the readings alone where they know better.
Result<BeamLight> ShapeOfReadings(const Session& session, const LightDescription& light,
                                  const Observations& observations, const FitSettings& settings,
                                  ForwardPlan& plan) {
  if (light.beam || light.field) {
    LightDescription unprinted = light;
    unprinted.beam.reset();
    unprinted.field.reset();
    Result<BeamLight> read = ShapeByAll(session, unprinted, observations, settings, plan);
    if (read && !read->even) {
      Warnings& warnings = read->estimate.warnings;
      const MeasuredBeam& found = read->beam;
      const bool beam = Contradicted(light.name, "beam_deg", light.beam, found.beam_deg, warnings);
      const bool field =
          Contradicted(light.name, "field_deg", light.field, found.field_deg, warnings);
      if (beam || field) return read;
    }
  }
  return ShapeByAll(session, light, observations, settings, plan);
}

// Relative intensity by the cone at gamma, and where it is farthest from what was read.
struct OffCone {
  double inner = 0.0, gamma = 0.0, read = 1.0, stated = 1.0;
  double within = 0.0;  // of what was read there
  [[nodiscard]] double Part() const { return std::max(0.0, std::abs(read - stated) - within); }
};

std::vector<double> AnglesRead(const Observations& observations, const LightDescription& light,
                               const BeamLight& found) {
  const std::optional<Vec3>& aim = found.aim ? found.aim : light.aim;
  std::vector<double> out;
  for (const Observation& row : observations.rows) {
    if (!row.lit) continue;
    if (row.off_axis_rad != 0.0) out.push_back(std::abs(row.off_axis_rad));
    if (!LitAndPlaced(row) || !light.position_m || !aim) continue;
    out.push_back(AngleFromAim(*aim, *row.position_m - *light.position_m).value());
  }
  return out;
}

double PartSdAt(const BeamLight& found, double gamma) {
  const double degrees = DegreesFromRadians(Radians(gamma));
  const auto above = std::ranges::lower_bound(found.gamma_deg, degrees);
  if (above == found.gamma_deg.end()) return found.part_sd.back();
  return found.part_sd[static_cast<std::size_t>(above - found.gamma_deg.begin())];
}

// `wider`: than the shape found, within its interval.
OffCone FarthestOff(const std::vector<double>& angles, const BeamLight& found, double wider,
                    double inner, double outer) {
  OffCone most{inner};
  const double axis = found.table.At(Radians(0.0), Radians(0.0)).value();
  for (const double gamma : angles) {
    const double read = found.table.At(Radians(0.0), Radians(gamma / wider)).value() / axis;
    const double stated = SpotProfile(HalfVersine(gamma), HalfVersine(inner), HalfVersine(outer),
                                      SpotFalloff::kSquaredLinear);
    const OffCone one{inner, gamma, read, stated, PartSdAt(found, gamma)};
    if (one.Part() > most.Part()) most = one;
  }
  return most;
}

// By the cone and the width, within what is known of both, that suit each other best.
OffCone LeastOff(const std::vector<double>& angles, const BeamLight& found,
                 const LightDescription& light) {
  constexpr int kSteps = 10;
  const Uncertain& beam = *found.beam.beam_deg;
  const double outer = light.outer->value();
  OffCone best;
  for (int i = 0; i <= kSteps; ++i) {
    const double wider = (*beam.low + (*beam.high - *beam.low) * i / kSteps) / beam.value;
    for (int k = 0; k < (light.inner ? 1 : kSteps); ++k) {
      const double inner = light.inner ? light.inner->value() : outer * k / kSteps;
      const OffCone off = FarthestOff(angles, found, wider, inner, outer);
      if ((i == 0 && k == 0) || off.Part() < best.Part()) best = off;
    }
  }
  return best;
}

}  // namespace

Result<void> CheckStatedCone(const Session& session, const LightDescription& light,
                             const Observations& observations, const FitSettings& settings,
                             bool answered) {
  // Of the peak: of a beam that may be some cone, and of one that is none.
  constexpr double kUnlikeThis = 0.15, kUnlikeAny = 0.04;
  LightDescription open = light;
  open.inner.reset();
  open.outer.reset();
  if (!light.outer || !NeedsProfile(observations, open)) return {};
  ForwardPlan plan;
  const auto found = ShapeOfReadings(session, open, observations, settings, plan);
  if (!found || found->even || !found->beam.beam_deg) return {};
  const std::vector<double> angles = AnglesRead(observations, light, *found);
  const OffCone best = LeastOff(angles, *found, light);
  if (best.Part() < (found->flat_cone ? kUnlikeThis : kUnlikeAny)) {
    if (answered) return {};
    const Uncertain& beam = *found->beam.beam_deg;
    return Refused("cone_unlike", light.name,
                   "with the stated cone the readings leave its strength open; by themselves they "
                   "show a beam " +
                       RoundedText(*beam.low, 2) + " to " + RoundedText(*beam.high, 2) +
                       " degrees wide: leave outer_deg and inner_deg out; what a data sheet prints "
                       "are beam_deg and field_deg");
  }
  const OffCone shown = FarthestOff(angles, *found, 1.0, best.inner, light.outer->value());
  return Refused("cone_unlike", light.name,
                 "at " + RoundedText(DegreesFromRadians(Radians(shown.gamma)), 2) +
                     " degrees off the axis the readings show " + PercentText(shown.read) +
                     " of the middle, the stated cone " + PercentText(shown.stated) +
                     ": leave outer_deg and inner_deg out, and the beam's own shape is found; "
                     "what a data sheet prints are beam_deg and field_deg");
}

Result<std::optional<FittedLight>> FitProfile(const Session& session, const LightDescription& light,
                                              const Observations& observations,
                                              const FitSettings& settings, FittedLight out,
                                              FittedSession& session_out) {
  ForwardPlan plan;
  Result<BeamLight> found = ShapeOfReadings(session, light, observations, settings, plan);
  // A cone and a bulb have fits of their own, which may still answer.
  const bool stated = std::ranges::any_of(
      observations.rows, [](const Observation& o) { return o.off_axis_rad != 0.0; });
  const bool bulb_by_places = light.kind == LightKind::kPoint && !stated;
  if (!found && (bulb_by_places || NeedsBeam(observations, light))) return std::nullopt;
  if (!found) return Propagate(std::move(found));
  if (bulb_by_places && !found->surely_a_beam) return std::nullopt;
  if (found->even || (found->flat_cone && NeedsBeam(observations, light))) return std::nullopt;
  if (auto known = CheckKnown(found->estimate, light.name); !known) {
    return Propagate(std::move(known));
  }
  WidenBeam(SharedCalibration(observations), *found);
  LightEstimate& estimate = found->estimate;
  if (SamplingOf(settings)) session_out.notes.push_back(SayOfSampling(estimate, light.name));
  FillParameters(estimate, true, out);
  out.fit = estimate.diagnostics;
  out.residuals = estimate.residuals;
  out.effects = ReportEffects(plan, observations, estimate);
  ReportCalibration(observations, out.effects);
  out.budget = BudgetWithScale(observations, estimate.variance_parts);
  session_out.Warn(std::move(estimate.warnings));
  FillBeamLight(*std::move(found), out);
  CheckPrintedFlux(light, *out.flux_lm, session_out.warnings);
  CheckDrift(session, out, session_out.warnings);
  return out;
}

}  // namespace lightcal::fit
