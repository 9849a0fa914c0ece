// SPDX-License-Identifier: Apache-2.0
#include "shooting/bracket_shoot.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "clock.h"
#include "guide/shell_word.h"
#include "interrupt.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/session_codec.h"
#include "lightcal_devices/captures/bracket.h"
#include "lightcal_devices/captures/camera_settings.h"
#include "lightcal_devices/captures/tether.h"
#include "lightcal_devices/transport/transport.h"
#include "output_files.h"
#include "session_names.h"
#include "shooting/frame_check.h"
#include "shooting/shoot_folder.h"

namespace lightcal::app {
namespace {

using devices::CameraState;
using devices::OpenCamera;
using devices::ReadCameraState;
using devices::StoredPicture;

namespace fs = std::filesystem;

constexpr int kBusyRetries = 20;
constexpr std::chrono::milliseconds kBusyPause{250};
constexpr Seconds kCardPatience{20.0};

class BracketShoot {
 public:
  BracketShoot(const ShootRequest& request, Console& console)
      : request_(request), console_(console) {}

  Result<ShootOutcome> Execute() {
    if (auto ready = OpenSession(); !ready) return Propagate(std::move(ready));
    const InterruptGuard guard;
    if (auto opened = OpenTheCamera(); !opened) return Propagate(std::move(opened));
    borrowed_.emplace(*camera_, shoot_.restore);
    auto done = request_.dry_run ? PlanOnly() : SetAndShoot();
    if (!request_.dry_run) GiveBack();
    if (done && !request_.dry_run) done = Complete();
    if (!done) return tl::unexpected(WithWayOn(done.error()));
    return ShootOutcome{folder_ ? InSession(folder_->path()) : "", std::move(shoot_)};
  }

 private:
  Result<void> OpenSession() {
    // Not noted as read: its capture.json is written anew, frame by frame.
    auto loaded = LoadSession(request_.session);
    if (!loaded) return Propagate(std::move(loaded));
    session_directory_ = loaded->session.directory;
    if (!request_.resume) {
      auto light = LightMeant(loaded->session, request_.light);
      if (!light) return Propagate(std::move(light));
      request_.light = *std::move(light);
      return {};
    }
    auto unfinished = ShootFolder::Unfinished(CapturesPath(request_.session), request_.light);
    if (!unfinished) return Propagate(std::move(unfinished));
    folder_ = std::move(unfinished->first);
    shoot_ = std::move(unfinished->second);
    return {};
  }

  Result<void> OpenTheCamera() {
    const bool as_before = request_.resume && request_.device.empty() &&
                           shoot_.device.find(":ptpip:") != std::string::npos;
    auto found =
        devices::ChooseCamera(devices::FindCameras(), as_before ? shoot_.device : request_.device);
    if (!found) return Propagate(std::move(found));
    found_ = *std::move(found);
    auto opened = OpenCamera(found_);
    if (!opened) return Propagate(std::move(opened));
    camera_ = *std::move(opened);
    if (!request_.resume) {
      shoot_.camera = camera_->Model();
    } else if (shoot_.camera != camera_->Model()) {
      return Refused("other_camera", camera_->Model(),
                     "the bracket was begun with " + shoot_.camera +
                         "; frames of two cameras make "
                         "no bracket");
    }
    return {};
  }

  Result<void> PlanOnly() {
    const auto state = ReadCameraState(*camera_);
    if (!state) return tl::unexpected(state.error());
    return Plan(*state);
  }

  Result<void> SetAndShoot() {
    if (auto set = SetUp(); !set) return set;
    console_.Note(shoot_.camera + ": " + std::to_string(shoot_.frames.size()) + " frames of " +
                  shoot_.light + " into " + InSession(folder_->path()) +
                  " (Ctrl-C stops; what is here stays)");
    for (std::size_t i = 0; i < shoot_.frames.size(); ++i) {
      if (folder_->Has(shoot_.frames[i])) continue;
      if (InterruptGuard::StopRequest().Requested()) {
        return Failed("interrupted", shoot_.light, "stopped by you");
      }
      if (auto taken = Take(i); !taken) return taken;
    }
    return {};
  }

