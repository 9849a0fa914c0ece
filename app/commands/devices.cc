// SPDX-License-Identifier: Apache-2.0
// lightcal devices: the meters and cameras that are plugged in, whether we may use them, and how
// far each driver has been verified.
#include <CLI/CLI.hpp>

#include "commands.h"
#include "lightcal_devices/captures/tether.h"
#include "lightcal_devices/meters/find_meters.h"

namespace lightcal::app {
namespace {

using devices::CameraAccess;
using devices::FoundCamera;
using devices::FoundMeter;
using devices::MeterAccess;
using devices::VerifiedName;

std::string StatusName(MeterAccess access) {
  switch (access) {
    case MeterAccess::kReady:
      return "ready";
    case MeterAccess::kNoPermission:
      return "no_permission";
    case MeterAccess::kBusy:
      return "busy";
  }
  return "";
}

Node ToJson(const FoundMeter& meter) {
  const bool locked = meter.access == MeterAccess::kNoPermission;
  return {{"id", meter.id},
          {"driver", meter.row->driver},
          {"models", meter.row->models},
          {"transport", meter.row->line->name},
          {"usb", Node::UnlessEmpty(meter.usb)},
          {"serial", Node::UnlessEmpty(meter.serial)},
          {"status", StatusName(meter.access)},
          {"verified", VerifiedName(meter.row->verified)},
          {"about", meter.row->describe != nullptr ? Node(meter.row->describe(meter)) : Node()},
          {"remedy", Node::UnlessEmpty(devices::Remedy(meter))},
          {"udev_rules", locked ? Node(devices::UdevRules(*meter.row)) : Node()}};
}

std::vector<std::string> ToRow(const FoundMeter& meter) {
  std::string transport(meter.row->line->name);
  if (!meter.usb.empty()) transport += " " + meter.usb;
  return {meter.id, std::string(meter.row->models), transport, StatusName(meter.access),
          std::string(VerifiedName(meter.row->verified))};
}

// Shoots through the real libgphoto2, against a camera of ours in Python.
constexpr devices::Verified kCameraVerified = devices::Verified::kDocumentation;

std::string StatusName(CameraAccess access) {
  switch (access) {
    case CameraAccess::kReady:
      return "ready";
    case CameraAccess::kNoPermission:
      return "no_permission";
    case CameraAccess::kBusy:
      return "busy";
  }
  return "";
}

Node ToJson(const FoundCamera& camera) {
  return {{"id", camera.id},
          {"driver", devices::kCameraDriver},
          {"models", camera.model},
          {"transport", devices::kCameraTransport},
          {"usb", camera.usb},
          {"serial", Node::UnlessEmpty(camera.serial)},
          {"status", StatusName(camera.access)},
          {"verified", VerifiedName(kCameraVerified)},
          {"remedy", Node::UnlessEmpty(camera.remedy)}};
}

std::vector<std::string> ToRow(const FoundCamera& camera) {
  return {camera.id, camera.model, std::string(devices::kCameraTransport) + " " + camera.usb,
          StatusName(camera.access), std::string(VerifiedName(kCameraVerified))};
}

// What there is to know besides, and what stands between the person and a reading.
std::string Remedies(const std::vector<FoundMeter>& found,
                     const std::vector<FoundCamera>& cameras) {
  std::string text;
  for (const FoundCamera& camera : cameras) {
    if (!camera.remedy.empty()) text += "\n" + camera.id + ": " + camera.remedy + "\n";
  }
  for (const FoundMeter& meter : found) {
    if (meter.row->describe != nullptr) {
      text += "\n" + meter.id + ": " + meter.row->describe(meter) + "\n";
    }
    const std::string remedy = devices::Remedy(meter);
    if (!remedy.empty()) text += "\n" + meter.id + ": " + remedy + "\n";
  }
  return text;
}

// Every driver, so that a person learns what could be plugged in.
std::string KnownMeters() {
  std::vector<std::vector<std::string>> rows;
  for (const devices::MeterRow& row : devices::MeterTable()) {
    rows.push_back({std::string(row.driver), std::string(row.models), std::string(row.line->name),
                    std::string(VerifiedName(row.verified))});
  }
  return TextTable({"driver", "models", "transport", "verified"}, rows);
}

std::string NothingFound() {
  return "No meter found, and no camera. lightcal knows:\n\n" + KnownMeters() +
         "\nand the cameras that libgphoto2 knows. Plug one in and switch it on. Any other meter: "
         "type what it shows,\n"
         "  lightcal read -s SESSION --light NAME --distance 0.5m --lux 192\n";
}

Result<void> RunDevices(Console& console) {
  const auto found = devices::FindMeters();
  if (!found) return tl::unexpected(found.error());
  std::vector<Node> devices;
  std::vector<std::vector<std::string>> rows;
  for (const FoundMeter& meter : *found) {
    devices.push_back(ToJson(meter));
    rows.push_back(ToRow(meter));
  }
  const std::vector<FoundCamera> cameras = devices::FindCameras();
  for (const FoundCamera& camera : cameras) {
    devices.push_back(ToJson(camera));
    rows.push_back(ToRow(camera));
  }
  if (rows.empty()) {
    console.Print(NothingFound());
  } else {
    console.Print(TextTable({"id", "models", "transport", "status", "verified"}, rows));
    console.Print(Remedies(*found, cameras));
  }
  console.PrintDocument({{"devices", devices}});
  return {};
}

}  // namespace

Run BuildDevices(CLI::App& /*parser*/) { return RunDevices; }

}  // namespace lightcal::app
