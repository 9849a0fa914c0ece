// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/photometric_codec.h"

#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_checks.h"

namespace lightcal {
namespace {

constexpr double kFluxTolerance = 0.05;

// A header that promises other lumens than its own intensities carry. Without an output ratio its
// lamps' lumens are the most that can come out.
void CheckFlux(ReadPhotometric& read, std::string_view where) {
  const PhotometricHeader& header = read.file.header;
  if (!header.lamp_flux) return;
  const double lamps = header.lamp_flux->value();
  const double promised = lamps * header.output_ratio.value_or(1.0);
  const double carried = read.file.table.Flux().value();
  if (carried - promised <= kFluxTolerance * promised &&
      (!header.output_ratio || promised - carried <= kFluxTolerance * promised)) {
    return;
  }
  read.warnings.push_back(
      {"flux_disagrees", std::string(where),
       "its intensities carry " + RoundedText(carried, 4) + " lm, " +
           (header.output_ratio
                ? "its lamps and output ratio promise " + RoundedText(promised, 4) + " lm"
                : "more than its lamps' " + RoundedText(promised, 4) + " lm") +
           "; the intensities are believed"});
}

}  // namespace

Result<ReadPhotometric> PhotometricFromText(std::string_view text, std::string_view where,
                                            const TiltText& tilt, std::optional<int> lamp_set) {
  if (text.size() > kMaxPhotometricBytes) {
    return Refused("too_large", std::string(where),
                   "is larger than 32 MiB, which no lamp's file is");
  }
  const bool ies = IsIes(text);
  if (ies && lamp_set && *lamp_set != 1) {
    return Refused("no_lamp_set", std::string(where),
                   "is an IES file, which describes one set of lamps; leave {photometric.set} out");
  }
  auto read = ies ? IesFromText(text, where, tilt) : EulumdatFromText(text, where, lamp_set);
  if (!ies && !read && read.error().code == "bad_photometric") {
    return Refused("unknown_format", std::string(where),
                   "is neither IES LM-63 (no TILT= line) nor EULUMDAT: " + read.error().message);
  }
  if (!read) return read;
  CheckFlux(*read, where);
  records::WarnOfGaps(read->file.table.grid(), where, read->warnings);
  return read;
}

}  // namespace lightcal
