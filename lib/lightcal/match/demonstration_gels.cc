// SPDX-License-Identifier: Apache-2.0
#include "lightcal/match/demonstration_gels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "lightcal/colorimetry/gel_stack.h"
#include "lightcal/colorimetry/planckian.h"

namespace lightcal::match {
namespace {

constexpr double kPeakTransmittance = 0.9;

template <class Law>
Gel DemonstrationGel(std::string id, std::string name, const Law& law) {
  Gel gel;
  gel.id = "demo:" + std::move(id);
  gel.name = std::move(name);
  for (std::size_t k = 0; k < kNodeCount; ++k) {
    gel.wavelengths_nm.push_back(NodeNm(k));
    gel.transmittance.push_back(law(NodeNm(k)));
  }
  return gel;
}

// Moves a black body by so many mireds.
Gel ShiftingGel(std::string id, std::string name, double mired) {
  const double clear_nm = mired > 0.0 ? 700.0 : 420.0;
  return DemonstrationGel(std::move(id), std::move(name), [=](double nm) {
    const double exponent = kC2MetreKelvin * 1e9 * mired * 1e-6 * (1.0 / nm - 1.0 / clear_nm);
    return kPeakTransmittance * std::min(1.0, std::exp(-exponent));
  });
}

}  // namespace

GelSet DemonstrationGels() {
  using Strength = std::pair<const char*, const char*>;
  constexpr std::array<Strength, 5> kStrengths = {{{"full", "Full"},
                                                   {"3/4", "Three Quarter"},
                                                   {"1/2", "Half"},
                                                   {"1/4", "Quarter"},
                                                   {"1/8", "Eighth"}}};
  constexpr std::array<double, 5> kOrange = {159.0, 120.0, 81.0, 42.0, 20.0};
  constexpr std::array<double, 5> kBlue = {-137.0, -112.0, -78.0, -35.0, -18.0};
  constexpr std::array<double, 5> kGreen = {0.3, 0.0, 0.15, 0.075, 0.0375};  // no three quarters
  GelSet set;
  set.source = "lightcal's demonstration filters";
  set.demonstration = true;
  for (std::size_t i = 0; i < kStrengths.size(); ++i) {
    const std::string id = kStrengths[i].first;
    const std::string name = kStrengths[i].second;
    set.gels.push_back(ShiftingGel("cto-" + id, name + " C.T. Orange", kOrange[i]));
    set.gels.push_back(ShiftingGel("ctb-" + id, name + " C.T. Blue", kBlue[i]));
    const double density = kGreen[i];
    if (density == 0.0) continue;
    const auto green = [](double nm) {
      const double off = (nm - 540.0) / 50.0;
      return std::exp(-0.5 * off * off);
    };
    set.gels.push_back(DemonstrationGel("minus-green-" + id, name + " Minus Green", [=](double nm) {
      return kPeakTransmittance * std::pow(10.0, -density * green(nm));
    }));
    set.gels.push_back(DemonstrationGel("plus-green-" + id, name + " Plus Green", [=](double nm) {
      return kPeakTransmittance * std::pow(10.0, -density * (1.0 - green(nm)));
    }));
  }
  for (const auto& [id, density] :
       {std::pair{"0.15", 0.15}, {"0.3", 0.3}, {"0.6", 0.6}, {"0.9", 0.9}}) {
    set.gels.push_back(DemonstrationGel("nd-" + std::string(id), std::string(id) + "ND",
                                        [=](double) { return std::pow(10.0, -density); }));
  }
  return set;
}

}  // namespace lightcal::match
