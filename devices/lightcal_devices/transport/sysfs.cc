// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/sysfs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;

bool IsFolder(const std::string& path) {
  struct stat info = {};
  return ::stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode);
}

tl::unexpected<Error> SysfsError(int error, const std::string& folder,
                                 const std::string& attribute) {
  const std::string path = folder + "/" + attribute;
  const bool gone = error == ENODEV || error == ENXIO || !IsFolder(folder);
  if (gone) {
    return Failed(std::string(fault::kUnplugged), folder,
                  "the device is gone; plug it in and try again");
  }
  switch (error) {
    case ENOENT:
      return Failed(std::string(fault::kNoAttribute), path, "the device has no such attribute");
    case EACCES:
    case EPERM:
      return Failed(std::string(fault::kNoPermission), path, "you may not read this attribute");
    case EBUSY:
      return Failed(std::string(fault::kBusy), path,
                    "another program uses the sensor; close it and try again");
    case ETIMEDOUT:
    case EAGAIN:
      return Failed(std::string(fault::kTimeout), path,
                    "the sensor did not answer the kernel; try again");
    default:
      return Failed(std::string(fault::kIo), path, std::strerror(error));
  }
}

// At most `max` bytes of an attribute.
Result<Bytes> Content(const std::string& folder, const std::string& attribute, std::size_t max) {
  const int fd = ::open((folder + "/" + attribute).c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return SysfsError(errno, folder, attribute);
  Bytes bytes(std::min(max, kSysfsAttributeBytes));
  std::size_t filled = 0;
  ssize_t got = 1;
  while (got > 0 && filled < bytes.size()) {
    got = ::read(fd, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) {
      got = 1;
      continue;
    }
    if (got > 0) filled += static_cast<std::size_t>(got);
  }
  const int error = got < 0 ? errno : 0;
  ::close(fd);
  if (error != 0) return SysfsError(error, folder, attribute);
  bytes.resize(filled);
  return bytes;
}

std::string AttributeOr(const std::string& folder, std::string_view attribute) {
  auto text = ReadSysfsAttribute(folder, attribute).value_or("");
  std::erase_if(text, [](char c) { return c < ' ' || c > '~'; });
  return text;
}

template <class Unsigned>
std::optional<Unsigned> UnsignedAttribute(const std::string& folder, std::string_view attribute,
                                          int base) {
  const std::string text = AttributeOr(folder, attribute);
  Unsigned value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string ThreeDigits(unsigned number) {
  const std::string text = std::to_string(number);
  return std::string(text.size() < 3 ? 3 - text.size() : 0, '0') + text;
}

std::optional<SysfsUsbInterface> UsbInterfaceOf(const std::string& folder) {
  const auto device_class = UnsignedAttribute<std::uint8_t>(folder, "bInterfaceClass", 16);
  const auto subclass = UnsignedAttribute<std::uint8_t>(folder, "bInterfaceSubClass", 16);
  if (!device_class || !subclass) return std::nullopt;
  std::error_code none;
  const auto driver = std::filesystem::read_symlink(folder + "/driver", none);
  return SysfsUsbInterface{*device_class, *subclass, driver.filename().string()};
}

// Absent where the folder is an interface, which has no id.
std::optional<SysfsUsbDevice> UsbDeviceOf(const std::string& folder) {
  const auto vendor = UnsignedAttribute<std::uint16_t>(folder, "idVendor", 16);
  const auto product = UnsignedAttribute<std::uint16_t>(folder, "idProduct", 16);
  const auto bus = UnsignedAttribute<unsigned>(folder, "busnum", 10);
  const auto number = UnsignedAttribute<unsigned>(folder, "devnum", 10);
  if (!vendor || !product) return std::nullopt;
  SysfsUsbDevice device;
  device.vendor = *vendor;
  device.product = *product;
  device.name = AttributeOr(folder, "product");
  device.serial = AttributeOr(folder, "serial");
  if (bus && number) device.node = "/dev/bus/usb/" + ThreeDigits(*bus) + "/" + ThreeDigits(*number);
  return device;
}

class SysfsTransport final : public Transport {
 public:
  explicit SysfsTransport(std::string folder) : folder_(std::move(folder)) {}

  Result<void> Write(std::span<const std::byte> bytes, milliseconds /*timeout*/) override {
    const std::string name(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (name.empty() || name.find_first_of(std::string_view("/\0", 2)) != std::string::npos ||
        name.starts_with('.')) {
      return Failed(std::string(fault::kNoAttribute), Name(),
                    EscapedName(name) + " is no attribute of the device");
    }
    attribute_ = name;
    return {};
  }

  Result<Bytes> Read(std::size_t max, milliseconds /*timeout*/) override {
    if (attribute_.empty()) {
      return Failed(std::string(fault::kIo), Name(), "no attribute was chosen");
    }
    return Content(folder_, attribute_, max);
  }

  [[nodiscard]] std::string Name() const override { return "sysfs " + folder_; }

 private:
  static std::string EscapedName(std::string name) {
    std::erase_if(name, [](char c) { return c < ' ' || c > '~'; });
    return "\"" + name + "\"";
  }

  std::string folder_;
  std::string attribute_;
};

}  // namespace

std::unique_ptr<Transport> OpenSysfs(const std::string& folder) {
  return std::make_unique<SysfsTransport>(folder);
}

Result<std::string> ReadSysfsAttribute(const std::string& folder, std::string_view attribute) {
  const auto bytes = Content(folder, std::string(attribute), kSysfsAttributeBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::vector<SysfsUsbDevice> UsbDevicesInSysfs() {
  std::vector<SysfsUsbDevice> devices;
  const std::vector<std::string> folders = FoldersIn(std::string(kUsbDevicesInSysfs));
  for (const std::string& folder : folders) {
    auto device = UsbDeviceOf(folder);
    if (!device) continue;
    for (const std::string& other : folders) {
      if (!other.starts_with(folder + ":")) continue;
      if (auto part = UsbInterfaceOf(other)) device->interfaces.push_back(*std::move(part));
    }
    devices.push_back(*std::move(device));
  }
  return devices;
}

std::vector<std::string> FoldersIn(const std::string& path) {
  std::vector<std::string> folders;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(path, ignored)) {
    folders.push_back(entry.path().string());
  }
  std::ranges::sort(folders);
  return folders;
}

}  // namespace lightcal::devices
