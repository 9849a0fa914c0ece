// SPDX-License-Identifier: Apache-2.0
// A preset's lights against the readings they were made from.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/presets/check/engine_light.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

struct ComparedReading {
  std::string light;
  int index = 0;  // among the readings of that light
  std::optional<double> distance_m;
  // measured: what the lamp itself gave, without the ambient light and, as the fit has it, the
  // walls'; predicted: what the file's lights give.
  double measured_lx = 0.0, walls_lx = 0.0, predicted_lx = 0.0;
  bool used = true;
  double off_axis_deg = 0.0;  // as the reading says; 0 = on the axis, or at a place
  // What the fit itself leaves of the reading (of a beam no less than the thousandth of its peak
  // where distributions end), and u95 of what it holds there: of the row, and of a
  // measured beam in that direction.
  double left_lx = 0.0, unsure_lx = 0.0;

  // Of what the meter showed, the ambient light aside; absent where it showed nothing.
  [[nodiscard]] std::optional<double> Error() const;
  // The error that a file is judged by. No file can be nearer to a reading than the fit it was
  // written from, and a reading that is dimmer than the fit is sure there says nothing by its own
  // size (a beam's rim, of 0.3 lx where the lamp's middle has 1000):
  //   sign(P - M) max(0, |P - M| - left) / max(M + walls, unsure)
  [[nodiscard]] std::optional<double> Judged() const;
};

// Of a row of the fit, the lux off the walls: no lamp in an engine gives them.
using WallPart = std::function<double(const FittedLight& lamp, const ResidualRow& row)>;

// One row a reading, in the order of the lamps' residuals. `lamps` is what was fitted to `session`:
// it says where lamps that the file does not place stand. A photometric file may be of any make: it
// stands for every lamp, unless it names one: then that one alone is compared.
[[nodiscard]] std::vector<ComparedReading> CompareWithReadings(const Session& session,
                                                               const LightFile& lamps,
                                                               std::vector<EngineLight> lights,
                                                               const WallPart& walls_of);

// Fitted lamps that no light of the file stands for, by name.
[[nodiscard]] std::vector<std::string> LampsMissing(const Session& session, const LightFile& lamps,
                                                    std::vector<EngineLight> lights);

// Lights that stand for no lamp of the session, by name: what they shine comes on top.
[[nodiscard]] std::vector<std::string> LightsBeyond(const Session& session,
                                                    const std::vector<EngineLight>& lights);

// Of a file for Blender: what its versions before 4.0 make of spheres where the nearest reading was
// taken, of more than half a per cent.
[[nodiscard]] Warnings OldBlenderSpheres(const Session& session, const LightFile& lamps);

// Root mean square of the used readings' errors; absent without any.
[[nodiscard]] std::optional<double> RmsOf(const std::vector<ComparedReading>& rows);

// Root mean square of what each lamp's used readings are judged by, in the order of its first row:
// among many right ones a wrong lamp is small. Without lamps that no used reading tells.
struct LampRms {
  std::string light;
  double rms = 0.0;
};
[[nodiscard]] std::vector<LampRms> RmsByLamp(const std::vector<ComparedReading>& rows);
// The largest of them; absent without any.
[[nodiscard]] std::optional<double> WorstRms(const std::vector<ComparedReading>& rows);

}  // namespace lightcal
