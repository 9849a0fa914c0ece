// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/scene/board_camera.h"

#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units.h"

namespace lightcal {
namespace {

constexpr int kPose = 6;  // parameters of a view; the others belong to the lens
constexpr int kLens = kCameraParameters - kPose;
constexpr double kDefaultFocal = 1.2;  // of the longer side
constexpr double kSigmaLnFocal = 0.5, kSigmaLnFocalKnown = 0.1;
constexpr double kSigmaCentre = 0.01;  // of the longer side
constexpr double kSigmaDistortion = 0.15;
constexpr double kSmallestSigmaPx = 0.1;
constexpr double kLargestRmsPx = 1.5;
constexpr double kMostOblique = 75.0 * kRadiansPerDegree;
constexpr double kFarAway = 1e6;  // pixels off, of a point behind the camera

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

// Rows of the rotation by |r| about r.
std::array<Vec3, 3> RotationRows(const Vec3& r) {
  const double angle = Length(r);
  if (angle < 1e-12) return {Vec3{1, -r[2], r[1]}, Vec3{r[2], 1, -r[0]}, Vec3{-r[1], r[0], 1}};
  const Vec3 k = r * (1.0 / angle);
  const double c = std::cos(angle), s = std::sin(angle), v = 1.0 - c;
  return {Vec3{c + k[0] * k[0] * v, k[0] * k[1] * v - k[2] * s, k[0] * k[2] * v + k[1] * s},
          Vec3{k[1] * k[0] * v + k[2] * s, c + k[1] * k[1] * v, k[1] * k[2] * v - k[0] * s},
          Vec3{k[2] * k[0] * v - k[1] * s, k[2] * k[1] * v + k[0] * s, c + k[2] * k[2] * v}};
}

// The Rodrigues vector of a rotation matrix.
Vec3 RotationVector(const Eigen::Matrix3d& m) {
  const Vec3 axis{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
  const double sine2 = Length(axis), cosine2 = m.trace() - 1.0;
  const double angle = std::atan2(sine2, cosine2);
  if (sine2 > 1e-9) return axis * (angle / sine2);
  if (cosine2 > 0.0) return {0, 0, 0};
  Eigen::Index largest = 0;
  m.diagonal().maxCoeff(&largest);
  Eigen::Vector3d k = m.col(largest);
  k(largest) += 1.0;
  k.normalize();
  return {angle * k(0), angle * k(1), angle * k(2)};
}

// The plane's homography from at least four points, by the smallest singular vector of normalised
// coordinates.   Source: Hartley & Zisserman, algorithm 4.2.
Eigen::Matrix3d HomographyOf(const std::vector<BoardCorner>& corners) {
  const auto normalise = [&](bool pixel) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    double spread = 0.0;
    const auto at = [&](const BoardCorner& c) {
      return Eigen::Vector2d(pixel ? c.pixel.data() : c.wall_m.data());
    };
    for (const BoardCorner& c : corners) mean += at(c);
    mean /= static_cast<double>(corners.size());
    for (const BoardCorner& c : corners) spread += (at(c) - mean).squaredNorm();
    const double scale = std::sqrt(2.0 * static_cast<double>(corners.size()) / spread);
    Eigen::Matrix3d t;
    t << scale, 0, -scale * mean(0), 0, scale, -scale * mean(1), 0, 0, 1;
    return t;
  };
  const Eigen::Matrix3d from_wall = normalise(false), from_pixel = normalise(true);
  Matrix a(2 * corners.size(), 9);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d w =
        from_wall * Eigen::Vector3d(corners[i].wall_m[0], corners[i].wall_m[1], 1.0);
    const Eigen::Vector3d p =
        from_pixel * Eigen::Vector3d(corners[i].pixel[0], corners[i].pixel[1], 1.0);
    const auto row = static_cast<Eigen::Index>(2 * i);
    a.row(row) << w.transpose(), Eigen::RowVector3d::Zero(), -p(0) * w.transpose();
    a.row(row + 1) << Eigen::RowVector3d::Zero(), w.transpose(), -p(1) * w.transpose();
  }
  const Vector h = Eigen::JacobiSVD<Matrix>(a, Eigen::ComputeFullV).matrixV().col(8);
  Eigen::Matrix3d m;
  m << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), h(8);
  return from_pixel.inverse() * m * from_wall;
}

