// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/irradiance_units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightcal {
namespace {

struct IrradianceUnit {
  std::string_view name;
  double W_m2_nm;
};
constexpr std::array kUnits = {
    IrradianceUnit{"W m-2 nm-1", 1.0},        IrradianceUnit{"mW m-2 nm-1", 1e-3},
    IrradianceUnit{"uW m-2 nm-1", 1e-6},      IrradianceUnit{"W cm-2 nm-1", 1e4},
    IrradianceUnit{"mW cm-2 nm-1", 10.0},     IrradianceUnit{"uW cm-2 nm-1", 1e-2},
    IrradianceUnit{"nW cm-2 nm-1", 1e-5},     IrradianceUnit{"W m-2 per 5 nm", 0.2},
    IrradianceUnit{"mW m-2 per 5 nm", 2e-4},  IrradianceUnit{"W m-2 per 10 nm", 0.1},
    IrradianceUnit{"mW m-2 per 10 nm", 1e-4},
};

}  // namespace

std::string_view IrradianceUnitOf(double W_m2_nm, double tolerance) {
  if (!(W_m2_nm > 0.0)) return "";
  const auto off = [&](const IrradianceUnit& unit) {
    return std::abs(std::log(unit.W_m2_nm / W_m2_nm));
  };
  const IrradianceUnit& nearest = *std::ranges::min_element(kUnits, {}, off);
  return off(nearest) <= std::log1p(tolerance) ? nearest.name : "";
}

}  // namespace lightcal
