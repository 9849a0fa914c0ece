// SPDX-License-Identifier: Apache-2.0
// Tables of sample_data, the reference vectors among them: comma-separated files with a header.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lightcal::test {

class VectorRow {
 public:
  explicit VectorRow(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  [[nodiscard]] const std::string& Text(const std::string& column) const {
    return cells_.at(column);
  }
  // "inf" is infinity. Throws std::out_of_range for an unknown column, std::invalid_argument for
  // text.
  [[nodiscard]] double Number(const std::string& column) const {
    return std::stod(cells_.at(column));
  }
  // By column.
  [[nodiscard]] const std::map<std::string, std::string>& cells() const { return cells_; }

 private:
  std::map<std::string, std::string> cells_;
};

// All rows of sample_data/<path>; throws std::runtime_error when there are none.
std::vector<VectorRow> ReadSampleTable(const std::string& path);
// Of sample_data/vectors/<name>.
inline std::vector<VectorRow> ReadVectors(const std::string& name) {
  return ReadSampleTable("vectors/" + name);
}

}  // namespace lightcal::test
