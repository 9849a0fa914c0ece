// SPDX-License-Identifier: Apache-2.0
#include "light_summary.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace lightcal::app {

nlohmann::ordered_json LightSummary(const FittedLight& light) {
  nlohmann::ordered_json json = {{"name", light.name}, {"kind", LightKindName(light.kind)}};
  const auto put = [&](const char* key, const std::optional<Uncertain>& u) {
    if (u) json[key] = {{"value", u->value}, {"u95", u->u95}};
  };
  put("intensity_cd", light.intensity_cd);
  put("illuminance_lx", light.illuminance_lx);
  put("luminance_nits", light.luminance_nits);
  put("flux_lm", light.flux_lm);
  put("cct_K", light.color.cct_K);
  put("duv", light.color.duv);
  return json;
}

}  // namespace lightcal::app
