// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/find_meters.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <thread>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"

namespace lightcal::devices {
namespace {

std::string DriverOf(std::string_view wanted) {
  return std::string(wanted.substr(0, wanted.find(':')));
}

tl::unexpected<Error> UnknownDriver(std::string_view wanted) {
  std::vector<std::string_view> names;
  for (const MeterRow& row : MeterTable()) names.push_back(row.driver);
  const std::string nearest = NearestWord(DriverOf(wanted), names);
  std::string message = "no such device or driver";
  if (!nearest.empty()) message += "; did you mean " + nearest + "?";
  return WrongUsage("{meter.device} " + std::string(wanted), message + " (see {FindMeters})");
}

tl::unexpected<Error> NotThere(std::string_view wanted) {
  return Failed(std::string(fault::kNoDevice), std::string(wanted),
                "none is plugged in; plug it in and switch it on");
}

// A meter whose line is opened by an address nobody had to find: "konica:/dev/ttyUSB1".
std::optional<FoundMeter> Addressed(std::string_view wanted) {
  const auto colon = wanted.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const MeterRow* row = FindDriver(DriverOf(wanted));
  if (row == nullptr || !row->line->takes_address) return std::nullopt;
  FoundMeter meter;
  meter.row = row;
  meter.id = wanted;
  meter.address = wanted.substr(colon + 1);
  return meter;
}

tl::unexpected<Error> Several(const std::vector<FoundMeter>& fitting) {
  return WrongUsage("{meter.device}", "several meters are plugged in; name one of " +
                                          Joined(fitting, ", ", &FoundMeter::id));
}

// Whether the folder of `inner` lies within that of `outer`.
bool IsWithin(const FoundMeter& inner, const FoundMeter& outer) {
  return !outer.sysfs_parent.empty() && inner.sysfs_parent.starts_with(outer.sysfs_parent + "/");
}

// Of two drivers that found the same device, the one nearer to the sensor is kept: the kernel's own
// before raw HID.
void DropTwins(std::vector<FoundMeter>& found) {
  const std::vector<FoundMeter> all = found;
  std::erase_if(found, [&](const FoundMeter& meter) {
    return std::ranges::any_of(all,
                               [&](const FoundMeter& other) { return IsWithin(other, meter); });
  });
}

}  // namespace

Result<std::vector<FoundMeter>> FindMeters() {
  std::vector<FoundMeter> found;
  for (const MeterRow& row : MeterTable()) {
    auto meters = row.line->find(row);
    if (!meters) return meters;
    for (FoundMeter& meter : *meters) {
      const std::string& which = meter.serial.empty() ? meter.address : meter.serial;
      meter.id = std::string(row.driver) + ":" + which;
      found.push_back(std::move(meter));
    }
  }
  DropTwins(found);
  return found;
}

Result<FoundMeter> ChooseMeter(const std::vector<FoundMeter>& found, std::string_view wanted) {
  if (!wanted.empty() && FindDriver(DriverOf(wanted)) == nullptr) return UnknownDriver(wanted);
  std::vector<FoundMeter> fitting;
  std::ranges::copy_if(found, std::back_inserter(fitting), [&](const FoundMeter& meter) {
    if (wanted.empty()) return meter.row->line->tells_meters_apart;
    return meter.id == wanted || meter.row->driver == wanted;
  });
  if (fitting.size() == 1) return fitting.front();
  if (!fitting.empty()) return Several(fitting);
  if (const auto meter = Addressed(wanted)) return *meter;
  return NotThere(wanted.empty() ? "meter" : wanted);
}

std::string Remedy(const FoundMeter& meter) {
  if (meter.access == MeterAccess::kReady || !meter.remedy.empty()) return meter.remedy;
  if (meter.access == MeterAccess::kBusy) return "another program holds it; close that program";
  std::string text = "you may not open this meter; ";
  const std::string_view without_rule = meter.row->line->permission_remedy;
  text += without_rule;
  const auto rules = UdevRules(*meter.row);
  if (rules.empty()) return text;
  if (!without_rule.empty()) text += ", or ";
  text +=
      "put this line into /etc/udev/rules.d/70-lightcal.rules, run "
      "`sudo udevadm control --reload`, and plug it in again:";
  for (const std::string& rule : rules) text += "\n" + rule;
  return text;
}

Result<std::unique_ptr<Transport>> OpenMeter(const FoundMeter& meter,
                                             std::chrono::milliseconds pause) {
  const MeterLine& meter_line = *meter.row->line;
  auto line = meter_line.open(meter);
  for (int retry = 0; retry < kBusyRetries && !line && line.error().code == fault::kBusy; ++retry) {
    std::this_thread::sleep_for(pause);
    line = meter_line.open(meter);
  }
  if (line) return line;
  Error error = line.error();
  error.subject = meter.id;
  if (error.code == fault::kNoPermission) {
    FoundMeter forbidden = meter;
    forbidden.access = MeterAccess::kNoPermission;
    error.message = Remedy(forbidden);
  }
  return tl::unexpected(std::move(error));
}

}  // namespace lightcal::devices
