// SPDX-License-Identifier: Apache-2.0
// The whole of lightcal_tether.so: the one file that sees libgphoto2.
#include "lightcal_devices/captures/gphoto_module.h"

#include <fcntl.h>
#include <gphoto2/gphoto2.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "lightcal_devices/transport/transport.h"

namespace {

using lightcal::Error;
using lightcal::Failed;
using lightcal::Result;
using lightcal::devices::CameraSetting;
using lightcal::devices::FoundCamera;
using lightcal::devices::StoredPicture;
using lightcal::devices::TetheredCamera;
namespace fault = lightcal::devices::fault;

constexpr int kEventSliceMs = 250;
constexpr const char* kNetworkModel = "PTP/IP Camera";

// Holds the signals that would cut an exchange in two until the call is over: Ctrl-C reaches its
// handler then. A broken network line's SIGPIPE is taken away: the call's answer says it.
class HoldSignals {
 public:
  HoldSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) sigaddset(&signals, signal);
    pthread_sigmask(SIG_BLOCK, &signals, &former_);
  }
  ~HoldSignals() {
    if (sigismember(&former_, SIGPIPE) == 0) {
      sigset_t pipe;
      sigemptyset(&pipe);
      sigaddset(&pipe, SIGPIPE);
      const timespec no_wait{};
      sigtimedwait(&pipe, nullptr, &no_wait);
    }
    pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }
  HoldSignals(const HoldSignals&) = delete;
  HoldSignals& operator=(const HoldSignals&) = delete;

 private:
  sigset_t former_{};
};

template <class T, int (*Release)(T*)>
struct Releases {
  void operator()(T* object) const { (void)Release(object); }
};
template <class T, int (*Release)(T*)>
using Owned = std::unique_ptr<T, Releases<T, Release>>;

using OwnedList = Owned<CameraList, gp_list_free>;
using OwnedPorts = Owned<GPPortInfoList, gp_port_info_list_free>;
using OwnedAbilities = Owned<CameraAbilitiesList, gp_abilities_list_free>;
using OwnedWidget = Owned<CameraWidget, gp_widget_free>;
using OwnedFile = Owned<::CameraFile, gp_file_free>;
using OwnedCamera = Owned<Camera, gp_camera_free>;

struct ContextDeleter {
  void operator()(GPContext* context) const { gp_context_unref(context); }
};
using OwnedContext = std::unique_ptr<GPContext, ContextDeleter>;

Error FaultOf(int status, const std::string& subject, std::string_view otherwise,
              const std::string& while_doing) {
  const std::string said = std::string(" (libgphoto2: ") + gp_result_as_string(status) + ")";
  const auto error = [&](std::string_view code, const std::string& what) {
    return Failed(std::string(code), subject, while_doing + ": " + what + said).value();
  };
  switch (status) {
    case GP_ERROR_CAMERA_BUSY:
    case GP_ERROR_IO_USB_CLAIM:
    case GP_ERROR_IO_LOCK:
      return error(fault::kBusy, "the camera is busy or another program holds it");
    case GP_ERROR_TIMEOUT:
      return error(fault::kTimeout, "the camera did not answer in time");
    case GP_ERROR_NO_SPACE:
      return error(fault::kCardFull, "the camera's card is full; make room on it");
    case GP_ERROR_IO_USB_FIND:
    case GP_ERROR_MODEL_NOT_FOUND:
    case GP_ERROR_UNKNOWN_PORT:
      return error(fault::kNoDevice, "there is no such camera; is it switched on?");
    case GP_ERROR_IO:
    case GP_ERROR_IO_READ:
    case GP_ERROR_IO_WRITE:
    case GP_ERROR_IO_INIT:
      return error(fault::kIo,
                   "the line to the camera broke; look at the cable and the camera's power");
    default:
      return error(otherwise, "the camera refused");
  }
}

class GphotoCamera final : public TetheredCamera {
 public:
  GphotoCamera(OwnedContext context, OwnedCamera camera, std::string model)
      : context_(std::move(context)), camera_(std::move(camera)), model_(std::move(model)) {}
  ~GphotoCamera() override {
    const HoldSignals hold;
    gp_camera_exit(camera_.get(), context_.get());
    camera_.reset();
  }

  [[nodiscard]] std::string Model() const override { return model_; }
  void AskModel() {
    const auto maker = TextOf("manufacturer"), model = TextOf("cameramodel");
    if (!model.empty()) model_ = maker.empty() ? model : maker + " " + model;
  }

  Result<std::optional<CameraSetting>> Read(const std::string& name) override {
    const HoldSignals hold;
    OwnedWidget widget;
    const int status = Single(name, widget);
    if (status == GP_ERROR_BAD_PARAMETERS || status == GP_ERROR_NOT_SUPPORTED) return std::nullopt;
    if (status != GP_OK) return Fault(status, name, fault::kIo, "its setting cannot be read");
    return SettingOf(name, widget.get());
  }

