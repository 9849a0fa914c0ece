// SPDX-License-Identifier: Apache-2.0
// What importing files would add to a session, worked out whole before anything is written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/records/reading.h"
#include "lightcal/records/session.h"
#include "lightcal_devices/files/import_file.h"
#include "output_files.h"

namespace lightcal::app {

struct ImportSettings {
  std::string light;  // for readings whose file names none, "" = the session's only one
  std::optional<Metres> distance;  // for readings whose file gives none
  std::string meter;               // for readings whose file names none
  FixtureState state;              // for readings whose file says nothing of the lamp's controls
  devices::TableWords table;       // what its person says of a table
  std::string column;              // one spectrum of a file, by name or number from 1; "" = all
  bool color_only = false;         // leave the illuminance out
  bool lamp_off = false;
  bool shadow_card = false;
  bool again = false;  // also what the session holds already
};

struct PlannedFile {
  std::string path;
  std::string format;
  std::size_t found = 0;          // readings in the file
  std::vector<Reading> readings;  // those to append
};

struct ImportPlan {
  std::vector<PlannedFile> files;
  std::vector<OutputFile> captures;  // spectra to copy into the session, not there yet
  Warnings warnings;                 // the importers' and already_imported
};

// Reads every file and completes its readings. A file with one spectrum is copied to captures/, or
// referenced where it lies in the session already; one spectrum of several, or the colour alone of
// an irradiance, is written there as CSV. A reading the session holds already is left out (as often
// as it holds it), so that importing a file twice adds nothing and an interrupted import resumes.
// Refused: unknown_light, unknown_meter (naming the nearest), light_missing, distance_missing,
// no_color, bad_reading, unknown_column, and whatever ImportFile refuses.
[[nodiscard]] Result<ImportPlan> PlanImport(const Session& session,
                                            const std::vector<std::string>& files,
                                            const ImportSettings& settings);

}  // namespace lightcal::app
