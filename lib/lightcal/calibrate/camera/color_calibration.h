// SPDX-License-Identifier: Apache-2.0
// The colour matrix of a camera: from its sensitivities, its files, or a chart.
#pragma once

#include "lightcal/core/result.h"
#include "lightcal/imaging/bracket/merge_frames.h"
#include "lightcal/records/camera_profile.h"
#include "lightcal/records/session.h"
#include "lightcal/records/sources.h"

namespace lightcal {

// Of [camera] sensitivities, which the profile then carries along, else of the DNG matrices in
// `info`; a file without either leaves profile.color empty.
// Refused as CameraSensitivitiesFromJson, SpectralCamera::Make, DaylightXyzFromRaw.
[[nodiscard]] Result<void> AddOwnColor(Session& session, const Sources& sources,
                                       const FrameInfo& info, CameraProfile& profile);

// Of the chart in a picture merged by BracketMergeRequest::raw: the middle of each patch, a fifth
// of the distance to its neighbours each way. Refused as ParseChartFile, ChartGrid::Make,
// MeasureRawPatch, FitChart; patch_uneven; where
// the file does not say where the chart is, as Sources::find_chart.
[[nodiscard]] Result<CameraColor> ColorFromChart(Session& session, const Sources& sources,
                                                 const CameraFramesDescription& what,
                                                 const MergedBracket& merged);

}  // namespace lightcal
