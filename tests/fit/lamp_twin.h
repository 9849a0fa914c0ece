// SPDX-License-Identifier: Apache-2.0
// A simulated lamp with known truth. It shares no code with the fit: its own inverse-square law,
// and air that the fit does not model.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "lightcal/records/session.h"

namespace lightcal::test {

struct LampTruth {
  double intensity_cd = 1000.0;
  double offset_m = 0.0;
  double ambient_lx = 0.0;
  double bounce_lx = 0.0;          // the walls' light, present whenever the lamp is on
  double extinction_per_m = 2e-4;  // clear air
};

[[nodiscard]] double TrueDirect(const LampTruth& truth, double distance_m);

// A session with one point light "lamp" whose readings carry log-normal noise of relative sigma.
class TwinSession {
 public:
  TwinSession(const LampTruth& truth, double sigma, std::uint64_t seed);
  TwinSession& On(double distance_m, double times = 1.0);  // `times`: a blunder's factor
  TwinSession& On(const std::vector<double>& distances_m);
  TwinSession& Off();
  TwinSession& ShadowCard(double distance_m);
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] Session& session() { return session_; }

 private:
  Reading& Add(double illuminance_lx);
  LampTruth truth_;
  double sigma_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Session session_;
};

// A session of hand-written readings {distance, lux} of one point light "lamp".
struct TypedReading {
  double distance_m;
  double illuminance_lx;
};
[[nodiscard]] Session TypedSession(const std::vector<TypedReading>& readings, double sigma = 0.05);

}  // namespace lightcal::test
