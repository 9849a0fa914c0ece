// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "dome/dome_words.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "one_of.h"
#include "picture_words.h"

namespace lightcal::app {
namespace {

Result<Lux> ParseReading(const char* option, const std::string& text) {
  const auto lux = ParseIlluminance(text);
  if (!lux) return tl::unexpected(lux.error());
  if (!(lux->value() > 0.0)) return Refused("not_positive", option, "a lux reading is above 0");
  return *lux;
}

Result<std::optional<DomeReading>> ReadingOf(const DomeOptions& options) {
  if (options.lux.empty()) {
    if (!options.lux_shaded.empty()) return WrongUsage("--lux-shaded", "belongs to a --lux");
    return std::nullopt;
  }
  DomeReading reading;
  const auto lux = ParseReading("--lux", options.lux);
  if (!lux) return tl::unexpected(lux.error());
  reading.illuminance = *lux;
  const auto sigma = ParseShare("--lux-sigma", options.lux_sigma);
  if (!sigma) return tl::unexpected(sigma.error());
  reading.sigma_relative = *sigma;
  const auto normal = ParseDirection("--lux-direction", options.lux_direction);
  if (!normal) return tl::unexpected(normal.error());
  reading.normal = *normal;
  if (!options.lux_shaded.empty()) {
    const auto shaded = ParseReading("--lux-shaded", options.lux_shaded);
    if (!shaded) return tl::unexpected(shaded.error());
    reading.shaded = *shaded;
  }
  return std::optional(reading);
}

constexpr const char* kMirrorBallWord = "mirrorball";

std::vector<std::string_view> DomeProjectionWords() {
  std::vector<std::string_view> words(kProjectionWords.begin(), kProjectionWords.end());
  words.emplace_back(kMirrorBallWord);
  return words;
}

Result<std::vector<BallView>> BallsOf(const DomeOptions& options) {
  const std::size_t pictures = options.files.size();
  if (options.balls.size() != 1 && options.balls.size() != pictures) {
    return WrongUsage("--ball",
                      "--projection mirrorball needs --ball X,Y,WIDTH,HEIGHT, the box "
                      "around the ball in pixels: once for each picture in their order, "
                      "or once for all");
  }
  BallView ball;
  if (!options.fov.empty()) {
    const auto fov = ParseAngle(options.fov);
    if (!fov) return tl::unexpected(fov.error());
    ball.field_of_view = *fov;
  }
  if (!options.ball_distance.empty()) {
    const auto diameters = ParseNumber(options.ball_distance);
    if (!diameters || !(*diameters > 0.5)) {
      return WrongUsage("--ball-distance", "\"" + options.ball_distance +
                                               "\" is not a count of the ball's diameters above "
                                               "0.5: 1.5 m from a ball of 76 mm is 20");
    }
    ball.distance_diameters = *diameters;
  }
  if (!options.ball_reflectance.empty()) {
    const auto reflectance = ParseReflectance("--ball-reflectance", options.ball_reflectance);
    if (!reflectance) return tl::unexpected(reflectance.error());
    ball.reflectance = (*reflectance)[0];
    ball.reflectance_sd = (*reflectance)[1];
  }
  std::vector<BallView> balls(pictures, ball);
  for (std::size_t i = 0; i < pictures; ++i) {
    const auto box = ParsePixelBox("--ball", options.balls[options.balls.size() == 1 ? 0 : i]);
    if (!box) return tl::unexpected(box.error());
    balls[i].outline = *box;
  }
  return balls;
}

// What finding aims needs besides.
Result<void> TakeAuto(const DomeOptions& options, DomeInputRequest& request) {
  request.find_aims = true;
  if (request.projection == Projection::kLatLong) request.projection = Projection::kRectilinear;
  if (!options.up.empty()) {
    const auto level = ParseLevel("--up", options.up);
    if (!level) return tl::unexpected(level.error());
    request.level = *level;
  }
  if (options.bracket.empty()) return {};
  const auto frames = ParseNumber(options.bracket);
  constexpr double kMostFrames = 100.0;
  if (!frames || !(*frames >= 1.0 && *frames <= kMostFrames) || std::fmod(*frames, 1.0) != 0.0) {
    return WrongUsage("--bracket", "\"" + options.bracket + "\" is not a count of frames a view");
  }
  request.bracket = static_cast<int>(*frames);
  return {};
}

Result<void> TakeViews(const DomeOptions& options, DomeInputRequest& request) {
  const bool mirror = options.projection == kMirrorBallWord;
  const bool find = options.aims.size() == 1 && options.aims.front() == "auto";
  if (!find && !(options.bracket.empty() && options.up.empty())) {
    return WrongUsage(options.up.empty() ? "--bracket" : "--up", "belongs to --aim auto");
  }
  if (find && mirror) {
    return WrongUsage("--aim", "mirror balls need YAW,PITCH[,ROLL] each: auto is for views");
  }
  if (mirror) {
    auto balls = BallsOf(options);
    if (!balls) return Propagate(std::move(balls));
    request.balls = std::move(*balls);
  } else if (options.projection.empty() && !find) {
    request.projection_of_file = true;
    if (!options.fov.empty()) return WrongUsage("--fov", "belongs to a --projection");
  } else if (!options.projection.empty()) {
    const auto projection = ParseProjection("--projection", options.projection);
    if (!projection) return tl::unexpected(projection.error());
    request.projection = *projection;
  }
  if (!options.fov.empty()) {
    const auto fov = ParseAngle(options.fov);
    if (!fov) return tl::unexpected(fov.error());
    request.field_of_view = *fov;
  }
  if (find) {
    if (auto ok = TakeAuto(options, request); !ok) return ok;
  }
  for (const std::string& text : options.aims) {
    if (find) break;
    const auto aim = ParseAim("--aim", text);
    if (!aim) return tl::unexpected(aim.error());
    request.aims.push_back(*aim);
  }
  const bool one =
      options.files.size() == 1 && (mirror || request.projection != Projection::kRectilinear);
  if (!find && request.aims.size() != options.files.size() && !(one && request.aims.empty())) {
    return WrongUsage("--aim", std::to_string(options.files.size()) +
                                   " pictures are views and need --aim auto, or --aim "
                                   "YAW,PITCH[,ROLL] once each in their order; " +
                                   std::to_string(request.aims.size()) + " given");
  }
  if (options.width.empty()) return {};
  const auto width = ParseNumber(options.width);
  constexpr double kLeast = 16.0, kMost = 16384.0;
  if (!width || !(*width >= kLeast && *width <= kMost) || std::fmod(*width, 2.0) != 0.0) {
    return WrongUsage("--width",
                      "\"" + options.width + "\" is not an even count of pixels, 16 to 16384");
  }
  request.width = static_cast<int>(*width);
  return {};
}

}  // namespace

void AddDomeOptions(CLI::App& parser, DomeOptions& w) {
  parser
      .add_option("panoramas", w.files,
                  "Lat-long panorama: EXR, Radiance HDR or float TIFF. Its centre looks along +Y, "
                  "its right side is +X, its upper edge +Z. Or views of other projections, several "
                  "with their --aim each: overlaps give them one scale")
      ->required();
  parser.add_option("--lux", w.lux,
                    "A lux meter's reading where the panorama was taken: sets the scale, or what "
                    "clipped [the picture's own scale]");
  parser
      .add_option("--lux-direction", w.lux_direction,
                  "Where the meter faced: up, down or AZIMUTH,ELEVATION in degrees, right of the "
                  "centre and above the horizon")
      ->capture_default_str();
  parser.add_option("--lux-shaded", w.lux_shaded,
                    "The same reading with a card shading the light that clips, or the brightest: "
                    "then a clipped light needs no absolute picture");
  parser.add_option("--lux-sigma", w.lux_sigma, "The meter's 1 sigma")->capture_default_str();
  parser.add_option("--clip", w.clip,
                    "Samples from this value on are clipped, in the picture's own unit [found]");
  parser.add_option("--luminance-convention", w.convention, kConventionHelp)
      ->check(OneOf(kConventionWords));
  parser.add_option("--north", w.north,
                    "Azimuth in degrees, right of the picture's centre, that becomes +Y [0]");
  parser
      .add_option("--projection", w.projection,
                  "Of the pictures: a panorama, fisheyes (looking up unless aimed), an ordinary "
                  "lens (rect), or its pictures of a mirror ball, which show all around but what "
                  "is behind the ball (mirrorball) [as Radiance's VIEW line says, else latlong]")
      ->check(OneOf(DomeProjectionWords()));
  parser.add_option("--fov", w.fov,
                    "Full angle in degrees: across a fisheye's circle, across a rect's width; of "
                    "a mirror ball's picture it tells how far the camera was [far away]");
  parser
      .add_option("--aim", w.aims,
                  "Where a view looks, once for each picture in their order: YAW,PITCH[,ROLL] in "
                  "degrees, right of +Y, above the horizon, leaning right; or auto: found from "
                  "what the views share")
      ->allow_extra_args(false);
  parser.add_option("--bracket", w.bracket,
                    "With --aim auto: every N files are the frames of one view, and are merged");
  parser.add_option(
      "--up", w.up,
      "With --aim auto: VIEW[,PITCH[,ROLL]], a view (file or number) that stood level, "
      "or as these degrees say [how the cameras were held]");
  parser
      .add_option("--ball", w.balls,
                  "X,Y,W,H in pixels: the box that touches the mirror ball's outline, once for "
                  "each picture in their order, or once for all")
      ->allow_extra_args(false);
  parser.add_option("--ball-reflectance", w.ball_reflectance,
                    "R or R,SIGMA: what the ball sends back of the light, looking straight at it "
                    "[0.62,0.05]");
  parser.add_option("--ball-distance", w.ball_distance,
                    "From the camera to the ball's middle, in diameters of the ball, for a picture "
                    "cut out of a larger one, where --fov says nothing [far away]");
  parser.add_option("--plate", w.plate,
                    "A linear picture or RAW that shows a grey ball or card where the dome was "
                    "taken, in its light: gives the dome the plate's own scale");
  parser.add_option("--grey-ball", w.grey_ball,
                    "X,Y,W,H in pixels: the box around the grey ball's outline in the --plate");
  parser.add_option("--grey-card", w.grey_card,
                    "X,Y,W,H in pixels: a box on a grey card in the --plate");
  parser.add_option("--card-direction", w.card_direction,
                    "Where the card faced: up, down or AZIMUTH,ELEVATION [the plate's camera]");
  parser.add_option("--grey-reflectance", w.grey_reflectance,
                    "R or R,SIGMA of the grey ball or card [0.18,0.006]");
  parser.add_option("--plate-fov", w.plate_fov,
                    "Full angle of the plate's lens across its width [a mirror ball's --fov]");
  parser.add_option("--plate-aim", w.plate_aim,
                    "Where the plate's camera looked: YAW,PITCH[,ROLL] [as the first mirror ball's "
                    "--aim, else 0,0]");
  parser.add_option("--width", w.width,
                    "Pixels across the dome made of views [the finest view's detail]");
}

Result<DomeRequest> DomeRequestOf(const DomeOptions& options) {
  DomeRequest request;
  request.input.files = options.files;
  if (auto views = TakeViews(options, request.input); !views) return Propagate(std::move(views));
  if (!options.convention.empty()) {
    const auto convention = ParseConvention("--luminance-convention", options.convention);
    if (!convention) return tl::unexpected(convention.error());
    request.input.convention = *convention;
  }
  if (!options.clip.empty()) {
    const auto clip = ParseNumber(options.clip);
    if (!clip || !(*clip > 0.0)) {
      return WrongUsage("--clip", "\"" + options.clip + "\" is not a value above 0");
    }
    request.input.clip = *clip;
  }
  if (!options.north.empty()) {
    const auto north = ParseAngle(options.north);
    if (!north) return tl::unexpected(north.error());
    request.north = *north;
  }
  auto reading = ReadingOf(options);
  if (!reading) return Propagate(std::move(reading));
  request.reading = *reading;
  return request;
}

Result<std::optional<GreyPlate>> GreyPlateOf(const DomeOptions& options, const DomeRequest& request,
                                             const std::optional<CameraSettings>& exposure) {
  const bool ball = !options.grey_ball.empty(), card = !options.grey_card.empty();
  if (options.plate.empty()) {
    if (ball) return WrongUsage("--grey-ball", "lies in a --plate FILE");
    if (card) return WrongUsage("--grey-card", "lies in a --plate FILE");
    return std::nullopt;
  }
  if (ball == card) {
    return WrongUsage("--plate",
                      "needs what is grey in it: --grey-ball X,Y,WIDTH,HEIGHT, the box "
                      "around a ball in pixels, or --grey-card X,Y,WIDTH,HEIGHT, a box "
                      "on a card");
  }
  GreyPlate plate;
  plate.exposure = exposure;
  GreyTarget& target = plate.target;
  target.file = options.plate;
  target.ball = ball;
  const auto box = ball ? ParsePixelBox("--grey-ball", options.grey_ball)
                        : ParsePixelBox("--grey-card", options.grey_card);
  if (!box) return tl::unexpected(box.error());
  target.box = *box;
  if (!options.card_direction.empty()) {
    const auto normal = ParseDirection("--card-direction", options.card_direction);
    if (!normal) return tl::unexpected(normal.error());
    target.card_normal = TurnedNorth(*normal, -request.north);
  }
  if (!options.grey_reflectance.empty()) {
    const auto grey = ParseReflectance("--grey-reflectance", options.grey_reflectance);
    if (!grey) return tl::unexpected(grey.error());
    target.reflectance = (*grey)[0];
    target.reflectance_sd = (*grey)[1];
  }
  const std::string& fov =
      options.plate_fov.empty() && !request.input.balls.empty() ? options.fov : options.plate_fov;
  if (!fov.empty()) {
    const auto angle = ParseAngle(fov);
    if (!angle) return tl::unexpected(angle.error());
    target.field_of_view = *angle;
  }
  if (!options.plate_aim.empty()) {
    const auto aim = ParseAim("--plate-aim", options.plate_aim);
    if (!aim) return tl::unexpected(aim.error());
    target.aim = *aim;
  } else if (!request.input.balls.empty() && !request.input.aims.empty()) {
    target.aim = request.input.aims.front();
  }
  return std::optional(std::move(plate));
}

}  // namespace lightcal::app
