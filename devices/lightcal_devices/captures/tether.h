// SPDX-License-Identifier: Apache-2.0
// Cameras on a cable or a network: found, opened, set, released, emptied. What libgphoto2 does
// stands behind this, in a module of its own (gphoto_module.cc).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"

namespace lightcal::devices {

inline constexpr std::string_view kCameraDriver = "gphoto2";
inline constexpr std::string_view kCameraTransport = "ptp";

enum class CameraAccess { kReady, kNoPermission, kBusy };

struct FoundCamera {
  std::string id;      // "gphoto2:usb:001,004"
  std::string port;    // as libgphoto2 writes it: "usb:001,004", "ptpip:192.168.1.5"
  std::string model;   // as the device names itself, "" = unknown until it is opened
  std::string serial;  // "" = unknown
  std::string usb;     // "04a9:3139", "" = not on USB
  CameraAccess access = CameraAccess::kReady;
  std::string remedy;  // what to do when it is not ready
};

// USB devices with an interface of the still image class, from sysfs: nothing is opened or sent.
[[nodiscard]] std::vector<FoundCamera> FindCameras();

// The camera that `wanted` means: an id, "gphoto2", "gphoto2:ptpip:HOST[:PORT]", or "" for the only
// one.   Fails: no_device.  Wrong usage: several fit (lists their ids), no such id.
[[nodiscard]] Result<FoundCamera> ChooseCamera(const std::vector<FoundCamera>& found,
                                               std::string_view wanted);

// One setting as the camera offers it.
struct CameraSetting {
  std::string name;                  // of libgphoto2: "shutterspeed"
  std::string current;               // one of its choices, mostly
  std::vector<std::string> choices;  // in the camera's order and words
  bool read_only = false;
};

// A picture in the camera's own memory.
struct StoredPicture {
  std::string folder;
  std::string name;
};

// Codes of a camera's failures besides those of transport.h.
namespace fault {
inline constexpr std::string_view kCardFull = "card_full";
inline constexpr std::string_view kSettingRefused = "setting_refused";
inline constexpr std::string_view kCaptureFailed = "capture_failed";
}  // namespace fault

// An open camera. A signal that comes during a call is held until the call returns, so that no
// exchange with the camera is cut in two; every call has an end of its own (libgphoto2's timeouts).
// Fails: busy, timeout, unplugged, io, besides what is named.
class TetheredCamera {
 public:
  TetheredCamera() = default;
  virtual ~TetheredCamera() = default;  // closes the session; settings stay as they are
  TetheredCamera(const TetheredCamera&) = delete;
  TetheredCamera& operator=(const TetheredCamera&) = delete;

  [[nodiscard]] virtual std::string Model() const = 0;
  // Absent: this camera has no such setting, or none with choices.
  [[nodiscard]] virtual Result<std::optional<CameraSetting>> Read(const std::string& name) = 0;
  // Fails: setting_refused.
  [[nodiscard]] virtual Result<void> Set(const std::string& name, const std::string& choice) = 0;
  // Exposes once and returns when the camera has what it made of it, `pictures` files (2: RAW with
  // JPEG), or after `patience` what there is.   Fails: card_full, capture_failed, timeout (none).
  [[nodiscard]] virtual Result<std::vector<StoredPicture>> Capture(int pictures,
                                                                   Seconds patience) = 0;
  // Writes the whole picture to `path`; of a picture that came shorter than the camera says it is,
  // fails as io. What stands at `path` after a failure is of no use.
  [[nodiscard]] virtual Result<void> Download(const StoredPicture& file,
                                              const std::string& path) = 0;
  [[nodiscard]] virtual Result<void> Delete(const StoredPicture& file) = 0;
};

// Opens lightcal_tether.so at the first call.
// Fails: no_tether_module, no_device, no_permission, busy, io.
[[nodiscard]] Result<std::unique_ptr<TetheredCamera>> OpenCamera(const FoundCamera& camera);

}  // namespace lightcal::devices
