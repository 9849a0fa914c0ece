// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tty.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/transport/file_descriptor.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr const char* kTtyClass = "/sys/class/tty";
constexpr int kDeepestSysfs = 12;  // from a port up to the USB device it hangs on

struct Speed {
  int baud;
  speed_t code;
};
constexpr std::array<Speed, 9> kSpeeds = {{{1200, B1200},
                                           {2400, B2400},
                                           {4800, B4800},
                                           {9600, B9600},
                                           {19200, B19200},
                                           {38400, B38400},
                                           {57600, B57600},
                                           {115200, B115200},
                                           {230400, B230400}}};

std::string PortName(const std::string& path) { return "serial port " + path; }

tl::unexpected<Error> PortError(int code, const std::string& path) {
  const std::string name = PortName(path);
  switch (code) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
    case ENOTDIR:
      return Failed(std::string(fault::kNoDevice), name,
                    "no such port; plug the adapter in, or see `ls /dev/ttyUSB* /dev/ttyACM*`");
    case EACCES:
    case EPERM:
      return Failed(std::string(fault::kNoPermission), name,
                    "you may not open this port; join the group dialout (sudo usermod -aG dialout "
                    "$USER, then log in anew)");
    case EBUSY:
    case EWOULDBLOCK:
      return Failed(std::string(fault::kBusy), name,
                    "another program holds this port; close it (a terminal program, another "
                    "lightcal, or ModemManager for some seconds after plugging in) and try again");
    default:
      return Failed(std::string(fault::kIo), name, std::strerror(code));
  }
}

tl::unexpected<Error> Unplugged(const std::string& name) {
  return Failed(std::string(fault::kUnplugged), name,
                "unplugged during the dialogue; plug it in and try again");
}

std::string FirstLine(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::erase_if(line, [](char c) { return c < ' ' || c > '~'; });
  return std::string(TrimBlanks(line));
}

std::optional<std::uint16_t> HexadecimalId(const std::filesystem::path& file) {
  const std::string text = FirstLine(file);
  std::uint16_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id, 16);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return id;
}

// Names in the directory; empty when it is not there.
std::vector<std::string> Entries(const char* directory) {
  std::vector<std::string> names;
  DIR* stream = ::opendir(directory);
  if (stream == nullptr) return names;
  while (const dirent* entry = ::readdir(stream)) {
    const std::string name = entry->d_name;
    if (!name.starts_with('.')) names.push_back(name);
  }
  ::closedir(stream);
  std::ranges::sort(names);
  return names;
}

bool MayOpen(const std::string& path) { return ::access(path.c_str(), R_OK | W_OK) == 0; }

