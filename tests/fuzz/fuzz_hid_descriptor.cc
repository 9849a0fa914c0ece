// SPDX-License-Identifier: Apache-2.0
// Whatever descriptor and reports a HID device sends: no field reaches outside its report, what is
// written into a field is read from it, and a light is finite. The input: a byte n, n * 8 bytes of
// descriptor, then a report.
#include <algorithm>
#include <cmath>
#include <span>

#include "lightcal_devices/meters/hid_als/frame.h"
#include "require.h"

namespace {

using lightcal::fuzz::Require;
namespace hid_als = lightcal::devices::hid_als;

void CheckField(const hid_als::ReportDescriptor& descriptor, const hid_als::Field& field) {
  const std::size_t length = descriptor.ReportBytes(field.kind, field.report);
  Require(field.bit_count >= 1 && field.bit_count <= 32);
  Require(field.bit_offset + field.bit_count <= 8 * length);
  Require(length <= hid_als::kLongestReportBits / 8);
  lightcal::devices::Bytes report(length);
  Require(field.Put(field.logical_min, report));
  const auto raw = field.RawIn(report);
  Require(!raw || (*raw >= field.logical_min && *raw <= field.logical_max));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  const std::size_t length = std::min<std::size_t>(bytes.size(), data[0] * 8U);
  const auto descriptor = hid_als::ParseReportDescriptor(bytes.first(length));
  if (!descriptor) {
    Require(descriptor.error().code == hid_als::kBadDescriptor);
    return 0;
  }
  for (const hid_als::Field& field : descriptor->fields) CheckField(*descriptor, field);
  const auto layout = hid_als::FindAmbientLight(*descriptor);
  if (!layout) return 0;
  const auto light = hid_als::DecodeInput(*layout, bytes.subspan(length));
  if (!light) return 0;
  Require(std::isfinite(light->illuminance_lx) && light->illuminance_lx >= 0.0);
  if (light->xy) Require(light->xy->x > 0.0 && light->xy->y > 0.0);
  if (light->cct_K) Require(std::isfinite(*light->cct_K) && *light->cct_K > 0.0);
  return 0;
}
