// SPDX-License-Identifier: Apache-2.0
#include "light_summary.h"

namespace lightcal::app {

Node ValueAndU95(const Uncertain& u) { return {{"value", u.value}, {"u95", u.u95}}; }

Node LightSummary(const FittedLight& light) {
  Node node = {{"name", light.name}, {"kind", LightKindName(light.kind)}};
  const auto put = [&](const char* key, const std::optional<Uncertain>& u) {
    if (u) node.Put(key, ValueAndU95(*u));
  };
  put("intensity_cd", light.intensity_cd);
  put("illuminance_lx", light.illuminance_lx);
  put("luminance_nits", light.luminance_nits);
  put("flux_lm", light.flux_lm);
  put("cct_K", light.color.cct_K);
  put("duv", light.color.duv);
  return node;
}

}  // namespace lightcal::app
