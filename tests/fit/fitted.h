// SPDX-License-Identifier: Apache-2.0
// A session's one light, fitted: what most tests of the fit ask for.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "lightcal/fit/fit_light.h"

namespace lightcal::test {

inline FittedLight FitOk(const Session& session, const FitSettings& settings = {}) {
  auto fitted = FitSession(session, settings);
  EXPECT_TRUE(fitted.has_value()) << fitted.error().code << " " << fitted.error().message;
  return fitted ? fitted->lights.lights.front() : FittedLight{};
}

inline const EffectReport& Effect(const FittedLight& light, const std::string& name) {
  const auto at = std::ranges::find(light.effects, name, &EffectReport::name);
  EXPECT_NE(at, light.effects.end()) << name;
  return *at;
}

}  // namespace lightcal::test
