// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "lightcal/records/fitted_light.h"
#include "lightcal/report/report_extras.h"

namespace lightcal::report {

// The figure a light is known by: intensity, else illuminance, else luminance, else flux.
struct Headline {
  const Uncertain* value = nullptr;  // null: nothing was found
  const char* unit = "";
};
[[nodiscard]] Headline HeadlineOf(const FittedLight& light);

// "learned", "prior" or "": who decided a parameter.
[[nodiscard]] std::string DecidedBy(const FitDiagnostics& fit, std::string_view parameter);

// The section of one light: headline, cards, what to type in, figures, tables. index makes ids
// unique; alone says that the page has no other light.
[[nodiscard]] std::string LightSection(const FittedLight& light, int index, bool alone,
                                       const ReportExtras& extras);

}  // namespace lightcal::report
