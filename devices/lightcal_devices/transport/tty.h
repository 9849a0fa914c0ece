// SPDX-License-Identifier: Apache-2.0
// Serial ports through termios: USB adapters, ports a person names, and pseudo-terminals.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

enum class Parity { kNone, kEven, kOdd };

// 9600 8N1 unless said otherwise. A character of `data_bits` 7 is masked with 0x7f as it comes in,
// because pseudo-terminals and some adapters pass eight bits whatever they are told.
struct SerialSettings {
  int baud = 9600;  // 1200 .. 230400, the usual ones
  int data_bits = 8;
  Parity parity = Parity::kNone;
  int stop_bits = 1;
  bool xon_xoff = false;
};
inline constexpr SerialSettings k9600_8N1 = {};
inline constexpr SerialSettings k9600_7E1 = {9600, 7, Parity::kEven, 1, false};
inline constexpr SerialSettings k9600_7E2 = {9600, 7, Parity::kEven, 2, false};
inline constexpr SerialSettings k19200_8N1 = {19200, 8, Parity::kNone, 1, false};
inline constexpr SerialSettings k115200_8N1 = {115200, 8, Parity::kNone, 1, false};

struct SerialPortInfo {
  std::string path;  // "/dev/ttyUSB0"
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial;     // of the adapter, "" = it has none
  bool permitted = true;  // its file lets us read and write
};

// The serial ports that hang on USB, sorted by path; ports without a USB id are never listed. Ids
// come from sysfs. No port is opened: opening one raises DTR, which resets an Arduino.
[[nodiscard]] std::vector<SerialPortInfo> ListSerialPorts();

// Opens and locks the port for this program alone (flock, and TIOCEXCL against programs that do not
// ask for locks), sets it raw and forgets what it had received. The port gets its former settings
// back with the transport's end.
//   Read    waits for at least one byte and returns what is there, at most `max`; a stream has no
//           messages, so an answer may come in pieces (framing.h puts them together). A signal ends
//           the wait early, as a timeout.
//   Write   returns once the kernel has taken all bytes.
// What the port reads back as its settings is not checked: pseudo-terminals say CS8 to everything.
// Fails: no_device, no_permission, busy, io (not a serial port, a baud rate it does not know).
[[nodiscard]] Result<std::unique_ptr<Transport>> OpenTty(const std::string& path,
                                                         const SerialSettings& settings);

}  // namespace lightcal::devices
