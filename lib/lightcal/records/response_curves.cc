// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/response_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr int kHighestCode = 65535;
constexpr double kLeastCode = 0.5;  // of code 0: what it stands for is not nothing

std::vector<double> NumbersOf(std::string_view line) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = std::min(line.find_first_of(",;\t"), line.size());
    const auto number = ParseNumber(line.substr(0, comma));
    if (!number) return {};
    numbers.push_back(*number);
    if (comma == line.size()) return numbers;
    line.remove_prefix(comma + 1);
  }
}

// Codes and one signal a column, as far as they were read.
struct Table {
  std::vector<double> codes;
  std::vector<std::vector<double>> columns;
};

// Why a line cannot follow those before; empty where it can.
std::string FaultOf(const Table& table, const std::vector<double>& line) {
  if (line.size() != 2 && line.size() != 4) {
    return "a line is code,signal or code,red,green,blue";
  }
  if (table.codes.empty()) {
    return line[0] == 0.0 || line[0] == 1.0 ? "" : "codes begin at 0 or 1";
  }
  if (line.size() != table.columns.size() + 1) return "it has other columns than those above it";
  if (!(line[0] > table.codes.back()) || line[0] > kHighestCode) {
    return "codes rise, up to 255 or 65535";
  }
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (line[c + 1] < table.columns[c].back()) return "more light gives no lower signal";
  }
  return "";
}

// Between the codes of the table straight lines; below its first, one through 0.
double SignalAt(const Table& table, std::size_t column, double code) {
  const auto& codes = table.codes;
  const auto& signals = table.columns[column];
  if (code < codes.front()) return signals.front() * code / codes.front();
  const auto at = static_cast<std::size_t>(std::ranges::upper_bound(codes, code) - codes.begin());
  if (at == codes.size()) return signals.back();
  const double share = (code - codes[at - 1]) / (codes[at] - codes[at - 1]);
  return signals[at - 1] + share * (signals[at] - signals[at - 1]);
}

// Code 0 stands for half a code; no signal is 0, whose logarithm nobody could take.
template <typename Signal>
std::vector<float> CurveOf(int top, Signal&& signal) {
  std::vector<float> curve;
  for (int code = 0; code <= top; ++code) {
    const double value = signal(std::max(kLeastCode, static_cast<double>(code)));
    curve.push_back(std::max(static_cast<float>(value), 1e-9F));
  }
  return curve;
}

}  // namespace

bool IsResponseWord(std::string_view word) {
  return std::ranges::find(kResponseWords, word) != kResponseWords.end();
}

ResponseCurves ResponseNamed(std::string_view word) {
  ResponseCurves curves;
  const bool linear = word == kResponseWords[1];
  curves.signal_of_code.fill(CurveOf(kHighestCode, [&](double code) {
    return linear ? code / kHighestCode : SrgbDecoded(code / kHighestCode);
  }));
  return curves;
}

Result<ResponseCurves> ResponseFromText(std::string_view text, const std::string& where) {
  Table table;
  int line_number = 0;
  const auto wrong = [&](const std::string& why) {
    return Refused("bad_response", where + ", line " + std::to_string(line_number), why);
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = TrimBlanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<double> numbers = NumbersOf(line);
    if (numbers.empty()) {
      if (table.codes.empty() && table.columns.empty() && line.starts_with("code")) continue;
      return wrong("holds no numbers; a line is code,signal or code,red,green,blue");
    }
    if (const auto fault = FaultOf(table, numbers); !fault.empty()) return wrong(fault);
    table.columns.resize(numbers.size() - 1);
    table.codes.push_back(numbers[0]);
    for (std::size_t c = 1; c < numbers.size(); ++c) table.columns[c - 1].push_back(numbers[c]);
  }
  if (table.codes.size() < 2 || (table.codes.back() != 255.0 && table.codes.back() < 1023.0)) {
    return wrong("the table ends before the highest code: 255, or of more bits 1023 to 65535");
  }
  ResponseCurves curves;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const double full = table.columns[c].back();
    if (!(table.columns[c].front() >= 0.0) || !(full > 0.0)) {
      return wrong("signals are 0 or above, and the highest code's above 0");
    }
    curves.signal_of_code[c] = CurveOf(static_cast<int>(table.codes.back()), [&](double code) {
      return SignalAt(table, c, code) / full;
    });
  }
  if (table.columns.size() == 1) curves.signal_of_code.fill(curves.signal_of_code[0]);
  return curves;
}

std::string ResponseToText(const ResponseCurves& curves) {
  const bool grey = curves.signal_of_code[1].empty();
  std::string text = "# written by " + GeneratorName() + ": response of codes, signal 1 = full\n";
  text += grey ? "code,signal\n" : "code,red,green,blue\n";
  for (std::size_t code = 0; code < curves.signal_of_code[0].size(); ++code) {
    text += std::to_string(code);
    for (std::size_t c = 0; c < (grey ? 1U : 3U); ++c) {
      text += "," + RoundedText(double{curves.signal_of_code[c][code]}, 7);
    }
    text += "\n";
  }
  return text;
}

ResponseCurves ResponseOfCodes(const ResponseCurves& curves, int top, int channels) {
  ResponseCurves fitted;
  for (int channel = 0; channel < channels; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    const auto& own = curves.signal_of_code[curves.signal_of_code[c].empty() ? 0 : c];
    const double highest = static_cast<double>(own.size() - 1);
    if (own.size() == static_cast<std::size_t>(top) + 1) {
      fitted.signal_of_code[c] = own;
      continue;
    }
    fitted.signal_of_code[c] = CurveOf(top, [&](double code) {
      const double at = highest * code / top;
      const auto low = std::min(static_cast<std::size_t>(at), own.size() - 2);
      return own[low] + (at - static_cast<double>(low)) * (double{own[low + 1]} - own[low]);
    });
  }
  return fitted;
}

}  // namespace lightcal
