// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/posed_wall.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/calibrate/captures/capture_readings.h"
#include "lightcal/calibrate/captures/recorded_picture.h"

namespace lightcal {
namespace {

// The board by the camera that took the frames, where it stands.
Result<GreyPicture> PoseGrey(const Session& session, const CaptureDescription& capture,
                             const WallPicture& frames, const Sources& sources,
                             Evidence& evidence) {
  const std::string& name = capture.wall->board_frame;
  if (name.empty()) return frames.nits;
  const std::string path = PathInSession(session, name);
  auto grey = ReadGrey(sources, path);
  if (!grey) return grey;
  if (grey->width != frames.whole_width || grey->height != frames.whole_height) {
    return Refused("mixed_size", path,
                   "the picture of the board and the frames differ in size; one camera must take "
                   "both, from one place");
  }
  evidence.AddFile(path);
  return grey;
}

// Further views of the board; one where it cannot be found is left out and named.
Result<std::vector<std::vector<BoardCorner>>> FurtherViews(const Session& session,
                                                           const CaptureDescription& capture,
                                                           const WallPicture& first,
                                                           const Sources& sources,
                                                           Evidence& evidence) {
  std::vector<std::vector<BoardCorner>> views;
  if (capture.wall->board_views.empty()) return views;
  const std::vector<std::string> patterns = {PathInSession(session, capture.wall->board_views)};
  const auto files = sources.expand_files(patterns);
  if (!files) return tl::unexpected(files.error());
  for (const std::string& file : *files) {
    const auto grey = ReadGrey(sources, file);
    if (!grey) return tl::unexpected(grey.error());
    if (grey->width != first.whole_width || grey->height != first.whole_height) {
      return Refused("mixed_size", file,
                     "the views of the board must be as large as the frames, by the same lens");
    }
    evidence.AddFile(file);
    auto corners = sources.find_board(grey->view(), capture.wall->board);
    if (corners) {
      views.push_back(*std::move(corners));
    } else {
      evidence.warnings.push_back(
          {corners.error().code, file, corners.error().message + "; this view is left out"});
    }
  }
  return views;
}

// What is wrong with the board, and in which file's picture.
tl::unexpected<Error> InPictureOf(const std::string& file, Error error) {
  error.subject += " in " + file;
  return tl::unexpected(std::move(error));
}

// Places in a picture made smaller as places in the whole one.
void Enlarge(const Thinning& thinning, std::vector<BoardCorner>& corners) {
  for (BoardCorner& corner : corners) {
    corner.pixel = {thinning.n * (corner.pixel[0] - thinning.ThinX(0.0)),
                    thinning.n * (corner.pixel[1] - thinning.ThinY(0.0))};
  }
}

// The camera of the whole picture as one of the picture made smaller.
SolvedCamera CameraOfSmaller(SolvedCamera camera, const Thinning& thinning) {
  const double size = 1.0 / thinning.n;
  camera.parameters[kLnFocal] += std::log(size);
  camera.parameters[kCentreX] = thinning.ThinX(camera.parameters[kCentreX]);
  camera.parameters[kCentreY] = thinning.ThinY(camera.parameters[kCentreY]);
  for (const int centre : {kCentreX, kCentreY}) {
    for (int other = 0; other < kCameraParameters; ++other) {
      camera.covariance[static_cast<std::size_t>(centre * kCameraParameters + other)] *= size;
      camera.covariance[static_cast<std::size_t>(other * kCameraParameters + centre)] *= size;
    }
  }
  camera.rms_px *= size;
  camera.sigma_px *= size;
  return camera;
}

}  // namespace

Result<PosedWall> ReadPosedWall(const Session& session, const CaptureDescription& capture,
                                const Sources& sources, Evidence& evidence) {
  auto picture = ReadWallPicture(session, capture, sources, evidence);
  if (!picture) return Propagate(std::move(picture));
  evidence.pictures.push_back(RecordedOf(capture, picture->nits.view()));
  const auto grey = PoseGrey(session, capture, *picture, sources, evidence);
  if (!grey) return tl::unexpected(grey.error());
  auto corners = sources.find_board(grey->view(), capture.wall->board);
  const std::string& pose_file =
      capture.wall->board_frame.empty() ? capture.frames : capture.wall->board_frame;
  if (!corners) return InPictureOf(pose_file, corners.error());
  // In the camera's own pixels, as those of further views.
  if (capture.wall->board_frame.empty()) Enlarge(picture->thinning, *corners);
  const auto further = FurtherViews(session, capture, *picture, sources, evidence);
  if (!further) return tl::unexpected(further.error());
  std::vector<std::vector<BoardCorner>> views = {*std::move(corners)};
  views.insert(views.end(), further->begin(), further->end());
  std::optional<double> focal_px;
  if (grey->focal_length && capture.wall->sensor_width) {
    focal_px = *grey->focal_length / *capture.wall->sensor_width * picture->whole_width;
  }
  auto camera = SolveCamera(views, picture->whole_width, picture->whole_height, focal_px);
  if (!camera) {
    const std::string& views_of = capture.wall->board_views;
    return InPictureOf(pose_file + (views_of.empty() ? "" : ", " + views_of), camera.error());
  }
  const SolvedCamera thinned = CameraOfSmaller(*camera, picture->thinning);
  return PosedWall{*std::move(picture), thinned};
}

}  // namespace lightcal
