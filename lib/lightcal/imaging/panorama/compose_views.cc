// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/panorama/compose_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/imaging/panorama/compose_dome.h"
#include "lightcal/imaging/panorama/view_contradictions.h"
#include "lightcal/imaging/panorama/view_scales.h"

namespace lightcal {
namespace {

constexpr int kViewPlateau = 16;        // pixels of a view that share its largest value: clipped
constexpr double kSameMatrix = 1e-4;    // of matrices that mean the same primaries
constexpr double kDisagreement = 0.05;  // robust sd of ln L in overlaps
constexpr double kWholeSphere = 0.9995;

Result<void> CheckAlike(const DomeInput& first, const DomeInput& other) {
  bool alike = first.dome.channels == other.dome.channels;
  for (std::size_t i = 0; i < 3 && first.has_colour; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      alike = alike &&
              std::abs(first.dome.xyz_from_rgb[i][j] - other.dome.xyz_from_rgb[i][j]) < kSameMatrix;
    }
  }
  if (alike) return {};
  return Refused("views_differ", other.files.front(),
                 "its channels or primaries are not those of " + first.files.front() +
                     "; write all views with one {merge.space}");
}

// Pixels at the view's end of scale: no reading of theirs makes them lights, but another view of
// the same direction is believed instead.
std::vector<std::uint8_t> PlateauOf(const Dome& dome) {
  const float brightest = *std::max_element(dome.nits.begin(), dome.nits.end());
  std::vector<std::uint8_t> at;
  if (std::ranges::count(dome.nits, brightest) < kViewPlateau) return at;
  at.reserve(dome.nits.size());
  for (const float v : dome.nits) at.push_back(v == brightest ? 1 : 0);
  return at;
}

// A fisheye looks up, the camera of a ball and a panorama along +Y.
ViewAim UnsaidAim(const DomeInputRequest& request) {
  ViewAim up;
  if (request.projection != Projection::kLatLong && request.balls.empty())
    up.pitch = Radians(std::numbers::pi / 2.0);
  return up;
}

ViewAim AimOf(const DomeInputRequest& request, std::size_t i) {
  return request.aims.empty() ? UnsaidAim(request) : request.aims[i];
}

Result<AimedView> ViewOf(const DomeInput& picture, const DomeInputRequest& request, std::size_t i) {
  const int width = picture.dome.width, height = picture.dome.height;
  const ViewAim aim = AimOf(request, i);
  if (!request.balls.empty()) {
    auto ball = BallMirror::Create(picture.files.front(), width, height, request.balls[i]);
    if (!ball) return Propagate(std::move(ball));
    return Result<AimedView>(tl::in_place, std::move(*ball), aim);
  }
  auto angles =
      PixelSolidAngles::Create({request.projection, width, height, request.field_of_view});
  if (!angles) return Propagate(std::move(angles));
  return Result<AimedView>(tl::in_place, std::move(*angles), aim, request.lens);
}

struct Views {
  std::vector<std::vector<std::uint8_t>> clipped;  // what the pictures' spans look at
  std::vector<AimedPicture> pictures;
  std::vector<bool> in_gauge;
};

Result<Views> AimPictures(const std::vector<DomeInput>& pictures, const DomeInputRequest& request) {
  Views views;
  const bool any_absolute = std::ranges::any_of(pictures, &DomeInput::absolute);
  for (const DomeInput& picture : pictures) {
    views.clipped.push_back(request.clip ? picture.clipped : PlateauOf(picture.dome));
    views.in_gauge.push_back(picture.absolute == any_absolute);
  }
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Dome& dome = pictures[i].dome;
    if (auto alike = CheckAlike(pictures.front(), pictures[i]); !alike) {
      return Propagate(std::move(alike));
    }
    auto view = ViewOf(pictures[i], request, i);
    if (!view) return Propagate(std::move(view));
    views.pictures.push_back(
        {pictures[i].files.front(), std::move(*view),
         View2d<const float>(dome.samples.data(), dome.width, dome.height, dome.channels),
         dome.luminance(), views.clipped[i]});
  }
  return views;
}

double SeenShare(const ComposedDome& composed) {
  const LatLongGrid grid = composed.dome.grid();
  double seen = 0.0;
  for (std::size_t i = 0; i < composed.unseen.size(); ++i) {
    if (composed.unseen[i] == 0) seen += grid.SolidAngle(grid.Y(static_cast<std::int32_t>(i)));
  }
  return seen / (4.0 * std::numbers::pi);
}

