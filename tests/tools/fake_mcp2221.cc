// SPDX-License-Identifier: Apache-2.0
#include "fake_mcp2221.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lightcal::test {
namespace {

using devices::Bytes;

constexpr std::uint8_t kStatus = 0x10;
constexpr std::uint8_t kFetch = 0x40;
constexpr std::uint8_t kWrite = 0x90;
constexpr std::uint8_t kWriteNoStop = 0x94;

Bytes Word(unsigned value) {
  return {static_cast<std::byte>(value >> 8U), static_cast<std::byte>(value & 0xFFU)};
}

std::uint8_t Number(std::byte b) { return std::to_integer<std::uint8_t>(b); }

}  // namespace

std::optional<Bytes> FakeMcp2221::Answer(const Bytes& request) {
  using Fault = Mcp2221Setting::Fault;
  if (gone_ || request.size() != 64) return std::nullopt;
  const std::uint8_t command = Number(request[0]);
  commands_.push_back(command);
  if (!started_ && setting_.busy_at_first) engine_ = 0x60;
  started_ = true;
  const bool struck = setting_.fault != Fault::kNone && command == setting_.fault_command;
  if (struck && setting_.fault == Fault::kSilent) return std::nullopt;
  if (struck && setting_.fault == Fault::kUnplug) {
    gone_ = true;
    return std::nullopt;
  }
  Bytes reply(64);
  reply[0] = request[0];
  if (struck && setting_.fault == Fault::kShort) return Bytes(reply.begin(), reply.begin() + 10);
  if (struck && setting_.fault == Fault::kBusHeld) {
    reply[1] = std::byte{0x01};
    reply[2] = std::byte{0x12};
    engine_ = 0x12;
    return reply;
  }
  if (struck && setting_.fault == Fault::kAlwaysBusy) {
    reply[1] = std::byte{0x01};
    engine_ = 0x21;
    return reply;
  }
  if (command == kStatus) AnswerStatus(request, reply);
  if (command == kFetch) AnswerFetch(reply);
  if (command >= kWrite) AnswerTransfer(request, reply);
  return reply;
}

void FakeMcp2221::AnswerStatus(const Bytes& request, Bytes& reply) {
  if (request[2] == std::byte{0x10}) {
    engine_ = 0;
    nack_ = false;
  }
  if (request[3] == std::byte{0x20}) reply[3] = std::byte{0x20};
  reply[8] = static_cast<std::byte>(engine_);
  if (nack_) reply[20] = std::byte{0x40};
}

void FakeMcp2221::AnswerTransfer(const Bytes& request, Bytes& reply) {
  const std::size_t count = Number(request[1]) | Number(request[2]) << 8U;
  const auto address = static_cast<std::uint8_t>(Number(request[3]) >> 1U);
  const std::uint8_t command = Number(request[0]);
  const bool is_write = command == kWrite || command == kWriteNoStop;
  const auto chip = setting_.chips.find(address);
  std::optional<Bytes> done;
  if (chip != setting_.chips.end()) {
    done = is_write
               ? chip->second(
                     Bytes(request.begin() + 4, request.begin() + 4 + static_cast<long>(count)), 0)
               : chip->second({}, count);
  }
  nack_ = !done;
  engine_ = !done ? 0x25 : command == kWriteNoStop ? 0x45 : 0x00;
  if (done && !is_write) fetched_ = *done;
  reply[1] = std::byte{0};
}

void FakeMcp2221::AnswerFetch(Bytes& reply) {
  if (fetched_.empty()) {
    reply[1] = std::byte{0x41};
    return;
  }
  reply[2] = std::byte{0x55};
  reply[3] = static_cast<std::byte>(fetched_.size());
  std::ranges::copy(fetched_, reply.begin() + 4);
  fetched_.clear();
}

