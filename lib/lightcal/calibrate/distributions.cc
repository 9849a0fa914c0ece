// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/distributions.h"

#include <cmath>
#include <utility>

#include "lightcal/core/file_stem.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/thin_table.h"
#include "lightcal/records/photometric_type_c.h"

namespace lightcal {

std::vector<std::string> DistributionFilesOf(const Session& session, const std::string& light,
                                             const Sources& sources) {
  std::vector<std::string> found;
  for (const char* extension : {".ies", ".ldt"}) {
    const std::string path = PathInSession(session, "captures/" + FileStem(light) + extension);
    if (sources.exists(path)) found.push_back(path);
  }
  return found;
}

tl::unexpected<Error> SeveralDistributions(const std::string& light, const std::string& one,
                                           const std::string& other) {
  return Refused("several_distributions", light,
                 one + " and " + other +
                     " both describe it; remove one, or name the one that counts with "
                     "distribution = \"file\"");
}

Result<LightDescription> WithDistribution(const Session& session, const LightDescription& light,
                                          double step_deg, const Sources& sources,
                                          Evidence& evidence) {
  if (light.kind != LightKind::kPhotometric) return light;
  std::vector<std::string> paths = DistributionFilesOf(session, light.name, sources);
  if (!light.distribution_file.empty()) {
    paths = {PathInSession(session, light.distribution_file)};
  }
  if (paths.empty()) return light;
  if (paths.size() > 1) return SeveralDistributions(light.name, paths[0], paths[1]);
  auto read = sources.read_photometric(paths.front());
  if (!read) return Propagate(std::move(read));
  evidence.AddWarnings(read->warnings);
  if (read->file.header.tilt) {
    evidence.AddWarnings(
        {{"tilt_dropped", light.name,
          paths.front() + " says how its lamp dims when tilted (TILT), which is "
                          "not applied: the intensities are those of the tested position"}});
  }
  auto table = AsTypeC(std::move(read->file.table));
  if (!table) return Propagate(std::move(table));
  if (step_deg > 0.0) table = ThinnedTable(*table, step_deg);
  if (!table) return Propagate(std::move(table));
  constexpr double kAlong = 0.9998;  // cosine of 1 degree
  if (light.axis && light.aim && std::abs(Dot(*light.axis, *light.aim)) > kAlong) {
    evidence.AddWarnings({{"axis_along_aim", light.name,
                           "its axis lies along its aim and turns nothing: axis is where the C0 "
                           "plane of its file points, across the aim"}});
  }
  LightDescription described = light;
  if (!described.flux) described.flux = table->Flux();
  described.distribution = *std::move(table);
  evidence.AddFile(paths.front());
  return described;
}

}  // namespace lightcal
