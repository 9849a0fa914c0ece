// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/camera_settings.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <span>
#include <string_view>
#include <thread>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/bracket_plan.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {
namespace {

constexpr int kBusyRetries = 10;
constexpr std::chrono::milliseconds kBusyPause{200};

// libgphoto2's names, by maker; the first a camera has counts.
constexpr std::array kShutterNames = {"shutterspeed2", "shutterspeed"};
constexpr std::array kApertureNames = {"f-number", "aperture"};
constexpr std::array kIsoNames = {"iso"};
constexpr std::array kFormatNames = {"imageformat", "imagequality"};
constexpr std::array kModeNames = {"expprogram", "autoexposuremode", "autoexposuremodedial"};
constexpr std::array kTargetNames = {"capturetarget"};
constexpr std::array kHelperNames = {"isoauto", "autoiso", "longexpnr"};

Result<std::optional<CameraSetting>> FirstOf(TetheredCamera& camera,
                                             std::span<const char* const> names,
                                             bool (*fits)(const CameraSetting&)) {
  for (const char* name : names) {
    auto setting = camera.Read(name);
    if (!setting) return setting;
    if (*setting && fits(**setting)) return setting;
  }
  return std::nullopt;
}

bool Any(const CameraSetting& setting) { return !setting.choices.empty(); }
bool MakesRaw(const CameraSetting& setting) { return RawFormat(setting.choices).has_value(); }

std::optional<std::string> ChoiceAmong(const CameraSetting& setting,
                                       std::span<const std::string_view> words) {
  for (const std::string& choice : setting.choices) {
    const std::string text = LowerAscii(TrimBlanks(choice));
    if (std::ranges::find(words, std::string_view(text)) != words.end()) return choice;
  }
  return std::nullopt;
}

}  // namespace

Result<CameraState> ReadCameraState(TetheredCamera& camera) {
  CameraState state;
  struct Wanted {
    std::span<const char* const> names;
    bool (*fits)(const CameraSetting&);
    std::optional<CameraSetting>* into;
  };
  const std::array wanted = {
      Wanted{kShutterNames, Any, &state.shutter}, Wanted{kApertureNames, Any, &state.aperture},
      Wanted{kIsoNames, Any, &state.iso},         Wanted{kFormatNames, MakesRaw, &state.format},
      Wanted{kModeNames, Any, &state.mode},       Wanted{kTargetNames, Any, &state.target}};
  for (const Wanted& one : wanted) {
    auto setting = FirstOf(camera, one.names, one.fits);
    if (!setting) return Propagate(std::move(setting));
    *one.into = *std::move(setting);
  }
  for (const char* name : kHelperNames) {
    auto setting = camera.Read(name);
    if (!setting) return Propagate(std::move(setting));
    if (*setting && !(*setting)->read_only) state.helpers.push_back(**std::move(setting));
  }
  return state;
}

std::optional<std::string> ManualChoice(const CameraSetting& mode) {
  constexpr std::array<std::string_view, 2> kWords = {"m", "manual"};
  return ChoiceAmong(mode, kWords);
}

std::optional<std::string> OffChoice(const CameraSetting& helper) {
  constexpr std::array<std::string_view, 1> kWords = {"off"};
  return ChoiceAmong(helper, kWords);
}

std::optional<std::string> CardChoice(const CameraSetting& target) {
  constexpr std::array<std::string_view, 2> kWords = {"memory card", "card"};
  return ChoiceAmong(target, kWords);
}

void BorrowedSettings::Remember(const CameraSetting& setting) {
  const bool known = std::ranges::find(owed_, setting.name, &NamedSetting::name) != owed_.end();
  if (!known) owed_.push_back({setting.name, setting.current});
}

Result<void> BorrowedSettings::Set(const std::string& name, const std::string& choice) {
  auto done = camera_->Set(name, choice);
  for (int i = 0; i < kBusyRetries && !done && done.error().code == fault::kBusy; ++i) {
    std::this_thread::sleep_for(kBusyPause);
    done = camera_->Set(name, choice);
  }
  return done;
}

void BorrowedSettings::GiveBack() {
  std::vector<NamedSetting> kept;
  for (auto owed = owed_.rbegin(); owed != owed_.rend(); ++owed) {
    const auto now = camera_->Read(owed->name);
    const bool is_back = now && *now && (*now)->current == owed->value;
    if (!is_back && !Set(owed->name, owed->value)) kept.insert(kept.begin(), *owed);
  }
  owed_ = std::move(kept);
}

}  // namespace lightcal::devices