Result<void> FakeMcp2221Line::Write(std::span<const std::byte> bytes, std::chrono::milliseconds) {
  if (bytes.size() != 65 || bytes[0] != std::byte{0}) {
    return Failed(std::string(devices::fault::kIo), Name(), "a report is a 0 and 64 bytes");
  }
  reply_ = bridge_.Answer(Bytes(bytes.begin() + 1, bytes.end()));
  if (bridge_.gone()) return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  return {};
}

Result<Bytes> FakeMcp2221Line::Read(std::size_t, std::chrono::milliseconds) {
  if (!reply_) return Failed(std::string(devices::fault::kTimeout), Name(), "silent");
  Bytes reply = *std::move(reply_);
  reply_.reset();
  return reply;
}

FakeChip ChipOf(std::shared_ptr<FakeRegisters> registers) {
  return [registers, at = std::uint8_t{0}](const Bytes& written,
                                           std::size_t count) mutable -> std::optional<Bytes> {
    if (!written.empty()) at = Number(written[0]);
    if (written.size() > 1) {
      registers->content[at] = Bytes(written.begin() + 1, written.end());
      registers->written.push_back(written);
      if (registers->after_write) registers->after_write(*registers);
    }
    Bytes answer = registers->content[at];
    answer.resize(count, std::byte{0xFF});
    return answer;
  };
}

FakeChip Bh1750(std::uint16_t counts, std::shared_ptr<Bytes> orders) {
  return [counts, orders](const Bytes& written, std::size_t count) -> std::optional<Bytes> {
    if (orders != nullptr) orders->insert(orders->end(), written.begin(), written.end());
    if (count == 0) return Bytes();
    Bytes answer = Word(counts);
    answer.resize(count);
    return answer;
  };
}

std::shared_ptr<FakeRegisters> Opt3001(std::uint16_t result, std::uint16_t ready) {
  auto chip = std::make_shared<FakeRegisters>();
  chip->content = {
      {0x00, Word(result)}, {0x01, Word(0xC810)}, {0x7E, Word(0x5449)}, {0x7F, Word(0x3001)}};
  chip->after_write = [ready](FakeRegisters& self) {
    if (self.content[0x01] == Word(0xCA10)) self.content[0x01] = Word(0xC810U | ready);
  };
  return chip;
}

std::shared_ptr<FakeRegisters> Opt4048(const Bytes& channels, std::uint16_t status) {
  auto chip = std::make_shared<FakeRegisters>();
  chip->content = {{0x00, channels}, {0x0A, Word(0x3208)}, {0x0C, Word(0)}, {0x11, Word(0x0821)}};
  chip->after_write = [status](FakeRegisters& self) {
    if (self.content[0x0A] == Word(0x3218)) self.content[0x0C] = Word(status);
  };
  return chip;
}

std::shared_ptr<FakeRegisters> Veml7700(double linear_lx) {
  auto chip = std::make_shared<FakeRegisters>();
  chip->content = {{0x00, {std::byte{0x01}, std::byte{0x00}}}};  // shut down, as it powers up
  chip->after_write = [linear_lx](FakeRegisters& self) {
    const Bytes& bytes = self.content[0x00];
    const unsigned bits = Number(bytes[0]) | Number(bytes[1]) << 8U;
    constexpr std::array kGains = {1.0, 2.0, 0.125, 0.25};
    const double gain = kGains[(bits >> 11U) & 3U];
    const std::map<unsigned, double> times = {{0, 100}, {1, 200}, {2, 400},
                                              {3, 800}, {8, 50},  {12, 25}};
    const auto time = times.find((bits >> 6U) & 0xFU);
    if (time == times.end()) return;
    const double counts = linear_lx / (0.0042 * 800.0 / time->second * 2.0 / gain);
    const auto raw = static_cast<unsigned>(std::min(65535.0, std::round(counts)));
    self.content[0x04] = {static_cast<std::byte>(raw & 0xFFU), static_cast<std::byte>(raw >> 8U)};
  };
  return chip;
}

}  // namespace lightcal::test