  Result<void> Set(const std::string& name, const std::string& choice) override {
    const HoldSignals hold;
    const std::string doing = name + " = " + choice;
    OwnedWidget widget;
    int status = Single(name, widget);
    if (status == GP_OK) status = gp_widget_set_value(widget.get(), choice.c_str());
    if (status == GP_OK) {
      status =
          gp_camera_set_single_config(camera_.get(), name.c_str(), widget.get(), context_.get());
    }
    if (status != GP_OK) return Fault(status, name, fault::kSettingRefused, doing);
    return {};
  }

  // Triggered and waited for in slices: gp_camera_capture waits for ever where no picture comes.
  Result<std::vector<StoredPicture>> Capture(int pictures, lightcal::Seconds patience) override {
    int status = Trigger();
    // libgphoto2 2.5.30 has no word of its own for PTP's Store_Full.
    if (status == GP_ERROR && CardIsFull()) status = GP_ERROR_NO_SPACE;
    if (status != GP_OK) {
      return Fault(status, "capture", fault::kCaptureFailed,
                   "no picture was taken (is the lens on manual focus, the card in?)");
    }
    std::vector<StoredPicture> files;
    const auto begin = std::chrono::steady_clock::now();
    const auto waited = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    while (static_cast<int>(files.size()) < pictures && waited() < patience.value()) {
      if (status = AwaitFile(files); status != GP_OK) {
        return Fault(status, "capture", fault::kCaptureFailed, "waiting for the picture");
      }
    }
    if (files.empty()) {
      return Failed(std::string(fault::kTimeout), model_ + " capture",
                    "no picture came; switch the camera off and on");
    }
    return files;
  }

  Result<void> Download(const StoredPicture& file, const std::string& path) override {
    const HoldSignals hold;
    CameraFileInfo info{};
    const int known = gp_camera_file_get_info(camera_.get(), file.folder.c_str(), file.name.c_str(),
                                              &info, context_.get());
    const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (fd < 0) return Unwritable(path, errno);
    ::CameraFile* raw = nullptr;
    int status = gp_file_new_from_fd(&raw, fd);  // owns fd from here on
    if (status != GP_OK) {
      ::close(fd);
      return Fault(status, file.name, fault::kIo, "download");
    }
    const OwnedFile sink(raw);
    errno = 0;
    status = gp_camera_file_get(camera_.get(), file.folder.c_str(), file.name.c_str(),
                                GP_FILE_TYPE_NORMAL, sink.get(), context_.get());
    if (errno == ENOSPC || errno == EDQUOT) return Unwritable(path, errno);
    if (status != GP_OK) return Fault(status, file.name, fault::kIo, "download of " + file.name);
    const off_t size = ::lseek(fd, 0, SEEK_END);
    const bool stated = known == GP_OK && (info.file.fields & GP_FILE_INFO_SIZE) != 0;
    if (size <= 0 || (stated && static_cast<std::uint64_t>(size) != info.file.size)) {
      return Failed(std::string(fault::kIo), file.name,
                    "came as " + std::to_string(size) + " bytes" +
                        (stated ? " of " + std::to_string(info.file.size) : "") +
                        "; it is still on the camera's card");
    }
    return {};
  }

  Result<void> Delete(const StoredPicture& file) override {
    const HoldSignals hold;
    const int status = gp_camera_file_delete(camera_.get(), file.folder.c_str(), file.name.c_str(),
                                             context_.get());
    if (status != GP_OK) return Fault(status, file.name, fault::kIo, "delete " + file.name);
    return {};
  }

 private:
  [[nodiscard]] tl::unexpected<Error> Fault(int status, const std::string& subject,
                                            std::string_view otherwise,
                                            const std::string& doing) const {
    return tl::unexpected(FaultOf(status, model_ + " " + subject, otherwise, doing));
  }
  static tl::unexpected<Error> Unwritable(const std::string& path, int error) {
    return Failed("unwritable", path,
                  std::system_category().message(error) + "; make room and resume");
  }

  int Single(const std::string& name, OwnedWidget& widget) {
    CameraWidget* raw = nullptr;
    const int status =
        gp_camera_get_single_config(camera_.get(), name.c_str(), &raw, context_.get());
    widget.reset(raw);
    return status;
  }

  std::string TextOf(const std::string& name) {
    OwnedWidget widget;
    const char* text = nullptr;
    CameraWidgetType type{};
    if (Single(name, widget) != GP_OK || gp_widget_get_type(widget.get(), &type) != GP_OK ||
        type != GP_WIDGET_TEXT || gp_widget_get_value(widget.get(), &text) != GP_OK ||
        text == nullptr) {
      return "";
    }
    std::string printable = text;
    std::erase_if(printable, [](char c) { return c < ' ' || c > '~'; });
    return printable;
  }

  static std::optional<CameraSetting> SettingOf(const std::string& name, CameraWidget* widget) {
    CameraWidgetType type{};
    gp_widget_get_type(widget, &type);
    if (type != GP_WIDGET_RADIO && type != GP_WIDGET_MENU) return std::nullopt;
    CameraSetting setting;
    setting.name = name;
    const char* current = nullptr;
    if (gp_widget_get_value(widget, &current) == GP_OK && current != nullptr) {
      setting.current = current;
    }
    const int count = gp_widget_count_choices(widget);
    for (int i = 0; i < count; ++i) {
      const char* choice = nullptr;
      if (gp_widget_get_choice(widget, i, &choice) == GP_OK && choice != nullptr) {
        setting.choices.emplace_back(choice);
      }
    }
    int read_only = 0;
    gp_widget_get_readonly(widget, &read_only);
    setting.read_only = read_only != 0;
    return setting;
  }

