// SPDX-License-Identifier: Apache-2.0
// Which gels, and how much dimming, bring one lamp to another.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/light_view.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/progress.h"
#include "lightcal/core/result.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal/records/gel.h"

namespace lightcal::match {

// What is not known exactly, as standard deviations unless said otherwise.
struct MatchSpread {
  // 95 % half width of what a batch of gel varies by, of full transmittance where it varies most:
  //   dT(l) = T ln T e(l) (points/1.96) e,  e = 2.718, e(l) of unit variance, correlated over 50
  //   nm:
  // the amount of each dye varies, a clear film does not.
  double gel_points = 0.02;
  double spectral = 0.015;  // of a measured spectrum, relative, correlated over 100 nm: 0.0015 in x
  double level = 0.025;     // of a measured illuminance, relative, shared by all wavelengths
  double sensitivity = 0.02;  // of a camera's measured channels, relative, correlated over 50 nm
};

struct MatchRequest {
  Spectrum lamp, target;
  bool lamp_measured = true, target_measured = true;  // false: defined, it has no meter's error
  std::vector<CameraSensitivities> cameras;           // none: the observer decides
  ObserverAngle observer = ObserverAngle::kTwoDegrees;
  int most_gels = 2;  // 0, 1 or 2 in one stack
  SheetGap gap = SheetGap::kNone;
  int count = 5;        // matches wanted
  double reach = 0.02;  // the largest distance in u'v' that is still called a match
  MatchSpread spread;
  int draws = 400;  // behind the intervals; 0: none are stated
  Progress progress{};
};

struct CameraDifference {
  double median = 0.0;  // of one camera its own
  double worst = 0.0;
  std::string worst_camera;
  double skin = 0.0;              // median over the cameras
  std::vector<double> by_camera;  // in the request's order
};

// What one stack makes of the lamp. Differences are as LightView states them.
struct Match {
  std::vector<std::size_t> gels;  // of the set, lowest first; none: the lamp as it is
  NodeValues transmittance{};
  Xy xy;
  CctResult cct;
  double delta_uv = 0.0;  // distance from the target in CIE 1976 u'v'
  double observer = 0.0, observer_skin = 0.0;
  std::optional<CameraDifference> camera;
  double ssi = 0.0;         // of the two spectra
  double stops_lost = 0.0;  // log2 of the unfiltered over the filtered illuminance
  // log2 of its illuminance over the target's; below 0 the lamp is too weak. Absent where either is
  // relative.
  std::optional<double> dimmer_stops;

  // 95 % intervals of the above. Absent without draws, cct and duv also where there is none.
  struct Intervals {
    std::optional<Uncertain> cct_K, duv;
    Uncertain delta_uv, observer, ssi, stops_lost;
    std::optional<Uncertain> camera, dimmer_stops;
  };
  std::optional<Intervals> intervals;
};

struct MatchAnswer {
  // The front, best colour first: no stack listed is bettered in everything (colour, SSI, stops,
  // number of gels) by another. All are within `reach`; the best of one gel is among them if it is.
  std::vector<Match> matches;
  Match unfiltered;
  std::size_t stacks = 0;  // looked at
  CctResult target_cct;
  Xy target_xy;
};

// All stacks of at most `most_gels` gels, a gel twice too, are looked at: those that cannot be
// among the best are left as soon as that is certain, so that the answer is the exhaustive one.
// Colour decides by the camera's difference, of many cameras by their median, of none by the
// observer's; in steps of 0.05, within which fewer gels come first (before any whose difference is
// not 0.05 smaller), then those that cost less light. A stack is not listed where one before it has
// no more than 0.05 stops, 1 point of SSI or a gel to lose against it; fewer than `count` are
// listed where the 4,000 nearest hold no more within `reach` (always the nearest). The same inputs
// give the same answer on any number of threads. Refused: "unreachable" (the nearest of all stacks
// is farther than `reach` in u'v': says which it is and what is left), "blind_view",
// "bad_spectrum", "truncated_spectrum", "coarse_spectrum", "noisy_spectrum".
[[nodiscard]] Result<MatchAnswer> MatchLights(const MatchRequest& request,
                                              std::span<const Gel> gels);

// What given gels make of the lamp: one match, with its intervals, wherever it leads.
[[nodiscard]] Result<Match> MatchOfStack(const MatchRequest& request, std::span<const Gel> gels,
                                         const std::vector<std::size_t>& stack);

// What the camera sees (of many the one nearest their median, of none the observer).
struct ViewedMatch {
  std::string viewer;
  std::vector<Xyz> target;
  LightView::Seen lamp, gelled;
};
[[nodiscard]] Result<ViewedMatch> ViewMatch(const MatchRequest& request, const Match& match);

}  // namespace lightcal::match
