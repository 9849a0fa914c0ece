// SPDX-License-Identifier: Apache-2.0
// Fixtures as consoles and visualisers share them: .gdtf, a zip with a description.xml.
#pragma once

#include <string>
#include <string_view>

#include "lightcal/core/result.h"
#include "lightcal/records/gdtf.h"

namespace lightcal::devices {

// The parts of a fixture that GdtfFixture holds; what else stands there is passed over. The
// schema's rules are not asked for (files in use break them: Physical="0"); numbers that cannot be
// (a negative flux, a full angle over 360, an emitter's level outside 0 ... 100) are refused, and
// a level of 0, which says nothing, is left out.
// Fails: not_found, unreadable. Refused: bad_archive, too_large (the archive over 256 MiB, its
// description over 8 MiB when unpacked), bad_gdtf (says where).
[[nodiscard]] Result<GdtfFixture> ReadGdtf(const std::string& path);
[[nodiscard]] Result<GdtfFixture> GdtfFromArchive(std::string_view bytes, std::string_view name);
[[nodiscard]] Result<GdtfFixture> GdtfFromDescription(std::string_view xml, std::string_view name);

}  // namespace lightcal::devices
