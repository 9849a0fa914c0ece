// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/hid.h"

#include <dlfcn.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "lightcal_devices/transport/hid_in_sysfs.h"
#include "lightcal_devices/transport/sysfs.h"
#include "lightcal_devices/transport/usb.h"

namespace lightcal::devices {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::string_view kHidrawClass = "/sys/class/hidraw";

// The calls of one back end.
struct HidFunctions {
  decltype(&::hid_init) init = nullptr;
  decltype(&::hid_exit) exit = nullptr;
  decltype(&::hid_enumerate) enumerate = nullptr;
  decltype(&::hid_free_enumeration) free_enumeration = nullptr;
  decltype(&::hid_open_path) open_path = nullptr;
  decltype(&::hid_close) close = nullptr;
  decltype(&::hid_write) write = nullptr;
  decltype(&::hid_read_timeout) read_timeout = nullptr;
  decltype(&::hid_get_feature_report) get_feature = nullptr;
  decltype(&::hid_send_feature_report) send_feature = nullptr;
  decltype(&::hid_get_input_report) get_input = nullptr;
};

struct LibraryCloser {
  void operator()(void* library) const { ::dlclose(library); }
};

// A back end in use; hidapi's own state ends with the last user.
class HidLibrary {
 public:
  static Result<std::shared_ptr<HidLibrary>> Use(HidBackend backend) {
    static std::mutex mutex;
    static std::array<std::weak_ptr<HidLibrary>, 2> in_use;
    const std::lock_guard lock(mutex);
    auto& slot = in_use[backend == HidBackend::kHidraw ? 0 : 1];
    if (auto library = slot.lock()) return library;
    auto opened = Open(backend == HidBackend::kHidraw ? "hidraw" : "libusb");
    if (opened) slot = *opened;
    return opened;
  }
  ~HidLibrary() { call.exit(); }
  HidLibrary(const HidLibrary&) = delete;
  HidLibrary& operator=(const HidLibrary&) = delete;

 private:
  HidLibrary() = default;

  static Result<std::shared_ptr<HidLibrary>> Open(const std::string& backend) {
    const std::string file = "libhidapi-" + backend + ".so.0";
    void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    std::unique_ptr<void, LibraryCloser> holder(handle);
    HidFunctions call;
    const bool complete =
        handle != nullptr && Find(handle, "hid_init", call.init) &&
        Find(handle, "hid_exit", call.exit) && Find(handle, "hid_enumerate", call.enumerate) &&
        Find(handle, "hid_free_enumeration", call.free_enumeration) &&
        Find(handle, "hid_open_path", call.open_path) && Find(handle, "hid_close", call.close) &&
        Find(handle, "hid_write", call.write) &&
        Find(handle, "hid_read_timeout", call.read_timeout) &&
        Find(handle, "hid_get_feature_report", call.get_feature) &&
        Find(handle, "hid_send_feature_report", call.send_feature) &&
        Find(handle, "hid_get_input_report", call.get_input);
    if (!complete || call.init() != 0) {
      return Failed(std::string(fault::kIo), file,
                    "cannot be used; install the Debian package libhidapi-" + backend + "0");
    }
    std::shared_ptr<HidLibrary> library(new HidLibrary());
    library->call = call;
    library->handle_ = std::move(holder);
    return library;
  }

  template <class Function>
  static bool Find(void* handle, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(handle, name));
    return function != nullptr;
  }

  std::unique_ptr<void, LibraryCloser> handle_;

 public:
  HidFunctions call;
};

// Printable ASCII of a string the device chose.
std::string Narrow(const wchar_t* wide) {
  std::string text;
  for (; wide != nullptr && *wide != L'\0'; ++wide) {
    if (*wide >= L' ' && *wide <= L'~') text += static_cast<char>(*wide);
  }
  return text;
}

