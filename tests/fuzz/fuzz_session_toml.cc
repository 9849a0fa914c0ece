// SPDX-License-Identifier: Apache-2.0
// A session.toml that is taken holds only what the verbs may rely on.
#include <cmath>

#include "lightcal/records/session_codec.h"
#include "require.h"

namespace {

using lightcal::fuzz::Require;

void RequireReading(const lightcal::Session& session, const lightcal::Reading& reading) {
  Require(lightcal::FindLight(session, reading.light) != nullptr);
  const double sigma = lightcal::SigmaRelative(session, reading);
  Require(sigma > 0.0 && sigma < 1.0);
  if (reading.distance) Require(reading.distance->value() > 0.0);
  if (reading.illuminance) Require(reading.illuminance->value() >= 0.0);
  Require(std::isfinite(reading.tilt.value()));
  const auto again = lightcal::ReadingFromJson(lightcal::ReadingToJson(reading), "line");
  Require(again.has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto session =
      lightcal::ParseSessionToml(lightcal::fuzz::TextOf(data, size), "session.toml");
  if (!session) {
    lightcal::fuzz::RequireGoodError(session.error());
    return 0;
  }
  Require(!session->lights.empty());
  for (const auto& light : session->lights) {
    Require(!light.name.empty());
    if (light.aim) Require(std::abs(lightcal::Length(*light.aim) - 1.0) < 1e-12);
  }
  for (const auto& row : session->readings) RequireReading(*session, row.reading);
  return 0;
}
