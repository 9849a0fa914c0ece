// SPDX-License-Identifier: Apache-2.0
#include "color_batch.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "input_files.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/cct_batch.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal::app {
namespace {

constexpr std::size_t kFlushBytes = 1 << 16;
constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

// Where x, y and a name stand in a line.
struct Columns {
  std::size_t x = 0, y = 1;
  std::optional<std::size_t> name;
  bool named = false;
};

void CellsInto(std::vector<std::string_view>& cells, std::string_view line) {
  cells.clear();
  for (std::size_t from = 0; from <= line.size();) {
    // Between quotes a comma parts nothing; a quote in a name is written twice.
    std::size_t quoted = from;
    const std::size_t content = line.find_first_not_of(" \t", from);
    if (content != std::string_view::npos && line[content] == '"') {
      quoted = std::min(line.find('"', content + 1), line.size());
      while (quoted + 1 < line.size() && line[quoted + 1] == '"') {
        quoted = std::min(line.find('"', quoted + 2), line.size());
      }
    }
    const std::size_t comma = std::min(line.find(',', quoted), line.size());
    cells.push_back(TrimBlanks(line.substr(from, comma - from)));
    from = comma + 1;
  }
}

// The columns that a line of names names; absent for a line of anything else.
std::optional<Columns> NamedColumns(std::string_view line) {
  std::vector<std::string_view> cells;
  CellsInto(cells, line);
  const auto x = std::ranges::find(cells, "x");
  const auto y = std::ranges::find(cells, "y");
  if (x == cells.end() || y == cells.end()) return std::nullopt;
  const auto name =
      std::ranges::find_if(cells, [](std::string_view cell) { return LowerAscii(cell) == "name"; });
  const auto at = [&](auto cell) { return static_cast<std::size_t>(cell - cells.begin()); };
  return Columns{at(x), at(y), name == cells.end() ? std::nullopt : std::optional(at(name)), true};
}

// A cell's contents without the quotes about them.
std::string Unquoted(std::string_view cell) {
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return std::string(cell);
  std::string content(cell.substr(1, cell.size() - 2));
  for (std::size_t at = 0; (at = content.find("\"\"", at)) != std::string::npos; ++at) {
    content.erase(at, 1);
  }
  return content;
}

struct BatchRow {
  std::string_view typed;  // "x,y" as it stands in the input
  std::string_view name;   // its cell, quotes included
  Xy xy;
  CctResult cct;
};

struct Sink {
  std::function<void(bool with_name)> names;
  std::function<void(const BatchRow&)> row;
};

// Some thousand rows at a time, so that their temperatures are found side by side.
class RowBlock {
 public:
  RowBlock(const std::string& name, const Sink& sink) : name_(name), sink_(sink) {}

  Result<void> Add(std::string_view line, const Columns& columns, std::size_t number) {
    CellsInto(cells_, line);
    const bool fits =
        columns.named ? cells_.size() > std::max(columns.x, columns.y) : cells_.size() == 2;
    if (!fits) {
      return Refused("bad_row", Where(number),
                     "a line is x,y; other columns need a first line that names x and y");
    }
    const auto x = ParseNumber(cells_[columns.x]);
    const auto y = ParseNumber(cells_[columns.y]);
    if (!x || !y) return Refused("bad_row", Where(number), "x and y must be finite numbers");
    typed_.append(cells_[columns.x]).append(1, ',').append(cells_[columns.y]);
    typed_ends_.push_back(typed_.size());
    if (columns.name && *columns.name < cells_.size()) names_.append(cells_[*columns.name]);
    name_ends_.push_back(names_.size());
    colors_.push_back({*x, *y});
    numbers_.push_back(number);
    return colors_.size() < kRowsInBlock ? Result<void>{} : Answer();
  }

  // Hands every row added so far to the sink, up to one that is no colour.
  Result<void> Answer() {
    results_.resize(colors_.size());
    CctBatch(colors_, results_);
    std::size_t from = 0, name_from = 0;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      if (results_[i].status == CctStatus::kNotAChromaticity) {
        return NotAChromaticity(Where(numbers_[i]));
      }
      const auto typed = std::string_view(typed_).substr(from, typed_ends_[i] - from);
      const auto name = std::string_view(names_).substr(name_from, name_ends_[i] - name_from);
      sink_.row({typed, name, colors_[i], results_[i]});
      from = typed_ends_[i];
      name_from = name_ends_[i];
    }
    typed_.clear();
    typed_ends_.clear();
    names_.clear();
    name_ends_.clear();
    colors_.clear();
    numbers_.clear();
    return {};
  }

