// SPDX-License-Identifier: Apache-2.0
#include "shooting/camera_setup.h"

#include <cmath>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

using devices::BracketRange;
using devices::CameraSetting;
using devices::CameraState;
using devices::FNumberOfChoice;
using devices::IsoOfChoice;

using NumberOfChoice = std::optional<double> (*)(std::string_view);

// A choice is what was asked for when they differ by less than this, relative: half of a third of
// a stop, of the f-number and of the ISO.

Result<std::string> ChoiceOf(const CameraSetting& setting, const std::string& option,
                             const std::string& wish, double near, NumberOfChoice number_of) {
  const auto wanted = number_of(wish);
  if (!wanted)
    return WrongUsage(option + " " + wish,
                      "is no such value; there are " + Joined(setting.choices));
  const std::string* nearest = nullptr;
  double distance = near;
  for (const std::string& choice : setting.choices) {
    const auto number = number_of(choice);
    if (!number || std::abs(*number / *wanted - 1.0) >= distance) continue;
    distance = std::abs(*number / *wanted - 1.0);
    nearest = &choice;
  }
  if (nearest == nullptr) {
    return WrongUsage(option + " " + wish, "the camera offers " + Joined(setting.choices));
  }
  return *nearest;
}

// The lowest fixed speed from ISO 100 on, else the lowest there is.
std::optional<std::string> LowIso(const CameraSetting& iso) {
  constexpr double kBaseIso = 100.0;
  std::optional<std::string> best;
  double best_speed = 0.0;
  for (const std::string& choice : iso.choices) {
    const auto speed = IsoOfChoice(choice);
    if (!speed) continue;
    const bool fits = *speed >= kBaseIso;
    const bool better = !best || (fits != (best_speed >= kBaseIso) ? fits : *speed < best_speed);
    if (!better) continue;
    best = choice;
    best_speed = *speed;
  }
  return best;
}

class SetupMaker {
 public:
  SetupMaker(const CameraState& state, const ExposureWish& wish) : state_(state), wish_(wish) {}

  Result<CameraSetup> Make(const BracketRange& bracket) {
    if (!state_.shutter || state_.shutter->read_only) {
      return Failed(std::string(devices::fault::kSettingRefused), "shutter",
                    "the camera does not let its shutter time be set over the cable; turn its dial "
                    "to M and try again");
    }
    auto centre = Centre();
    if (!centre) return Propagate(std::move(centre));
    auto plan = devices::PlanBracket(state_.shutter->choices, *centre, bracket);
    if (!plan) return Propagate(std::move(plan));
    setup_.plan = *std::move(plan);
    setup_.shutter_setting = state_.shutter->name;
    TakeFormat();
    TakeCard();
    for (const CameraSetting& helper : state_.helpers) {
      if (const auto off = devices::OffChoice(helper)) Use(helper, *off);
    }
    if (auto iso = TakeIso(); !iso) return Propagate(std::move(iso));
    if (auto aperture = TakeAperture(); !aperture) return Propagate(std::move(aperture));
    return std::move(setup_);
  }

 private:
  Result<Seconds> Centre() const {
    const bool named = !wish_.center.empty();
    const auto time = devices::TimeOfChoice(named ? wish_.center : state_.shutter->current);
    if (time) return time->time;
    if (named) return WrongUsage("--center " + wish_.center, "is no shutter time such as 1/60");
    return WrongUsage("--center", "the camera's shutter stands at \"" + state_.shutter->current +
                                      "\"; name the middle of the bracket, for example 1/60");
  }

  void Use(const CameraSetting& setting, const std::string& choice) {
    setup_.settings.push_back({setting.name, choice});
    if (setting.current != choice) setup_.changes.push_back({setting.name, choice});
  }

  void TakeFormat() {
    const auto raw = state_.format ? devices::RawFormat(state_.format->choices) : std::nullopt;
    if (!raw) return;
    if (state_.format->read_only && state_.format->current != *raw) {
      setup_.plan.warnings.push_back({"not_raw", state_.format->current,
                                      "the picture format cannot be set over the cable; choose RAW "
                                      "in the camera's menu"});
      return;
    }
    Use(*state_.format, *raw);
    if (raw->find('+') != std::string::npos) setup_.pictures = 2;
  }

  void TakeCard() {
    if (!state_.target || state_.target->read_only) return;
    if (const auto card = devices::CardChoice(*state_.target)) Use(*state_.target, *card);
  }

  Result<void> TakeIso() {
    if (!state_.iso) return Absent("--iso", wish_.iso);
    std::string chosen = state_.iso->current;
    if (!wish_.iso.empty()) {
      auto choice = ChoiceOf(*state_.iso, "--iso", wish_.iso, kNearIso, IsoOfChoice);
      if (!choice) return Propagate(std::move(choice));
      chosen = *std::move(choice);
    } else if (!IsoOfChoice(chosen)) {
      const auto low = LowIso(*state_.iso);
      if (!low) return {};
      setup_.plan.warnings.push_back({"auto_iso", state_.iso->current,
                                      "the camera chose its speed itself; it is set to ISO " +
                                          *low + " for the bracket (--iso takes another)"});
      chosen = *low;
    }
    setup_.iso = IsoOfChoice(chosen);
    return Fix(*state_.iso, chosen);
  }

  Result<void> TakeAperture() {
    if (!state_.aperture) return Absent("--aperture", wish_.aperture);
    std::string chosen = state_.aperture->current;
    if (!wish_.aperture.empty()) {
      auto choice =
          ChoiceOf(*state_.aperture, "--aperture", wish_.aperture, kNearFNumber, FNumberOfChoice);
      if (!choice) return Propagate(std::move(choice));
      chosen = *std::move(choice);
    }
    setup_.f_number = FNumberOfChoice(chosen);
    return Fix(*state_.aperture, chosen);
  }

  Result<void> Fix(const CameraSetting& setting, const std::string& choice) {
    if (setting.current == choice && setting.read_only) return {};
    if (setting.read_only) {
      return Failed(std::string(devices::fault::kSettingRefused), setting.name,
                    "stands at " + setting.current + " and cannot be set over the cable; set " +
                        choice + " on the camera or lens");
    }
    Use(setting, choice);
    return {};
  }

  static Result<void> Absent(const std::string& option, const std::string& wish) {
    if (wish.empty()) return {};
    return WrongUsage(option + " " + wish, "this camera does not let it be set over the cable");
  }

  const CameraState& state_;
  const ExposureWish& wish_;
  CameraSetup setup_;
};

}  // namespace

Result<CameraSetup> SetupFor(const CameraState& state, const BracketRange& bracket,
                             const ExposureWish& wish) {
  return SetupMaker(state, wish).Make(bracket);
}

}  // namespace lightcal::app
