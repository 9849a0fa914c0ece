// SPDX-License-Identifier: Apache-2.0
// Whatever a Konica Minolta meter sends: a reply of numbers within their digits, or bad_reply. A
// reply that is accepted was a whole frame.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/konica/frame.h"
#include "lightcal_devices/meters/konica/reading.h"
#include "require.h"

namespace {

namespace konica = lightcal::devices::konica;
using lightcal::fuzz::Require;

void CheckReading(const lightcal::Result<lightcal::devices::MeterReading>& reading) {
  if (!reading) return;
  const lightcal::Reading& r = reading->reading;
  Require(r.illuminance && std::isfinite(r.illuminance->value()) && r.illuminance->value() >= 0.0);
  Require(r.sigma_relative && *r.sigma_relative > 0.0 && *r.sigma_relative < 1.0);
  Require(!r.cct || r.cct->value() > 0.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto short_reply = konica::DecodeShortReply(bytes, 0, 40);
  Require(!short_reply || size == konica::kShortReplyBytes);
  for (const int command : {2, 8, 10}) {
    const auto reply = konica::DecodeLongReply(bytes, 0, command);
    if (!reply) {
      Require(reply.error().code == "bad_reply" && reply.error().message.size() < 100 + 4 * size);
      continue;
    }
    Require(size == konica::kLongReplyBytes);
    for (const auto& number : reply->data) {
      Require(!number || (std::abs(number->n) <= 9999 && std::isfinite(number->Value())));
    }
    CheckReading(konica::ReadingFromT10a(*reply, "konica"));
    CheckReading(konica::ReadingFromCl200a(*reply, *reply, "konica"));
  }
  return 0;
}
