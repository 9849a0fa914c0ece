// SPDX-License-Identifier: Apache-2.0
#include "capture_readings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "capture_reading.h"
#include "card_capture.h"
#include "dome_capture.h"
#include "source_capture.h"

namespace lightcal::app {
namespace {

using CaptureReadings = std::vector<CaptureReading>;

// None where the pictures tell something else of the light than how bright it is.
Result<CaptureReadings> ReadCapture(Session& session, const CaptureDescription& capture,
                                    Warnings& warnings) {
  const auto one = [](CaptureReading&& reading) { return CaptureReadings{std::move(reading)}; };
  switch (capture.use) {
    case CaptureUse::kCard:
      return ReadCard(session, capture, warnings).map(one);
    case CaptureUse::kSource:
      return ReadSource(session, capture, warnings).map(one);
    case CaptureUse::kDome:
      return ReadDomeCapture(session, capture, warnings).map(one);
    case CaptureUse::kWall:  // MeasureWalls
    case CaptureUse::kBall:  // PlaceByBalls
      return CaptureReadings{};
  }
  return Refused("capture_unsupported", capture.where, "this use is not built");
}

}  // namespace

Result<void> AddCaptureReadings(Session& session, Warnings& warnings) {
  CaptureReadings all;
  std::vector<std::string> places;
  std::map<std::pair<std::string, std::string>, int> sharing;  // captures by light and camera
  for (const CaptureDescription& capture : session.captures) {
    auto read = ReadCapture(session, capture, warnings);
    if (!read) return Propagate(std::move(read));
    for (CaptureReading& one : *read) {
      if (!one.anchored) ++sharing[{one.reading.light, one.camera}];
      all.push_back(std::move(one));
      places.push_back(capture.where);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    CaptureReading& one = all[i];
    const int others = one.anchored ? 1 : sharing[{one.reading.light, one.camera}];
    one.reading.sigma_relative =
        std::min(0.99, std::hypot(one.independent_sd, std::sqrt(others) * one.shared_sd));
    session.readings.push_back({std::move(one.reading), places[i]});
  }
  return {};
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

}  // namespace lightcal::app
