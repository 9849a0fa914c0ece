// SPDX-License-Identifier: Apache-2.0
#include "lightcal/fit/beam/beam_family.h"

namespace lightcal::fit {

const char* NameOf(BeamFamily family) {
  constexpr std::array<const char*, kBeamFamilies> kNames = {
      "even", "cosine_power", "cosine_gaussian", "peaked_or_flat", "cone", "domed_cone", "smooth"};
  return kNames[static_cast<std::size_t>(family)];
}

double LogitOfAngle(double radians) {
  const double x = std::clamp(radians / (0.99 * kQuarterTurn), 1e-3, 1.0 - 1e-3);
  return std::log(x / (1.0 - x));
}

std::array<ParameterRule, BeamShape::kNodes> BeamShape::Rules() const {
  std::array<ParameterRule, kNodes> rules{};
  switch (family) {
    case BeamFamily::kEven:
      break;
    case BeamFamily::kCosinePower:
      rules[0] = kHalfAngleRule;
      break;
    case BeamFamily::kCosineGaussian:
      rules[0] = kHalfAngleRule;
      rules[1] = {true, -1.0, 1.5};
      break;
    case BeamFamily::kPeakedOrFlat:
      rules[0] = kHalfAngleRule;
      rules[1] = {true, std::numbers::ln2, 0.5};
      break;
    case BeamFamily::kCone:
      rules[0] = {true, -0.9, 1.1};
      rules[1] = {true, 0.5, 1.5};
      break;
    case BeamFamily::kDomedCone:
      rules[0] = {true, -0.9, 1.1};
      rules[1] = {true, 0.5, 1.5};
      rules[2] = {true, -2.5, 1.5};
      break;
    case BeamFamily::kSmooth:
      rules.fill({true, 0.0, 0.0});  // under PriorRows
      break;
  }
  return rules;
}

std::size_t BeamShape::FirstNode(double gamma) const {
  constexpr double kMost = kNodes - kNodesOfAngle;
  const double before = std::floor(NodesAlong(gamma)) - 1.0;
  return static_cast<std::size_t>(before < kMost ? std::max(0.0, before) : kMost);
}

double BeamShape::LnPriorScale() const {
  if (family != BeamFamily::kSmooth) return 0.0;
  return (kNodes - 1) * std::log(bend) - std::numbers::ln2 + std::log(kAxialPrior.prior_sd) +
         (kink >= 0 ? std::log(kKinkBends) : 0.0);
}

double BeamShape::LatentOf(double relative) {
  const double x = std::max(relative, 1e-4) / kSoft;
  return x > 30.0 ? relative : kSoft * std::log(std::expm1(x));
}

}  // namespace lightcal::fit
