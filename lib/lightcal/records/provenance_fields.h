// SPDX-License-Identifier: Apache-2.0
// The "provenance" of light.json and camera.json. Internal to the records room.
#pragma once

#include <type_traits>

namespace lightcal::records {

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
    });
  });
}

}  // namespace lightcal::records
