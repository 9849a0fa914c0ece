// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/camera/color_calibration.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lightcal/calibrate/session_files.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/imaging/camera/chart_file.h"
#include "lightcal/imaging/camera/color_chart.h"
#include "lightcal/imaging/camera/raw_patch.h"
#include "lightcal/imaging/camera/spectral_mismatch.h"

namespace lightcal {
namespace {

constexpr double kPatchShare = 0.2;  // of the distance to the next patch
constexpr double kLargestPatchUnevenness = 0.15;
constexpr Xy kD50{0.34567, 0.35851};  // CIE 15:2018, table 11.3

Region PatchRegion(const ChartGrid& grid, int column, int row) {
  const auto center = grid.Place(column, row);
  const auto right = grid.Place(column + 0.5, row), left = grid.Place(column - 0.5, row);
  const auto below = grid.Place(column, row + 0.5), above = grid.Place(column, row - 0.5);
  const double step = std::min(std::hypot(right[0] - left[0], right[1] - left[1]),
                               std::hypot(below[0] - above[0], below[1] - above[1]));
  const int half = std::max(1, static_cast<int>(kPatchShare * step));
  return {static_cast<int>(center[0]) - half, static_cast<int>(center[1]) - half, 2 * half + 1,
          2 * half + 1};
}

Result<CameraColor> FitChartAt(const std::array<double, 8>& corners, const ChartFile& chart,
                               const std::string& name, const MergedBracket& merged) {
  const auto grid = ChartGrid::Make(corners, chart.columns, chart.rows);
  if (!grid) return tl::unexpected(grid.error());
  const Xy lamp = chart.lamp.value_or(kD50);
  std::vector<ChartPatch> patches;
  for (const ChartFilePatch& one : chart.patches) {
    const std::string place =
        name + ", column " + std::to_string(one.column) + ", row " + std::to_string(one.row);
    const auto seen =
        MeasureRawPatch(merged, PatchRegion(*grid, one.column - 1, one.row - 1), place);
    if (!seen) return tl::unexpected(seen.error());
    if (seen->uneven_sd > kLargestPatchUnevenness) {
      return Refused("patch_uneven", place,
                     "the picture is not even there; check corners: the centres of the corner "
                     "patches, upper left, upper right, lower right, lower left");
    }
    patches.push_back({seen->rgb, AdaptBradford(one.xyz, kD50, lamp)});
  }
  const Xyz white = XyzFromXyAtUnitY(lamp);
  return FitChart(patches, {100.0 * white.X, 100.0, 100.0 * white.Z});
}

// Of the four ways round in which the chart may hang where it was found, the one that fits best.
Result<CameraColor> FitChartAnyWayRound(const std::array<double, 8>& found, const ChartFile& chart,
                                        const std::string& name, const MergedBracket& merged) {
  std::array<double, 8> corners = found;
  Result<CameraColor> best = FitChartAt(corners, chart, name, merged);
  for (int quarter = 1; quarter < 4; ++quarter) {
    std::rotate(corners.begin(), corners.begin() + 2, corners.end());
    auto fitted = FitChartAt(corners, chart, name, merged);
    if (fitted && (!best || *fitted->delta_e_mean < *best->delta_e_mean)) best = std::move(fitted);
  }
  return best;
}

}  // namespace

Result<CameraColor> ColorFromChart(Session& session, const Sources& sources,
                                   const CameraFramesDescription& what,
                                   const MergedBracket& merged) {
  const std::string path = PathInSession(session, what.chart);
  const auto text = sources.read_text(path);
  if (!text) return tl::unexpected(text.error());
  const auto chart = ParseChartFile(*text, what.chart);
  if (!chart) return tl::unexpected(chart.error());
  NoteInputFile(path, session);
  if (chart->corners) return FitChartAt(*chart->corners, *chart, what.chart, merged);
  const auto found =
      sources.find_chart({merged.picture.data(), merged.width, merged.height, merged.channels});
  if (!found) return tl::unexpected(found.error());
  return FitChartAnyWayRound(*found, *chart, what.chart, merged);
}

Result<void> AddOwnColor(Session& session, const Sources& sources, const FrameInfo& info,
                         CameraProfile& profile) {
  const std::string& name = session.camera.sensitivities;
  if (!name.empty()) {
    const std::string path = PathInSession(session, name);
    const auto text = sources.read_text(path);
    if (!text) return tl::unexpected(text.error());
    auto sensitivities = CameraSensitivitiesFromJson(*text, name);
    if (!sensitivities) return Propagate(std::move(sensitivities));
    const auto camera = SpectralCamera::Make(*sensitivities);
    if (!camera) return tl::unexpected(camera.error());
    NoteInputFile(path, session);
    profile.sensitivities = std::move(*sensitivities);
    profile.color = {ColorMatrixSource::kSensitivities, camera->xyz_from_raw(), {}, {}};
    return {};
  }
  if (!info.matrices) return {};
  const auto daylight = DaylightXyzFromRaw(*info.matrices);
  if (!daylight) return tl::unexpected(daylight.error());
  profile.color = {ColorMatrixSource::kDng, *daylight, {}, {}};
  return {};
}

}  // namespace lightcal
