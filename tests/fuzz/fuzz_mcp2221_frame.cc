// SPDX-License-Identifier: Apache-2.0
// Whatever a bridge and the chips behind it send: each decoder answers within its range or refuses.
#include <cmath>
#include <span>

#include "lightcal_devices/meters/i2c_sensors/bh1750.h"
#include "lightcal_devices/meters/i2c_sensors/opt3001.h"
#include "lightcal_devices/meters/i2c_sensors/opt4048.h"
#include "lightcal_devices/meters/i2c_sensors/veml7700.h"
#include "lightcal_devices/meters/mcp2221/frame.h"
#include "require.h"

namespace {

using lightcal::fuzz::Require;
namespace mcp2221 = lightcal::devices::mcp2221;
namespace i2c = lightcal::devices::i2c;

void CheckLight(const i2c::SensorLight& light) {
  Require(std::isfinite(light.illuminance_lx) && light.illuminance_lx > 0.0);
  Require(light.illuminance_lx < 2e5 && light.step_lx > 0.0);
  Require(!(light.over_range && light.under_range));
  if (!light.xy) return;
  Require(light.xy->x > 0.0 && light.xy->y > 0.0 && light.xy->x + light.xy->y < 1.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  static_cast<void>(mcp2221::DecodeStatus(bytes));
  static_cast<void>(mcp2221::DecodeAcceptance(bytes, mcp2221::Command::kWrite));
  const auto fetched = mcp2221::DecodeFetched(bytes);
  if (fetched && *fetched) Require((*fetched)->size() <= mcp2221::kMostDataBytes);
  if (const auto light = i2c::bh1750::Decode(bytes)) CheckLight(*light);
  if (const auto channels = i2c::opt4048::DecodeChannels(bytes)) {
    CheckLight(i2c::opt4048::LightFromChannels(*channels, 0x0004));
  }
  if (size < 4) return 0;
  const auto first = static_cast<std::uint16_t>(data[0] << 8U | data[1]);
  const auto second = static_cast<std::uint16_t>(data[2] << 8U | data[3]);
  if (const auto light = i2c::opt3001::Decode(first, second)) CheckLight(*light);
  const auto& settings = i2c::veml7700::kSettings;
  CheckLight(i2c::veml7700::Decode(first, settings[second % settings.size()]));
  return 0;
}
