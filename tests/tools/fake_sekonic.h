// SPDX-License-Identifier: Apache-2.0
// A Sekonic spectrometer in memory: takes commands, answers transfers, fails on request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lightcal::test {

enum class Fault {
  kNone,
  kNak,        // acknowledges with 15 32
  kSilent,     // takes the command and never answers
  kShort,      // answers ten bytes less
  kWrongEcho,  // answers another command
  kStall,      // the acknowledgement's transfer stalls
  kUnplug,     // the device is gone from this command on
};

struct SekonicSetting {
  std::string model = "C-800";
  std::string firmware = "20,C36E,27,7881,11,B216,14,50CC,17,74EC";
  std::vector<std::byte> measurement;  // the whole reply to NR
  unsigned ring = 2;                   // 2 = LOW
  unsigned button = 0;
  int busy_polls_before = 0;  // answers to ST that say "initialising" before the first measurement
  bool busy_is_dark = false;  // "calibrating its dark signal" instead of "initialising"
  std::vector<std::vector<std::byte>> memory;  // whole replies to NR, as MRnnnn gives them
  int busy_polls_after = 2;                    // answers to ST that say "measuring" after RM0
  std::string fault_command;                   // the command (whole) the fault strikes
  Fault fault = Fault::kNone;
  int fault_times = 1000000;
};

class FakeSekonic {
 public:
  enum class Answer { kBytes, kNothing, kStall, kGone };

  explicit FakeSekonic(SekonicSetting setting) : setting_(std::move(setting)) {}

  // What the next measurement answers.
  void Show(std::vector<std::byte> measurement) { setting_.measurement = std::move(measurement); }

  // A whole OUT transfer. False when the device is gone.
  bool Take(std::span<const std::byte> command);
  // The next IN transfer.
  Answer Give(std::vector<std::byte>& bytes);

  [[nodiscard]] const std::vector<std::string>& commands() const { return commands_; }
  [[nodiscard]] bool remote() const { return remote_; }
  [[nodiscard]] bool has_answer() const { return gone_ || !answers_.empty(); }

 private:
  struct Pending {
    Answer kind = Answer::kBytes;
    std::vector<std::byte> bytes;
  };
  [[nodiscard]] std::vector<std::byte> ReplyTo(const std::string& command);
  [[nodiscard]] std::vector<std::byte> StateReply();

  SekonicSetting setting_;
  std::deque<Pending> answers_;
  std::vector<std::string> commands_;
  int busy_left_ = setting_.busy_polls_before;
  bool measuring_ = false;
  bool remote_ = false;
  bool gone_ = false;
};

// The bytes of sample_data/sekonic_replies/<name>.
std::vector<std::byte> RecordedReply(const std::string& name);
inline constexpr const char* kReply407lx = "c800_407lx_4995K.nr";
inline constexpr const char* kReply14lx = "c800_14lx_3289K.nr";

// The same reply with another float32 (big-endian) or byte at an offset.
std::vector<std::byte> WithFloat(std::vector<std::byte> reply, std::size_t at, float value);
std::vector<std::byte> WithByte(std::vector<std::byte> reply, std::size_t at, std::byte value);

}  // namespace lightcal::test
