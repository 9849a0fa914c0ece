// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/captures/capture_readings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "lightcal/calibrate/captures/capture_reading.h"
#include "lightcal/calibrate/captures/card_capture.h"
#include "lightcal/calibrate/captures/dome_capture.h"
#include "lightcal/calibrate/captures/source_capture.h"
#include "lightcal/core/as_one.h"

namespace lightcal {
namespace {

// 1 sigma, relative, between two pictures of one camera that saw the same light: an aperture closes
// again within 5 %, f-numbers are rounded by up to 3.7 %, and cards lie here and there in the
// picture.
constexpr double kShotRepeatability = 0.03;

// What each capture's reading is off by alone, and whose scale it shares: a lux meter's with all
// that it read where one was held to the card, else its camera's with its other pictures.
void ShareScale(const Session& session, const CaptureDescription& capture, CaptureReading& one) {
  Reading& reading = one.reading;
  if (one.anchored) {
    reading.scale = AnchorScale(session, capture);
    reading.sigma_relative = std::hypot(one.independent_sd, one.shared_sd);
    return;
  }
  reading.scale = SharedScale{reading.device, one.shared_sd};
  reading.sigma_relative =
      std::min(0.99, std::hypot(one.independent_sd, kShotRepeatability, one.shared_sd));
}

// None where the pictures tell something else of the light than how bright it is.
Result<std::optional<CaptureReading>> ReadCapture(const Session& session,
                                                  const CaptureDescription& capture,
                                                  const Sources& sources, Evidence& evidence) {
  switch (capture.use) {
    case CaptureUse::kCard:
      return ReadCard(session, capture, sources, evidence);
    case CaptureUse::kSource:
      return ReadSource(session, capture, sources, evidence);
    case CaptureUse::kDome:
      return ReadDomeCapture(session, capture, sources, evidence);
    case CaptureUse::kWall:  // MeasureWalls
    case CaptureUse::kBall:  // PlaceByBalls
      return std::nullopt;
  }
  return Refused("capture_unsupported", capture.where, "this use is not built");
}

}  // namespace

Result<CaptureReadings> ReadCaptures(const Session& session, const Sources& sources,
                                     Evidence& evidence) {
  Session sized = session;
  CaptureReadings out;
  out.captures = session.captures;
  std::vector<Error> refusals;
  std::vector<std::pair<std::string, Error>> unsized;  // by light
  for (std::size_t i = 0; i < session.captures.size(); ++i) {
    const CaptureDescription& capture = session.captures[i];
    auto read = ReadCapture(sized, capture, sources, evidence);
    if (!read) {
      refusals.push_back(AtCapture(capture, std::move(read).error()).value());
      continue;
    }
    if (!*read) continue;
    CaptureReading& one = **read;
    out.captures[i].found = one.found;
    if (one.sized) {
      *std::ranges::find(sized.lights, one.sized->name, &LightDescription::name) = *one.sized;
    }
    if (one.unsized) unsized.emplace_back(capture.light, *one.unsized);
    ShareScale(session, capture, one);
    out.readings.push_back({std::move(one.reading), capture.where});
  }
  for (auto& [light, error] : unsized) {
    // Another capture may have told it.
    if (LacksSize(*FindLight(sized, light))) refusals.push_back(std::move(error));
  }
  if (!refusals.empty()) return tl::unexpected(AsOne(std::move(refusals)));
  out.lights = std::move(sized.lights);
  return out;
}

bool RestsOnCameraScale(const Session& session, const std::string& light) {
  bool any = false;
  for (const SessionReading& row : session.readings) {
    if (row.reading.light != light || !row.reading.illuminance) continue;
    if (!row.reading.device.starts_with(kCameraDevicePrefix)) return false;
    any = true;
  }
  for (const CaptureDescription& capture : session.captures) {
    if (capture.light == light && capture.anchor_illuminance) return false;
  }
  return any;
}

}  // namespace lightcal
