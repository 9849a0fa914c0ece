// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

Result<Bytes> Transport::Control(std::string_view verb, std::span<const std::byte> /*bytes*/,
                                 std::size_t /*max*/, std::chrono::milliseconds /*timeout*/) {
  return Failed(std::string(fault::kIo), Name(), "this line has no " + std::string(verb));
}

}  // namespace lightcal::devices
