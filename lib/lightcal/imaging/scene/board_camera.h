// SPDX-License-Identifier: Apache-2.0
// Corners of a board in pictures -> the camera that took them, and which point of the wall each of
// its pixels sees.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/vec3.h"
#include "lightcal/imaging/scene/charuco.h"

namespace lightcal {

// What is solved for, in this order; in the board's own coordinates X is ours, Y our Z, and Z our
// -Y, out of the wall.
enum CameraParameter {
  kRotationX,  // Rodrigues vector of camera_from_board [rad]
  kRotationY,
  kRotationZ,
  kTranslationX,  // of the board's origin in camera coordinates (x right, y down, z ahead) [m]
  kTranslationY,
  kTranslationZ,
  kLnFocal,  // ln of the focal length in pixels
  kCentreX,  // principal point [pixels]
  kCentreY,
  kRadial2,  // distorted = undistorted (1 + k1 r^2 + k2 r^4), r = tan of the angle from the axis
  kRadial4,
  kCameraParameters
};
using CameraParameters = std::array<double, kCameraParameters>;

// Where the camera model maps points of the wall, and back.
class WallCamera {
 public:
  explicit WallCamera(const CameraParameters& parameters);
  // Pixel of a point (x, z) of the wall; absent behind the camera.
  [[nodiscard]] std::optional<std::array<double, 2>> PixelOf(
      const std::array<double, 2>& wall_m) const;
  // Point (x, z) of the wall that a pixel sees; absent where its ray misses the wall, or beyond the
  // angle up to which the distortion has an inverse.
  [[nodiscard]] std::optional<std::array<double, 2>> WallPointOf(
      const std::array<double, 2>& pixel) const;
  // In wall coordinates [m].
  [[nodiscard]] const Vec3& position_m() const { return position_m_; }
  // cos of the angle between a pixel's ray and the optical axis.
  [[nodiscard]] double CosineOffAxis(const std::array<double, 2>& pixel) const;

 private:
  [[nodiscard]] std::optional<std::array<double, 2>> Undistorted(
      const std::array<double, 2>& pixel) const;

  std::array<Vec3, 3> camera_from_board_{};  // rows
  Vec3 translation_{};
  Vec3 position_m_{};
  double focal_ = 1.0, centre_x_ = 0.0, centre_y_ = 0.0, k1_ = 0.0, k2_ = 0.0;
};

struct SolvedCamera {
  CameraParameters parameters{};
  // Of the parameters, row by row; corners of sigma_px each and the priors below.
  std::array<double, std::size_t{kCameraParameters} * kCameraParameters> covariance{};
  double rms_px = 0.0;       // of the corners' distances to where the model has them
  double sigma_px = 0.0;     // of a corner's coordinate: from the residuals, 0.1 pixels at least
  double oblique_rad = 0.0;  // angle between the board's normal and the line from it to the camera
};

// Least squares of the corners of views[0], whose pose is asked for, and of further views that one
// camera took of the board with the same lens, focus and size of picture. Priors (1 sigma): ln f
// about `focal_px`, 0.1, or about 1.2 times the picture's longer side, 0.5, where it is unknown;
// principal point in the middle, 1 % of the longer side; k1 and k2 zero, 0.15. Pixels are square,
// distortion is radial.
// Refused: board_oblique (seen at more than 75 degrees), board_not_flat (corners off by more than
// 1.5 pixels rms: a bent board, or no ordinary lens).
[[nodiscard]] Result<SolvedCamera> SolveCamera(std::span<const std::vector<BoardCorner>> views,
                                               int width, int height,
                                               std::optional<double> focal_px = std::nullopt);

// The parameters, each time one standard deviation along one of as many independent directions as
// there are parameters (columns of the covariance's Cholesky factor).
[[nodiscard]] std::vector<CameraParameters> OneSigmaShifts(const SolvedCamera& camera);

}  // namespace lightcal
