// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/usb.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;

struct ContextDeleter {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
using Context = std::unique_ptr<libusb_context, ContextDeleter>;

struct HandleDeleter {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using Handle = std::unique_ptr<libusb_device_handle, HandleDeleter>;

struct DeviceDeleter {
  void operator()(libusb_device* device) const { libusb_unref_device(device); }
};
using Device = std::unique_ptr<libusb_device, DeviceDeleter>;

struct ConfigDeleter {
  void operator()(libusb_config_descriptor* config) const { libusb_free_config_descriptor(config); }
};
using Config = std::unique_ptr<libusb_config_descriptor, ConfigDeleter>;

struct EndpointPair {
  int interface_number = 0;
  unsigned char type = LIBUSB_TRANSFER_TYPE_BULK;  // of both
  unsigned char in = 0;
  unsigned char out = 0;
};

tl::unexpected<Error> UsbError(int status, const std::string& name, milliseconds timeout) {
  switch (status) {
    case LIBUSB_ERROR_TIMEOUT:
      return Failed(std::string(fault::kTimeout), name,
                    "no answer within " + std::to_string(timeout.count()) +
                        " ms; is it switched on and past its start-up screen?");
    case LIBUSB_ERROR_PIPE:
      return Failed(std::string(fault::kStalled), name,
                    "the instrument refused the transfer (stall); try again, then switch it off "
                    "and on");
    case LIBUSB_ERROR_NO_DEVICE:
      return Failed(std::string(fault::kUnplugged), name,
                    "unplugged during the dialogue; plug it in and try again");
    case LIBUSB_ERROR_NOT_FOUND:
      return Failed(std::string(fault::kNoDevice), name, "no such device; is it plugged in?");
    case LIBUSB_ERROR_ACCESS:
      return Failed(std::string(fault::kNoPermission), name,
                    "you may not open this device; `{FindMeters}` prints the udev rule that "
                    "allows it");
    case LIBUSB_ERROR_BUSY:
      return Failed(std::string(fault::kBusy), name,
                    "another program holds this device; close it and try again");
    default:
      return Failed(
          std::string(fault::kIo), name,
          std::string("USB: ") + libusb_strerror(status) + " (" + libusb_error_name(status) + ")");
  }
}

Context NewContext() {
  libusb_context* context = nullptr;
  if (libusb_init(&context) != LIBUSB_SUCCESS) return nullptr;
  libusb_set_option(context, LIBUSB_OPTION_LOG_LEVEL, LIBUSB_LOG_LEVEL_NONE);
  return Context(context);
}

std::vector<Device> AllDevices(libusb_context* context) {
  libusb_device** list = nullptr;
  const ssize_t count = libusb_get_device_list(context, &list);
  std::vector<Device> devices;
  devices.reserve(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  for (ssize_t i = 0; i < count; ++i) devices.emplace_back(list[i]);
  if (count >= 0) libusb_free_device_list(list, 0);
  return devices;
}

bool HasId(libusb_device* device, std::uint16_t vendor, std::uint16_t product) {
  libusb_device_descriptor descriptor{};
  return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS &&
         descriptor.idVendor == vendor && descriptor.idProduct == product;
}

std::string PortPath(libusb_device* device) {
  std::array<std::uint8_t, 7> ports{};  // USB 3.0: at most 7 tiers
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string path = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) path += (i == 0 ? "-" : ".") + std::to_string(ports[i]);
  return path;
}

// The kernel reads the serial number when the device is plugged in; asking sysfs needs neither
// permission nor traffic on the wire.
std::string SerialFromSysfs(const std::string& port) {
  std::ifstream stream("/sys/bus/usb/devices/" + port + "/serial");
  std::string line;
  std::getline(stream, line);
  std::erase_if(line, [](char c) { return c < ' ' || c > '~'; });
  return std::string(TrimBlanks(line));
}

// IN and OUT of one type in an interface's first setting.
std::optional<EndpointPair> PairOf(const libusb_interface_descriptor& setting, unsigned char type) {
  EndpointPair pair{setting.bInterfaceNumber, type, 0, 0};
  for (int e = 0; e < setting.bNumEndpoints; ++e) {
    const libusb_endpoint_descriptor& endpoint = setting.endpoint[e];
    if ((endpoint.bmAttributes & 0x03U) != type) continue;
    const bool is_in = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0;
    unsigned char& slot = is_in ? pair.in : pair.out;
    if (slot == 0) slot = endpoint.bEndpointAddress;
  }
  if (pair.in == 0 || pair.out == 0) return std::nullopt;
  return pair;
}

std::optional<EndpointPair> FindPair(libusb_device* device) {
  libusb_config_descriptor* raw = nullptr;
  if (libusb_get_active_config_descriptor(device, &raw) != LIBUSB_SUCCESS &&
      libusb_get_config_descriptor(device, 0, &raw) != LIBUSB_SUCCESS) {
    return std::nullopt;
  }
  const Config config(raw);
  for (const unsigned char type : {LIBUSB_TRANSFER_TYPE_BULK, LIBUSB_TRANSFER_TYPE_INTERRUPT}) {
    for (int i = 0; i < config->bNumInterfaces; ++i) {
      const libusb_interface& interface = config->interface[i];
      if (interface.num_altsetting == 0) continue;
      if (auto pair = PairOf(interface.altsetting[0], type)) return pair;
    }
  }
  return std::nullopt;
}

// An opened device whose interface is ours until the end of the scope.
struct Claimed {
  Handle handle;
  EndpointPair pair;