// Pose of a plane seen through this homography by a lens without distortion.
// Source: Zhang 2000, 3.1.
std::array<double, kPose> PoseFromHomography(const Eigen::Matrix3d& h, double focal, double cx,
                                             double cy) {
  Eigen::Matrix3d k;
  k << focal, 0, cx, 0, focal, cy, 0, 0, 1;
  Eigen::Matrix3d m = k.inverse() * h;
  m /= 0.5 * (m.col(0).norm() + m.col(1).norm());
  if (m(2, 2) < 0.0) m = -m;
  Eigen::Matrix3d r;
  r << m.col(0), m.col(1), m.col(0).cross(m.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  r = svd.matrixU() * svd.matrixV().transpose();
  const Vec3 rotation = RotationVector(r);
  return {rotation[0], rotation[1], rotation[2], m(0, 2), m(1, 2), m(2, 2)};
}

// Parameters of all views: the first view's pose, the lens, then the other views' poses.
struct Problem {
  std::span<const std::vector<BoardCorner>> views;
  double longer_side = 1.0, centre_x = 0.0, centre_y = 0.0;
  double ln_focal = 0.0, sigma_ln_focal = kSigmaLnFocal;
  double sigma_px = kSmallestSigmaPx;

  [[nodiscard]] Eigen::Index Size() const {
    return kCameraParameters + kPose * static_cast<Eigen::Index>(views.size() - 1);
  }
  [[nodiscard]] CameraParameters OfView(const Vector& all, std::size_t view) const {
    CameraParameters one{};
    for (int i = 0; i < kCameraParameters; ++i) one[static_cast<std::size_t>(i)] = all(i);
    if (view > 0) {
      const auto first = kCameraParameters + kPose * static_cast<Eigen::Index>(view - 1);
      for (int i = 0; i < kPose; ++i) one[static_cast<std::size_t>(i)] = all(first + i);
    }
    return one;
  }
  [[nodiscard]] std::size_t Corners() const {
    std::size_t count = 0;
    for (const auto& view : views) count += view.size();
    return count;
  }
};

// Residuals over their sigmas: corners, then priors of the lens.
Vector Residuals(const Problem& problem, const Vector& all) {
  Vector out(2 * static_cast<Eigen::Index>(problem.Corners()) + kLens);
  Eigen::Index row = 0;
  for (std::size_t v = 0; v < problem.views.size(); ++v) {
    const WallCamera camera(problem.OfView(all, v));
    for (const BoardCorner& corner : problem.views[v]) {
      const auto pixel = camera.PixelOf(corner.wall_m);
      for (std::size_t k = 0; k < 2; ++k) {
        const double off = pixel ? (*pixel)[k] - corner.pixel[k] : kFarAway;
        out(row++) = off / problem.sigma_px;
      }
    }
  }
  out(row++) = (all(kLnFocal) - problem.ln_focal) / problem.sigma_ln_focal;
  out(row++) = (all(kCentreX) - problem.centre_x) / (kSigmaCentre * problem.longer_side);
  out(row++) = (all(kCentreY) - problem.centre_y) / (kSigmaCentre * problem.longer_side);
  out(row++) = all(kRadial2) / kSigmaDistortion;
  out(row++) = all(kRadial4) / kSigmaDistortion;
  return out;
}

// Step of a central difference, by the kind of parameter.
double StepOf(Eigen::Index index, const Problem& problem) {
  if (index == kCentreX || index == kCentreY) return 1e-5 * problem.longer_side;
  return 1e-6;
}

Matrix Jacobian(const Problem& problem, const Vector& all) {
  Matrix out(2 * static_cast<Eigen::Index>(problem.Corners()) + kLens, problem.Size());
  for (Eigen::Index i = 0; i < problem.Size(); ++i) {
    const double step = StepOf(i, problem);
    Vector up = all, down = all;
    up(i) += step;
    down(i) -= step;
    out.col(i) = (Residuals(problem, up) - Residuals(problem, down)) / (2.0 * step);
  }
  return out;
}

// As ceres::TinySolver takes it.
struct Corners {
  using Scalar = double;
  enum : int { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };
  const Problem& problem;

  [[nodiscard]] int NumParameters() const { return static_cast<int>(problem.Size()); }
  [[nodiscard]] int NumResiduals() const { return 2 * static_cast<int>(problem.Corners()) + kLens; }
  bool operator()(const double* all, double* residuals, double* jacobian) const {
    const Vector at = Eigen::Map<const Vector>(all, NumParameters());
    Eigen::Map<Vector>(residuals, NumResiduals()) = Residuals(problem, at);
    if (jacobian == nullptr) return true;
    Eigen::Map<Matrix>(jacobian, NumResiduals(), NumParameters()) = Jacobian(problem, at);
    return true;
  }
};

// Returns half the sum of squares.
double Minimise(const Problem& problem, Vector& all) {
  ceres::TinySolver<Corners> solver;
  solver.options.max_num_iterations = 60;
  solver.options.function_tolerance = 1e-12;
  solver.options.parameter_tolerance = 1e-14;  // of all at once, pixels and radians alike
  return solver.Solve({problem}, &all).final_cost;
}

Vector StartAt(const Problem& problem, const std::vector<Eigen::Matrix3d>& homographies,
               double focal) {
  Vector all = Vector::Zero(problem.Size());
  all(kLnFocal) = std::log(focal);
  all(kCentreX) = problem.centre_x;
  all(kCentreY) = problem.centre_y;
  for (std::size_t v = 0; v < homographies.size(); ++v) {
    const auto pose =
        PoseFromHomography(homographies[v], focal, problem.centre_x, problem.centre_y);
    const auto first =
        v == 0 ? Eigen::Index{0} : kCameraParameters + kPose * static_cast<Eigen::Index>(v - 1);
    for (int i = 0; i < kPose; ++i) all(first + i) = pose[static_cast<std::size_t>(i)];
  }
  return all;
}

double RmsPixels(const Problem& problem, const Vector& all) {
  const auto count = static_cast<Eigen::Index>(problem.Corners());
  const double sum = Residuals(problem, all).head(2 * count).squaredNorm();
  return problem.sigma_px * std::sqrt(sum / static_cast<double>(count));
}

Vec3 BoardMiddle(const std::vector<BoardCorner>& corners) {
  Vec3 middle{};
  for (const BoardCorner& c : corners) middle = middle + Vec3{c.wall_m[0], 0.0, c.wall_m[1]};
  return middle * (1.0 / static_cast<double>(corners.size()));
}

}  // namespace

