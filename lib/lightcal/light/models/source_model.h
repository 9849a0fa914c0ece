// SPDX-License-Identifier: Apache-2.0
// Any source with a position, as one type.
#pragma once

#include <type_traits>
#include <variant>

#include "lightcal/light/models/disk_source.h"
#include "lightcal/light/models/ladder.h"
#include "lightcal/light/models/point_source.h"
#include "lightcal/light/models/receiver.h"
#include "lightcal/light/models/rect_source.h"
#include "lightcal/light/models/sphere_source.h"
#include "lightcal/light/models/spot_source.h"
#include "lightcal/light/models/tube_source.h"

namespace lightcal {

struct PointSource {};
template <class T>
[[nodiscard]] T LuxPerCandela(const PointSource&, const Receiver<T>& at) {
  return PointLuxPerCandela(at);
}

using SourceModel =
    std::variant<PointSource, SphereSource, DiskSource, RectSource, TubeSource, SpotSource>;

// E/I at the receiver, exact.                                                        [lx/cd]
template <class T>
[[nodiscard]] T LuxPerCandela(const SourceModel& source, const Receiver<T>& at) {
  return std::visit([&at](const auto& s) { return LuxPerCandela(s, at); }, source);
}
// Within `tolerance` of it, relative.
template <class T>
[[nodiscard]] T LuxPerCandela(const SourceModel& source, const Receiver<T>& at, double tolerance) {
  return std::visit(
      [&](const auto& s) {
        using Source = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<Source, DiskSource> || std::is_same_v<Source, RectSource> ||
                      std::is_same_v<Source, TubeSource>) {
          return LuxPerCandelaAt(ChooseLevel(s, at, tolerance), s, at);
        } else {
          return LuxPerCandela(s, at);
        }
      },
      source);
}

}  // namespace lightcal
