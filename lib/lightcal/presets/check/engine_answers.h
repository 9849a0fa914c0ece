// SPDX-License-Identifier: Apache-2.0
// What the engines of reports make of a file's lights.
#pragma once

#include <memory>
#include <vector>

#include "lightcal/presets/environment_picture.h"
#include "lightcal/records/engine_answers.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// Of every engine of ReportTargets whose exporter takes these lights; before them what any engine
// gets whose colour stays white.
//   figures  the one number by which an engine's light is as bright as the lamp
//   parity   one row a light and engine, on the axis, facing the lamp, at the distance of its
//   median
//            used reading (1 m where none has one): the engine's emission law makes lux of the
//            numbers that its file holds; where there is none, the file is read back.
//            Lights without an intensity or illuminance are left out. A dome with a picture is
//            compared six ways, by the engine's published law of lighting with one.
// `environments`: the pictures that domes name, one a light (null = none), or none at all.
[[nodiscard]] EngineAnswers EngineAnswersOf(
    const LightFile& lights,
    const std::vector<std::shared_ptr<const EnvironmentPicture>>& environments = {});

}  // namespace lightcal