WallCamera::WallCamera(const CameraParameters& p)
    : camera_from_board_(RotationRows({p[kRotationX], p[kRotationY], p[kRotationZ]})),
      translation_{p[kTranslationX], p[kTranslationY], p[kTranslationZ]},
      focal_(std::exp(p[kLnFocal])),
      centre_x_(p[kCentreX]),
      centre_y_(p[kCentreY]),
      k1_(p[kRadial2]),
      k2_(p[kRadial4]) {
  const auto& r = camera_from_board_;
  Vec3 board{};  // -R^T t
  for (std::size_t i = 0; i < 3; ++i) {
    board[i] = -(r[0][i] * translation_[0] + r[1][i] * translation_[1] + r[2][i] * translation_[2]);
  }
  position_m_ = {board[0], -board[2], board[1]};
}

std::optional<std::array<double, 2>> WallCamera::PixelOf(
    const std::array<double, 2>& wall_m) const {
  const Vec3 board{wall_m[0], wall_m[1], 0.0};
  const double ahead = Dot(camera_from_board_[2], board) + translation_[2];
  if (!(ahead > 0.0)) return std::nullopt;
  const double x = (Dot(camera_from_board_[0], board) + translation_[0]) / ahead;
  const double y = (Dot(camera_from_board_[1], board) + translation_[1]) / ahead;
  const double r2 = x * x + y * y;
  const double stretch = 1.0 + r2 * (k1_ + r2 * k2_);
  return std::array{centre_x_ + focal_ * stretch * x, centre_y_ + focal_ * stretch * y};
}

std::optional<std::array<double, 2>> WallCamera::Undistorted(
    const std::array<double, 2>& pixel) const {
  constexpr int kIterations = 30;
  const double x = (pixel[0] - centre_x_) / focal_, y = (pixel[1] - centre_y_) / focal_;
  const double distorted = std::hypot(x, y);
  if (distorted == 0.0) return std::array{0.0, 0.0};
  double r = distorted;  // Newton's way to r (1 + k1 r^2 + k2 r^4) = distorted
  for (int i = 0; i < kIterations; ++i) {
    const double r2 = r * r;
    const double slope = 1.0 + r2 * (3.0 * k1_ + 5.0 * r2 * k2_);
    if (!(slope > 0.05)) return std::nullopt;
    const double step = (r * (1.0 + r2 * (k1_ + r2 * k2_)) - distorted) / slope;
    r -= step;
    if (std::abs(step) < 1e-13 * distorted) break;
  }
  if (!(r > 0.0) || !std::isfinite(r)) return std::nullopt;
  return std::array{x * r / distorted, y * r / distorted};
}

