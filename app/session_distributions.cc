// SPDX-License-Identifier: Apache-2.0
#include "session_distributions.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/light/thin_table.h"
#include "lightcal/records/photometric_type_c.h"
#include "lightcal_devices/files/read_photometric.h"
#include "session_names.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> ImportedFor(const Session& session, const std::string& light) {
  std::vector<std::string> found;
  for (const char* extension : {".ies", ".ldt"}) {
    std::error_code error;
    const std::string path = PathInSession(session, "captures/" + light + extension);
    if (fs::exists(path, error)) found.push_back(path);
  }
  return found;
}

tl::unexpected<Error> Several(const std::string& light, const std::vector<std::string>& found) {
  return Refused("several_distributions", light,
                 found[0] + " and " + found[1] +
                     " both describe it; remove one, or name the one that counts with "
                     "distribution = \"file\"");
}

}  // namespace

Result<void> ResolveDistributions(double step_deg, Session& session, Warnings& warnings) {
  for (LightDescription& light : session.lights) {
    if (light.kind != LightKind::kPhotometric) continue;
    std::vector<std::string> paths = ImportedFor(session, light.name);
    if (!light.distribution_file.empty()) {
      paths = {PathInSession(session, light.distribution_file)};
    }
    if (paths.empty()) continue;
    if (paths.size() > 1) return Several(light.name, paths);
    auto read = ReadPhotometricFile(paths.front());
    if (!read) return Propagate(std::move(read));
    warnings.insert(warnings.end(), read->warnings.begin(), read->warnings.end());
    auto table = AboutItsAim(std::move(read->file.table));
    if (!table) return Propagate(std::move(table));
    if (step_deg > 0.0) table = ThinnedTable(*table, step_deg);
    if (!table) return Propagate(std::move(table));
    if (!light.flux) light.flux = table->Flux();
    light.distribution = *std::move(table);
    NoteInputFile(paths.front(), session);
  }
  return {};
}

bool IsPhotometricName(const std::string& path) {
  const std::string extension = LowerAscii(fs::path(path).extension().string());
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
  auto read = ReadPhotometricFile(path);
  if (!read) return Propagate(std::move(read));
  plan.flux_lm = read->file.table.Flux().value();
  plan.peak_cd = read->file.table.peak().intensity.value();
  plan.warnings = std::move(read->warnings);
  auto bytes = ReadWholeFile(path);
  if (!bytes) return Propagate(std::move(bytes));
  const char* extension = read->file.header.format == PhotometricFormat::kIes ? ".ies" : ".ldt";
  const std::string target = PathInSession(session, "captures/" + plan.light + extension);
  for (const std::string& held : ImportedFor(session, plan.light)) {
    if (held != target) return Several(plan.light, {target, held});
    const auto there = ReadWholeFile(held);
    if (there && *there == *bytes) return plan;
  }
  plan.files.push_back({target, std::move(*bytes)});
  return plan;
}

}  // namespace lightcal::app