  // The mode first: what it is decides which choices there are.
  Result<void> SetUp() {
    auto state = ReadCameraState(*camera_);
    if (!state) return Propagate(std::move(state));
    if (auto manual = SetManual(*state); !manual) return manual;
    if (!request_.resume) {
      if (auto planned = Plan(*state); !planned) return planned;
      folder_ = ShootFolder::New(CapturesPath(request_.session), shoot_.light);
      Describe();
      if (auto checked = CheckRecord(); !checked) return checked;
    } else {
      RemoveLeftovers(folder_->path());
    }
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    for (const NamedSetting& setting : shoot_.settings) {
      if (auto noted = Note(setting.name); !noted) return noted;
    }
    if (auto noted = Note(shoot_.shutter_setting); !noted) return noted;
    if (auto saved = Save(); !saved) return saved;
    for (const NamedSetting& setting : shoot_.settings) {
      if (auto set = SetUnlessSo(setting); !set) return set;
    }
    return {};
  }

  Result<void> SetManual(CameraState& state) {
    if (!state.mode) return {};
    const devices::CameraSetting mode = *state.mode;
    const auto manual = devices::ManualChoice(mode);
    if (manual && mode.current == *manual) return {};
    if (!manual || mode.read_only) {
      console_.Warn({"not_manual", mode.current,
                     "the camera's mode cannot be set to manual over the cable; turn its dial to M "
                     "if it is not there"});
      return {};
    }
    borrowed_->Remember(mode);
    if (auto set = borrowed_->Set(mode.name, *manual); !set) return set;
    auto again = ReadCameraState(*camera_);
    if (!again) return Propagate(std::move(again));
    state = *std::move(again);
    return {};
  }

  Result<void> Plan(const CameraState& state) {
    auto setup = SetupFor(state, request_.bracket, request_.exposure);
    if (!setup) return Propagate(std::move(setup));
    console_.Warn(setup->plan.warnings);
    shoot_.light = request_.light;
    shoot_.device = found_.id;
    shoot_.time = NowIso8601();
    shoot_.shutter_setting = setup->shutter_setting;
    shoot_.pictures = setup->pictures;
    shoot_.delete_from_card = request_.delete_from_card;
    shoot_.f_number = setup->f_number;
    shoot_.iso = setup->iso;
    shoot_.settings = std::move(setup->settings);
    for (const devices::PlannedFrame& frame : setup->plan.frames) {
      ShotFrame shot;
      shot.shutter = frame.shutter;
      shot.planned_s = frame.time.time.value();
      shot.rounding_s = frame.time.rounding.value();
      shoot_.frames.push_back(std::move(shot));
    }
    return {};
  }

  void Describe() {
    shoot_.capture = request_.capture;
    if (!shoot_.capture) return;
    shoot_.capture->light = shoot_.light;
    shoot_.capture->frames = InSession(folder_->path()) + "/frame_*";
  }

  // What the session would not take is refused before a shutter clicks.
  Result<void> CheckRecord() const {
    auto read = TetheredShootFromJson(TetheredShootToJson(shoot_), "--use");
    if (!read) return Propagate(std::move(read));
    return {};
  }

  Result<void> Note(const std::string& name) {
    auto setting = camera_->Read(name);
    if (!setting) return Propagate(std::move(setting));
    if (*setting) borrowed_->Remember(**setting);
    return {};
  }

  Result<void> SetUnlessSo(const NamedSetting& wanted) {
    const auto now = camera_->Read(wanted.name);
    if (!now) return tl::unexpected(now.error());
    if (*now && (*now)->current == wanted.value) return {};
    return borrowed_->Set(wanted.name, wanted.value);
  }

