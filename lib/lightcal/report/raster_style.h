// SPDX-License-Identifier: Apache-2.0
// A figure's style sheet for a rasteriser.
#pragma once

#include <string>

namespace lightcal::report {

// The SVG with each var(--name) of its style sheet replaced by what the first :root sets it to, and
// without @media blocks: rasterisers (librsvg) know neither custom properties nor media, so this is
// the picture as a light screen shows it. An SVG without a style sheet comes back as it was.
[[nodiscard]] std::string ForRaster(std::string svg);

}  // namespace lightcal::report
