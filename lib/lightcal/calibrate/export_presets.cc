// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/export_presets.h"

#include <utility>

#include "lightcal/calibrate/states/control_sweeps.h"

namespace lightcal {

Result<ExportedPresets> ExportPresets(const LightFile& lights,
                                      const std::vector<std::string>& targets,
                                      const std::string& stem, PresetOptions options) {
  if (options.sweeps.empty()) options.sweeps = ControlSweepsOf(lights);
  return ExportTargets(lights, targets, stem, options);
}

}  // namespace lightcal