  Result<void> Take(std::size_t index) {
    ShotFrame& frame = shoot_.frames[index];
    const int number = static_cast<int>(index) + 1;
    if (auto set = borrowed_->Set(shoot_.shutter_setting, frame.shutter); !set) return set;
    auto files = Capture(frame);
    if (!files) return Propagate(std::move(files));
    const auto raw = std::ranges::find_if(
        *files, [](const StoredPicture& file) { return devices::LooksLikeRaw(file.name); });
    const StoredPicture& picture = raw == files->end() ? files->front() : *raw;
    auto name = folder_->Fetch(*camera_, picture, number);
    if (!name) return Propagate(std::move(name));
    ShotFrame taken = frame;
    taken.file = *std::move(name);
    auto warnings = CheckFrame(folder_->PathOf(taken.file), shoot_, taken);
    if (!warnings) {
      std::error_code ignored;
      fs::remove(folder_->PathOf(taken.file), ignored);
      return Propagate(std::move(warnings));
    }
    console_.Warn(*warnings);
    frame = std::move(taken);
    if (auto saved = Save(); !saved) return saved;
    console_.Note("  " + std::to_string(number) + "/" + std::to_string(shoot_.frames.size()) +
                  "  " + frame.shutter + "  " + frame.file);
    if (shoot_.delete_from_card) DeleteFromCard(*files);
    return {};
  }

  // The exposure, the dark frame some cameras add to it, and the time to write the card.
  Result<std::vector<StoredPicture>> Capture(const ShotFrame& frame) {
    const Seconds patience = Seconds(2.0 * frame.planned_s) + kCardPatience;
    auto files = camera_->Capture(shoot_.pictures, patience);
    for (int i = 0; i < kBusyRetries && !files && files.error().code == devices::fault::kBusy &&
                    !InterruptGuard::StopRequest().Requested();
         ++i) {
      std::this_thread::sleep_for(kBusyPause);
      files = camera_->Capture(shoot_.pictures, patience);
    }
    return files;
  }

  void DeleteFromCard(const std::vector<StoredPicture>& files) {
    for (const StoredPicture& file : files) {
      const auto deleted = camera_->Delete(file);
      if (!deleted) console_.Warn({"not_deleted", file.name, deleted.error().message});
    }
  }

  // A camera that was lost on the way is looked for once more.
  void GiveBack() {
    borrowed_->GiveBack();
    if (!borrowed_->owed().empty()) {
      camera_.reset();
      if (auto opened = OpenCamera(found_)) {
        camera_ = *std::move(opened);
        borrowed_->Move(*camera_);
        borrowed_->GiveBack();
      }
    }
    for (const NamedSetting& owed : borrowed_->owed()) {
      console_.Warn({"not_restored", owed.name,
                     "could not be set back to " + owed.value + "; set it on the camera"});
    }
    if (!recorded_) return;
    if (const auto saved = Save(); !saved) {
      console_.Warn({saved.error().code, saved.error().subject, saved.error().message});
    }
  }

  Result<void> Complete() {
    if (auto strict = console_.RefuseIfStrict(); !strict) return strict;
    shoot_.complete = true;
    return Save();
  }

  Result<void> Save() {
    shoot_.restore = borrowed_->owed();
    recorded_ = true;
    return folder_->Save(shoot_);
  }

  // A failure says what is here already and how to go on.
  [[nodiscard]] Error WithWayOn(Error error) const {
    if (!recorded_) return error;
    const auto here = std::ranges::count_if(
        shoot_.frames, [&](const ShotFrame& frame) { return folder_->Has(frame); });
    error.message += ". " + std::to_string(here) + " of " + std::to_string(shoot_.frames.size()) +
                     " frames are in " + folder_->path() + "; go on with: lightcal shoot -s " +
                     ShellWord(request_.session) + " --resume";
    return error;
  }

  [[nodiscard]] std::string InSession(const std::string& path) const {
    return fs::path(path).lexically_proximate(session_directory_).generic_string();
  }

  ShootRequest request_;
  Console& console_;
  std::string session_directory_;
  devices::FoundCamera found_;
  std::unique_ptr<devices::TetheredCamera> camera_;
  std::optional<devices::BorrowedSettings> borrowed_;
  std::optional<ShootFolder> folder_;
  TetheredShoot shoot_;
  bool recorded_ = false;
};

}  // namespace

Result<ShootOutcome> ShootBracket(const ShootRequest& request, Console& console) {
  return BracketShoot(request, console).Execute();
}

}  // namespace lightcal::app
