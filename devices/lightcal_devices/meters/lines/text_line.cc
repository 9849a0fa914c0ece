// SPDX-License-Identifier: Apache-2.0
// Sources of text: whatever a person names, and the person. None is ever found.
#include <optional>
#include <utility>

#include "lightcal_devices/meters/lines.h"
#include "lightcal_devices/transport/text.h"

namespace lightcal::devices {
namespace {

Result<std::vector<FoundMeter>> FindNone(const MeterRow& /*row*/) {
  return std::vector<FoundMeter>();
}

Result<std::unique_ptr<Transport>> OpenSource(const FoundMeter& meter) {
  return OpenTextSource(meter.address);
}

// "typed:192lx" says it once and then has no more to say.
Result<std::unique_ptr<Transport>> OpenGivenText(const FoundMeter& meter) {
  return OpenTyped([text = std::optional<std::string>(meter.address)]() mutable {
    return std::exchange(text, std::nullopt);
  });
}

std::string NoRule(UsbId /*id*/) { return ""; }

}  // namespace

const MeterLine kTextLine = {
    .name = "text",
    .find = FindNone,
    .open = OpenSource,
    .udev_rule = NoRule,
    .takes_address = true,
    .tells_meters_apart = false,
    .permission_remedy =
        "join the group dialout (sudo usermod -aG dialout $USER, then log in anew), or give "
        "yourself the right to read and write the FIFO"};

const MeterLine kTypedLine = {.name = "typed",
                              .find = FindNone,
                              .open = OpenGivenText,
                              .udev_rule = NoRule,
                              .takes_address = true,
                              .tells_meters_apart = false,
                              .permission_remedy = ""};

}  // namespace lightcal::devices
