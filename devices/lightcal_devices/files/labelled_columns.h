// SPDX-License-Identifier: Apache-2.0
// Exports with one label per row and one column per measurement (Sekonic, UPRtek, JETI): what they
// share once the format has said how its labels read.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/files/delimited_text.h"
#include "lightcal_devices/files/spectrum_readings.h"

namespace lightcal::devices::files {

// The labels of the header rows; the first row that carries one wins. "" = the format has none;
// a final '*' matches any ending, a leading '*' any beginning.
struct HeaderLabels {
  std::string_view illuminance, cct, duv, x, y, X, Y, Z, cri_Ra;
  std::string_view cri_R;  // what stands before the 1 of R1
  std::string_view tm30_rf, tm30_rg;
};

struct SpectralRows {
  std::vector<double> wavelengths_nm;
  std::vector<const Row*> rows;  // label first, then one value per measurement
};

class LabelledColumns {
 public:
  LabelledColumns(std::vector<Row> rows, bool decimal_comma, std::string_view file_name)
      : rows_(std::move(rows)), decimal_comma_(decimal_comma), file_name_(file_name) {}

  // Decimal commas where the spectrum has them and another character parts the cells.
  // Refused: decimals_ambiguous, where commas part cells and every one of several values of the
  // spectrum is of digits alone, as halves of 0,5 are.
  [[nodiscard]] Result<void> FindDecimals(const SpectralRows& spectral, char delimiter);

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] std::string_view file_name() const { return file_name_; }
  // The cell of a labelled row, "" where there is none.
  [[nodiscard]] std::string_view Value(std::string_view label, std::size_t column) const;
  // The same as a number; absent for "---", "Under", "Not calculated" and the like.
  [[nodiscard]] std::optional<double> Number(std::string_view label, std::size_t column) const;
  // Colour rendering is absent where no CCT is reported: instruments then print 0 for it too.
  [[nodiscard]] ReportedColor Reported(const HeaderLabels& labels, std::size_t column) const;
  // The columns that hold a spectrum: those filled in the first spectral row.
  [[nodiscard]] static std::vector<std::size_t> MeasuredColumns(const SpectralRows& spectral);
  // Values of one column times `scale`. Refused: bad_spectrum, naming the line that is no number.
  [[nodiscard]] Result<Spectrum> SpectrumOf(const SpectralRows& spectral, std::size_t column,
                                            double scale) const;

 private:
  void ReadRendering(const HeaderLabels& labels, std::size_t column, ReportedColor& reported) const;
  [[nodiscard]] const Row* Find(std::string_view label) const;

  std::vector<Row> rows_;
  bool decimal_comma_;
  std::string file_name_;
};

}  // namespace lightcal::devices::files
