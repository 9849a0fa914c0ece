// SPDX-License-Identifier: Apache-2.0
// The five small serial meters through the real termios and the built binary, each behind a
// pseudo-terminal, with what goes wrong on a cable.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "fake_torchbearer.h"
#include "run_cli.h"
#include "stream_instrument.h"

namespace lightcal::test {
namespace {

using nlohmann::json;
using testing::EndsWith;

std::string Hex(const std::string& text) { return AsText(FromHex(text)); }

const std::string kUt382 = Hex(
    "30 30 35 36 3C 3F 3E 35 30 36 30 30 30 30 30 30 30 30 38 32 32 3E 30 30 30 30 30 30 30 30 0D "
    "0A 00");
const std::string kUt382Overload = Hex(
    "30 30 30 30 3B 30 3B 37 30 30 30 30 30 30 30 30 30 30 38 32 32 3E 30 30 30 30 30 30 30 30 0D "
    "0A 00");
const std::string kLutron = Hex("02 34 31 31 35 30 31 30 30 30 30 31 32 33 34 0D");
const std::string kGm1020 = Hex("33 22 04 D2 01 00 FD 11");
const std::string kGm1020Start = Hex("3C 01 00 00 00 00 00 3D");
const std::string kGm1020Stop = Hex("3C 02 00 00 00 00 00 3E");
const std::string kPce174Read = Hex("87 83 11");
const std::string kPce174 = Hex("AA DD 00 26 06 11 21 12 34 56 0C 22 0C 22 81 00 00 01");
const std::string kPce174Over = Hex("AA DD 00 26 06 11 21 12 34 56 28 01 28 01 81 00 00 01");
const std::string kPce174Damaged = Hex("AA DD 00 26 06 11 21 12 34 56 0C 22 7F 7F 81 00 00 01");
const std::string kTorchStop = Hex("CC 01 09 00 00 04 DA 0D 0A");

// Answers `command` with `answer` each time it is asked.
Speak Answering(const std::string& command, const std::string& answer) {
  return [=](std::string& unread) {
    if (unread.find(command) == std::string::npos) return Spoken{};
    unread.clear();
    return Spoken{answer, false};
  };
}

// Says `frame` every moment between start and stop.
Speak Gm1020Saying(const std::string& frame) {
  return [frame, live = false](std::string& unread) mutable {
    if (unread.find(kGm1020Start) != std::string::npos) live = true;
    if (unread.find(kGm1020Stop) != std::string::npos) live = false;
    if (unread.size() >= kGm1020Start.size()) unread.clear();
    return Spoken{live ? frame : "", false};
  };
}

// Says half a frame and is gone.
Speak Breaking(const std::string& half) {
  return [half](std::string&) { return Spoken{half, true}; };
}

Speak Torch(std::vector<TorchMeasurement> measurements, unsigned faulty_type = 0,
            const std::string& instead = "", int times = 0) {
  TorchSetting setting;
  setting.measurements = std::move(measurements);
  setting.faulty_type = faulty_type;
  setting.instead = instead;
  setting.times = times;
  return FakeTorchbearer(setting);
}

std::string DamagedTorchMessage() {
  std::string message = AsText(TorchMessage(0x33, TorchData(IlluminantA())));
  message[700] = static_cast<char>(message[700] ^ 0x10);
  return message;
}

CliResult Read(const std::string& driver, const StreamStandIn& meter,
               std::vector<std::string> more = {}) {
  std::vector<std::string> command = {
      "read", "--once", "--json", "--device", driver + ":" + meter.path(), "--timeout", "300ms"};
  command.insert(command.end(), more.begin(), more.end());
  return RunLightcal(command);
}

struct Reads {
  const char* name;
  const char* driver;
  Speak speak;
  double illuminance_lx;
  bool over_range = false;
};
void PrintTo(const Reads& reads, std::ostream* os) { *os << reads.name; }
class SmallMeter : public testing::TestWithParam<Reads> {};
TEST_P(SmallMeter, ReadsOverARealSerialPort) {
  const StreamStandIn meter(GetParam().speak);
  const TempDir dir;
  const std::string tape = dir.path() + "/meter.tape";
  const CliResult live = Read(GetParam().driver, meter, {"--record", tape});
  ASSERT_EQ(live.exit_code, 0) << live.err << live.out;
  json reading = json::parse(live.out);
  EXPECT_NEAR(double(reading["illuminance_lx"]), GetParam().illuminance_lx, 1e-9);
  EXPECT_EQ(reading.value("over_range", false), GetParam().over_range);

  const CliResult played = RunLightcal({"read", "--once", "--json", "--replay", tape});
  ASSERT_EQ(played.exit_code, 0) << played.err;
  json again = json::parse(played.out);
  reading.erase("time");
  again.erase("time");
  EXPECT_EQ(again, reading) << "what was recorded replays";
}
INSTANTIATE_TEST_SUITE_P(
    Tty, SmallMeter,
    testing::Values(
        Reads{"Ut382", "ut382", Saying({kUt382}), 123.4},
        Reads{"Ut382JoinedInMidFrame", "ut382", Saying({kUt382.substr(13), kUt382}), 123.4},
        Reads{"Ut382Overload", "ut382", Saying({kUt382Overload}), 20000.0, true},
        Reads{"Lutron", "lutron16", Saying({kLutron}), 123.4},
        Reads{"LutronAfterNoise", "lutron16", Saying({"\xFF\x02\x34\x02" + kLutron}), 123.4},
        Reads{"Gm1020", "gm1020", Gm1020Saying(kGm1020), 123.4},
        Reads{"Gm1020AfterNoise", "gm1020", Gm1020Saying("\x33" + kGm1020), 123.4},
        Reads{"Pce174", "pce174", Answering(kPce174Read, kPce174), 123.4},
        Reads{"Pce174AfterNoise", "pce174", Answering(kPce174Read, "\xAA\xAA" + kPce174), 123.4},
        Reads{"Pce174OverRange", "pce174", Answering(kPce174Read, kPce174Over), 400.0, true}),
    [](const auto& reads) { return std::string(reads.param.name); });

struct Fails {
  const char* name;
  const char* driver;
  Speak speak;
  const char* code;
};
void PrintTo(const Fails& fails, std::ostream* os) { *os << fails.name; }
class SmallMeterFault : public testing::TestWithParam<Fails> {};
TEST_P(SmallMeterFault, IsNamed) {
  const StreamStandIn meter(GetParam().speak);
  const CliResult result = Read(GetParam().driver, meter);
  EXPECT_NE(result.exit_code, 0) << result.out;
  EXPECT_EQ(json::parse(result.out)["error"]["code"], GetParam().code) << result.err;
}
INSTANTIATE_TEST_SUITE_P(
    Tty, SmallMeterFault,
    testing::Values(
        Fails{"Ut382Silent", "ut382", Saying({}), "timeout"},
        Fails{"Ut382Noise", "ut382", Saying({std::string(40, 'x')}), "bad_reply"},
        Fails{"Ut382Unplugged", "ut382", Breaking(kUt382.substr(0, 20)), "unplugged"},
        Fails{"LutronDecibels", "lutron16",
              Saying({"\x02"
                      "41170100001234\r"}),
              "wrong_unit"},
        Fails{"LutronUnplugged", "lutron16", Breaking(kLutron.substr(0, 9)), "unplugged"},
        Fails{"Gm1020Silent", "gm1020", Gm1020Saying(""), "timeout"},
        Fails{"Gm1020Unplugged", "gm1020", Breaking(kGm1020.substr(0, 5)), "unplugged"},
        Fails{"Pce174Damaged", "pce174", Answering(kPce174Read, kPce174Damaged), "bad_reply"},
        Fails{"Pce174Unplugged", "pce174", Breaking(kPce174.substr(0, 7)), "unplugged"},
        Fails{"TorchOverExposed", "torchbearer", Torch({Exposed(1)}), "over_exposed"},
        Fails{"TorchDamaged", "torchbearer",
              Torch({IlluminantA()}, 0x33, DamagedTorchMessage(), 1000), "bad_reply"},
        Fails{"TorchSilent", "torchbearer", Torch({IlluminantA()}, 0x0F, "", 1000), "timeout"}),
    [](const auto& fails) { return std::string(fails.param.name); });

// CIE illuminant A: 2856 K, x = 0.44758, y = 0.40745 (CIE 15:2018, table 1).
TEST(TorchbearerOverTty, MeasuresIlluminantAAndEndsTheStream) {
  const StreamStandIn meter(Torch({Exposed(1), IlluminantA()}, 0x33, DamagedTorchMessage(), 1));
  const CliResult result = Read("torchbearer", meter);
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const json reading = json::parse(result.out);
  EXPECT_NEAR(double(reading["xy"][0]), 0.44758, 2e-5);
  EXPECT_NEAR(double(reading["xy"][1]), 0.40745, 2e-5);
  EXPECT_NEAR(double(reading["cct_K"]), 2856.0, 1.0);
  EXPECT_THAT(result.err, testing::HasSubstr("experimental"));
  EXPECT_THAT(meter.received(), EndsWith(kTorchStop));
}

TEST(Gm1020OverTty, CtrlCStopsTheMeter) {
  const StreamStandIn meter(Gm1020Saying(""));
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  const std::string device = "gm1020:" + meter.path();
  if (child == 0) {
    ::execl(LIGHTCAL_BINARY, "lightcal", "read", "--once", "--quiet", "--timeout", "20s",
            "--device", device.c_str(), nullptr);
    ::_exit(127);
  }
  const bool started = meter.WaitFor(kGm1020Start);
  ::usleep(100'000);  // so that it is waiting for a frame
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(started);
  ASSERT_TRUE(WIFEXITED(status)) << "killed instead of stopping by itself";
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(meter.WaitFor(kGm1020Stop));
}

}  // namespace
}  // namespace lightcal::test
