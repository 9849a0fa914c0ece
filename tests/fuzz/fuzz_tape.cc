// SPDX-License-Identifier: Apache-2.0
// A tape that is taken is written as the same tape.
#include "lightcal_devices/transport/tape_codec.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using lightcal::fuzz::Require;
  const auto tape = lightcal::devices::TapeFromText(lightcal::fuzz::TextOf(data, size), "tape");
  if (!tape) {
    lightcal::fuzz::RequireGoodError(tape.error());
    return 0;
  }
  const std::string text = lightcal::devices::TapeToText(*tape);
  const auto again = lightcal::devices::TapeFromText(text, "tape");
  Require(again.has_value());
  Require(lightcal::devices::TapeToText(*again) == text);
  return 0;
}
