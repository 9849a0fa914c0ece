// SPDX-License-Identifier: Apache-2.0
#include "guide/driven_fixture.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "input_files.h"
#include "interrupt.h"
#include "lightcal_devices/meters/summary.h"

namespace lightcal::app {
namespace {

using std::chrono::milliseconds;

// The sender's first packets, and time for the host to say that nobody listens.
constexpr milliseconds kFirstPackets(700);
// Between a packet and light that it moved: a driver's own time and a meter's.
constexpr double kReaction_s = 0.3;
// Light that did not move at all is looked at for longer.
constexpr double kUnmoved_s = 1.5;
constexpr double kBetweenLooks_s = 0.1;

std::optional<int> WholeNumber(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Slept in pieces, so that a wish to stop is seen.
void Pause(milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end && !InterruptGuard::StopRequest().Requested()) {
    std::this_thread::sleep_for(milliseconds(20));
  }
}

struct Look {
  double at_s = 0.0, lux = 0.0;
};

// The last looks a tenth of a second apart or more, oldest first; fewer than six where there are.
std::vector<double> LastLooks(const std::vector<Look>& looks) {
  std::vector<double> last;
  double next = HUGE_VAL;
  for (auto look = looks.rbegin(); look != looks.rend(); ++look) {
    if (look->at_s > next) continue;
    last.push_back(look->lux);
    next = look->at_s - kBetweenLooks_s;
    if (last.size() == devices::kSettleWindow) break;
  }
  std::ranges::reverse(last);
  return last;
}

}  // namespace

Result<devices::SacnTarget> ParseSacnTarget(const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return WrongUsage("--sacn " + text,
                      why +
                          "; write a universe to multicast it (1), or a universe and where to "
                          "send it (1@10.0.0.5)");
  };
  devices::SacnTarget target;
  const std::size_t at = text.find('@');
  const auto universe = WholeNumber(std::string_view(text).substr(0, at));
  if (!universe || *universe < 1 || *universe > kMostUniverse) {
    return wrong("a universe is a whole number from 1 to 63999");
  }
  target.universe = *universe;
  if (at == std::string::npos) return target;
  target.host = text.substr(at + 1);
  const std::size_t colon = target.host.rfind(':');
  if (colon != std::string::npos && target.host.find(':') == colon) {
    const auto port = WholeNumber(std::string_view(target.host).substr(colon + 1));
    if (!port || *port < 1 || *port > 65535) return wrong("a port lies between 1 and 65535");
    target.port = *port;
    target.host.resize(colon);
  }
  if (target.host.empty()) return wrong("no host follows the @");
  return target;
}

Result<DrivenFixture> DrivenFixture::Open(const std::string& sacn, const std::string& map_file,
                                          const std::string& session,
                                          const std::vector<FixtureState>& states) {
  const auto target = ParseSacnTarget(sacn);
  if (!target) return tl::unexpected(target.error());
  const auto text = InputSources().read_text(map_file);
  if (!text) return tl::unexpected(text.error());
  auto map = DmxMapFromToml(*text, map_file);
  if (!map) return Propagate(std::move(map));
  if (map->universe && *map->universe != target->universe) {
    return WrongUsage("--sacn " + sacn, map_file + " is of universe " +
                                            std::to_string(*map->universe) +
                                            "; name that one, or take universe out of the map");
  }
  for (const FixtureState& state : states) {
    if (auto fits = SlotsAt(*map, state); !fits) {
      Error error = std::move(fits).error();
      error.subject = map_file + ": " + error.subject;
      return tl::unexpected(std::move(error));
    }
  }
  DrivenFixture fixture;
  fixture.universe_ = target->universe;
  devices::SacnPacket source;
  const std::string whole = std::filesystem::weakly_canonical(session).string();
  source.cid = devices::SacnCidOf(whole + "#" + std::to_string(target->universe));
  source.source_name = "lightcal sweep";
  source.priority = map->priority;
  auto slots = SlotsAt(*map, states.front());
  auto sender = devices::SacnSender::Open(*target, std::move(source), *std::move(slots));
  if (!sender) return Propagate(std::move(sender));
  fixture.map_ = *std::move(map);
  fixture.sender_ = *std::move(sender);
  Pause(kFirstPackets);
  if (auto heard = fixture.Trouble(); !heard) return Propagate(std::move(heard));
  return fixture;
}

Result<void> DrivenFixture::Set(const FixtureState& state) {
  auto slots = SlotsAt(map_, state);
  if (!slots) return Propagate(std::move(slots));
  sender_->Set(*std::move(slots));
  return Trouble();
}

Result<bool> WaitUntilSteady(MeterSession& meter, const SteadyRule& rule) {
  const bool tape = meter.IsReplay();
  const double limit_s = std::chrono::duration<double>(rule.limit).count();
  const auto start = std::chrono::steady_clock::now();
  std::vector<Look> looks;
  while (meter.HasMore()) {
    const auto one = meter.Measure();
    if (!one) return tl::unexpected(one.error());
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - start;
    const double at = tape ? static_cast<double>(looks.size()) : since.count();
    if (one->reading.illuminance && at >= kReaction_s) {
      looks.push_back({at, one->reading.illuminance->value()});
    }
    const std::vector<double> last = LastLooks(looks);
    if (devices::HasSettled(last, rule.change_relative)) {
      const bool unmoved = rule.before_lx && std::abs(last.back() - *rule.before_lx) <=
                                                 rule.change_relative * *rule.before_lx;
      if (tape || !unmoved || at >= kUnmoved_s) return true;
    }
    if (!tape && at > limit_s) return false;
  }
  return tape;
}

}  // namespace lightcal::app