 private:
  static constexpr std::size_t kRowsInBlock = 2048;
  [[nodiscard]] std::string Where(std::size_t number) const {
    return name_ + ":" + std::to_string(number);
  }

  const std::string& name_;
  const Sink& sink_;
  std::vector<std::string_view> cells_;
  std::string typed_, names_;
  std::vector<std::size_t> typed_ends_, name_ends_, numbers_;
  std::vector<Xy> colors_;
  std::vector<CctResult> results_;
};

Result<void> ForEachRow(std::istream& stream, const std::string& name, const Sink& sink) {
  Columns columns;
  RowBlock block(name, sink);
  std::string line;
  std::size_t rows = 0;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::string_view text = line;
    if (number == 1 && text.starts_with(kUtf8Mark)) text.remove_prefix(kUtf8Mark.size());
    text = TrimBlanks(text);
    if (text.empty()) continue;
    if (const auto named = rows == 0 && !columns.named ? NamedColumns(text) : std::nullopt) {
      columns = *named;
      sink.names(columns.name.has_value());
      continue;
    }
    if (auto added = block.Add(text, columns, number); !added) {
      auto before = block.Answer();  // an earlier row may be the first bad one
      return before ? added : before;
    }
    ++rows;
  }
  if (auto last = block.Answer(); !last) return last;
  if (stream.bad()) return Failed("unreadable", name, "cannot be read");
  if (rows == 0) return Refused("no_rows", name, "holds no x,y line");
  return {};
}

// CSV lines, a buffer at a time; with --json one array.
class Writer {
 public:
  explicit Writer(Console& console) : console_(console) {}

  void Names(bool with_name) {
    with_name_ = with_name;
    buffer_ += with_name ? "x,y,cct_K,duv,name" : "x,y,cct_K,duv";
    EndLine();
  }
  void Add(const BatchRow& row) {
    if (console_.json()) {
      rows_.push_back({{"name", Node::UnlessEmpty(Unquoted(row.name))},
                       {"xy", {row.xy.x, row.xy.y}},
                       {"cct_K", row.cct.valid() ? Node(row.cct.temperature) : Node()},
                       {"duv", row.cct.duv}});
      return;
    }
    buffer_.append(row.typed).append(1, ',');
    if (row.cct.valid()) AppendShortest(row.cct.temperature.value());
    buffer_ += ',';
    AppendShortest(row.cct.duv);
    if (with_name_) buffer_.append(1, ',').append(row.name);
    EndLine();
  }
  void Flush() {
    console_.Print(buffer_);
    buffer_.clear();
  }
  void Finish() {
    Flush();
    console_.PrintDocument({{"rows", rows_}});
  }

 private:
  void AppendShortest(double value) {
    std::array<char, 32> text{};  // the shortest form of a double has at most 24 characters
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), value == 0.0 ? 0.0 : value);
    buffer_.append(text.data(), end.ptr);
  }
  void EndLine() {
    buffer_ += '\n';
    if (buffer_.size() >= kFlushBytes) Flush();
  }

  Console& console_;
  std::string buffer_;
  bool with_name_ = false;
  std::vector<Node> rows_;
};

Result<void> WriteRows(std::istream& stream, const std::string& name, Console& console) {
  Writer writer(console);
  auto done = ForEachRow(stream, name,
                         {[&](bool with_name) { writer.Names(with_name); },
                          [&](const BatchRow& row) { writer.Add(row); }});
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
  NoteInput(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Failed("unreadable", path, "cannot be read; check its permissions");
  if (std::filesystem::is_regular_file(path)) {
    const Sink nothing = {[](bool) {}, [](const BatchRow&) {}};
    if (auto checked = ForEachRow(stream, path, nothing); !checked) return checked;
    stream.clear();
    stream.seekg(0);
  }
  return WriteRows(stream, path, console);
}

}  // namespace lightcal::app
