// SPDX-License-Identifier: Apache-2.0
// A lamp's data sheet as prior: the answer without readings, the check with them.
#pragma once

#include <optional>

#include "lightcal/core/result.h"
#include "lightcal/fit/estimate_light.h"
#include "lightcal/fit/model/observations.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Half width of the 95 % interval of a printed luminous flux: about what lamp standards allow it
// (IEC 62612, a tenth below the rated flux; from memory, not re-read).
inline constexpr double kFluxToleranceRelative = 0.10;

// Flux over that of its kind's own pattern, 95 %. Of what is taken for a point, over 4 pi I: bulbs,
// 667 traced ones (tests/tools/traced_rooms), .71 to 1.01 with the median .86, for a base hides
// some and glass is not alike all round. A flat lamp has pi I. What nobody described may be a
// narrow beam: .0089 is the 2.5 % quantile of 667 traced ones. Other kinds but a sphere's: within
// 15 %.
struct FluxSpread {
  double low, high;
};
[[nodiscard]] FluxSpread FluxSpreadOf(const LightDescription& light);

// Whether flux_lm is given for a kind that has an axial intensity.
[[nodiscard]] bool HasDataSheet(const LightDescription& light);

// Peak intensity I = Phi/Omega with Omega from the beams of beam_ensemble.h, from the cone, or from
// the kind's own distribution (of a bulb by FluxSpreadOf, within 30 % for another point lamp, 15 %
// otherwise; 95 % interval), widened by the flux's own tolerance. value is the geometric middle of
// the interval. Refused: no_readings (no data sheet), bad_beam.
[[nodiscard]] Result<Uncertain> IntensityFromDataSheet(const LightDescription& light);

// Fills intensity and the diagnostics of a light that was never read: everything is a prior.
[[nodiscard]] Result<void> FillFromDataSheet(const LightDescription& light, FittedLight& out);

// The printed flux beside `by_readings`, an interval of readings alone; `held`: how likely it is
// this lamp's (LightEstimate). Two normals of ln Phi, mixed with the readings' own.
[[nodiscard]] Uncertain FluxBeside(const Uncertain& by_readings, Lumens printed, double held);

// What the manufacturer says beside a person's readings, of a lamp without controls: which setting
// of others it is of nobody says.
[[nodiscard]] std::optional<SheetIntensity> SheetBeside(const Session& session,
                                                        const Observations& observations,
                                                        const LightDescription& light);
// Not where the readings (ln I and its 1 sigma) ask for another intensity, as of a lamp that is
// dimmed, aged or another.
[[nodiscard]] bool Agrees(const SheetIntensity& sheet, double ln_cd, double sd);

// The intensity before a data sheet was heard.
[[nodiscard]] std::optional<Uncertain> ByReadings(const LightEstimate& estimate,
                                                  const FittedLight& out);
// The flux as a data sheet that the readings bear out leaves it.
void TellFlux(const LightEstimate& estimate, const LightDescription& light, FittedLight& out);

// Adds the warning data_sheet_disagrees when the flux of a beam whose shape was read and the
// printed one do not overlap within their 95 % intervals.
void CheckPrintedFlux(const LightDescription& light, const Uncertain& read, Warnings& warnings);

// Adds the warning data_sheet_disagrees when the intensity that readings alone give and the data
// sheet's do not overlap within their 95 % intervals.
void CheckDataSheet(const LightDescription& light, const std::optional<Uncertain>& measured,
                    Warnings& warnings);

}  // namespace lightcal::fit