class HidTransport final : public Transport {
 public:
  HidTransport(std::shared_ptr<HidLibrary> library, hid_device* device, HidDeviceInfo info)
      : library_(std::move(library)), device_(device), info_(std::move(info)) {}
  ~HidTransport() override { library_->call.close(device_); }
  HidTransport(const HidTransport&) = delete;
  HidTransport& operator=(const HidTransport&) = delete;

  Result<void> Write(std::span<const std::byte> bytes, milliseconds /*timeout*/) override {
    errno = 0;
    const int sent = library_->call.write(device_, Raw(bytes), bytes.size());
    if (sent >= 0) return {};
    const int error = errno;
    if (ReaderStopped()) return Gone();
    errno = error;
    return Fail("did not take an output report");
  }

  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    Bytes bytes(std::min(max, kLongestHidReport));
    const int wait = static_cast<int>(std::clamp<milliseconds::rep>(timeout.count(), 1, 3600000));
    errno = 0;
    const int got = library_->call.read_timeout(device_, Raw(bytes), bytes.size(), wait);
    if (got < 0) {
      // libusb's reader stops, and hidraw's poll hangs up without a word, only when it is gone.
      if (errno == 0 || info_.backend == HidBackend::kLibusb) return Gone();
      return Fail("gave no input report");
    }
    if (got == 0) {
      return Failed(
          std::string(fault::kTimeout), Name(),
          "no report within " + std::to_string(wait) + " ms; is it still plugged in? Try again");
    }
    bytes.resize(static_cast<std::size_t>(got));
    return bytes;
  }

  Result<Bytes> Control(std::string_view verb, std::span<const std::byte> bytes, std::size_t max,
                        milliseconds timeout) override {
    if (verb == "report_descriptor") return ReportDescriptor(max);
    if (verb == "get_feature") return Get(library_->call.get_feature, "feature", bytes, max);
    if (verb == "get_input") return Get(library_->call.get_input, "input", bytes, max);
    if (verb != "set_feature") return Transport::Control(verb, bytes, max, timeout);
    errno = 0;
    if (library_->call.send_feature(device_, Raw(bytes), bytes.size()) < 0) {
      return Fail("did not take a feature report");
    }
    return Bytes();
  }

  [[nodiscard]] std::string Name() const override {
    return "hid " + UsbIdText(info_.vendor, info_.product) + " at " + info_.path;
  }

 private:
  static const unsigned char* Raw(std::span<const std::byte> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
  }
  static unsigned char* Raw(Bytes& bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }

  // hidapi's libusb back end does not say why a write failed, but its reader stops only when the
  // device is gone.
  bool ReaderStopped() {
    if (info_.backend != HidBackend::kLibusb) return false;
    constexpr int kUntilItKnowsMs = 100;
    Bytes bytes(kLongestHidReport);
    return library_->call.read_timeout(device_, Raw(bytes), bytes.size(), kUntilItKnowsMs) < 0;
  }

  Result<Bytes> Get(decltype(&::hid_get_feature_report) get, const std::string& kind,
                    std::span<const std::byte> number, std::size_t max) {
    Bytes bytes(std::clamp<std::size_t>(max, 1, kLongestHidReport));
    bytes[0] = number.empty() ? std::byte{0} : number[0];
    errno = 0;
    const int got = get(device_, Raw(bytes), bytes.size());
    if (got < 0) return Fail("gave no " + kind + " report");
    bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(got)));
    return bytes;
  }

  Result<Bytes> ReportDescriptor(std::size_t max) const {
    if (info_.backend != HidBackend::kHidraw) {
      return Failed(std::string(fault::kIo), Name(), "its report descriptor is not in sysfs");
    }
    const fs::path node(info_.path);
    const auto line =
        OpenSysfs(std::string(kHidrawClass) + "/" + node.filename().string() + "/device");
    if (auto chosen = line->Write(AsBytes("report_descriptor"), milliseconds(0)); !chosen) {
      return tl::unexpected(chosen.error());
    }
    return line->Read(max, milliseconds(0));
  }

  [[nodiscard]] tl::unexpected<Error> Gone() const {
    return Failed(std::string(fault::kUnplugged), Name(),
                  "unplugged during the dialogue; plug it in and try again");
  }

  // After a call of hidapi failed; errno is the kernel's, 0 = it said nothing.
  [[nodiscard]] tl::unexpected<Error> Fail(const std::string& what) const {
    const int error = errno;
    const bool node_gone = ::access(info_.node.c_str(), F_OK) != 0;
    if (node_gone || error == ENODEV || error == ENXIO || error == ESHUTDOWN) return Gone();
    if (error == EPIPE) {
      return Failed(std::string(fault::kStalled), Name(), what + " (stall); try again");
    }
    if (error == ETIMEDOUT) {
      return Failed(std::string(fault::kTimeout), Name(), what + " in time; try again");
    }
    return Failed(std::string(fault::kIo), Name(),
                  what + (error == 0 ? "" : std::string(": ") + std::strerror(error)) +
                      "; unplug it, plug it in and try again");
  }

  std::shared_ptr<HidLibrary> library_;  // outlives the device
  hid_device* device_;
  HidDeviceInfo info_;
};

