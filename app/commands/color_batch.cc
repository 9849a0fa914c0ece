// SPDX-License-Identifier: Apache-2.0
#include "color_batch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kFlushBytes = 1 << 16;
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

// Where x and y stand in a line.
struct Columns {
  std::size_t x = 0, y = 1;
  bool named = false;
};

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    cells.push_back(TrimBlanks(line.substr(from, comma - from)));
    from = comma + 1;
  }
  return cells;
}

// The columns that a line of names names; absent for a line of anything else.
std::optional<Columns> NamedColumns(std::string_view line) {
  const auto cells = Cells(line);
  const auto x = std::ranges::find(cells, "x");
  const auto y = std::ranges::find(cells, "y");
  if (x == cells.end() || y == cells.end()) return std::nullopt;
  return Columns{static_cast<std::size_t>(x - cells.begin()),
                 static_cast<std::size_t>(y - cells.begin()), true};
}

struct Row {
  std::string_view x_text, y_text;
  Xy xy;
  CctResult cct;
};

Result<Row> RowFromLine(std::string_view line, const Columns& columns, const std::string& where) {
  const auto cells = Cells(line);
  const bool fits =
      columns.named ? cells.size() > std::max(columns.x, columns.y) : cells.size() == 2;
  if (!fits) {
    return Refused("bad_row", where,
                   "a line is x,y; other columns need a first line that names x and y");
  }
  Row row{cells[columns.x], cells[columns.y], {}, {}};
  const auto x = ParseNumber(row.x_text);
  const auto y = ParseNumber(row.y_text);
  if (!x || !y) return Refused("bad_row", where, "x and y must be finite numbers");
  row.xy = {*x, *y};
  row.cct = CctFromXy(row.xy);
  if (row.cct.status == CctStatus::kNotAChromaticity) return NotAChromaticity(where);
  return row;
}

struct Sink {
  std::function<void()> names;
  std::function<void(const Row&)> row;
};

Result<void> ForEachRow(std::istream& stream, const std::string& name, const Sink& sink) {
  Columns columns;
  std::string line;
  std::size_t rows = 0;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::string_view text = line;
    if (number == 1 && text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
    text = TrimBlanks(text);
    if (text.empty()) continue;
    if (const auto named = rows == 0 && !columns.named ? NamedColumns(text) : std::nullopt) {
      columns = *named;
      sink.names();
      continue;
    }
    auto row = RowFromLine(text, columns, name + ":" + std::to_string(number));
    if (!row) return Propagate(std::move(row));
    sink.row(*row);
    ++rows;
  }
  if (stream.bad()) return Failed("unreadable", name, "cannot be read");
  if (rows == 0) return Refused("no_rows", name, "holds no x,y line");
  return {};
}

// CSV lines, a buffer at a time; with --json one array.
class Writer {
 public:
  explicit Writer(Console& console) : console_(console) {}

  void Names() { Line("x,y,cct_K,duv"); }
  void Add(const Row& row) {
    if (console_.json()) {
      nlohmann::ordered_json json = {{"xy", {row.xy.x, row.xy.y}}};
      if (row.cct.valid()) json["cct_K"] = row.cct.temperature.value();
      json["duv"] = row.cct.duv;
      rows_.push_back(std::move(json));
      return;
    }
    std::string line = std::string(row.x_text) + "," + std::string(row.y_text) + ",";
    if (row.cct.valid()) line += ShortestText(row.cct.temperature.value());
    Line(line + "," + ShortestText(row.cct.duv));
  }
  void Flush() {
    console_.Print(buffer_);
    buffer_.clear();
  }
  void Finish() {
    Flush();
    console_.PrintJson({{"rows", std::move(rows_)}});
  }

 private:
  void Line(const std::string& line) {
    buffer_ += line + "\n";
    if (buffer_.size() >= kFlushBytes) Flush();
  }

  Console& console_;
  std::string buffer_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

Result<void> WriteRows(std::istream& stream, const std::string& name, Console& console) {
  Writer writer(console);
  auto done =
      ForEachRow(stream, name, {[&] { writer.Names(); }, [&](const Row& row) { writer.Add(row); }});
  if (!done) {
    writer.Flush();
    return done;
  }
  writer.Finish();
  return {};
}

Result<void> CheckFile(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return Failed("not_found", path, "there is no such file");
  }
  if (std::filesystem::is_directory(path, ignored)) {
    return Failed("unreadable", path, "is a directory; name the file in it");
  }
  return {};
}

}  // namespace

tl::unexpected<Error> NotAChromaticity(const std::string& subject) {
  return Refused("bad_chromaticity", subject,
                 "no light has this chromaticity: x and y must be finite with y above 0 and "
                 "12y + 3 above 2x");
}

Result<void> RunColorBatch(const std::string& path, Console& console) {
  if (path == "-") return WriteRows(std::cin, "standard input", console);
  if (auto checked = CheckFile(path); !checked) return checked;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Failed("unreadable", path, "cannot be read; check its permissions");
  if (std::filesystem::is_regular_file(path)) {
    const Sink nothing = {[] {}, [](const Row&) {}};
    if (auto checked = ForEachRow(stream, path, nothing); !checked) return checked;
    stream.clear();
    stream.seekg(0);
  }
  return WriteRows(stream, path, console);
}

}  // namespace lightcal::app
