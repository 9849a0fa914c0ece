// SPDX-License-Identifier: Apache-2.0
#include "lux_tables.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lightcal::test {

std::vector<LuxTable> LoadLuxTables() {
  std::ifstream file(LIGHTCAL_SOURCE_DIR "/sample_data/lux_tables/lux_tables.csv");
  if (!file) throw std::runtime_error("sample_data/lux_tables/lux_tables.csv is missing");
  std::vector<LuxTable> tables;
  std::string line;
  std::getline(file, line);  // header
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string fixture, accessory, cct, distance, lux;
    std::getline(fields, fixture, ',');
    std::getline(fields, accessory, ',');
    std::getline(fields, cct, ',');
    std::getline(fields, distance, ',');
    std::getline(fields, lux, ',');
    if (tables.empty() || tables.back().fixture != fixture ||
        tables.back().accessory != accessory || tables.back().nominal_cct_K != std::stod(cct)) {
      tables.push_back({fixture, accessory, std::stod(cct), {}, {}});
    }
    tables.back().distances_m.push_back(std::stod(distance));
    tables.back().illuminances_lx.push_back(std::stod(lux));
  }
  return tables;
}

Session SessionOf(const LuxTable& table, const std::string& meter, std::size_t count) {
  Session session;
  session.surroundings = Surroundings::kDark;
  session.lights.emplace_back();
  session.lights.back().name = "lamp";
  for (std::size_t i = 0; i < std::min(count, table.distances_m.size()); ++i) {
    SessionReading row;
    row.reading.light = "lamp";
    row.reading.meter = meter;
    row.reading.distance = Metres(table.distances_m[i]);
    row.reading.illuminance = Lux(table.illuminances_lx[i]);
    session.readings.push_back(row);
  }
  return session;
}

}  // namespace lightcal::test
