// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/dome/aimed_views.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/calibrate/dome/read_dome.h"
#include "lightcal/calibrate/dome/view_groups.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/panorama/compose_dome.h"
#include "lightcal/imaging/panorama/compose_views.h"
#include "lightcal/imaging/panorama/feature_picture.h"
#include "lightcal/imaging/panorama/lens_bearing.h"
#include "lightcal/imaging/panorama/level_aims.h"
#include "lightcal/imaging/panorama/reduce_dome.h"
#include "lightcal/imaging/panorama/solve_aims.h"

namespace lightcal {
namespace {

constexpr int kFeaturePictureSide = 1200;
constexpr int kMostFeatures = 1500;
constexpr double kFinerThanDome = 0.75;  // a view's pixel, of the dome's, at most
constexpr double kGuessRect = 65.0, kGuessFisheye = 180.0;  // degrees, where none are given

void Tell(const DomeInputRequest& request, const std::string& text) {
  if (request.progress) request.progress(text);
}

bool ShowsColour(const FrameInfo& info) {
  const bool sensor =
      info.meaning == SampleMeaning::kMosaic || info.meaning == SampleMeaning::kSensor;
  return sensor ? info.matrices.has_value() : info.channels == 3;
}

// A bracket as a picture in cd/m^2.
Result<DomeInput> MergedView(const std::vector<std::string>& files, const Sources& sources) {
  const auto bracket = sources.open_bracket(files, {});
  if (!bracket) return tl::unexpected(bracket.error());
  BracketMergeRequest how;
  const RgbPrimaries primaries = PrimariesOf(RgbSpace::kSrgb);
  if (ShowsColour(bracket->frames.front())) how.space = RgbSpace::kSrgb;
  auto merged = MergeBracket(*bracket, sources, how);
  if (!merged) return Propagate(std::move(merged));
  DomeInput input;
  input.files = {files.front()};
  input.warnings = bracket->warnings;
  for (Warning& warning : merged->warnings) input.warnings.push_back(std::move(warning));
  input.scale = WordOf(merged->scale_source);
  input.absolute = true;
  input.scale_u95_relative = merged->scale_u95_relative;
  input.has_colour = merged->channels == 3;
  Dome& dome = input.dome;
  dome.width = merged->width;
  dome.height = merged->height;
  dome.channels = merged->channels;
  dome.samples = std::move(merged->picture);
  if (!input.has_colour) {
    dome.nits = dome.samples;
    return input;
  }
  input.primaries = primaries;
  dome.xyz_from_rgb = XyzFromRgbMatrix(primaries);
  const auto& luminance = dome.xyz_from_rgb[1];
  dome.nits.reserve(dome.samples.size() / 3);
  for (std::size_t i = 0; i < dome.samples.size(); i += 3) {
    double nits = 0.0;
    for (std::size_t c = 0; c < 3; ++c) nits += luminance[c] * double{dome.samples[i + c]};
    dome.nits.push_back(static_cast<float>(nits));
  }
  return input;
}

// No finer than the dome shows; the focal length [pixels] shrinks with it.
void ReduceTo(int step, DomeInput& input) {
  if (step < 2) return;
  if (!input.clipped.empty()) {
    input.clipped = ReducedMarks(input.clipped, input.dome.width, input.dome.height, step);
  }
  input.dome = ReducedDome(input.dome, step);
}

int StepTo(const PictureView& view, const std::optional<int>& width) {
  const double finest = 2.0 * std::numbers::pi / width.value_or(kMostDomeWidth);
  return std::max(1, static_cast<int>(kFinerThanDome * finest * FocalOf(view)));
}

struct ReadViews {
  std::vector<DomeInput> pictures;
  AimQuestion question;
};

Result<ReadViews> ReadAll(const std::vector<std::vector<std::string>>& groups,
                          const DomeInputRequest& request, const Sources& sources) {
  ReadViews views;
  int width = 0, height = 0;
  const bool known = request.field_of_view.value() > 0.0;
  const bool rect = request.projection == Projection::kRectilinear;
  for (const auto& group : groups) {
    auto read = group.size() > 1 ? MergedView(group, sources)
                                 : ReadDomePicture(group.front(), sources, request);
    if (!read) return Propagate(std::move(read));
    const Dome& dome = read->dome;
    if (width == 0) {
      width = dome.width;
      height = dome.height;
    }
    if (dome.width != width || dome.height != height) {
      return Refused("views_differ", group.front(),
                     "it has " + std::to_string(dome.width) + " x " + std::to_string(dome.height) +
                         " pixels, " + groups.front().front() + " has " + std::to_string(width) +
                         " x " + std::to_string(height) +
                         "; views are of one lens and one size, none turned on its side");
    }
    PictureView view{
        request.projection, dome.width, dome.height,
        known ? request.field_of_view : RadiansFromDegrees(rect ? kGuessRect : kGuessFisheye)};
    if (auto ok = PixelSolidAngles::Create(view); !ok) return tl::unexpected(ok.error());
    const double focal = FocalOf(view);
    const int step = StepTo(view, request.width);
    ReduceTo(step, *read);
    view.width = read->dome.width;
    view.height = read->dome.height;
    view.field_of_view = FieldOfViewOf(view, focal / step);
    const auto angles = PixelSolidAngles::Create(view);
    if (!angles) return tl::unexpected(angles.error());
    const FeaturePicture picture =
        MakeFeaturePicture(read->dome.luminance(), *angles, kFeaturePictureSide);
    const View2d<const std::uint8_t> grey(picture.grey.data(), picture.width, picture.height);
    const View2d<const std::uint8_t> seen(picture.seen.data(), picture.width, picture.height);
    auto features = sources.find_features(grey, seen, kMostFeatures);
    if (!features) return tl::unexpected(features.error());
    views.question.features.push_back(FeaturesInView(*std::move(features), picture, *angles));
    views.question.names.push_back(group.front());
    views.question.view = view;
    views.pictures.push_back(*std::move(read));
    Tell(request, "view " + std::to_string(views.pictures.size()) + " of " +
                      std::to_string(groups.size()) + ": " + group.front() + ", " +
                      std::to_string(views.question.features.back().size()) + " features");
  }
  if (!known) views.question.view.field_of_view = Radians(0.0);
  return views;
}

Result<std::optional<KnownPose>> PoseOf(const DomeInputRequest& request,
                                        const std::vector<std::string>& names) {
  if (!request.level) return std::optional<KnownPose>();
  const LevelView& level = *request.level;
  std::vector<std::size_t> meant;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].ends_with(level.file)) meant.push_back(i);
  }
  const auto number = ParseNumber(level.file);
  if (meant.empty() && number && *number >= 1.0 && *number <= static_cast<double>(names.size())) {
    meant.push_back(static_cast<std::size_t>(*number) - 1);
  }
  if (meant.size() != 1) {
    return Refused("level_view", level.file,
                   std::string(meant.empty() ? "no view is" : "several views are") +
                       " called so; give {view.level} the end of a view's first file, or its "
                       "number from 1");
  }
  return std::optional(KnownPose{meant.front(), level.pitch, level.roll});
}

}  // namespace

