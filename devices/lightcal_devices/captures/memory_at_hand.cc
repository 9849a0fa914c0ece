// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/memory_at_hand.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The one number of a file such as memory.max; nullopt for "max" or no file.
std::optional<double> NumberIn(const std::filesystem::path& file) {
  std::ifstream text(file);
  double number = 0.0;
  if (text >> number) return number;
  return std::nullopt;
}

double KernelAvailable() {
  std::ifstream text("/proc/meminfo");
  for (std::string word; text >> word;) {
    double kibibytes = 0.0;
    if (word == "MemAvailable:" && text >> kibibytes) return 1024.0 * kibibytes;
  }
  return kNoLimit;
}

// The path of this process below /sys/fs/cgroup: the line "0::/path" of version 2.
std::optional<std::filesystem::path> ControlGroup() {
  std::ifstream text("/proc/self/cgroup");
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("0::/")) return line.substr(4);
  }
  return std::nullopt;
}

double ControlGroupsLeave() {
  const auto group = ControlGroup();
  if (!group) return kNoLimit;
  double left = kNoLimit;
  for (std::filesystem::path path = *group;; path = path.parent_path()) {
    const std::filesystem::path folder = "/sys/fs/cgroup" / path;
    const auto most = NumberIn(folder / "memory.max");
    const auto used = NumberIn(folder / "memory.current");
    if (most && used) left = std::min(left, std::max(0.0, *most - *used));
    if (path.empty()) return left;
  }
}

double AddressSpaceLeaves() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
  const double pages = NumberIn("/proc/self/statm").value_or(0.0);
  const double used = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

std::string Gigabytes(double bytes) { return RoundedText(bytes / 1e9, 2) + " GB"; }

}  // namespace

double MemoryAtHandBytes() {
  return std::min({KernelAvailable(), ControlGroupsLeave(), AddressSpaceLeaves()});
}

Result<void> CheckFitsMemory(double bytes, const std::string& subject) {
  const double at_hand = MemoryAtHandBytes();
  if (bytes <= at_hand) return {};
  return Refused("too_large", subject,
                 std::string(kSamplesNeedMemory) + " (" + Gigabytes(bytes) + " of " +
                     Gigabytes(at_hand) + ")");
}

}  // namespace lightcal::devices
