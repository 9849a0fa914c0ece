// SPDX-License-Identifier: Apache-2.0
// Hand-held lux meters that send what their display shows, and do not tell who they are: one
// dialogue, and one row a meter.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/meters/meter.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

struct DisplayProtocol {
  std::string_view driver;  // "gm1020"
  std::string_view model;   // "GM1020": what the device is called when no serial number is given
  FrameSearch search;       // its wait is the meter's time for a reply
  int most_frames = 1;      // that are listened to, as FirstDecoded does
  int most_tries = 1;       // from the first byte on, while the answer is bad_reply
  // What starts the sending, none where the meter sends unasked; and what ends it. The end is also
  // said after an error or a cancellation; where that fails a reading warns of not_restored.
  std::span<const std::byte> begin = {};
  std::span<const std::byte> end = {};
  std::size_t bytes_a_write = 64;
  Result<MeterReading> (*reading)(const Bytes& frame, const std::string& device) = nullptr;
};

// For the meter table; both outlive the meter. Identify asks nothing. Errors besides the
// transport's own: bad_reply, interrupted, and those of the protocol's `reading`.
[[nodiscard]] std::unique_ptr<Meter> MakeDisplayMeter(const DisplayProtocol& protocol,
                                                      Transport& transport,
                                                      const MeterSetup& setup);
template <const DisplayProtocol& kProtocol>
[[nodiscard]] std::unique_ptr<Meter> MakeDisplayMeter(Transport& transport,
                                                      const MeterSetup& setup) {
  return MakeDisplayMeter(kProtocol, transport, setup);
}

// The rows, in <driver>/meter.cc, with what `reading` fails of; README.md there tells the protocol.
namespace gm1020 {
extern const DisplayProtocol kProtocol;  // of two measurements a second, while it is told to
}
namespace lutron16 {
// Unasked, about once a second. Fails: wrong_unit, no_light_display (only the lower display is
// sent), negative_reading.
extern const DisplayProtocol kProtocol;
}  // namespace lutron16
namespace pce174 {
// Fails: hold (the display is held, or shows MAX, MIN, PMAX, PMIN, REL or a stored value),
// negative_reading.
extern const DisplayProtocol kProtocol;
}  // namespace pce174
namespace ut382 {
// Unasked, eight times a second. Fails: in_menu, hold (or MAX, MIN shown), overload (in a range
// chosen by hand).
extern const DisplayProtocol kProtocol;
}  // namespace ut382

}  // namespace lightcal::devices