// Why a device that is listed could not be opened; hidapi's libusb back end gives no reason.
tl::unexpected<Error> NotOpened(const HidDeviceInfo& device) {
  const std::string name = "hid " + UsbIdText(device.vendor, device.product) + " at " + device.path;
  const int missing = ::access(device.node.c_str(), R_OK | W_OK) != 0 ? errno : 0;
  if (missing == EACCES) {
    return Failed(std::string(fault::kNoPermission), name,
                  "you may not open this device; `{FindMeters}` prints the udev rule that "
                  "allows it");
  }
  if (missing != 0) {
    return Failed(std::string(fault::kNoDevice), name, "no such device; is it plugged in?");
  }
  if (device.backend == HidBackend::kHidraw) {
    return Failed(std::string(fault::kIo), name, "hidapi could not open it; plug it in anew");
  }
  return Failed(std::string(fault::kBusy), name,
                "the interface could not be taken from " +
                    (device.kernel_driver.empty() ? "whoever holds it"
                                                  : "the kernel's driver " + device.kernel_driver) +
                    "; close the program that uses it");
}

}  // namespace

Result<std::vector<HidDeviceInfo>> ListHidraw() {
  std::vector<HidDeviceInfo> found;
  if (FoldersIn(std::string(kHidrawClass)).empty())
    return found;  // no device, no need of the library
  const auto library = HidLibrary::Use(HidBackend::kHidraw);
  if (!library) return tl::unexpected(library.error());
  hid_device_info* list = (*library)->call.enumerate(0, 0);
  for (const hid_device_info* item = list; item != nullptr; item = item->next) {
    HidDeviceInfo info;
    info.path = item->path;
    info.vendor = item->vendor_id;
    info.product = item->product_id;
    info.serial = Narrow(item->serial_number);
    info.name = Narrow(item->product_string);
    info.interface_number = item->interface_number;
    info.usage_page = item->usage_page;
    info.usage = item->usage;
    info.node = info.path;
    const std::string folder =
        std::string(kHidrawClass) + "/" + fs::path(info.path).filename().string() + "/device";
    AddKernelDevice(folder, info);
    info.access = AccessTo(info.node);
    found.push_back(std::move(info));
  }
  (*library)->call.free_enumeration(list);
  return found;
}

Result<std::unique_ptr<Transport>> OpenHid(const HidDeviceInfo& device) {
  auto library = HidLibrary::Use(device.backend);
  if (!library) return Propagate(std::move(library));
  hid_device* opened = (*library)->call.open_path(device.path.c_str());
  if (opened == nullptr) return NotOpened(device);
  return std::make_unique<HidTransport>(*std::move(library), opened, device);
}

}  // namespace lightcal::devices
