// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "command.h"

namespace lightcal::app {

// Every command, in the order --help shows them.
[[nodiscard]] std::span<const CommandRow> Commands();

// One file each in commands/.
Run BuildQuick(CLI::App& parser);
Run BuildNew(CLI::App& parser);
Run BuildPlan(CLI::App& parser);
Run BuildShoot(CLI::App& parser);
Run BuildImport(CLI::App& parser);
Run BuildCamera(CLI::App& parser);
Run BuildMatch(CLI::App& parser);
Run BuildMerge(CLI::App& parser);
Run BuildDome(CLI::App& parser);
Run BuildInspect(CLI::App& parser);
Run BuildRun(CLI::App& parser);
Run BuildFit(CLI::App& parser);
Run BuildExplain(CLI::App& parser);
Run BuildSimulate(CLI::App& parser);
Run BuildTradeoff(CLI::App& parser);
Run BuildExport(CLI::App& parser);
Run BuildEngine(CLI::App& parser);
Run BuildCheck(CLI::App& parser);
Run BuildReport(CLI::App& parser);
Run BuildDiff(CLI::App& parser);
Run BuildLights(CLI::App& parser);
Run BuildValidate(CLI::App& parser);
Run BuildPhotometric(CLI::App& parser);
Run BuildConvert(CLI::App& parser);
Run BuildExposure(CLI::App& parser);
Run BuildReference(CLI::App& parser);
Run BuildCompletion(CLI::App& parser);
Run BuildMan(CLI::App& parser);
Run BuildPage(CLI::App& parser);
Run BuildColor(CLI::App& parser);
Run BuildDevices(CLI::App& parser);
Run BuildRatio(CLI::App& parser);
Run BuildState(CLI::App& parser);
Run BuildSweep(CLI::App& parser);
Run BuildRead(CLI::App& parser);
Run BuildWatch(CLI::App& parser);

}  // namespace lightcal::app
