// SPDX-License-Identifier: Apache-2.0
// A drawing as the file its name asks for: .svg as it is, .png painted by librsvg at twice its
// size, .pdf in vectors.
#pragma once

#include <string>

#include "lightcal/core/result.h"
#include "output_files.h"

namespace lightcal::app {

// Wrong usage unless the name ends in .svg or .png.
[[nodiscard]] Result<void> CheckPictureName(const std::string& option, const std::string& path);

// svg: a whole SVG file with a viewBox. The PNG is what a light screen shows of it, on white, and
// says in its "Software" text that lightcal wrote it. librsvg is opened here, at the first PNG, so
// that starting lightcal costs nothing; fails: no_rasterizer (it is not installed), bad_drawing.
[[nodiscard]] Result<OutputFile> PictureFile(const std::string& path, const std::string& svg);

// A page to print, in true size: .svg as it is, .pdf drawn by librsvg in vectors and dated by
// SOURCE_DATE_EPOCH, else 2000-01-01.   Wrong usage: another ending. Fails: no_rasterizer,
// bad_drawing.
[[nodiscard]] Result<OutputFile> PrintFile(const std::string& path, const std::string& svg,
                                           double width_mm, double height_mm);

}  // namespace lightcal::app