std::optional<std::array<double, 2>> WallCamera::WallPointOf(
    const std::array<double, 2>& pixel) const {
  const auto ray = Undistorted(pixel);
  if (!ray) return std::nullopt;
  // The ray and the camera's place in board coordinates, cut with Z = 0.
  Vec3 direction{}, camera{};
  const auto& r = camera_from_board_;
  for (std::size_t i = 0; i < 3; ++i) {
    direction[i] = r[0][i] * (*ray)[0] + r[1][i] * (*ray)[1] + r[2][i];
    camera[i] =
        -(r[0][i] * translation_[0] + r[1][i] * translation_[1] + r[2][i] * translation_[2]);
  }
  const double length = -camera[2] / direction[2];
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return std::array{camera[0] + length * direction[0], camera[1] + length * direction[1]};
}

double WallCamera::CosineOffAxis(const std::array<double, 2>& pixel) const {
  const auto ray = Undistorted(pixel);
  return ray ? 1.0 / std::hypot(1.0, std::hypot((*ray)[0], (*ray)[1])) : 0.0;
}

Result<SolvedCamera> SolveCamera(std::span<const std::vector<BoardCorner>> views, int width,
                                 int height, std::optional<double> focal_px) {
  Problem problem;
  problem.views = views;
  problem.longer_side = std::max(width, height);
  problem.centre_x = 0.5 * width;
  problem.centre_y = 0.5 * height;
  problem.ln_focal = std::log(focal_px.value_or(kDefaultFocal * problem.longer_side));
  if (focal_px) problem.sigma_ln_focal = kSigmaLnFocalKnown;
  std::vector<Eigen::Matrix3d> homographies;
  for (const auto& view : views) homographies.push_back(HomographyOf(view));
  Vector best;
  double least = std::numeric_limits<double>::infinity();
  for (const double factor : {1.0, 0.7, 1.5}) {
    Vector all = StartAt(problem, homographies, factor * std::exp(problem.ln_focal));
    const double cost = Minimise(problem, all);
    if (!(cost < least)) continue;
    least = cost;
    best = all;
  }
  SolvedCamera out;
  if (best.size() > 0) out.rms_px = RmsPixels(problem, best);
  if (best.size() == 0 || out.rms_px > kLargestRmsPx) {
    return Refused("board_not_flat", "ChArUco board",
                   "its corners lie " + RoundedText(out.rms_px, 2) +
                       " pixels (rms) from where a flat board's would; tape it flat to the wall, "
                       "and do not use a fisheye lens");
  }
  // sqrt(2): a distance has two coordinates.
  problem.sigma_px = std::max(kSmallestSigmaPx, out.rms_px / std::numbers::sqrt2);
  Minimise(problem, best);
  out.sigma_px = problem.sigma_px;
  out.parameters = problem.OfView(best, 0);
  const Matrix jacobian = Jacobian(problem, best);
  const Matrix normal = jacobian.transpose() * jacobian;
  const Matrix covariance = normal.ldlt().solve(Matrix::Identity(problem.Size(), problem.Size()));
  for (int i = 0; i < kCameraParameters; ++i) {
    for (int j = 0; j < kCameraParameters; ++j) {
      out.covariance[static_cast<std::size_t>(i * kCameraParameters + j)] = covariance(i, j);
    }
  }
  const Vec3 to_camera = WallCamera(out.parameters).position_m() - BoardMiddle(views.front());
  out.oblique_rad = std::acos(std::clamp(-to_camera[1] / Length(to_camera), -1.0, 1.0));
  if (out.oblique_rad > kMostOblique) {
    return Refused("board_oblique", "ChArUco board",
                   "it is seen at " + RoundedText(DegreesFromRadians(Radians(out.oblique_rad)), 3) +
                       " degrees from its normal; 75 are the most: move the camera to face the "
                       "wall");
  }
  return out;
}

std::vector<CameraParameters> OneSigmaShifts(const SolvedCamera& camera) {
  using Square = Eigen::Matrix<double, kCameraParameters, kCameraParameters, Eigen::RowMajor>;
  const Square covariance = Eigen::Map<const Square>(camera.covariance.data());
  const Square factor = covariance.llt().matrixL();
  std::vector<CameraParameters> out;
  for (Eigen::Index column = 0; column < kCameraParameters; ++column) {
    CameraParameters& shifted = out.emplace_back(camera.parameters);
    for (Eigen::Index row = 0; row < kCameraParameters; ++row) {
      shifted[static_cast<std::size_t>(row)] += factor(row, column);
    }
  }
  return out;
}

}  // namespace lightcal