  Claimed(Handle opened, EndpointPair endpoints) : handle(std::move(opened)), pair(endpoints) {}
  Claimed(Claimed&&) = default;
  Claimed& operator=(Claimed&&) = delete;
  Claimed(const Claimed&) = delete;
  Claimed& operator=(const Claimed&) = delete;
  ~Claimed() {
    if (handle) libusb_release_interface(handle.get(), pair.interface_number);
  }
};

Result<Claimed> Claim(libusb_device* device, const std::string& name) {
  libusb_device_handle* raw = nullptr;
  if (const int status = libusb_open(device, &raw); status != LIBUSB_SUCCESS) {
    return UsbError(status, name, milliseconds(0));
  }
  Handle handle(raw);
  const auto pair = FindPair(device);
  if (!pair) {
    return Failed(std::string(fault::kIo), name,
                  "has no interface with a bulk or interrupt endpoint each way; this is not the "
                  "instrument the id promises");
  }
  if (const int status = libusb_claim_interface(raw, pair->interface_number);
      status != LIBUSB_SUCCESS) {
    return UsbError(status, name, milliseconds(0));
  }
  return Claimed(std::move(handle), *pair);
}

std::string NameOf(const UsbDeviceInfo& info) {
  return "usb " + UsbIdText(info.vendor, info.product) + " at " + info.port;
}

UsbDeviceInfo Describe(libusb_device* device, std::uint16_t vendor, std::uint16_t product) {
  UsbDeviceInfo info;
  info.vendor = vendor;
  info.product = product;
  info.bus = libusb_get_bus_number(device);
  info.address = libusb_get_device_address(device);
  info.port = PortPath(device);
  info.serial = SerialFromSysfs(info.port);
  return info;
}

class UsbTransport final : public Transport {
 public:
  UsbTransport(Context context, Claimed claimed, std::string name)
      : context_(std::move(context)), claimed_(std::move(claimed)), name_(std::move(name)) {}

