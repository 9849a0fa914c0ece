// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/fit_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/core/as_one.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/fit/beam/beam_light.h"
#include "lightcal/fit/beam/fit_profile.h"
#include "lightcal/fit/beam/stated_beam.h"
#include "lightcal/fit/beam/unstated_inner.h"
#include "lightcal/fit/colour/fit_color.h"
#include "lightcal/fit/fit_by_distance.h"
#include "lightcal/fit/fit_uneven_bulb.h"
#include "lightcal/fit/locate/fit_located_light.h"
#include "lightcal/fit/locate/locate.h"
#include "lightcal/fit/model/data_sheet.h"
#include "lightcal/fit/model/distance_scatter.h"
#include "lightcal/fit/model/fill_light.h"
#include "lightcal/fit/model/input_checks.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/model/off_axis.h"
#include "lightcal/fit/model/reading_times.h"
#include "lightcal/fit/states/measure_states.h"
#include "lightcal/fit/states/split_geometries.h"
#include "lightcal/light/effects/distance_error.h"
#include "lightcal/photometry/spot_cone.h"

namespace lightcal {
namespace {

// What nobody read answers from its data sheet.
Result<FittedLight> FitUnread(const LightDescription& light, const fit::Observations& observations,
                              FittedLight out) {
  if (observations.rejected.empty() && fit::HasDataSheet(light)) {
    if (auto filled = fit::FillFromDataSheet(light, out); !filled) {
      return Propagate(std::move(filled));
    }
    fit::AddDerivedQuantities(light, out);
    out.flux_lm =
        Uncertain{light.flux->value(), fit::kFluxToleranceRelative * light.flux->value(), {}, {}};
    fit::FindInnerByFlux(light, out);
    return out;
  }
  return observations.rejected.empty()
             ? Refused("no_readings", light.name,
                       "the session holds no illuminance reading of this light; add one with "
                       "`{ReadMeter}`, or give flux_lm from its data sheet")
             : Refused("no_valid_readings", light.name,
                       "every reading of this light was rejected; the first because " +
                           observations.warnings.front().message);
}

// No reading thrown out, and the others as near as they scatter, about an axis near the stated one.
bool SuitsReadings(const LightDescription& light, const FittedLight& fitted) {
  constexpr double kChiSquared = 3.0;  // a degree of freedom
  constexpr double kAimStands = 2.0;   // standard deviations
  if (light.aim && fitted.aim &&
      AngleFromAim(*light.aim, *fitted.aim) > kAimStands * fit::AngleSigma(light)) {
    return false;
  }
  return std::ranges::all_of(fitted.residuals, &ResidualRow::used) &&
         fitted.fit.chi2_dof.value_or(1.0) < kChiSquared;
}

Result<FittedLight> FitStrength(const Session& session, const LightDescription& light,
                                const FitSettings& settings, FittedSession& session_out) {
  Warnings& warnings = session_out.warnings;
  Result<fit::Observations> observations = fit::CollectObservations(session, light);
  if (!observations) return Propagate(std::move(observations));
  fit::CheckTimes(session, light, warnings);
  fit::CheckRoom(session, light, warnings);
  if (auto sized = fit::CheckLengths(session, light, warnings); !sized)
    return Propagate(std::move(sized));
  FittedLight out = fit::Describe(light);
  if (observations->rows.empty()) return FitUnread(light, *observations, std::move(out));
  if (fit::NeedsLocating(*observations, light)) {
    session_out.Warn(std::move(observations->warnings));
    return fit::FitLocatedLight(session, light, *observations, settings, std::move(out),
                                session_out);
  }
  if (auto bulb = fit::FitUnevenBulb(session, light, *observations, settings, out, session_out)) {
    return *std::move(bulb);
  }
  if (fit::NeedsProfile(*observations, light)) {
    Result<std::optional<FittedLight>> shaped =
        fit::FitProfile(session, light, *observations, settings, out, session_out);
    if (!shaped) return Propagate(std::move(shaped));
    if (*shaped) {
      session_out.Warn(std::move(observations->warnings));
      return **std::move(shaped);
    }
  }
  if (light.field && !light.beam) {
    session_out.warnings.push_back(
        {"field_alone", light.name,
         "field_deg (a tenth of the middle) says little of a beam by itself and changed nothing: "
         "give beam_deg (half of it) too, or readings off the axis"});
  }
  if (!light.outer) {
    return fit::FitByDistance(session, light, *std::move(observations), settings, std::move(out),
                              session_out);
  }
  Result<FittedLight> fitted =
      fit::LacksInner(light, *observations)
          ? fit::FitUnstatedInner(session, light, *observations, settings, out, session_out)
          : fit::FitByDistance(session, light, *observations, settings, out, session_out);
  if (fitted && SuitsReadings(light, *fitted)) return fitted;
  if (auto cone = fit::CheckStatedCone(session, light, *observations, settings, fitted.has_value());
      !cone) {
    return Propagate(std::move(cone));
  }
  return fitted;
}

// How wide the 95 % of its strength is, in ln; absent where it has none.
std::optional<double> LnWidthOf(const FittedLight& light) {
  if (!light.intensity_cd || !(LowEnd(*light.intensity_cd) > 0.0)) return std::nullopt;
  return std::log(HighEnd(*light.intensity_cd) / LowEnd(*light.intensity_cd));
}

// Distances in whole inches are read off a tape to the inch: said where that tells.
void SayOfRounding(const Session& session, const LightDescription& light,
                   const FitSettings& settings, const FittedLight& fitted,
                   FittedSession& session_out) {
  constexpr double kTells = 1.1;
  if (!fit::RoundedToInches(session, light)) return;
  LightDescription by_tape = light;
  by_tape.distance_sigma = Metres(effects::kDistanceSigmaMetres);
  FittedSession unused;
  const Result<FittedLight> finer = FitStrength(session, by_tape, settings, unused);
  const std::optional<double> whole = LnWidthOf(fitted);
  const std::optional<double> part = finer ? LnWidthOf(*finer) : std::nullopt;
  if (!whole || !part || !(*whole > kTells * *part)) return;
  session_out.notes.push_back(
      light.name + ": its distances are whole inches and count as rounded to them, which widens " +
      "its 95 % by " + PercentText(*whole / *part - 1.0) +
      ": state distance_sigma_m in its [[light]] where they were read more finely");
}

// Its colour last: how much of the light in a reading was the lamp's own is what the fit found.
Result<FittedLight> FitOne(const Session& session, const LightDescription& light,
                           const FitSettings& settings, FittedSession& session_out) {
  Result<FittedLight> out = FitStrength(session, light, settings, session_out);
  if (!out) return out;
  SayOfRounding(session, light, settings, *out, session_out);
  fit::ShapeByStatedBeam(light, *out);
  const fit::OtherLight others(session, light, *out);
  fit::ColorFit found =
      fit::FitColor(session, light, &others, session_out.warnings, settings.cct_method);
  out->color = found.color;
  if (!found.note.empty()) session_out.notes.push_back(std::move(found.note));
  return out;
}

// Each zoom and front that tells where its light starts is a lamp of its own, and its states too.
Result<void> AddGeometries(const fit::GeometryParts& parts, const LightDescription& light,
                           const FitSettings& settings, FittedLight& fitted, FittedSession& out) {
  for (const Session& part : parts.others) {
    const FixtureState reference = ReferenceState(part, light.name);
    const LightDescription there = fit::DescriptionFromReadings(part, light, reference);
    Result<FittedLight> own = FitOne(part, there, settings, out);
    if (!own) return Propagate(std::move(own));
    fit::MeasureStates(part, there, settings.cct_method, *own, out.warnings);
    fit::TakeGeometry(*own, fitted);
  }
  fit::DescribeOtherGeometries(light, fitted);
  return {};
}

// A point shines all round: in every engine, in flux_lm and off its axis.
void WarnOfOneSidedPoint(const LightDescription& light, const FittedLight& fitted,
                         Warnings& warnings) {
  if (fitted.kind != LightKind::kPoint) return;
  if (light.beam && light.fixture != Fixture::kBulb) {
    warnings.push_back({"one_sided_point", light.name,
                        "its beam angle is stated, " +
                            RoundedText(DegreesFromRadians(*light.beam), 3) +
                            " degrees, and its kind is a point, which shines all round: make it a "
                            "spot, or no engine gets that beam"});
    return;
  }
  if (!light.fixture || !ShinesOneWay(*light.fixture)) return;
  const bool beam = light.fixture == Fixture::kReflector || light.fixture == Fixture::kFresnel;
  warnings.push_back(
      {"one_sided_point", light.name,
       "a " + std::string(FixtureName(*light.fixture)) +
           " shines one way and is taken as a point, which shines all round: right the way it was "
           "read, and nowhere else; " +
           (beam ? "give its beam angle ({light.beam}), or read it off its axis too"
                 : "give its size (kind rect or disk), or read it off its axis too")});
}

// With all its states.
Result<FittedLight> FitWhole(const Session& session, const LightDescription& light,
                             const FitSettings& settings, FittedSession& out) {
  Result<FittedLight> fitted = FitOne(session, light, settings, out);
  if (!fitted) return fitted;
  const fit::GeometryParts parts = fit::SplitGeometries(session, light);
  const Session& read = parts.others.empty() ? session : parts.main;
  fit::MeasureStates(read, light, settings.cct_method, *fitted, out.warnings);
  auto added = AddGeometries(parts, light, settings, *fitted, out);
  if (!added) return Propagate(std::move(added));
  WarnOfOneSidedPoint(light, *fitted, out.warnings);
  return fitted;
}

// Which of its states a lamp's intensity is of: a line a lamp, of many one for all.
void NoteStates(const std::vector<FittedLight>& lights, std::vector<std::string>& notes) {
  constexpr std::size_t kMostLines = 3;
  std::vector<const FittedLight*> settable;
  for (const FittedLight& light : lights) {
    if (light.states.size() > 1) settable.push_back(&light);
  }
  const std::size_t shown = std::min(settable.size(), kMostLines);
  if (settable.size() <= kMostLines) {
    for (const FittedLight* const light : settable) {
      notes.push_back(light->name + ": read at " + std::to_string(light->states.size()) +
                      " states of its controls; its intensity is that at " +
                      StateText(light->state));
    }
    return;
  }
  std::string names;
  for (std::size_t i = 0; i < shown; ++i) {
    names += settable[i]->name + " at " + StateText(settable[i]->state) + ", ";
  }
  const auto [fewest, most] = std::ranges::minmax_element(
      settable, {}, [](const FittedLight* light) { return light->states.size(); });
  const std::size_t few = (*fewest)->states.size();
  const std::size_t many = (*most)->states.size();
  notes.push_back(std::to_string(settable.size()) + " lights were read at " +
                  (few < many ? std::to_string(few) + " to " : "") + std::to_string(many) +
                  " states of their controls; the intensity of each is that at one of them: " +
                  names + "and " + std::to_string(settable.size() - shown) + " more");
}

Result<FittedSession> FitSound(const Session& session, FitSettings settings) {
  FittedSession out;
  std::vector<Error> refusals, unread;
  const Progress whole = std::move(settings.progress);
  const double part = 1.0 / static_cast<double>(std::max<std::size_t>(1, session.lights.size()));
  double begun = 0.0;
  for (const LightDescription& described : session.lights) {
    const LightDescription light =
        DescriptionAt(described, ReferenceState(session, described.name));
    settings.progress = PartOf(whole, begun, begun + part);
    begun += part;
    Result<FittedLight> fitted = FitWhole(session, light, settings, out);
    if (fitted) {
      out.lights.lights.push_back(*std::move(fitted));
      continue;
    }
    if (fitted.error().kind != ErrorKind::kRefused) return Propagate(std::move(fitted));
    if (fitted.error().code != "no_readings") {
      refusals.push_back(std::move(fitted).error());
      continue;
    }
    out.warnings.push_back({"no_readings", light.name, fitted.error().message});
    unread.push_back(std::move(fitted).error());
  }
  // Beside an answer the unread are warned of; where there is none they are what is missing.
  if (out.lights.lights.empty()) std::ranges::move(unread, std::back_inserter(refusals));
  if (!refusals.empty()) return tl::unexpected(AsOne(std::move(refusals)));
  NoteStates(out.lights.lights, out.notes);
  if (out.lights.lights.empty()) {
    return Refused("no_light", session.name, "the session describes no light");
  }
  return out;
}

}  // namespace

Result<FittedSession> FitSession(const Session& session, const FitSettings& settings) {
  if (!(settings.tolerance_relative >= 0.0) || !std::isfinite(settings.tolerance_relative)) {
    return Refused("bad_tolerance", session.name,
                   "effects are left off within a part of the light, 0 or more, not " +
                       ShortestText(settings.tolerance_relative));
  }
  if (auto sound = CheckSession(session); !sound) return Propagate(std::move(sound));
  const std::optional<Session> sound = SetFaultyAside(session);
  return FitSound(sound ? *sound : session, settings);
}

}  // namespace lightcal
