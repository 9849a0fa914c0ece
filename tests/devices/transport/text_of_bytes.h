// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "lightcal_devices/transport/transport.h"

namespace lightcal::test {

inline std::string Text(const devices::Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace lightcal::test
