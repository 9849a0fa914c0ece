// SPDX-License-Identifier: Apache-2.0
// Fitted lights as a person reads them in a terminal.
#pragma once

#include <string>

#include "lightcal/records/fitted_light.h"

namespace lightcal::app {

// One row a light: what it is, how bright, its colour, the distance offset with learned/prior.
[[nodiscard]] std::string LightTable(const LightFile& file);
// One row a light: readings used of all, degrees of freedom, rms, leave-one-out error, what the
// readings decided and what the priors did.
[[nodiscard]] std::string FitTable(const LightFile& file);
// The gate: one row an effect of one light.
[[nodiscard]] std::string EffectTable(const FittedLight& light);

// Where one light's uncertainty comes from, and what would halve each part; "" where nobody knows.
[[nodiscard]] std::string BudgetTable(const FittedLight& light);
// One line: the effects that this scene has nothing of.
[[nodiscard]] std::string EffectsOfNoConcern(const FittedLight& light);

// Where readings found the lamp: its three coordinates, each with its 95 %.
[[nodiscard]] std::string PlaceFound(const FittedLight& light);

// The row's headline number: intensity, else illuminance, else luminance, else flux.
[[nodiscard]] std::string Headline(const FittedLight& light);

}  // namespace lightcal::app
