// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/distribution_codec.h"

#include <string>
#include <utility>

namespace lightcal::records {
namespace {

constexpr auto kVisitPart = [](auto& archive, auto& part) {
  archive.Text("name", part.name);
  archive.Number("peak_sd_relative", part.peak, kNotNegative);
  archive.Number("flux_sd_relative", part.flux, kNotNegative);
  archive.Require({"name"});
};

template <class Archive, class SomeGrid>
void VisitGrid(Archive& archive, SomeGrid& grid) {
  archive.Word("type", grid.type, kGoniometerTypeWords);
  archive.Numbers("horizontal_deg", grid.horizontal_deg, kAnyNumber);
  archive.Numbers("vertical_deg", grid.vertical_deg, kAnyNumber);
  archive.Numbers("candela", grid.candela, kNotNegative);
  archive.Require({"type", "horizontal_deg", "vertical_deg", "candela"});
}

}  // namespace

void VisitDistribution(FieldReader& reader, std::optional<MeasuredDistribution>& out) {
  if (!reader.Has("distribution")) return;
  reader.Group("distribution", [&](FieldReader& inner) {
    IntensityGrid grid;
    double interpolated_share = 0.0;
    std::vector<MeasuredDistribution::Part> budget;
    VisitGrid(inner, grid);
    inner.Number("interpolated_share", interpolated_share, kNotNegative);
    inner.List("budget", budget, kVisitPart);
    std::vector<double> pattern_sd;
    if (inner.Has("pattern_sd")) inner.Numbers("pattern_sd", pattern_sd, kNotNegative);
    if (inner.Failed()) return;
    if (!pattern_sd.empty() && pattern_sd.size() != grid.vertical_deg.size()) {
      inner.Fail("pattern_sd", "pattern_sd must have one number a vertical angle");
      return;
    }
    auto table = IntensityTable::Make(std::move(grid), "distribution");
    if (!table) {
      inner.Fail("candela", table.error().message);
      return;
    }
    out = MeasuredDistribution{*std::move(table), interpolated_share, std::move(budget),
                               std::move(pattern_sd)};
  });
}

void VisitDistribution(FieldWriter& writer, const std::optional<MeasuredDistribution>& given) {
  if (!given) return;
  writer.Group("distribution", [&](FieldWriter& inner) {
    VisitGrid(inner, given->table.grid());
    inner.Number("interpolated_share", given->interpolated_share);
    inner.List("budget", given->budget, kVisitPart);
    if (!given->pattern_sd.empty()) inner.Numbers("pattern_sd", given->pattern_sd, kNotNegative);
  });
}

}  // namespace lightcal::records
