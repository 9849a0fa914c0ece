// SPDX-License-Identifier: Apache-2.0
#include "color_tlci.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lightcal/colorimetry/resample.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/transport/process.h"

namespace lightcal::app {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLongestRun{5000};
constexpr std::size_t kMostOutput = 1 << 16;
constexpr std::size_t kMostSamples = 600;  // specplot's table ends at 601
constexpr std::string_view kSubject = "specplot";

tl::unexpected<Error> ProgramFailed(std::string message) {
  return Failed("program_failed", std::string(kSubject), std::move(message));
}

// Everything a program prints.
Result<std::string> OutputOf(const std::string& program,
                             const std::vector<std::string>& arguments) {
  const auto line =
      devices::OpenProcess({.program = program, .environment = {}, .longest_run = kLongestRun});
  if (auto started = line->Control("start", devices::StartArguments(arguments), 0, kLongestRun);
      !started) {
    return Propagate(std::move(started));
  }
  std::string text;
  for (;;) {
    const auto bytes = line->Read(4096, kLongestRun);
    if (bytes) {
      text.append(reinterpret_cast<const char*>(bytes->data()), bytes->size());
      if (text.size() > kMostOutput) return ProgramFailed("prints without end");
      continue;
    }
    const bool over = line->Control("exit_status", {}, 16, milliseconds(0)).has_value();
    if (over) return text;
    return ProgramFailed(bytes.error().message);
  }
}

// A file of its own, gone at the end of the scope.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Result<void> Write(const std::string& contents) {
    std::error_code no_folder;
    const auto folder = std::filesystem::temp_directory_path(no_folder);
    std::string path = (no_folder ? "/tmp" : folder.string()) + "/lightcal-XXXXXX.sp";
    const int file = ::mkstemps(path.data(), 3);
    if (file < 0) return Failed("unwritable", path, "cannot be created; set TMPDIR");
    path_ = path;
    const bool whole =
        ::write(file, contents.data(), contents.size()) == static_cast<ssize_t>(contents.size());
    if (::close(file) != 0 || !whole) return Failed("unwritable", path, "the disk is full");
    return {};
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string SixDecimals(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 6);
  return {text.data(), end.ptr};
}

// Samples in equal steps that specplot has room for.
Result<Spectrum> OnAGridOfArgyll(const Spectrum& s) {
  const bool whole_names = s.wavelengths_nm[1] - s.wavelengths_nm[0] >= 1.0;
  if (HasEqualSteps(s) && whole_names && s.values.size() <= kMostSamples) return s;
  const std::vector<double> edges = BinEdgesNm(s);
  constexpr double kRounding = 1e-9;
  const double first = std::ceil(edges.front() + 0.5 - kRounding);
  const double last = std::min(std::floor(edges.back() - 0.5 + kRounding),
                               first + static_cast<double>(kMostSamples) - 1.0);
  return ResampleByArea(s, Nanometres(first), Nanometres(1.0), static_cast<int>(last - first) + 1);
}

// Argyll's own format: its parser looks for fields named after whole nanometres and reads six
// decimals but no exponent.
std::string SpectrumFile(const Spectrum& s) {
  const std::string count = std::to_string(s.values.size());
  double largest = 0.0;
  for (const double value : s.values) largest = std::max(largest, std::abs(value));
  std::string text = "SPECT   \n\nORIGINATOR \"lightcal\"\nSPECTRAL_BANDS \"" + count +
                     "\"\nSPECTRAL_START_NM \"" + SixDecimals(s.wavelengths_nm.front()) +
                     "\"\nSPECTRAL_END_NM \"" + SixDecimals(s.wavelengths_nm.back()) +
                     "\"\nSPECTRAL_NORM \"100.000000\"\nNUMBER_OF_FIELDS " + count +
                     "\nBEGIN_DATA_FORMAT\n";
  for (const double nm : s.wavelengths_nm) text += "SPEC_" + std::to_string(std::lround(nm)) + " ";
  text += "\nEND_DATA_FORMAT\nNUMBER_OF_SETS 1\nBEGIN_DATA\n";
  for (const double value : s.values) text += SixDecimals(100.0 * value / largest) + " ";
  return text + "\nEND_DATA\n";
}

// What follows `label` up to the end of its line.
std::optional<std::string_view> After(std::string_view text, std::string_view label) {
  const std::size_t at = text.find(label);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(at + label.size());
  return TrimBlanks(rest.substr(0, rest.find('\n')));
}

Result<Tlci> ParseIndex(std::string_view printed) {
  const auto line = After(printed, "TLCI = ");
  const auto qa = line ? ParseNumber(line->substr(0, line->find(' '))) : std::nullopt;
  if (!qa || *qa > 100.0) {
    const std::string_view said = TrimBlanks(printed).substr(0, 200);
    return ProgramFailed("prints no TLCI but \"" + std::string(said) +
                         "\"; install ArgyllCMS 1.6 or later (Debian: argyll)");
  }
  if (*qa < 0.0) {
    return Refused("no_tlci", std::string(kSubject), "finds no TLCI for this light");
  }
  return Tlci{*qa, line->find("Invalid") != std::string_view::npos, ""};
}

// specplot does not tell its version; spec2cie, installed with it, does.
std::string NameOfArgyll(const std::string& specplot) {
  const std::string sibling = specplot.substr(0, specplot.rfind('/') + 1) + "spec2cie";
  const auto help = OutputOf(sibling, {"-?"});
  const auto version = help ? After(*help, "Version ") : std::nullopt;
  return version ? "ArgyllCMS " + std::string(*version) : "ArgyllCMS";
}

}  // namespace

Result<Tlci> TlciByArgyll(const Spectrum& spectrum) {
  const auto specplot = devices::ProgramOnPath(kSubject);
  if (!specplot) {
    return Failed("no_program", "--tlci",
                  "is computed by ArgyllCMS's specplot, which is not on PATH; install ArgyllCMS "
                  "(Debian: apt install argyll)");
  }
  const auto grid = OnAGridOfArgyll(spectrum);
  if (!grid) return tl::unexpected(grid.error());
  TemporaryFile file;
  if (auto written = file.Write(SpectrumFile(*grid)); !written) {
    return Propagate(std::move(written));
  }
  const auto printed = OutputOf(*specplot, {"-s", file.path()});
  if (!printed) return tl::unexpected(printed.error());
  auto tlci = ParseIndex(*printed);
  if (tlci) tlci->by = NameOfArgyll(*specplot);
  return tlci;
}

}  // namespace lightcal::app