Result<DomeInput> ReadAimedViews(const DomeInputRequest& request, const Sources& sources) {
  auto files = sources.expand_files(request.files);
  if (!files) return Propagate(std::move(files));
  const auto groups = GroupBrackets(*files, request.bracket, sources);
  if (!groups) return tl::unexpected(groups.error());
  if (groups->size() < 2) {
    return Refused("too_few_views", files->front(),
                   "one view has no other to find its aim by; give {view.aims}");
  }
  std::vector<std::string> names;
  for (const auto& group : *groups) names.push_back(group.front());
  const auto pose = PoseOf(request, names);
  if (!pose) return tl::unexpected(pose.error());
  auto views = ReadAll(*groups, request, sources);
  if (!views) return Propagate(std::move(views));
  const auto solved = SolveAims(views->question);
  if (!solved) return tl::unexpected(solved.error());
  const LevelledAims levelled = LevelAims(solved->axes, *pose);

  DomeInputRequest aimed = request;
  aimed.files = names;
  aimed.aims = levelled.aims;
  aimed.lens = solved->lens;
  aimed.field_of_view = FieldOfViewOf(views->question.view, solved->focal_px);
  Tell(request, std::to_string(solved->matches) + " matches within " +
                    RoundedText(solved->rms_px, 2) + " pixels; the lens sees " +
                    RoundedText(DegreesFromRadians(aimed.field_of_view), 4) + " degrees");
  auto dome = ComposeViews(std::move(views->pictures), aimed);
  if (!dome) return dome;
  for (std::size_t i = 0; i < dome->views.size(); ++i) {
    dome->views[i].aim_u95_deg = solved->u95_deg[i];
  }
  dome->files = *std::move(files);
  dome->field_of_view = aimed.field_of_view;
  dome->aims_rms_px = solved->rms_px;
  if (levelled.assumed) {
    dome->warnings.push_back({"horizon_assumed", names.front(),
                              "up is taken from how the cameras were held; give {view.level} a "
                              "view that stood level"});
  }
  return dome;
}

}  // namespace lightcal
