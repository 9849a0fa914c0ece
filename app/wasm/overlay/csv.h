// SPDX-License-Identifier: Apache-2.0
// Rows of delimited text with libcsv's names, for what lightcal_devices/files/delimited_text.cc
// asks of it: RFC 4180 quoting, blanks around an unquoted cell taken off, every line end a row.
#pragma once

#include <cstddef>
#include <string>

inline constexpr unsigned char CSV_REPALL_NL = 2;

struct csv_parser {
  unsigned char delimiter = ',';
  int (*is_space)(unsigned char) = nullptr;
  int (*is_line_end)(unsigned char) = nullptr;
  std::string cell;
  std::size_t blanks = 0;  // at the cell's end
  enum { kRowBegin, kCellBegin, kPlain, kQuoted, kQuoteInQuoted } state = kRowBegin;
};

inline int csv_init(csv_parser* p, unsigned char /*options*/) {
  *p = csv_parser();
  return 0;
}
inline void csv_set_delim(csv_parser* p, unsigned char c) { p->delimiter = c; }
inline void csv_set_space_func(csv_parser* p, int (*f)(unsigned char)) { p->is_space = f; }
inline void csv_set_term_func(csv_parser* p, int (*f)(unsigned char)) { p->is_line_end = f; }
inline void csv_free(csv_parser* p) { *p = csv_parser(); }

using csv_cell_visitor = void (*)(void*, std::size_t, void*);
using csv_row_visitor = void (*)(int, void*);

inline void csv_end_cell(csv_parser* p, csv_cell_visitor cell, void* data) {
  p->cell.resize(p->cell.size() - p->blanks);
  cell(p->cell.data(), p->cell.size(), data);
  p->cell.clear();
  p->blanks = 0;
}

inline std::size_t csv_parse(csv_parser* p, const void* bytes, std::size_t size,
                             csv_cell_visitor cell, csv_row_visitor row, void* data) {
  const auto* const text = static_cast<const unsigned char*>(bytes);
  for (std::size_t i = 0; i < size; ++i) {
    const unsigned char c = text[i];
    const bool line_end = p->is_line_end(c) != 0, space = p->is_space(c) != 0;
    if (p->state == csv_parser::kQuoted) {
      if (c == '"') {
        p->state = csv_parser::kQuoteInQuoted;
      } else {
        p->cell += static_cast<char>(c);
      }
      continue;
    }
    if (c == p->delimiter) {
      csv_end_cell(p, cell, data);
      p->state = csv_parser::kCellBegin;
    } else if (line_end) {
      if (p->state != csv_parser::kRowBegin) csv_end_cell(p, cell, data);
      row(c, data);
      p->state = csv_parser::kRowBegin;
    } else if (p->state == csv_parser::kRowBegin || p->state == csv_parser::kCellBegin) {
      if (space) continue;
      if (c == '"') {
        p->state = csv_parser::kQuoted;
      } else {
        p->cell += static_cast<char>(c);
        p->state = csv_parser::kPlain;
      }
    } else if (p->state == csv_parser::kQuoteInQuoted) {
      if (c == '"' && p->blanks == 0) {
        p->cell += '"';
        p->state = csv_parser::kQuoted;
      } else if (space) {
        ++p->blanks;
        p->cell += static_cast<char>(c);
      } else {  // a lone quote inside
        p->cell.insert(p->cell.size() - p->blanks, 1, '"');
        p->blanks = 0;
        if (c == '"') continue;
        p->cell += static_cast<char>(c);
        p->state = csv_parser::kQuoted;
      }
    } else {
      p->blanks = space ? p->blanks + 1 : 0;
      p->cell += static_cast<char>(c);
    }
  }
  return size;
}

inline int csv_fini(csv_parser* p, csv_cell_visitor cell, csv_row_visitor row, void* data) {
  if (p->state != csv_parser::kRowBegin) {
    csv_end_cell(p, cell, data);
    row(-1, data);
  }
  p->state = csv_parser::kRowBegin;
  return 0;
}
