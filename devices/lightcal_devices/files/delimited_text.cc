// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/delimited_text.h"

#include <csv.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::files {
namespace {

// Absent where the bytes are not in that encoding.
std::optional<std::string> Converted(std::string_view bytes, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the value POSIX defines for failure.
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string source(bytes);
  char* in = source.data();
  std::size_t in_left = source.size();
  std::string text(2 * bytes.size() + 16, '\0');  // the longest any of our encodings becomes
  char* out = text.data();
  std::size_t out_left = text.size();
  const bool converted =
      iconv(converter, &in, &in_left, &out, &out_left) != static_cast<std::size_t>(-1);
  iconv_close(converter);
  if (!converted) return std::nullopt;
  text.resize(text.size() - out_left);
  return text;
}

std::optional<std::string> AnyTextAsUtf8(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    return Converted(bytes, "UTF-16");
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (auto utf8 = Converted(bytes, "UTF-8")) return utf8;
  return Converted(bytes, "ISO-8859-1");
}

void UnixLineEnds(std::string& text) {
  std::size_t to = 0;
  for (std::size_t from = 0; from < text.size(); ++from) {
    const bool before_newline = from + 1 < text.size() && text[from + 1] == '\n';
    if (text[from] == '\r' && before_newline) continue;
    text[to++] = text[from] == '\r' ? '\n' : text[from];
  }
  text.resize(to);
}

constexpr std::string_view kDecimalDigits = "0123456789";
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// ".250" or ",250" of a second, taken off the front, with a point; "" where there is none.
std::string TakeFraction(std::string_view& text) {
  const bool begins = text.size() > 1 && (text[0] == '.' || text[0] == ',') && IsDigit(text[1]);
  if (!begins) return {};
  const std::size_t end = std::min(text.find_first_not_of(kDecimalDigits, 1), text.size());
  std::string fraction = "." + std::string(text.substr(1, end - 1));
  text.remove_prefix(end);
  return fraction;
}

// "Z" or "+02:00" where the whole text is a zone ("Z", "UTC", "+02", "+0200", "+02:00"), else "".
std::string ZoneIn(std::string_view text) {
  text = TrimBlanks(text);
  if (text == "Z" || text == "z" || text == "UTC" || text == "GMT") return "Z";
  if (!text.starts_with('+') && !text.starts_with('-')) return {};
  std::string digits(text.substr(1));
  if (digits.size() == 5 && digits[2] == ':') digits.erase(2, 1);
  if (digits.size() == 2) digits += "00";
  if (digits.size() != 4 || !std::ranges::all_of(digits, IsDigit)) return {};
  return text.front() + digits.substr(0, 2) + ":" + digits.substr(2);
}

int IsBlank(unsigned char c) { return c == ' ' ? 1 : 0; }
int IsLineEnd(unsigned char c) { return c == '\n' ? 1 : 0; }

// What libcsv's C callbacks fill.
class RowCollector {
 public:
  explicit RowCollector(const RowVisitor& visit) : visit_(visit) {}

  static void TakeCell(void* data, std::size_t size, void* self) {
    static_cast<RowCollector*>(self)->AddCell({static_cast<const char*>(data), size});
  }
  static void EndRow(int /*terminator*/, void* self) {
    static_cast<RowCollector*>(self)->FinishRow();
  }
  [[nodiscard]] bool GoesOn() const { return result_.has_value(); }
  [[nodiscard]] Result<void> TakeResult() { return std::move(result_); }

 private:
  void AddCell(std::string_view cell) {
    if (count_ == cells_.size()) cells_.emplace_back();
    cells_[count_++].assign(cell);
  }
  void FinishRow() {
    const std::span<const std::string> cells(cells_.data(), count_);
    if (result_) result_ = visit_(line_, cells);
    ++line_;
    for (const std::string& cell : cells) {  // a quoted cell may hold line ends of its own
      line_ += static_cast<int>(std::ranges::count(cell, '\n'));
    }
    count_ = 0;
  }

  const RowVisitor& visit_;
  std::vector<std::string> cells_;
  std::size_t count_ = 0;
  int line_ = 1;
  Result<void> result_;
};

}  // namespace

Result<std::string> TextFromBytes(std::string_view bytes, std::string_view name) {
  auto text = AnyTextAsUtf8(bytes);
  if (!text || text->find('\0') != std::string::npos) {
    return Refused("not_text", std::string(name),
                   "holds bytes that no text has; give the file the instrument's software exports");
  }
  UnixLineEnds(*text);
  return std::move(*text);
}

char DelimiterOf(std::string_view header) {
  for (const char delimiter : {'\t', ';'}) {
    if (header.find(delimiter) != std::string_view::npos) return delimiter;
  }
  return ',';
}

