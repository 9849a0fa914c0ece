// SPDX-License-Identifier: Apache-2.0
// lightcal devices: the meters that are plugged in, whether we may use them, and how far each
// driver has been verified.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "lightcal_devices/meters/find_meters.h"

namespace lightcal::app {
namespace {

std::string StatusName(UsbAccess access) {
  switch (access) {
    case UsbAccess::kReady:
      return "ready";
    case UsbAccess::kNoPermission:
      return "no_permission";
    case UsbAccess::kBusy:
      return "busy";
  }
  return "";
}

nlohmann::ordered_json ToJson(const FoundMeter& meter) {
  nlohmann::ordered_json json = {{"id", meter.id},
                                 {"driver", meter.row->driver},
                                 {"models", meter.row->models},
                                 {"transport", LineName(meter.row->line)},
                                 {"usb", UsbIdText(meter.usb.vendor, meter.usb.product)}};
  if (!meter.usb.serial.empty()) json["serial"] = meter.usb.serial;
  json["status"] = StatusName(meter.usb.access);
  json["verified"] = VerifiedName(meter.row->verified);
  if (meter.usb.access == UsbAccess::kNoPermission) json["udev_rule"] = UdevRule(*meter.row);
  return json;
}

std::vector<std::string> ToRow(const FoundMeter& meter) {
  return {
      meter.id, std::string(meter.row->models),
      std::string(LineName(meter.row->line)) + " " + UsbIdText(meter.usb.vendor, meter.usb.product),
      StatusName(meter.usb.access), std::string(VerifiedName(meter.row->verified))};
}

// What stands between the person and a reading, for each meter that is not ready.
std::string Remedies(const std::vector<FoundMeter>& found) {
  std::string text;
  for (const FoundMeter& meter : found) {
    if (meter.usb.access == UsbAccess::kNoPermission) {
      text += "\n" + meter.id +
              ": you may not open it yet. Put this line into /etc/udev/rules.d/70-lightcal.rules, "
              "run\n`sudo udevadm control --reload`, and plug the meter in again:\n" +
              UdevRule(*meter.row) + "\n";
    } else if (meter.usb.access == UsbAccess::kBusy) {
      text += "\n" + meter.id + ": another program holds it; close that program.\n";
    }
  }
  return text;
}

std::string NothingFound() {
  std::string text = "No meter found. lightcal knows:\n";
  for (const MeterRow& row : MeterTable()) {
    text += "  " + std::string(row.driver) + "  " + std::string(row.models) + "  (" +
            std::string(LineName(row.line)) + " " + UsbIdText(row.usb_vendor, row.usb_product) +
            ", verified: " + std::string(VerifiedName(row.verified)) + ")\n";
  }
  return text +
         "Plug one in and switch it on. Any other meter: type what it shows,\n"
         "  lightcal read -s SESSION --light NAME --distance 0.5m --lux 192\n";
}

Result<void> RunDevices(Console& console) {
  const auto found = FindMeters();
  if (!found) return tl::unexpected(found.error());
  nlohmann::ordered_json document = {{"devices", nlohmann::ordered_json::array()}};
  std::vector<std::vector<std::string>> rows;
  for (const FoundMeter& meter : *found) {
    document["devices"].push_back(ToJson(meter));
    rows.push_back(ToRow(meter));
  }
  if (found->empty()) {
    console.Print(NothingFound());
  } else {
    console.Print(TextTable({"id", "models", "transport", "status", "verified"}, rows));
    console.Print(Remedies(*found));
  }
  console.PrintJson(document);
  return {};
}

}  // namespace

Run BuildDevices(CLI::App& /*parser*/) { return RunDevices; }

}  // namespace lightcal::app
