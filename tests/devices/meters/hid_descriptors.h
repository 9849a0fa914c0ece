// SPDX-License-Identifier: Apache-2.0
// Report descriptors of light sensors, as their bytes.
#pragma once

#include "hex_bytes.h"

namespace lightcal::test {

// The shortest: report 1, an illuminance of 32 bits times 10^-2, no more.
inline devices::Bytes TinyDescriptor() {
  return FromHex(
      "05 20 09 01 A1 01 09 41 A1 00 85 01 0A D1 04 15 00 26 FF FF 75 20 95 01 55 0E 81 02 C0 C0");
}

// ColorHugALS (hughski/colorhug-als-firmware, usb_descriptors.c), the facts of its bytes; one edit:
// the unit exponent of the illuminance is 0E (10^-2), where the published file has 08.
inline devices::Bytes ColorHugDescriptor() {
  return FromHex(
      "05 20 09 01 A1 01 09 41 A1 00 85 01 "
      // Feature report 1: connection, reporting state, power state, state, interval.
      "0A 09 03 15 00 25 01 75 08 95 01 A1 02 0A 31 08 0A 32 08 B1 00 C0 "
      "0A 16 03 15 00 25 02 A1 02 0A 40 08 0A 41 08 0A 42 08 B1 00 C0 "
      "0A 19 03 15 00 25 02 A1 02 0A 50 08 0A 51 08 0A 52 08 B1 00 C0 "
      "0A 01 02 15 00 25 06 A1 02 0A 00 08 0A 01 08 0A 02 08 0A 03 08 0A 04 08 0A 05 08 0A 06 08 "
      "B1 00 C0 "
      "0A 0E 03 15 00 27 FF FF FF FF 75 20 55 00 B1 02 "
      // Input report 1: state, event, illuminance.
      "05 20 0A 01 02 15 00 25 05 75 08 95 01 A1 02 0A 00 08 0A 01 08 0A 02 08 0A 03 08 0A 05 08 "
      "0A 06 08 81 00 C0 "
      "0A 02 02 15 00 25 04 A1 02 0A 10 08 0A 11 08 0A 12 08 0A 13 08 0A 14 08 81 00 C0 "
      "0A D1 04 15 00 26 FF FF 75 20 55 0E 81 02 "
      // The maker's own reports 2 and 3.
      "06 C0 FF 09 02 A1 01 85 02 09 01 09 0D 09 03 95 03 B1 22 09 05 75 10 95 01 B1 22 C0 "
      "09 03 A1 01 85 03 09 30 75 08 95 01 B1 22 09 07 75 30 95 01 B1 22 09 0B 75 20 B1 22 "
      "09 24 09 28 75 08 95 02 C0 C0 C0");
}

// A laptop's sensor hub after AMD's: illuminance times 10^-1, then colour temperature and x, y with
// the exponent 0, 32 bits each, in report 4.
inline devices::Bytes AmdDescriptor() {
  return FromHex(
      "05 20 09 41 A1 00 85 04 15 00 27 FF FF FF FF 75 20 95 01 "
      "55 0F 0A D1 04 81 02 55 00 0A D2 04 81 02 0A D4 04 81 02 0A D5 04 81 02 C0");
}

}  // namespace lightcal::test
