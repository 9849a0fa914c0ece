// SPDX-License-Identifier: Apache-2.0
#include "vector_file.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lightcal::test {
namespace {

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::vector<VectorRow> ReadSampleTable(const std::string& path) {
  std::ifstream file(LIGHTCAL_SOURCE_DIR "/sample_data/" + path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = Cells(line);
  std::vector<VectorRow> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = Cells(line);
    if (cells.size() != header.size()) throw std::runtime_error(path + ": ragged row: " + line);
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[header[i]] = cells[i];
    rows.emplace_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error(path + ": no rows");
  return rows;
}

}  // namespace lightcal::test