// What the files say of scale and of themselves, all together; the same of several once.
DomeInput Together(std::vector<DomeInput>& pictures) {
  DomeInput all;
  const auto labelled = std::ranges::find_if(pictures, &DomeInput::absolute);
  const DomeInput& speaker = labelled == pictures.end() ? pictures.front() : *labelled;
  all.scale = speaker.scale;
  all.absolute = speaker.absolute;
  all.scale_u95_relative = speaker.scale_u95_relative;
  all.primaries = pictures.front().primaries;
  all.has_colour = pictures.front().has_colour;
  for (DomeInput& picture : pictures) {
    all.files.push_back(picture.files.front());
    for (Warning& warning : picture.warnings) {
      if (warning.code == "relative_scale" && all.absolute) continue;  // another view's scale
      const auto said = std::ranges::find_if(all.warnings, [&](const Warning& other) {
        return other.code == warning.code && other.message == warning.message;
      });
      if (said == all.warnings.end()) all.warnings.push_back(std::move(warning));
    }
  }
  return all;
}

// What balls leave open: their reflectance in an absolute scale, and what one of them hides.
void TakeBalls(const std::vector<AimedPicture>& views, const DomeInputRequest& request,
               DomeInput& dome) {
  if (request.balls.empty()) return;
  const BallView& ball = request.balls.front();
  if (dome.absolute) {
    dome.scale_u95_relative = std::hypot(dome.scale_u95_relative.value_or(kUnstatedScaleU95),
                                         kZ95 * ball.reflectance_sd / ball.reflectance);
  }
  if (views.size() > 1) return;
  const AimedView& view = views.front().view;
  dome.blind_cap = BlindCap{view.Outward(view.ball()->axis()), view.ball()->BlindAngle()};
}

// Found aims are as right as pictures from several places allow: those are ghosts, no blunder.
Result<std::string> WordsOfOverlaps(Result<std::string> judged, bool aims_found) {
  if (judged) return judged;
  if (aims_found) return judged.error().message;
  judged.error().message +=
      ". Check aims, rolls, turns and the order of the files, or let them be found ({dome.aims} "
      "auto)";
  return judged;
}

void WarnOfDisagreement(const std::string& overlaps, bool aims_found, DomeInput& dome) {
  std::string what;
  if (dome.agreement_sd > kDisagreement) {
    what = "where views overlap they differ by " + RoundedText(100.0 * dome.agreement_sd, 2) +
           " % (1 sigma)";
  }
  if (!overlaps.empty()) what += (what.empty() ? "" : "; ") + overlaps;
  if (what.empty()) return;
  dome.warnings.push_back(
      {"views_disagree", dome.files.front(),
       what + (aims_found ? "; something moved, or the camera did not turn about its lens"
                          : "; check their aims ({dome.aims} auto finds them) and field of view, "
                            "or something moved")});
}

}  // namespace

Result<DomeInput> ComposeViews(std::vector<DomeInput> pictures, const DomeInputRequest& request) {
  const auto views = AimPictures(pictures, request);
  if (!views) return tl::unexpected(views.error());
  const auto scales = SolveViewScales(views->pictures, views->in_gauge);
  if (!scales) return tl::unexpected(scales.error());
  std::vector<std::string> names;
  for (const AimedPicture& picture : views->pictures) names.push_back(picture.name);
  const auto apart = WordsOfOverlaps(JudgeOverlaps(scales->overlaps, names), request.find_aims);
  if (!apart) return tl::unexpected(apart.error());
  ComposedDome composed =
      ComposeDome(views->pictures, *scales, request.width.value_or(WidthForViews(views->pictures)));
  DomeInput dome = Together(pictures);
  for (std::size_t i = 0; i < dome.files.size(); ++i) {
    dome.views.push_back({dome.files[i], scales->factor[i], kZ95 * scales->sd_relative[i],
                          AimOf(request, i), std::nullopt});
  }
  dome.rim_transmission = scales->Falloff(1.0);
  dome.agreement_sd = scales->agreement_sd;
  dome.apart_share = ShareApart(scales->overlaps);
  dome.seen_share = SeenShare(composed);
  if (dome.seen_share < kWholeSphere) dome.unseen = std::move(composed.unseen);
  if (request.clip) dome.clipped = std::move(composed.clipped);
  TakeBalls(views->pictures, request, dome);
  composed.dome.xyz_from_rgb = pictures.front().dome.xyz_from_rgb;
  dome.dome = std::move(composed.dome);
  WarnOfDisagreement(*apart, request.find_aims, dome);
  return dome;
}

}  // namespace lightcal
