// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/labelled_columns.h"

#include <algorithm>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::files {
namespace {

bool Matches(std::string_view label, std::string_view pattern) {
  if (pattern.empty()) return false;
  if (pattern.ends_with('*')) return label.starts_with(pattern.substr(0, pattern.size() - 1));
  if (pattern.starts_with('*')) return label.ends_with(pattern.substr(1));
  return label == pattern;
}

}  // namespace

const Row* LabelledColumns::Find(std::string_view label) const {
  const auto row = std::ranges::find_if(
      rows_, [&](const Row& candidate) { return Matches(CellAt(candidate, 0), label); });
  return row == rows_.end() ? nullptr : &*row;
}

Result<void> LabelledColumns::FindDecimals(const SpectralRows& spectral, char delimiter) {
  bool several = false, point = false;
  for (const Row* row : spectral.rows) {
    for (std::size_t column = 1; column < row->cells.size(); ++column) {
      const std::string& cell = row->cells[column];
      point = point || cell.find('.') != std::string::npos;
      several = several || column > 1;
      const bool comma = cell.find(',') != std::string::npos && ParseNumber(cell, true);
      if (delimiter != ',' && comma) decimal_comma_ = true;
    }
  }
  if (delimiter != ',' || !several || point) return {};
  return Refused(
      "decimals_ambiguous", file_name_,
      "commas part its cells, and its spectrum has no decimal point: its numbers seem to "
      "have decimal commas, which cannot be told from those between cells. Export it "
      "with decimal points, or with semicolons or tabs between the cells");
}

std::string_view LabelledColumns::Value(std::string_view label, std::size_t column) const {
  const Row* row = Find(label);
  return row == nullptr ? std::string_view() : CellAt(*row, column);
}

std::optional<double> LabelledColumns::Number(std::string_view label, std::size_t column) const {
  return ParseNumber(Value(label, column), decimal_comma_);
}

ReportedColor LabelledColumns::Reported(const HeaderLabels& labels, std::size_t column) const {
  ReportedColor reported;
  reported.illuminance_lx = Number(labels.illuminance, column);
  if (reported.illuminance_lx) {
    reported.illuminance_last_digit_lx = LastDigit(Value(labels.illuminance, column));
  }
  const auto cct = Number(labels.cct, column);
  if (cct && *cct > 0.0) {  // instruments print 0 where a CCT means nothing, and a Duv of 0 with it
    reported.cct_K = cct;
    reported.cct_last_digit_K = LastDigit(Value(labels.cct, column));
    reported.duv = Number(labels.duv, column);
    if (reported.duv) reported.duv_last_digit = LastDigit(Value(labels.duv, column));
  }
  const auto x = Number(labels.x, column);
  const auto y = Number(labels.y, column);
  if (x && y && *y > 0.0) reported.xy = Xy{*x, *y};
  const auto X = Number(labels.X, column);
  const auto Y = Number(labels.Y, column);
  const auto Z = Number(labels.Z, column);
  if (X && Y && Z) reported.xyz = Xyz{*X, *Y, *Z};
  if (reported.cct_K) ReadRendering(labels, column, reported);
  return reported;
}

void LabelledColumns::ReadRendering(const HeaderLabels& labels, std::size_t column,
                                    ReportedColor& reported) const {
  reported.cri_Ra = Number(labels.cri_Ra, column);
  for (std::size_t i = 0; i < reported.cri_R.size(); ++i) {
    reported.cri_R[i] = Number(std::string(labels.cri_R) + std::to_string(i + 1), column);
  }
  reported.tm30_rf = Number(labels.tm30_rf, column);
  reported.tm30_rg = Number(labels.tm30_rg, column);
}

std::vector<std::size_t> LabelledColumns::MeasuredColumns(const SpectralRows& spectral) {
  std::vector<std::size_t> columns;
  if (spectral.rows.empty()) return columns;
  const Row& first = *spectral.rows.front();
  for (std::size_t column = 1; column < first.cells.size(); ++column) {
    if (!TrimBlanks(first.cells[column]).empty()) columns.push_back(column);
  }
  return columns;
}

Result<Spectrum> LabelledColumns::SpectrumOf(const SpectralRows& spectral, std::size_t column,
                                             double scale) const {
  Spectrum spectrum;
  spectrum.wavelengths_nm = spectral.wavelengths_nm;
  for (const Row* row : spectral.rows) {
    const auto value = ParseNumber(CellAt(*row, column), decimal_comma_);
    if (!value) {
      return Refused("bad_spectrum", AtLine(file_name_, row->line),
                     "'" + std::string(CellAt(*row, column).substr(0, 40)) +
                         "' is no spectral value; the file is damaged or cut short");
    }
    spectrum.values.push_back(*value * scale);
  }
  return spectrum;
}

}  // namespace lightcal::devices::files
