// SPDX-License-Identifier: Apache-2.0
// What the programs of the standing page share: their input is a table of numbers, the last column
// the truth; their output is one row a setting,
//   method <tab> setting <tab> processor seconds an answer <tab> worst error <tab> median error.
// Includes no header of lightcal.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace page {

using Numbers = std::vector<double>;

// Lines of numbers. Ends the program where there are none.
inline std::vector<Numbers> ReadTable(const char* path) {
  std::ifstream file(path);
  std::vector<Numbers> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Numbers row;
    for (double x = 0.0; words >> x;) row.push_back(x);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) {
    std::fprintf(stderr, "%s: no table\n", path);
    std::exit(EXIT_FAILURE);
  }
  return rows;
}

enum class ErrorScale { kRelative, kAbsolute };

// Rows of one figure. Times are the mean over whole passes through the table for 20 ms, after
// one untimed that makes tables and warms memory; what takes 0.2 s is passed through once.
class Rows {
 public:
  Rows(const std::vector<Numbers>& table, ErrorScale scale) : scale_(scale) {
    for (const Numbers& row : table) truth_.push_back(row.back());
  }

  // fill(answers) computes all answers at once.
  template <class Fill>
  void PrintFilled(const std::string& method, const std::string& setting, const Fill& fill) const {
    constexpr double kLeast_s = 0.02, kLong_s = 0.2;
    Numbers answers(truth_.size());
    double seconds = SecondsOf([&] { fill(answers); });
    int passes = 1;
    if (seconds < kLong_s) {  // tables are made and memory is warm now: the clock starts anew
      for (seconds = 0.0, passes = 0; seconds < kLeast_s; ++passes) {
        seconds += SecondsOf([&] { fill(answers); });
      }
    }
    Print(method, setting, seconds / passes / static_cast<double>(truth_.size()), answers);
  }

  // answer(i) computes one.
  template <class Answer>
  void PrintEach(const std::string& method, const std::string& setting,
                 const Answer& answer) const {
    PrintFilled(method, setting, [&](Numbers& out) {
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = answer(i);
    });
  }

 private:
  // Of this process, so that what else the machine does is left out.
  static double ProcessorSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  template <class Work>
  static double SecondsOf(const Work& work) {
    const double start = ProcessorSeconds();
    work();
    return ProcessorSeconds() - start;
  }

  void Print(const std::string& method, const std::string& setting, double seconds,
             const Numbers& answers) const {
    Numbers errors;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const double off = std::abs(answers[i] - truth_[i]);
      errors.push_back(scale_ == ErrorScale::kRelative ? off / std::abs(truth_[i]) : off);
    }
    std::sort(errors.begin(), errors.end());
    std::printf("%s\t%s\t%.9g\t%.6g\t%.6g\n", method.c_str(), setting.c_str(), seconds,
                errors.back(), errors[errors.size() / 2]);
  }

  ErrorScale scale_;
  Numbers truth_;
};

}  // namespace page