Result<void> ForEachRow(std::string_view text, char delimiter, const RowVisitor& visit) {
  csv_parser parser;
  if (csv_init(&parser, CSV_REPALL_NL) != 0) {
    return Failed("internal", "csv", "libcsv does not start");
  }
  csv_set_delim(&parser, static_cast<unsigned char>(delimiter));
  csv_set_space_func(&parser, IsBlank);
  csv_set_term_func(&parser, IsLineEnd);
  RowCollector collector(visit);
  constexpr std::size_t kChunk = 1 << 16;  // between chunks a refusal stops the parser
  for (std::size_t at = 0; at < text.size() && collector.GoesOn(); at += kChunk) {
    const std::string_view chunk = text.substr(at, kChunk);
    csv_parse(&parser, chunk.data(), chunk.size(), RowCollector::TakeCell, RowCollector::EndRow,
              &collector);
  }
  csv_fini(&parser, RowCollector::TakeCell, RowCollector::EndRow, &collector);
  csv_free(&parser);
  return collector.TakeResult();
}

Result<std::vector<Row>> ReadRows(std::string_view text, char delimiter) {
  std::vector<Row> rows;
  const auto read = ForEachRow(text, delimiter,
                               [&](int line, std::span<const std::string> cells) -> Result<void> {
                                 rows.push_back({line, {cells.begin(), cells.end()}});
                                 return {};
                               });
  if (!read) return tl::unexpected(read.error());
  return rows;
}

std::string_view CellAt(const Row& row, std::size_t column) {
  return column < row.cells.size() ? std::string_view(row.cells[column]) : std::string_view();
}

bool HasDecimalComma(std::span<const Row> rows, char delimiter,
                     const std::function<bool(std::size_t column)>& may_hold) {
  if (delimiter == ',') return false;
  return std::ranges::any_of(rows, [&](const Row& row) {
    for (std::size_t column = 0; column < row.cells.size(); ++column) {
      const std::string& cell = row.cells[column];
      if (cell.find(',') == std::string::npos || !may_hold(column)) continue;
      if (ParseNumber(cell, true)) return true;
    }
    return false;
  });
}

bool HasLineStarting(std::string_view text, std::string_view prefix) {
  for (std::size_t at = 0; at < text.size();) {
    if (text.substr(at).starts_with(prefix)) return true;
    const std::size_t newline = text.find('\n', at);
    if (newline == std::string_view::npos) return false;
    at = newline + 1;
  }
  return false;
}

double LastDigit(std::string_view printed) {
  const std::size_t e = printed.find_first_of("eE");
  const std::string_view mantissa = printed.substr(0, e);
  const std::size_t point = mantissa.find_first_of(".,");
  double exponent = 0.0;
  if (e != std::string_view::npos) exponent = ParseNumber(printed.substr(e + 1)).value_or(0.0);
  if (point != std::string_view::npos) {
    exponent -= static_cast<double>(TrimBlanks(mantissa.substr(point + 1)).size());
  }
  return std::pow(10.0, exponent);
}

std::string IsoTime(std::string_view text, DateOrder order) {
  std::array<int, 6> numbers{};
  std::size_t count = 0;
  bool colon = false;  // before the last number
  while (true) {
    const std::size_t start = text.find_first_of(kDecimalDigits);
    if (start == std::string_view::npos) break;
    // "10:00+02:00": a time to the minute.
    constexpr std::size_t kToTheMinute = 5;
    if (count == kToTheMinute && colon && !ZoneIn(text).empty()) break;
    colon = start > 0 && text[start - 1] == ':';
    text.remove_prefix(start);
    int& number = numbers[count++];
    while (!text.empty() && IsDigit(text.front())) {
      number = std::min(number * 10 + (text.front() - '0'), 100000);
      text.remove_prefix(1);
    }
    if (count == numbers.size()) break;
  }
  if (count < 5) return {};
  if (order == DateOrder::kDayFirst) std::swap(numbers[0], numbers[2]);
  const auto [year, month, day, hour, minute, second] = numbers;
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  const bool valid =
      year >= 1900 && year <= 9999 && date.ok() && hour < 24 && minute < 60 && second < 61;
  if (!valid) return {};
  std::array<char, 32> buffer{};
  const int size = std::snprintf(buffer.data(), buffer.size(), "%04d-%02d-%02dT%02d:%02d:%02d",
                                 year, month, day, hour, minute, second);
  std::string iso(buffer.data(), static_cast<std::size_t>(size));
  if (count == numbers.size()) iso += TakeFraction(text);
  return iso + ZoneIn(text);
}

std::string AtLine(std::string_view name, int line) {
  return std::string(name) + ":" + std::to_string(line);
}

}  // namespace lightcal::devices::files
