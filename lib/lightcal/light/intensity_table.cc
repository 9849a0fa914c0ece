// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/intensity_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "lightcal/light/table_pieces.h"

namespace lightcal {
namespace {

constexpr double kSameAngleRad = 1e-9;

double Rad(double degrees) { return RadiansFromDegrees(degrees).value(); }

// ---- planes through a pole ----

struct AboutPole {
  double azimuth = 0.0;
  double theta = 0.0;
};

AboutPole PoleAngles(GoniometerType type, const Vec3& d) {
  switch (type) {
    case GoniometerType::kC:
      break;
    case GoniometerType::kB:
      return {std::atan2(d[0], -d[2]), std::atan2(std::hypot(d[0], d[2]), -d[1])};
    case GoniometerType::kA:
      return {std::atan2(-d[1], -d[2]), std::atan2(std::hypot(d[1], d[2]), d[0])};
  }
  return {std::atan2(d[1], d[0]), std::atan2(std::hypot(d[0], d[1]), -d[2])};
}

Vec3 DirectionOf(GoniometerType type, double azimuth, double theta) {
  const double s = std::sin(theta);
  switch (type) {
    case GoniometerType::kC:
      break;
    case GoniometerType::kB:
      return {s * std::sin(azimuth), -std::cos(theta), -s * std::cos(azimuth)};
    case GoniometerType::kA:
      return {std::cos(theta), -s * std::sin(azimuth), -s * std::cos(azimuth)};
  }
  return {s * std::cos(azimuth), s * std::sin(azimuth), -std::cos(theta)};
}

bool MirrorsAzimuth(GoniometerType type, TableSymmetry symmetry) {
  if (symmetry == TableSymmetry::kQuadrant) return type != GoniometerType::kC;
  return (type == GoniometerType::kA && symmetry == TableSymmetry::kBilateral) ||
         (type == GoniometerType::kB && symmetry == TableSymmetry::kBilateral90);
}
bool MirrorsTheta(GoniometerType type, TableSymmetry symmetry) {
  if (symmetry == TableSymmetry::kQuadrant) return type != GoniometerType::kC;
  return (type == GoniometerType::kA && symmetry == TableSymmetry::kBilateral90) ||
         (type == GoniometerType::kB && symmetry == TableSymmetry::kBilateral);
}

// How often the stored planes make up the sphere.
double Copies(GoniometerType type, TableSymmetry symmetry) {
  if (type == GoniometerType::kC) {
    if (symmetry == TableSymmetry::kQuadrant) return 4.0;
    return symmetry == TableSymmetry::kNone || symmetry == TableSymmetry::kAxial ? 1.0 : 2.0;
  }
  return (MirrorsAzimuth(type, symmetry) ? 2.0 : 1.0) * (MirrorsTheta(type, symmetry) ? 2.0 : 1.0);
}

// C of the mirrored plane among the stored ones.
double FoldC(double c, TableSymmetry symmetry) {
  c = std::fmod(c, 2.0 * std::numbers::pi);
  if (c < 0.0) c += 2.0 * std::numbers::pi;
  switch (symmetry) {
    case TableSymmetry::kNone:
      return c;
    case TableSymmetry::kAxial:
      return 0.0;
    case TableSymmetry::kBilateral:
      return c > std::numbers::pi ? 2.0 * std::numbers::pi - c : c;
    case TableSymmetry::kBilateral90:
      if (c < 0.5 * std::numbers::pi) return std::numbers::pi - c;
      return c > 1.5 * std::numbers::pi ? 3.0 * std::numbers::pi - c : c;
    case TableSymmetry::kQuadrant:
      if (c > std::numbers::pi) c = 2.0 * std::numbers::pi - c;
      return c > 0.5 * std::numbers::pi ? std::numbers::pi - c : c;
  }
  return c;
}

struct Found {
  std::size_t index = 0;
  double part = 0.0;
  bool inside = false;
};

Found Locate(const std::vector<double>& nodes, double x) {
  if (nodes.size() == 1) return {0, 0.0, true};
  if (!(x >= nodes.front() - kSameAngleRad && x <= nodes.back() + kSameAngleRad)) return {};
  const auto next = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const auto index = static_cast<std::size_t>(next - nodes.begin()) - 1;
  const double part = (x - nodes[index]) / (nodes[index + 1] - nodes[index]);
  return {index, std::clamp(part, 0.0, 1.0), true};
}

}  // namespace

Result<IntensityTable> IntensityTable::Make(IntensityGrid grid, std::string_view where) {
  auto symmetry = SymmetryOfGrid(grid, where);
  if (!symmetry) return Propagate(std::move(symmetry));
  IntensityTable table;
  table.symmetry_ = *symmetry;
  table.grid_ = std::move(grid);
  table.Lay();
  table.FindSlopes();
  table.FindPeak();
  return table;
}

void IntensityTable::Lay() {
  const std::size_t nv = grid_.vertical_deg.size();
  const bool planes_are_vertical = grid_.type == GoniometerType::kB;
  const auto& planes = planes_are_vertical ? grid_.vertical_deg : grid_.horizontal_deg;
  const auto& along = planes_are_vertical ? grid_.horizontal_deg : grid_.vertical_deg;
  const bool from_pole = grid_.type == GoniometerType::kC;
  for (const double a : planes) azimuth_.push_back(Rad(a));
  for (const double a : along) theta_.push_back(Rad(from_pole ? a : 90.0 - a));
  if (!from_pole) std::reverse(theta_.begin(), theta_.end());
  values_.reserve((planes.size() + 1) * along.size());
  for (std::size_t p = 0; p < planes.size(); ++p) {
    for (std::size_t t = 0; t < along.size(); ++t) {
      const std::size_t a = from_pole ? t : along.size() - 1 - t;
      values_.push_back(grid_.candela[planes_are_vertical ? a * nv + p : p * nv + a]);
    }
  }
  const bool turn = from_pole && symmetry_ == TableSymmetry::kNone;
  if (!turn) return;
  if (SameAngle(grid_.horizontal_deg.back(), 360.0)) {
    azimuth_.back() = 2.0 * std::numbers::pi;
  } else {
    azimuth_.push_back(2.0 * std::numbers::pi);
    values_.insert(values_.end(), grid_.candela.begin(), grid_.candela.begin() + nv);
  }
}

std::optional<double> IntensityTable::Opposite(double azimuth, std::size_t theta) const {
  const Found plane = Locate(azimuth_, Folded(azimuth + std::numbers::pi));
  if (!plane.inside) return std::nullopt;
  const double before = Node(plane.index, theta);
  return plane.part == 0.0 ? before : before + plane.part * (Node(plane.index + 1, theta) - before);
}

void IntensityTable::FindSlopes() {
  const bool first_is_pole = std::abs(theta_.front()) <= kSameAngleRad;
  const bool last_is_pole = std::abs(theta_.back() - std::numbers::pi) <= kSameAngleRad;
  const bool last_is_mirror = MirrorsTheta(grid_.type, symmetry_);
  slopes_.resize(values_.size());
  for (std::size_t p = 0; p < azimuth_.size(); ++p) {
    const std::span<const double> plane(&values_[p * theta_.size()], theta_.size());
    const std::span<double> slopes(&slopes_[p * theta_.size()], theta_.size());
    ThreePointSlopes(theta_, plane, slopes);
    const std::size_t last = theta_.size() - 1;
    // A plane goes on beyond its pole as the one opposite.
    if (const auto beyond = first_is_pole ? Opposite(azimuth_[p], 1) : std::nullopt) {
      slopes[0] = (plane[1] - *beyond) / (2.0 * (theta_[1] - theta_[0]));
    }
    if (const auto beyond = last_is_pole ? Opposite(azimuth_[p], last - 1) : std::nullopt) {
      slopes[last] = (*beyond - plane[last - 1]) / (2.0 * (theta_[last] - theta_[last - 1]));
    }
    if (last_is_mirror) slopes[last] = 0.0;
  }
}

void IntensityTable::FindPeak() {
  const auto largest = std::max_element(values_.begin(), values_.end());
  const auto index = static_cast<std::size_t>(largest - values_.begin());
  const Vec3 d =
      DirectionOf(grid_.type, azimuth_[index / theta_.size()], theta_[index % theta_.size()]);
  const AboutPole place = PoleAngles(GoniometerType::kC, d);
  const bool on_axis = std::hypot(d[0], d[1]) < kSameAngleRad;
  const double c = place.azimuth < 0.0 ? place.azimuth + 2.0 * std::numbers::pi : place.azimuth;
  if (on_axis) {
    peak_ = {Candela(*largest), Radians(0.0), Radians(d[2] < 0.0 ? 0.0 : std::numbers::pi)};
  } else {
    peak_ = {Candela(*largest), Radians(c), Radians(place.theta)};
  }
}

double IntensityTable::AlongPlane(std::size_t plane, std::size_t index, double part,
                                  TableInterpolation way) const {
  const double before = Node(plane, index);
  const double after = Node(plane, index + 1);
  if (way == TableInterpolation::kLinear) return before + part * (after - before);
  const std::size_t node = plane * theta_.size() + index;
  const double step = theta_[index + 1] - theta_[index];
  const CubicPiece piece =
      PieceFromSlopes(before, after, slopes_[node] * step, slopes_[node + 1] * step);
  return std::max(0.0, piece.At(part));
}

double IntensityTable::Folded(double azimuth) const {
  if (grid_.type == GoniometerType::kC) return FoldC(azimuth, symmetry_);
  azimuth = std::remainder(azimuth, 2.0 * std::numbers::pi);
  return MirrorsAzimuth(grid_.type, symmetry_) ? std::abs(azimuth) : azimuth;
}

double IntensityTable::AtPole(double azimuth, double theta, TableInterpolation way) const {
  if (MirrorsTheta(grid_.type, symmetry_)) theta = std::min(theta, std::numbers::pi - theta);
  const Found along = Locate(theta_, theta);
  const Found plane = Locate(azimuth_, Folded(azimuth));
  if (!along.inside || !plane.inside) return 0.0;
  const double before = AlongPlane(plane.index, along.index, along.part, way);
  if (plane.part == 0.0) return before;
  const double after = AlongPlane(plane.index + 1, along.index, along.part, way);
  return before + plane.part * (after - before);
}

Candela IntensityTable::Towards(const Vec3& direction, TableInterpolation way) const {
  const AboutPole place = PoleAngles(grid_.type, direction);
  return Candela(AtPole(place.azimuth, place.theta, way));
}

Candela IntensityTable::At(Radians c, Radians gamma, TableInterpolation way) const {
  if (grid_.type == GoniometerType::kC) return Candela(AtPole(c.value(), gamma.value(), way));
  return Towards(DirectionOf(GoniometerType::kC, c.value(), gamma.value()), way);
}

double IntensityTable::BendAt(std::size_t plane, std::size_t theta) const {
  double before = theta > 0 ? Node(plane, theta - 1) : 0.0;
  double step_before = theta > 0 ? theta_[theta] - theta_[theta - 1] : 0.0;
  if (theta + 1 == theta_.size()) return 0.0;
  if (theta == 0) {
    const auto beyond =
        theta_.front() <= kSameAngleRad ? Opposite(azimuth_[plane], 1) : std::nullopt;
    if (!beyond) return 0.0;
    before = *beyond;
    step_before = theta_[1] - theta_[0];
  }
  const double step = theta_[theta + 1] - theta_[theta];
  const double here = Node(plane, theta);
  const double turn = (Node(plane, theta + 1) - here) / step - (here - before) / step_before;
  return std::abs(2.0 * turn / (step + step_before));
}

double IntensityTable::ErrorAtPole(double azimuth, double theta) const {
  if (MirrorsTheta(grid_.type, symmetry_)) theta = std::min(theta, std::numbers::pi - theta);
  const Found node = Locate(theta_, theta);
  const Found plane = Locate(azimuth_, Folded(azimuth));
  if (!node.inside || !plane.inside) return 0.0;
  const bool between = plane.part > 0.0;
  double bend = 0.0;
  for (std::size_t p = plane.index; p <= plane.index + (between ? 1 : 0); ++p) {
    const std::size_t first = node.index == 0 ? 0 : node.index - 1;
    const std::size_t last = std::min(node.index + 2, theta_.size() - 1);
    for (std::size_t t = first; t <= last; ++t) bend = std::max(bend, BendAt(p, t));
  }
  const double step = theta_[node.index + 1] - theta_[node.index];
  const double along = 4.0 * node.part * (1.0 - node.part) * bend * step * step / 8.0;
  if (!between) return along;
  const double low = azimuth_[plane.index], high = azimuth_[plane.index + 1];
  const auto second = [&](double middle) {
    const auto at = [&](double a) { return AtPole(a, theta, TableInterpolation::kLinear); };
    return std::abs(at(middle - (high - low)) - 2.0 * at(middle) + at(middle + (high - low)));
  };
  const double across = std::max(second(low), second(high)) / 8.0;
  return along + 4.0 * plane.part * (1.0 - plane.part) * across;
}

Candela IntensityTable::InterpolationErrorTowards(const Vec3& direction) const {
  const AboutPole place = PoleAngles(grid_.type, direction);
  return Candela(ErrorAtPole(place.azimuth, place.theta));
}

Candela IntensityTable::InterpolationErrorAt(Radians c, Radians gamma) const {
  if (grid_.type == GoniometerType::kC) return Candela(ErrorAtPole(c.value(), gamma.value()));
  return InterpolationErrorTowards(DirectionOf(GoniometerType::kC, c.value(), gamma.value()));
}

Radians IntensityTable::LargestStep() const {
  double step = 0.0;
  for (std::size_t i = 1; i < theta_.size(); ++i) step = std::max(step, theta_[i] - theta_[i - 1]);
  return Radians(step);
}

Lumens IntensityTable::Flux(TableInterpolation way) const {
  double sum = 0.0;
  for (std::size_t p = 0; p < azimuth_.size(); ++p) {
    double width = 2.0 * std::numbers::pi;
    if (azimuth_.size() > 1) {
      const double low = azimuth_[p == 0 ? 0 : p - 1];
      const double high = azimuth_[std::min(p + 1, azimuth_.size() - 1)];
      width = 0.5 * (high - low);
    }
    const std::span<const double> plane(&values_[p * theta_.size()], theta_.size());
    const std::span<const double> slopes(&slopes_[p * theta_.size()], theta_.size());
    sum +=
        width * (way == TableInterpolation::kLinear ? SineIntegralOfLinear(theta_, plane)
                                                    : SineIntegralOfCubic(theta_, plane, slopes));
  }
  return Lumens(Copies(grid_.type, symmetry_) * sum);
}

IntensityTable IntensityTable::Scaled(double factor) const {
  IntensityTable out = *this;
  for (double& v : out.grid_.candela) v *= factor;
  for (double& v : out.values_) v *= factor;
  for (double& v : out.slopes_) v *= factor;
  out.peak_.intensity = peak_.intensity * factor;
  return out;
}

Result<IntensityTable> SampledAsTypeC(const IntensityTable& table, std::vector<double> c_deg,
                                      std::vector<double> gamma_deg, TableInterpolation way) {
  IntensityGrid grid{GoniometerType::kC, std::move(c_deg), std::move(gamma_deg), {}};
  for (const double c : grid.horizontal_deg) {
    for (const double gamma : grid.vertical_deg) {
      grid.candela.push_back(
          table.At(RadiansFromDegrees(c), RadiansFromDegrees(gamma), way).value());
    }
  }
  return IntensityTable::Make(std::move(grid), "sampled distribution");
}

}  // namespace lightcal
