// SPDX-License-Identifier: Apache-2.0
#include "distribution_plan.h"

#include <filesystem>
#include <utility>

#include "input_files.h"
#include "lightcal/calibrate/distributions.h"
#include "lightcal/core/file_stem.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/disk_sources.h"
#include "session_names.h"

namespace lightcal::app {

bool IsPhotometricName(const std::string& path) {
  const std::string extension = LowerAscii(std::filesystem::path(path).extension().string());
  return extension == ".ies" || extension == ".ldt";
}

Result<PlannedDistribution> PlanDistribution(const Session& session, const std::string& path,
                                             const std::string& light) {
  PlannedDistribution plan;
  plan.light = light.empty() && session.lights.size() == 1 ? session.lights.front().name : light;
  if (plan.light.empty()) {
    return Refused("light_missing", path, "does not say whose light it is; add --light");
  }
  if (auto named = CheckNames(session, plan.light, ""); !named) return Propagate(std::move(named));
  if (FindLight(session, plan.light)->kind != LightKind::kPhotometric) {
    return Refused("kind_mismatch", plan.light,
                   "a photometric file describes a light of kind = \"photometric\"; write that "
                   "into its [[light]] first");
  }
  const Sources disk = devices::DiskSources();
  NoteInput(path);
  auto read = disk.read_photometric(path);
  if (!read) return Propagate(std::move(read));
  plan.flux_lm = read->file.table.Flux().value();
  plan.peak_cd = read->file.table.peak().intensity.value();
  plan.warnings = std::move(read->warnings);
  auto bytes = disk.read_text(path);
  if (!bytes) return Propagate(std::move(bytes));
  const char* extension = read->file.header.format == PhotometricFormat::kIes ? ".ies" : ".ldt";
  const std::string target = PathInSession(session, "captures/" + FileStem(plan.light) + extension);
  for (const std::string& held : DistributionFilesOf(session, plan.light, disk)) {
    if (held != target) return SeveralDistributions(plan.light, target, held);
    const auto there = disk.read_text(held);
    if (there && *there == *bytes) return plan;
  }
  plan.files.push_back({target, std::move(*bytes)});
  return plan;
}

}  // namespace lightcal::app