// The USB device above a port, if any: the nearest folder with an idVendor.
std::optional<SerialPortInfo> UsbPort(const std::string& tty) {
  const std::filesystem::path link = std::filesystem::path(kTtyClass) / tty;
  std::error_code error;
  const auto target = std::filesystem::read_symlink(link, error);
  if (error || target.string().find("/virtual/") != std::string::npos) return std::nullopt;
  auto folder = (link.parent_path() / target).lexically_normal();
  for (int i = 0; i < kDeepestSysfs && folder.has_relative_path(); ++i) {
    const auto vendor = HexadecimalId(folder / "idVendor");
    const auto product = HexadecimalId(folder / "idProduct");
    if (vendor && product) {
      const std::string path = "/dev/" + tty;
      return SerialPortInfo{path, *vendor, *product, FirstLine(folder / "serial"), MayOpen(path)};
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

std::optional<speed_t> SpeedCode(int baud) {
  const auto* speed = std::ranges::find(kSpeeds, baud, &Speed::baud);
  if (speed == kSpeeds.end()) return std::nullopt;
  return speed->code;
}

void SetBit(tcflag_t& flags, tcflag_t bit, bool on) { flags = on ? (flags | bit) : (flags & ~bit); }

termios Raw(termios attributes, const SerialSettings& settings, speed_t speed) {
  ::cfmakeraw(&attributes);
  ::cfsetispeed(&attributes, speed);
  ::cfsetospeed(&attributes, speed);
  tcflag_t& control = attributes.c_cflag;
  control = (control & ~static_cast<tcflag_t>(CSIZE)) | (settings.data_bits == 7 ? CS7 : CS8);
  SetBit(control, CLOCAL | CREAD, true);
  SetBit(control, CRTSCTS, false);
  SetBit(control, CSTOPB, settings.stop_bits == 2);
  SetBit(control, PARENB, settings.parity != Parity::kNone);
  SetBit(control, PARODD, settings.parity == Parity::kOdd);
  // A character of wrong parity comes in as NUL, which no checksum forgives.
  SetBit(attributes.c_iflag, INPCK, settings.parity != Parity::kNone);
  SetBit(attributes.c_iflag, IXON | IXOFF, settings.xon_xoff);
  attributes.c_cc[VMIN] = 0;
  attributes.c_cc[VTIME] = 0;
  return attributes;
}

enum class Wait { kReady, kTimeout, kGone };

class TtyTransport final : public Transport {
 public:
  TtyTransport(FileDescriptor port, termios former, bool seven_bits, std::string name)
      : port_(std::move(port)), former_(former), seven_bits_(seven_bits), name_(std::move(name)) {}
  TtyTransport(const TtyTransport&) = delete;
  TtyTransport& operator=(const TtyTransport&) = delete;
  ~TtyTransport() override {
    ::ioctl(port_.get(), TIOCNXCL);
    ::tcsetattr(port_.get(), TCSANOW, &former_);
  }

  Result<void> Write(std::span<const std::byte> bytes, milliseconds timeout) override {
    const auto deadline = steady_clock::now() + timeout;
    while (!bytes.empty()) {
      if (const Wait wait = WaitFor(POLLOUT, deadline); wait != Wait::kReady) {
        return WaitError(wait, "takes no bytes", timeout);
      }
      const ssize_t sent = ::write(port_.get(), bytes.data(), bytes.size());
      if (sent < 0 && errno != EAGAIN && errno != EINTR) return TransferError(errno);
      bytes = bytes.subspan(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
    }
    return {};
  }

  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    const auto deadline = steady_clock::now() + timeout;
    Bytes bytes(max);
    while (true) {
      if (const Wait wait = WaitFor(POLLIN, deadline); wait != Wait::kReady) {
        return WaitError(wait, "sent nothing", timeout);
      }
      const ssize_t received = ::read(port_.get(), bytes.data(), bytes.size());
      if (received == 0) return Unplugged(name_);  // ready, and yet at its end
      if (received < 0 && errno != EAGAIN && errno != EINTR) return TransferError(errno);
      if (received < 0) continue;
      bytes.resize(static_cast<std::size_t>(received));
      if (seven_bits_) {
        for (std::byte& byte : bytes) byte &= std::byte{0x7f};
      }
      return bytes;
    }
  }

  [[nodiscard]] std::string Name() const override { return name_; }

 private:
  // A signal ends the wait, so that Ctrl-C need not wait for an answer that does not come.
  [[nodiscard]] Wait WaitFor(short what, steady_clock::time_point deadline) const {
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
    const auto wait = std::clamp<milliseconds::rep>(left.count(), 0, 86'400'000);
    pollfd port{port_.get(), what, 0};
    if (::poll(&port, 1, static_cast<int>(wait)) <= 0) return Wait::kTimeout;
    if ((port.revents & what) != 0) return Wait::kReady;
    return Wait::kGone;
  }

  tl::unexpected<Error> WaitError(Wait wait, const std::string& what, milliseconds timeout) const {
    if (wait == Wait::kGone) return Unplugged(name_);
    return Failed(std::string(fault::kTimeout), name_,
                  what + " within " + std::to_string(timeout.count()) +
                      " ms; is the meter switched on, is this its port, and is its cable one for "
                      "data?");
  }

  tl::unexpected<Error> TransferError(int code) const {
    if (code == EIO || code == ENXIO || code == ENODEV) return Unplugged(name_);
    return Failed(std::string(fault::kIo), name_, std::strerror(code));
  }

  FileDescriptor port_;
  termios former_;
  bool seven_bits_;
  std::string name_;
};

}  // namespace

std::vector<SerialPortInfo> ListSerialPorts() {
  std::vector<SerialPortInfo> ports;
  for (const std::string& tty : Entries(kTtyClass)) {
    if (auto port = UsbPort(tty)) ports.push_back(*std::move(port));
  }
  return ports;
}

Result<std::unique_ptr<Transport>> OpenTty(const std::string& path,
                                           const SerialSettings& settings) {
  const auto speed = SpeedCode(settings.baud);
  if (!speed) {
    return Failed(std::string(fault::kIo), PortName(path),
                  std::to_string(settings.baud) + " baud is no speed of serial ports");
  }
  FileDescriptor port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (port.get() < 0) return PortError(errno, path);
  if (::flock(port.get(), LOCK_EX | LOCK_NB) != 0) return PortError(errno, path);
  termios former{};
  if (::tcgetattr(port.get(), &former) != 0) {
    return Failed(std::string(fault::kIo), PortName(path), "is not a serial port");
  }
  ::ioctl(port.get(), TIOCEXCL);  // what a terminal cannot do, its lock does
  const termios raw = Raw(former, settings, *speed);
  if (::tcsetattr(port.get(), TCSANOW, &raw) != 0) return PortError(errno, path);
  ::tcflush(port.get(), TCIOFLUSH);
  return std::make_unique<TtyTransport>(std::move(port), former, settings.data_bits == 7,
                                        PortName(path));
}

}  // namespace lightcal::devices
