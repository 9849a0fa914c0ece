// SPDX-License-Identifier: Apache-2.0
// The "provenance" of light.json and camera.json. Internal to the records room.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>

#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"

namespace lightcal::records {

inline void CheckHash(FieldReader& reader, const std::string& sha256) {
  constexpr std::size_t kDigits = 64;
  const bool hex = sha256.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!reader.Has("sha256") || (hex && sha256.size() == kDigits)) return;
  reader.Fail("sha256", "sha256 = " + Quoted(sha256) + " is no SHA-256: 64 digits 0-9 and a-f");
}
inline void CheckHash(FieldWriter& /*writer*/, const std::string& /*sha256*/) {}

// One visitor for FieldReader and FieldWriter.
template <class Archive, class SomeProvenance>
void VisitProvenance(Archive& archive, SomeProvenance& provenance) {
  archive.Group("provenance", [&](auto& group) {
    group.Text("generator", provenance.generator);
    group.Text("time", provenance.time);
    // Absent rather than empty; a const provenance is one being written.
    constexpr bool kReading = !std::is_const_v<SomeProvenance>;
    if (kReading || !provenance.devices.empty()) group.Texts("devices", provenance.devices);
    group.List("inputs", provenance.inputs, [](auto& inner, auto& input) {
      inner.Text("path", input.path);
      inner.Text("sha256", input.sha256);
      inner.Require({"path", "sha256"});
      CheckHash(inner, input.sha256);
    });
  });
}

}  // namespace lightcal::records
