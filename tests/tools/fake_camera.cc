// SPDX-License-Identifier: Apache-2.0
#include "fake_camera.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "synthetic_dng.h"

namespace lightcal::test {
namespace {

// Tenths of a millisecond the camera offers, the dial's label, and the true time.
struct Shutter {
  int tenths_ms;
  double label_s, true_s;
};
constexpr std::array kShutters = {Shutter{10, 1.0 / 1000, 1.0 / 1024},
                                  Shutter{20, 1.0 / 500, 1.0 / 512},
                                  Shutter{40, 1.0 / 250, 1.0 / 256},
                                  Shutter{80, 1.0 / 125, 1.0 / 128},
                                  Shutter{166, 1.0 / 60, 1.0 / 64},
                                  Shutter{333, 1.0 / 30, 1.0 / 32},
                                  Shutter{666, 1.0 / 15, 1.0 / 16},
                                  Shutter{1250, 1.0 / 8, 1.0 / 8},
                                  Shutter{2500, 1.0 / 4, 1.0 / 4},
                                  Shutter{5000, 1.0 / 2, 1.0 / 2},
                                  Shutter{10000, 1.0, 1.0}};

SyntheticXyz Card(int /*x*/, int /*y*/) {
  constexpr double kLux = 300.0 / (0.8 * 0.8), kReflectance = 0.18;
  return XyzOf(kReflectance * kLux / std::numbers::pi, 0.4369, 0.4041);  // black body of 3000 K
}

void RenderCards(const std::string& folder) {
  SyntheticCamera camera;
  camera.width = 120;
  camera.height = 80;
  SyntheticDngOptions options;
  options.white_x = 0.4369;
  options.white_y = 0.4041;
  std::uint64_t seed = 1;
  for (const Shutter& shutter : kShutters) {
    SyntheticExposure exposure;
    exposure.true_time_s = shutter.true_s;
    exposure.label_time_s = shutter.label_s;
    exposure.true_f_number = exposure.label_f_number = 4.0;
    exposure.seed = seed++;
    const std::string path = folder + "/exposure_" + std::to_string(shutter.tenths_ms) + ".dng";
    std::ofstream(path, std::ios::binary)
        << EncodeDng(camera, exposure, Expose(camera, exposure, Card), options);
  }
}

}  // namespace

const std::string& CardPictures() {
  static const TempDir folder;
  static const bool rendered = (RenderCards(folder.path()), true);
  (void)rendered;
  return folder.path();
}

FakeCamera::FakeCamera(const std::vector<std::string>& faults) {
  std::vector<std::string> command = {
      "/usr/bin/python3", std::string(LIGHTCAL_SOURCE_DIR) + "/tests/tools/fake_ptp_camera.py",
      CardPictures(), folder_.path() + "/log"};
  command.insert(command.end(), faults.begin(), faults.end());
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
  process_ = ::fork();
  if (process_ < 0) throw std::runtime_error("fork");
  if (process_ == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  std::string line;
  char c = 0;
  while (::read(ends[0], &c, 1) == 1 && c != '\n') line += c;
  ::close(ends[0]);
  if (!line.starts_with("port ")) throw std::runtime_error("the fake camera did not start");
  id_ = "gphoto2:ptpip:127.0.0.1:" + line.substr(5);
}

FakeCamera::~FakeCamera() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

std::vector<std::string> FakeCamera::log() const {
  std::istringstream text(ReadFile(folder_.path() + "/log"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

int FakeCamera::Count(const std::string& beginning) const {
  const auto lines = log();
  return static_cast<int>(std::ranges::count_if(
      lines, [&](const std::string& line) { return line.starts_with(beginning); }));
}

bool FakeCamera::WaitFor(const std::string& beginning, int count) const {
  constexpr int kTries = 2000;
  constexpr std::chrono::milliseconds kPause{10};
  for (int i = 0; i < kTries && Count(beginning) < count; ++i) std::this_thread::sleep_for(kPause);
  return Count(beginning) >= count;
}

std::string FakeCamera::Property(const std::string& code) const {
  std::string value = code == "500d" ? "166" : code == "5007" ? "800" : code == "500f" ? "200" : "";
  const std::string beginning = "set " + code + " ";
  for (const std::string& line : log()) {
    if (line.starts_with(beginning)) value = line.substr(beginning.size());
  }
  return value;
}

}  // namespace lightcal::test
