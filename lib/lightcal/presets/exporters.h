// SPDX-License-Identifier: Apache-2.0
// The functions behind the rows of preset_table.cc. Each is described at the head of its own file,
// <engine>.cc, and its reader in check/read_<engine>.cc.
#pragma once

#include "lightcal/presets/check/engine_light.h"
#include "lightcal/presets/emission.h"
#include "lightcal/presets/preset.h"

namespace lightcal {

Exporter ExportGltf, ExportGodot, ExportMitsuba, ExportPbrt, ExportUnity, ExportUnreal, ExportUsd,
    ExportJson, ExportBlender, ExportBlenderAddon, ExportThree, ExportFilament, ExportIes,
    ExportLdt, ExportGdtf;

PresetReader ReadGltf, ReadGodot, ReadUsd, ReadJson, ReadBlender, ReadThree, ReadFilament,
    ReadPhotometricTable;

EmissionLaw EmittedInGodot, EmittedInMitsuba, EmittedInPbrt, EmittedInUnity, EmittedInUnreal;

}  // namespace lightcal
