// SPDX-License-Identifier: Apache-2.0
// One number of a lamp (ln of its light, ln of its mired, its Duv) as a function of what its
// controls say, from the states that were read.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace lightcal::fit {

// How a control's label enters.
enum class ControlKind : std::uint8_t {
  kLevel,        // 0 ... 1 of its largest: light grows with it
  kTemperature,  // kelvin, above 0
  kZoom,         // degrees of a beam, above 0: what it gathers goes with a power of it
  kOther,        // any number
};

// What the curve is of, which says how it may run between states.
enum class CurveTarget : std::uint8_t {
  kLnLight,
  kLnMired,
  kDuv,
};

struct CurvePoint {
  std::vector<double> at;  // one label a control
  double value = 0.0;
  double sd = 0.0;  // 1 sigma, its own, above 0

  [[nodiscard]] bool operator==(const CurvePoint&) const = default;
};

struct CurveValue {
  double value = 0.0;
  double sd = 0.0;  // 1 sigma
};

// Light against a level x follows  ln E = c + p ln(x + x0) + rest(x):
//   p = 1 with any x0 is a driver that dims linearly and does not end at zero;
//   p free is tungsten on a dimmer, or a dimmer with a gamma;
// or ln E = c + p x: a dimmer of equal ratios (DALI). Against a zoom's angle ln E falls as a power
// between 0 (a frame before the beam) and 2 (all light in the beam).
// Colour follows ln x by a slope, and the label of its own control one to one, as priors. `rest` is
// a Gaussian process, one a control and one of all together: of light a slope that walks along the
// label (a driver of straight pieces, whose bends are as large at 5 % as at 50 %), or, as of all
// else, Matern 3/2 (a continuous slope, so kinks cost little). x0, the sizes and the lengths of the
// rests are not chosen but averaged over, each by how probable it makes the readings (marginal
// likelihood): where states are few or a curve bends, the answers differ and the interval is wide;
// far from states it grows to the rest's size. A rest may be as large as a third of the light, so
// that a law that is none of these still passes through what was read. Source: Rasmussen and
// Williams, Gaussian Processes for Machine Learning (2006), 2.2, 2.7, 5.4.
class ControlCurve {
 public:
  // At least one point; every point of as many labels as there are kinds.
  ControlCurve(std::vector<ControlKind> kinds, CurveTarget target, std::vector<CurvePoint> points);
  ~ControlCurve();
  ControlCurve(ControlCurve&& other) noexcept;
  ControlCurve& operator=(ControlCurve&& other) noexcept;
  ControlCurve(const ControlCurve&) = delete;
  ControlCurve& operator=(const ControlCurve&) = delete;

  [[nodiscard]] CurveValue At(const std::vector<double>& labels) const;
  // Of f(a) - f(b), whose errors they share.
  [[nodiscard]] CurveValue Difference(const std::vector<double>& a,
                                      const std::vector<double>& b) const;

 private:
  struct Hypotheses;
  std::unique_ptr<Hypotheses> hypotheses_;
};

}  // namespace lightcal::fit
