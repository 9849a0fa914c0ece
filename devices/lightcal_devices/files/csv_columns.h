// SPDX-License-Identifier: Apache-2.0
// What the column names of a plain CSV mean. A quantity's name carries its unit: distance_cm,
// "Illuminance [fc]", "warm irradiance_mW_m2_nm".
#pragma once

#include <string>
#include <string_view>

namespace lightcal::devices::files {

enum class CsvQuantity {
  kUnknown,
  kLeftOut,    // "-": a person's word for a column that is not wanted; or a spectrum's uncertainty
  kNeedsUnit,  // a length, angle or irradiance whose unit the name does not say
  kDistance,
  kIlluminance,
  kCard,  // lux behind a shadow card at the place of the row's reading
  kCct,
  kDuv,
  kX,
  kY,
  kTilt,
  kOffAxis,
  kPositionX,  // of the meter
  kPositionY,
  kPositionZ,
  kNormalX,  // the way it faces
  kNormalY,
  kNormalZ,
  kSigma,
  kLight,
  kMeter,
  kTime,
  kDate,       // beside a time of its own (csv_table.h)
  kTimestamp,  // a time where every cell is one (csv_table.h)
  kLamp,
  kFixture,  // the light's name where no other column is (csv_table.h)
  kShadowCard,
  kState,         // a control of the lamp, its name in series
  kDimmerUnsaid,  // the dimmer, in percent unless no value is above 1 (csv_table.h)
  kWavelength,
  kIrradiance,
  kRelative,
};

struct CsvColumn {
  CsvQuantity quantity = CsvQuantity::kUnknown;
  double scale = 1.0;   // file value times scale = m, lx, K, degrees, nm, W m^-2 nm^-1
  std::string written;  // the name as written
  std::string series;   // of a spectral column what its name says beside the unit; a control's name
};

[[nodiscard]] CsvColumn ColumnFromName(std::string_view name);

// For messages: every name understood, and the nearest one to a name that is not.
[[nodiscard]] std::string KnownColumnNames();
[[nodiscard]] std::string NearestColumnName(std::string_view name);

}  // namespace lightcal::devices::files
