// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/camera/chart_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "lightcal/core/numbers_text.h"
#include "lightcal/imaging/camera/find_chart.h"

namespace lightcal {
namespace {

constexpr int kMostPlaces = 100;  // columns, rows
constexpr double kMostXyz = 1000.0;
constexpr double kMostPixel = 1e6;

std::vector<std::string_view> Fields(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = std::min(line.find(','), line.size());
    fields.push_back(TrimBlanks(line.substr(0, comma)));
    if (comma == line.size()) return fields;
    line.remove_prefix(comma + 1);
  }
}

// CIELAB of D50 (X 96.422, Y 100, Z 82.521).   Source: CIE 15:2018, 8.2.1; ICC.1:2022.
Xyz XyzFromLab(double l, double a, double b) {
  const auto inverse = [](double f) {
    constexpr double kEdge = 6.0 / 29.0;
    return f > kEdge ? f * f * f : 3.0 * kEdge * kEdge * (f - 4.0 / 29.0);
  };
  const double fy = (l + 16.0) / 116.0;
  return {96.422 * inverse(fy + a / 500.0), 100.0 * inverse(fy), 82.521 * inverse(fy - b / 200.0)};
}

class ChartReader {
 public:
  explicit ChartReader(const std::string& where) : where_(where) {}

  Result<ChartFile> Read(std::string_view text) {
    for (int number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, std::min(end, text.find('#')));
      text.remove_prefix(std::min(end + 1, text.size()));
      line = TrimBlanks(line);
      if (line.empty()) continue;
      auto taken = Take(line, number);
      if (!taken) return Propagate(std::move(taken));
    }
    if (chart_.patches.empty()) return Bad(1, "holds no patch");
    const bool common = chart_.columns == kChartColumns && chart_.rows == kChartRows;
    if (!chart_.corners && !common) {
      return Bad(1, "does not say where its corner patches are in the picture");
    }
    return std::move(chart_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> Bad(int line, const std::string& what) const {
    return Refused("bad_chart", where_ + ":" + std::to_string(line),
                   what +
                       "; wanted are a line corners,x,y,x,y,x,y,x,y, one such as "
                       "name,column,row,L,a,b (or X,Y,Z), and one line a patch");
  }

  Result<void> Take(std::string_view line, int number) {
    if (!header_.empty()) return TakePatch(line, number);
    const auto fields = Fields(line);
    if (fields.front() == "corners") {
      return TakeNumbers(fields, number, chart_.corners.emplace());
    }
    if (fields.front() != "lamp_xy") return TakeHeader(line, number);
    std::array<double, 2> xy{};
    if (auto taken = TakeNumbers(fields, number, xy); !taken) return taken;
    if (!(xy[0] > 0.0 && xy[1] > 0.0 && xy[0] + xy[1] < 1.0)) {
      return Bad(number, "lamp_xy is no chromaticity");
    }
    chart_.lamp = Xy{xy[0], xy[1]};
    return {};
  }

  Result<void> TakeNumbers(const std::vector<std::string_view>& fields, int number,
                           std::span<double> out) const {
    if (fields.size() != out.size() + 1) {
      return Bad(number,
                 std::string(fields.front()) + " wants " + std::to_string(out.size()) + " numbers");
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto value = ParseNumber(fields[i + 1]);
      if (!value || std::abs(*value) > kMostPixel) {
        return Bad(number, std::string(fields.front()) + " holds something that is no number");
      }
      out[i] = *value;
    }
    return {};
  }

  [[nodiscard]] std::optional<std::size_t> ColumnOf(std::string_view name) const {
    const auto found = std::ranges::find(header_, name);
    if (found == header_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - header_.begin());
  }

  Result<void> TakeHeader(std::string_view line, int number) {
    for (const std::string_view field : Fields(line)) header_.emplace_back(field);
    const auto all = [this](const std::array<const char*, 3>& names) {
      return std::ranges::all_of(names, [this](const char* n) { return ColumnOf(n).has_value(); });
    };
    lab_ = all({"L", "a", "b"});
    if (!ColumnOf("column") || !ColumnOf("row") || lab_ == all({"X", "Y", "Z"})) {
      return Bad(number, "does not name the columns column, row and either L, a, b or X, Y, Z");
    }
    return {};
  }

  Result<void> TakePatch(std::string_view line, int number) {
    const auto fields = Fields(line);
    if (fields.size() != header_.size()) return Bad(number, "has another number of columns");
    std::array<double, 5> values{};
    const std::array<const char*, 5> names = {"column", "row", lab_ ? "L" : "X", lab_ ? "a" : "Y",
                                              lab_ ? "b" : "Z"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto value = ParseNumber(fields[*ColumnOf(names[i])]);
      if (!value || std::abs(*value) > kMostXyz) {
        return Bad(number, std::string(names[i]) + " is no number");
      }
      values[i] = *value;
    }
    const bool counts = values[0] >= 1.0 && values[1] >= 1.0 && values[0] <= kMostPlaces &&
                        values[1] <= kMostPlaces && values[0] == std::floor(values[0]) &&
                        values[1] == std::floor(values[1]);
    if (!counts) return Bad(number, "column and row count patches from 1");
    ChartFilePatch patch;
    if (const auto name = ColumnOf("name")) patch.name = fields[*name];
    patch.column = static_cast<int>(values[0]);
    patch.row = static_cast<int>(values[1]);
    patch.xyz =
        lab_ ? XyzFromLab(values[2], values[3], values[4]) : Xyz{values[2], values[3], values[4]};
    if (!(patch.xyz.Y > 0.0)) return Bad(number, "a patch has no luminance");
    chart_.columns = std::max(chart_.columns, patch.column);
    chart_.rows = std::max(chart_.rows, patch.row);
    chart_.patches.push_back(std::move(patch));
    return {};
  }

  const std::string& where_;
  std::vector<std::string> header_;
  bool lab_ = false;
  ChartFile chart_;
};

}  // namespace

Result<ChartFile> ParseChartFile(std::string_view text, const std::string& where) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return ChartReader(where).Read(text);
}

}  // namespace lightcal