  Result<void> Write(std::span<const std::byte> bytes, milliseconds timeout) override {
    Bytes copy(bytes.begin(), bytes.end());  // libusb's buffer is not const
    int sent = 0;
    const int status = Transfer(claimed_.pair.out, copy, timeout, sent);
    if (status != LIBUSB_SUCCESS) return Fail(status, claimed_.pair.out, timeout);
    if (static_cast<std::size_t>(sent) != bytes.size()) {
      return Failed(std::string(fault::kIo), name_,
                    "took " + std::to_string(sent) + " of " + std::to_string(bytes.size()) +
                        " bytes; try again");
    }
    return {};
  }

  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    Bytes buffer(kUsbInBufferBytes);
    int received = 0;
    const int status = Transfer(claimed_.pair.in, buffer, timeout, received);
    const bool cut_short = status == LIBUSB_ERROR_TIMEOUT && received > 0;
    if (status != LIBUSB_SUCCESS && !cut_short) return Fail(status, claimed_.pair.in, timeout);
    buffer.resize(static_cast<std::size_t>(received));
    if (buffer.size() > max) {
      return Failed(std::string(fault::kIo), name_,
                    "answered " + std::to_string(buffer.size()) + " bytes where at most " +
                        std::to_string(max) + " are known");
    }
    return buffer;
  }

  [[nodiscard]] std::string Name() const override { return name_; }

 private:
  int Transfer(unsigned char endpoint, Bytes& bytes, milliseconds timeout, int& done) {
    // 0 would mean: wait for ever.
    const auto wait = static_cast<unsigned>(std::max<milliseconds::rep>(1, timeout.count()));
    const auto transfer = claimed_.pair.type == LIBUSB_TRANSFER_TYPE_INTERRUPT
                              ? libusb_interrupt_transfer
                              : libusb_bulk_transfer;
    return transfer(claimed_.handle.get(), endpoint, reinterpret_cast<unsigned char*>(bytes.data()),
                    static_cast<int>(bytes.size()), &done, wait);
  }

  tl::unexpected<Error> Fail(int status, unsigned char endpoint, milliseconds timeout) {
    if (status == LIBUSB_ERROR_PIPE) libusb_clear_halt(claimed_.handle.get(), endpoint);
    return UsbError(status, name_, timeout);
  }

  Context context_;  // outlives the handle: members are destroyed from the last to the first
  Claimed claimed_;
  std::string name_;
};

}  // namespace

std::string UsbIdText(std::uint16_t vendor, std::uint16_t product) {
  std::array<char, 10> text{};
  std::snprintf(text.data(), text.size(), "%04x:%04x", vendor, product);
  return text.data();
}

Result<std::vector<UsbDeviceInfo>> ListUsbDevices(std::uint16_t vendor, std::uint16_t product) {
  const Context context = NewContext();
  std::vector<UsbDeviceInfo> found;
  if (!context) return found;  // libusb_init fails where the machine has no USB bus at all
  for (const Device& device : AllDevices(context.get())) {
    if (!HasId(device.get(), vendor, product)) continue;
    UsbDeviceInfo info = Describe(device.get(), vendor, product);
    if (const auto claimed = Claim(device.get(), NameOf(info)); !claimed) {
      const std::string& code = claimed.error().code;
      if (code == fault::kUnplugged || code == fault::kNoDevice) continue;
      if (code != fault::kNoPermission && code != fault::kBusy) {
        return tl::unexpected(claimed.error());
      }
      info.access = code == fault::kBusy ? UsbAccess::kBusy : UsbAccess::kNoPermission;
    }
    found.push_back(std::move(info));
  }
  return found;
}

Result<std::unique_ptr<Transport>> OpenUsb(const UsbDeviceInfo& device) {
  const std::string name = NameOf(device);
  Context context = NewContext();
  if (!context) return UsbError(LIBUSB_ERROR_NOT_FOUND, name, milliseconds(0));
  for (const Device& candidate : AllDevices(context.get())) {
    if (!HasId(candidate.get(), device.vendor, device.product) ||
        libusb_get_bus_number(candidate.get()) != device.bus ||
        libusb_get_device_address(candidate.get()) != device.address) {
      continue;
    }
    auto claimed = Claim(candidate.get(), name);
    if (!claimed) return tl::unexpected(claimed.error());
    return std::make_unique<UsbTransport>(std::move(context), *std::move(claimed), name);
  }
  return UsbError(LIBUSB_ERROR_NOT_FOUND, name, milliseconds(0));
}

}  // namespace lightcal::devices