  int Trigger() {
    const HoldSignals hold;
    return gp_camera_trigger_capture(camera_.get(), context_.get());
  }

  bool CardIsFull() {
    constexpr std::uint64_t kRoomForOneKilobytes = 1024;
    const HoldSignals hold;
    CameraStorageInformation* cards = nullptr;
    int count = 0;
    if (gp_camera_get_storageinfo(camera_.get(), &cards, &count, context_.get()) != GP_OK) {
      return false;
    }
    const std::unique_ptr<CameraStorageInformation, decltype(&std::free)> owned(cards, std::free);
    const std::span<const CameraStorageInformation> all(cards, static_cast<std::size_t>(count));
    return !all.empty() && std::ranges::all_of(all, [](const CameraStorageInformation& card) {
      return (card.fields & GP_STORAGEINFO_FREESPACEKBYTES) != 0 &&
             card.freekbytes < kRoomForOneKilobytes;
    });
  }

  int AwaitFile(std::vector<StoredPicture>& files) {
    const HoldSignals hold;
    CameraEventType type = GP_EVENT_UNKNOWN;
    void* data = nullptr;
    const int status =
        gp_camera_wait_for_event(camera_.get(), kEventSliceMs, &type, &data, context_.get());
    const std::unique_ptr<void, decltype(&std::free)> owned(data, std::free);
    if (status == GP_OK && type == GP_EVENT_FILE_ADDED && data != nullptr) {
      const auto* path = static_cast<const CameraFilePath*>(data);
      files.push_back({path->folder, path->name});
    }
    return status;
  }

  OwnedContext context_;
  OwnedCamera camera_;
  std::string model_;
};

// The model libgphoto2 knows this port's camera by.
std::string ModelAt(const std::string& port, CameraAbilitiesList* abilities, GPPortInfoList* ports,
                    GPContext* context) {
  if (port.starts_with("ptpip:")) return kNetworkModel;
  CameraList* raw = nullptr;
  gp_list_new(&raw);
  const OwnedList list(raw);
  if (gp_abilities_list_detect(abilities, ports, list.get(), context) != GP_OK) return "";
  for (int i = 0; i < gp_list_count(list.get()); ++i) {
    const char *model = nullptr, *at = nullptr;
    gp_list_get_name(list.get(), i, &model);
    gp_list_get_value(list.get(), i, &at);
    if (model != nullptr && at != nullptr && port == at) return model;
  }
  return "";
}

int Point(Camera* camera, const std::string& port, GPContext* context, std::string& model) {
  CameraAbilitiesList* raw_abilities = nullptr;
  gp_abilities_list_new(&raw_abilities);
  const OwnedAbilities abilities(raw_abilities);
  if (const int status = gp_abilities_list_load(abilities.get(), context); status != GP_OK) {
    return status;
  }
  GPPortInfoList* raw_ports = nullptr;
  gp_port_info_list_new(&raw_ports);
  const OwnedPorts ports(raw_ports);
  if (const int status = gp_port_info_list_load(ports.get()); status != GP_OK) return status;
  model = ModelAt(port, abilities.get(), ports.get(), context);
  const int index = gp_abilities_list_lookup_model(abilities.get(), model.c_str());
  if (index < 0) return GP_ERROR_MODEL_NOT_FOUND;
  CameraAbilities ability{};
  gp_abilities_list_get_abilities(abilities.get(), index, &ability);
  gp_camera_set_abilities(camera, ability);
  const int place = gp_port_info_list_lookup_path(ports.get(), port.c_str());
  if (place < 0) return place;
  GPPortInfo info = nullptr;
  gp_port_info_list_get_info(ports.get(), place, &info);
  return gp_camera_set_port_info(camera, info);
}

std::unique_ptr<TetheredCamera> Open(const FoundCamera& found, Error& error) {
  const HoldSignals hold;
  OwnedContext context(gp_context_new());
  Camera* raw = nullptr;
  gp_camera_new(&raw);
  OwnedCamera camera(raw);
  std::string model;
  int status = Point(camera.get(), found.port, context.get(), model);
  if (status == GP_OK) status = gp_camera_init(camera.get(), context.get());
  if (status != GP_OK) {
    error = FaultOf(status, found.id, fault::kIo, "it cannot be opened");
    return nullptr;
  }
  auto opened =
      std::make_unique<GphotoCamera>(std::move(context), std::move(camera), std::move(model));
  opened->AskModel();
  return opened;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) TetheredCamera* lightcal_gphoto_open(
    const FoundCamera& camera, Error& error) noexcept {
  try {
    return Open(camera, error).release();
  } catch (const std::exception& thrown) {
    error = Failed("internal", camera.id, thrown.what()).value();
  } catch (...) {
    error = Failed("internal", camera.id, "unknown error").value();
  }
  return nullptr;
}
