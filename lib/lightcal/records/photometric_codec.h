// SPDX-License-Identifier: Apache-2.0
// IES LM-63 (1986 to 2019) and EULUMDAT files, read and written.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/photometric_file.h"

namespace lightcal {

// No lamp needs more; larger files are refused before they are held.
inline constexpr std::size_t kMaxPhotometricBytes = 32U << 20U;

struct ReadPhotometric {
  PhotometricFile file;
  Warnings warnings;  // reserved_field, tilt_missing, flux_disagrees, lamp_sets, no_axis, ...
};

// The text of the file beside an IES file that its TILT=name names. Names with a path in them are
// refused before it is asked.
using TiltText = std::function<Result<std::string>(const std::string& name)>;

// Tells the two formats apart by content. `where` stands in messages. lamp_set: which of a EULUMDAT
// file's sets of lamps is in it, from 1; the first where absent.
// Refused: unknown_format, bad_photometric (names line or value), bad_table, no_lamp_set,
// too_large, unsafe_path. Memory stays within a small multiple of the text, whatever counts it
// claims.
[[nodiscard]] Result<ReadPhotometric> PhotometricFromText(std::string_view text,
                                                          std::string_view where,
                                                          const TiltText& tilt = {},
                                                          std::optional<int> lamp_set = {});

// I = candela x multiplier x ballast factor [x ballast-lamp factor, 1986 and 1991 only]. The
// twelfth number of LM-63-2019 says how the data came to be (1.1, 1.00001 ...) and multiplies
// nothing. Lengths in feet become metres.
[[nodiscard]] bool IsIes(std::string_view text);
[[nodiscard]] Result<ReadPhotometric> IesFromText(std::string_view text, std::string_view where,
                                                  const TiltText& tilt = {});
// LM-63-2002 as the strictest readers want it: CRLF, absolute candela with all factors 1, whole
// numbers without decimals, ASCII, the flux of the table where no lamp flux is known (never -1).
// Eight significant digits. Keeps the table's type and planes, but a table of C90 to C270 (1995
// only) is written with its mirror image from 0 to 360, and a full turn with its last plane.
[[nodiscard]] std::string IesText(const PhotometricFile& file);

// I = value x lamp lumens / 1000 x conversion factor (CFLI); a negative lamp count marks absolute
// photometry, whose lumens are those of the luminaire. Decimal points and commas. The sets of lamps
// are alternatives (Stockmar 1990: "number of standard sets of lamps", normally 1), candela per
// 1000 lm hold for each.
[[nodiscard]] Result<ReadPhotometric> EulumdatFromText(std::string_view text,
                                                       std::string_view where,
                                                       std::optional<int> lamp_set = {});
// EULUMDAT in ISO 8859-1 with CRLF, ten significant digits. Type C only.   Refused: needs_type_c.
[[nodiscard]] Result<std::string> EulumdatText(const PhotometricFile& file);

}  // namespace lightcal
