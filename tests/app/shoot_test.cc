// SPDX-License-Identifier: Apache-2.0
// lightcal shoot: the built program and the real libgphoto2, against a camera on loopback that is a
// Python program and misbehaves on request.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fake_camera.h"
#include "run_cli.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const std::vector<std::string> kCard = {"--use", "card",          "--distance",
                                        "0.8m",  "--reflectance", "0.18"};

class Shoot : public testing::Test {
 protected:
  Shoot() {
    folder_.Write("lamp/session.toml",
                  "lightcal = 1\n[room]\ndark = true\n"
                  "[[light]]\nname = \"key\"\nkind = \"point\"\nfixture = \"bulb\"\n");
  }
  [[nodiscard]] std::string Session() const { return folder_.path() + "/lamp"; }
  [[nodiscard]] std::string Captures(const std::string& name) const {
    return Session() + "/captures/" + name;
  }

  [[nodiscard]] std::vector<std::string> Arguments(const FakeCamera& camera,
                                                   const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"shoot", "-s", Session(), "--device", camera.id()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // Five frames about 1/60 s at f/4 and ISO 100, as the pictures were rendered.
  [[nodiscard]] std::vector<std::string> FiveFrames(const FakeCamera& camera,
                                                    std::vector<std::string> more = {}) const {
    more.insert(more.begin(),
                {"--light", "key", "--bracket", "±2EV/1EV", "--aperture", "f/4", "--iso", "100"});
    return Arguments(camera, more);
  }
  // libgphoto2 keeps a file in the home directory, and what its drivers allocated.
  [[nodiscard]] CliResult Run(const std::vector<std::string>& arguments,
                              const std::vector<std::string>& wrapper = {}) const {
    return RunLightcal(arguments, "", {"HOME=" + folder_.path(), "LSAN_OPTIONS=detect_leaks=0"},
                       wrapper);
  }
  // Runs until the camera has exposed so often, then sends the signal.
  [[nodiscard]] CliResult RunAndSignal(const std::vector<std::string>& arguments,
                                       const FakeCamera& camera, int exposures, int signal) const {
    const std::string pid_file = folder_.path() + "/pid";
    const std::vector<std::string> wrapper = {"/bin/sh", "-c",
                                              "echo $$ > " + pid_file + "; exec \"$@\"", "sh"};
    auto running = std::async(std::launch::async, [&] { return Run(arguments, wrapper); });
    EXPECT_TRUE(camera.WaitFor("exposed", exposures));
    ::kill(static_cast<pid_t>(std::stol(ReadFile(pid_file))), signal);
    return running.get();
  }

  void ExpectItHasItsSettingsBack(const FakeCamera& camera) const {
    EXPECT_EQ(camera.Property("500d"), "166");
    EXPECT_EQ(camera.Property("5007"), "800");
    EXPECT_EQ(camera.Property("500f"), "200");
  }
  [[nodiscard]] json Record(const std::string& name) const {
    return json::parse(ReadFile(Captures(name) + "/capture.json"));
  }
  // SIGKILL leaves what was being written, under a hidden name; nothing else does.
  [[nodiscard]] long FramesIn(const std::string& name, bool after_a_kill = false) const {
    std::error_code none;
    long count = 0;
    for (const auto& entry : fs::directory_iterator(Captures(name), none)) {
      const std::string file = entry.path().filename().string();
      EXPECT_TRUE(!file.ends_with(".tmp") || (after_a_kill && file.starts_with("."))) << file;
      if (file.starts_with("frame_")) ++count;
    }
    return count;
  }

  TempDir folder_;
};

std::string CodeOf(const CliResult& result) {
  return json::parse(result.out)["error"].value("code", "");
}

bool Warned(const json& document, const std::string& code) {
  const json warnings = document.value("warnings", json::array());
  return std::ranges::any_of(warnings, [&](const json& w) { return w["code"] == code; });
}

TEST_F(Shoot, ABracketOfACardIsInTheSessionAndRunUsesIt) {
  const FakeCamera camera;
  std::vector<std::string> more = kCard;
  more.insert(more.end(), {"--light", "key", "--bracket", "±4EV/1EV", "--aperture", "f/4", "--iso",
                           "100", "--json"});
  const CliResult shot = Run(Arguments(camera, more));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  const json document = json::parse(shot.out);
  EXPECT_EQ(document["folder"], "captures/key-1");
  EXPECT_EQ(document["in_session"], true);
  EXPECT_EQ(document["camera"], "lightcal FakeCam");
  ASSERT_EQ(document["frames"].size(), 9U);
  for (int i = 0; i < 9; ++i) {  // 2^-10 s to 2^-2 s
    const json& frame = document["frames"].at(i);
    EXPECT_DOUBLE_EQ(double(frame["planned_s"]), std::exp2(i - 10));
    EXPECT_DOUBLE_EQ(double(frame["exposure_s"]), std::exp2(i - 10));
    EXPECT_TRUE(fs::exists(Session() + "/" + frame["file"].get<std::string>()));
  }
  EXPECT_FALSE(document.contains("warnings")) << document["warnings"];
  ExpectItHasItsSettingsBack(camera);
  EXPECT_EQ(camera.Count("deleted"), 0);

  const CliResult run = RunLightcal({"run", Session(), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json light = json::parse(run.out)["lights"].at(0);
  EXPECT_NEAR(double(light["intensity_cd"]["value"]), 300.0, 6.0);
  EXPECT_LE(double(light["intensity_cd"]["low95"]), 300.0);
  EXPECT_GE(double(light["intensity_cd"]["high95"]), 300.0);
  EXPECT_NEAR(double(light["color"]["cct_K"]["value"]), 3000.0, 60.0);
}

TEST_F(Shoot, WithoutAUseTheBlockToPasteIsPrintedAndTakesTheFramesPlace) {
  const FakeCamera camera;
  const CliResult shot = Run(FiveFrames(camera));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  EXPECT_THAT(shot.out,
              HasSubstr("[[capture]]\nlight = \"key\"\nframes = \"captures/key-1/frame_*\""));
  EXPECT_EQ(FramesIn("key-1"), 5);
  EXPECT_FALSE(Record("key-1").contains("capture"));
  const std::string toml = ReadFile(Session() + "/session.toml");
  const std::string block = shot.out.substr(shot.out.find("[[capture]]"));
  folder_.Write("lamp/session.toml", toml + block + "reflectance = 0.18\ndistance_m = 0.8\n");
  const CliResult run = RunLightcal({"run", Session(), "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(Warned(json::parse(run.out), "capture_not_described"));
}

TEST_F(Shoot, DryRunPlansAndSetsNothing) {
  const FakeCamera camera;
  const CliResult plan = Run(FiveFrames(camera, {"--dry-run", "--json"}));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(json::parse(plan.out)["frames"].size(), 5U);
  EXPECT_TRUE(camera.log().empty());
  EXPECT_FALSE(fs::exists(Session() + "/captures"));
}

TEST_F(Shoot, DeleteEmptiesTheCardOnceTheFramesAreHere) {
  const FakeCamera camera;
  const CliResult shot = Run(FiveFrames(camera, {"--delete"}));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  EXPECT_EQ(camera.Count("deleted"), 5);
}

TEST_F(Shoot, AnApertureProgrammeIsSetToManualAndBack) {
  const FakeCamera camera({"auto"});
  const CliResult shot = Run(FiveFrames(camera));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  EXPECT_EQ(camera.Property("500e"), "3");
  EXPECT_GE(camera.Count("set 500e 1"), 1);
  ExpectItHasItsSettingsBack(camera);
}

TEST_F(Shoot, FlickerSafeTimesAreToldFromOthers) {
  const FakeCamera camera;
  const CliResult plan = Run(FiveFrames(camera, {"--mains", "60", "--dry-run", "--json"}));
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_TRUE(Warned(json::parse(plan.out), "flicker_unsafe_shutter"));
}

TEST_F(Shoot, ABusyCameraIsAskedAgain) {
  const FakeCamera camera({"busy=3"});
  const CliResult shot = Run(FiveFrames(camera));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  EXPECT_EQ(FramesIn("key-1"), 5);
}

TEST_F(Shoot, ASlowCameraIsWaitedFor) {
  const FakeCamera camera({"slow=0.6"});
  const CliResult shot = Run(FiveFrames(camera));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  EXPECT_EQ(FramesIn("key-1"), 5);
  ExpectItHasItsSettingsBack(camera);
}

TEST_F(Shoot, AFrameThatSaysAnotherExposureIsNamedAndKept) {
  const FakeCamera camera({"wrong=2"});
  const CliResult shot = Run(FiveFrames(camera, {"--json"}));
  ASSERT_EQ(shot.exit_code, 0) << shot.err;
  const json document = json::parse(shot.out);
  ASSERT_TRUE(Warned(document, "exposure_conflict"));
  EXPECT_EQ(document["warnings"][0]["subject"], "frame_02.DNG");
  EXPECT_THAT(shot.err, HasSubstr("1/128 s was asked (0.0080s), the file says 1.00 s"));
  EXPECT_EQ(FramesIn("key-1"), 5);
  const FakeCamera other({"wrong=2"});
  EXPECT_EQ(Run(FiveFrames(other, {"--strict"})).exit_code, 3);
  ExpectItHasItsSettingsBack(other);
}

struct FaultCase {
  const char* name;
  const char* fault;
  const char* code;
  int frames;  // that stay here
};
void PrintTo(const FaultCase& fault_case, std::ostream* os) { *os << fault_case.name; }

class ShootFault : public Shoot, public testing::WithParamInterface<FaultCase> {};

TEST_P(ShootFault, KeepsWhatIsHereGivesTheSettingsBackAndGoesOn) {
  {
    const FakeCamera camera({GetParam().fault});
    const CliResult broken = Run(FiveFrames(camera, {"--json"}));
    EXPECT_EQ(broken.exit_code, std::string(GetParam().code) == "bad_picture" ? 3 : 1);
    EXPECT_EQ(CodeOf(broken), GetParam().code) << broken.err;
    EXPECT_THAT(broken.err + broken.out, HasSubstr("--resume"));
    EXPECT_EQ(FramesIn("key-1"), GetParam().frames);
    EXPECT_EQ(Record("key-1")["state"], "shooting");
    ExpectItHasItsSettingsBack(camera);
  }
  const FakeCamera mended;
  const CliResult resumed = Run(Arguments(mended, {"--resume", "--json"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(FramesIn("key-1"), 5);
  EXPECT_EQ(mended.Count("exposed"), 5 - GetParam().frames);
  EXPECT_EQ(Record("key-1")["state"], "complete");
  ExpectItHasItsSettingsBack(mended);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ShootFault,
    testing::Values(FaultCase{"RefusesTheShutter", "refuse=500d", "setting_refused", 0},
                    FaultCase{"RefusesTheIso", "refuse=500f", "setting_refused", 0},
                    FaultCase{"LineBreaksInADownload", "drop=3", "io", 2},
                    FaultCase{"CardIsFull", "full=4", "card_full", 3},
                    FaultCase{"HalfAFile", "torn=2", "bad_picture", 1}),
    [](const auto& param) { return std::string(param.param.name); });

TEST_F(Shoot, CtrlCFinishesTheFrameGivesTheSettingsBackAndCanGoOn) {
  const FakeCamera camera({"slow=0.3"});
  const CliResult stopped = RunAndSignal(FiveFrames(camera, {"--json"}), camera, 2, SIGINT);
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_EQ(CodeOf(stopped), "interrupted") << stopped.err;
  ExpectItHasItsSettingsBack(camera);
  const long here = FramesIn("key-1");
  EXPECT_GE(here, 2);
  const CliResult resumed = Run(Arguments(camera, {"--resume"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(FramesIn("key-1"), 5);
  EXPECT_EQ(camera.Count("exposed"), 5);
}

TEST_F(Shoot, AShootThatWasKilledLosesNothingAndGivesTheSettingsBackLater) {
  const FakeCamera camera({"slow=0.3"});
  const CliResult killed = RunAndSignal(FiveFrames(camera, kCard), camera, 3, SIGKILL);
  // A leftover for certain; one whose writer lives is none.
  const std::string mine =
      Captures("key-1") + "/.frame_05.jpg." + std::to_string(getpid()) + ".tmp";
  std::ofstream(Captures("key-1") + "/.frame_05.jpg.999999999.tmp") << "half a frame";
  std::ofstream(mine) << "being written";
  EXPECT_EQ(killed.exit_code, 128 + SIGKILL);
  EXPECT_EQ(camera.Property("5007"), "400");
  EXPECT_GE(FramesIn("key-1", true), 2);
  const CliResult run = RunLightcal({"run", Session()});
  EXPECT_THAT(run.err, HasSubstr("shoot --resume goes on"));
  const CliResult resumed = Run(Arguments(camera, {"--resume"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_TRUE(fs::remove(mine));
  EXPECT_EQ(FramesIn("key-1"), 5);
  ExpectItHasItsSettingsBack(camera);
  EXPECT_EQ(RunLightcal({"run", Session()}).exit_code, 0);
}

TEST_F(Shoot, WhatCannotBeIsSaidBeforeAShutterClicks) {
  const FakeCamera camera;
  const auto code = [&](const std::vector<std::string>& arguments) {
    const CliResult result = Run(arguments);
    EXPECT_THAT(result.err, HasSubstr(":")) << result.out;
    return result.exit_code;
  };
  EXPECT_EQ(code(FiveFrames(camera, {"--use", "card"})), 2);
  EXPECT_EQ(code(Arguments(camera, {"--light", "key"})), 2);
  EXPECT_EQ(code(Arguments(camera, {"--light", "key", "--bracket", "4EV"})), 2);
  EXPECT_EQ(code(Arguments(camera, {"--light", "kee", "--bracket", "4EV/1EV"})), 3);
  EXPECT_EQ(code(Arguments(camera, {"--light", "key", "--bracket", "4/1", "--aperture", "f/22"})),
            2);
  EXPECT_EQ(code(Arguments(camera, {"--resume"})), 1);
  EXPECT_EQ(camera.Count("exposed"), 0);
  EXPECT_FALSE(fs::exists(Session() + "/captures"));
}

TEST_F(Shoot, NoCameraAndNoAnswerAreNamed) {
  EXPECT_EQ(CodeOf(Run({"shoot", "-s", Session(), "--light", "key", "--bracket", "4EV/1EV",
                        "--json", "--device", "gphoto2:ptpip:127.0.0.1:1"})),
            "io");
}

// A camera as the kernel shows it.
std::string PluggedIn(const std::string& driver) {
  return "P: /devices/usb1/1-1/1-1:1.0\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_interface\n"
         "A: bInterfaceClass=06\\n\nA: bInterfaceSubClass=01\\n\n" +
         (driver.empty() ? "" : "L: driver=../../../../bus/usb/drivers/" + driver + "\n") +
         "\nP: /devices/usb1/1-1\nN: bus/usb/001/004\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\n"
         "E: DEVNAME=/dev/bus/usb/001/004\nA: idVendor=04a9\\n\nA: idProduct=32da\\n\n"
         "A: product=Canon Digital Camera\\n\nA: serial=0042\\n\nA: busnum=1\\n\nA: devnum=4\\n\n\n"
         "P: /devices/usb1\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nA: idVendor=1d6b\\n\n"
         "A: idProduct=0002\\n\n";
}

json ListedCamera(const std::string& driver) {
  const TempDir folder;
  const std::string description = folder.Write("camera.umockdev", PluggedIn(driver));
  const CliResult result =
      RunLightcal({"devices", "--json"}, "", {}, {"umockdev-run", "-d", description, "--"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json document = json::parse(result.out);
  for (const json& device : document["devices"]) {
    if (device["transport"] == "ptp") return device;
  }
  return {};
}

TEST(DevicesCamera, ACameraOnACableIsListed) {
  const json camera = ListedCamera("");
  EXPECT_EQ(camera["id"], "gphoto2:usb:001,004");
  EXPECT_EQ(camera["driver"], "gphoto2");
  EXPECT_EQ(camera["usb"], "04a9:32da");
  EXPECT_EQ(camera["serial"], "0042");
  EXPECT_EQ(camera["models"], "Canon Digital Camera");
  EXPECT_EQ(camera["status"], "ready");
  EXPECT_EQ(camera["verified"], "documentation");
}

TEST(DevicesCamera, OneTheDesktopHoldsIsBusyAndSaysHowToFreeIt) {
  const json camera = ListedCamera("usbfs");
  EXPECT_EQ(camera["status"], "busy");
  EXPECT_THAT(camera["remedy"].get<std::string>(), HasSubstr("gio mount"));
}

}  // namespace
}  // namespace lightcal::test
