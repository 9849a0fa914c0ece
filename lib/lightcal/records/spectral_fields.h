// SPDX-License-Identifier: Apache-2.0
// How a light's spectra stand in a light file: its own, its states' and its emitters'.
// Internal to this room.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/records/fitted_light.h"

namespace lightcal::records {

class FieldReader;
class FieldWriter;

// Whole, or not at all.
void VisitSpectrumOf(FieldReader& reader, std::optional<Spectrum>& spectrum);
void VisitSpectrumOf(FieldWriter& writer, const std::optional<Spectrum>& spectrum);

// Each emitter a spectrum, each state that has amounts one of each.
void VisitEmittersOf(FieldReader& reader, FittedLight& light);
void VisitEmittersOf(FieldWriter& writer, const FittedLight& light);

void VisitAmounts(FieldReader& reader, std::vector<double>& amounts);
void VisitAmounts(FieldWriter& writer, const std::vector<double>& amounts);

}  // namespace lightcal::records
