// SPDX-License-Identifier: Apache-2.0
#include "fake_sekonic.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "run_cli.h"

namespace lightcal::test {
namespace {

std::vector<std::byte> BytesOf(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

bool FakeSekonic::Take(std::span<const std::byte> command) {
  if (gone_) return false;
  std::string text(reinterpret_cast<const char*>(command.data()), command.size());
  commands_.push_back(text);
  const bool struck =
      setting_.fault != Fault::kNone && text == setting_.fault_command && setting_.fault_times > 0;
  const Fault fault = struck ? setting_.fault : Fault::kNone;
  if (struck) --setting_.fault_times;
  switch (fault) {
    case Fault::kUnplug:
      gone_ = true;
      return false;
    case Fault::kSilent:
      return true;
    case Fault::kStall:
      answers_.push_back({Answer::kStall, {}});
      return true;
    case Fault::kNak:
      answers_.push_back({Answer::kBytes, {std::byte{0x15}, std::byte{0x32}}});
      return true;
    default:
      break;
  }
  std::vector<std::byte> reply = ReplyTo(text);
  if (fault == Fault::kShort) reply.resize(reply.size() - std::min<std::size_t>(10, reply.size()));
  if (fault == Fault::kWrongEcho) reply = BytesOf("XX@@@");
  answers_.push_back({Answer::kBytes, {std::byte{0x06}, std::byte{0x30}}});
  answers_.push_back({Answer::kBytes, std::move(reply)});
  return true;
}

FakeSekonic::Answer FakeSekonic::Give(std::vector<std::byte>& bytes) {
  if (gone_) return Answer::kGone;
  if (answers_.empty()) return Answer::kNothing;
  const Pending next = std::move(answers_.front());
  answers_.pop_front();
  bytes = next.bytes;
  return next.kind;
}

std::vector<std::byte> FakeSekonic::StateReply() {
  unsigned s1 = 0x40;
  unsigned s2 = 0x40;
  if (busy_left_ > 0) {
    --busy_left_;
    s1 |= 0x01U;
    const unsigned before = setting_.busy_is_dark ? 0x04U : 0x01U;
    s2 |= measuring_ ? 0x08U : before;
  } else {
    measuring_ = false;
  }
  if (remote_) s1 |= 0x02U;
  const unsigned key = (setting_.ring << 5U) | setting_.button;
  return {std::byte{'S'}, std::byte{'T'}, static_cast<std::byte>(s1), static_cast<std::byte>(s2),
          static_cast<std::byte>(key)};
}

std::vector<std::byte> FakeSekonic::ReplyTo(const std::string& command) {
  const std::string name = command.substr(0, 2);
  if (name == "MN") return BytesOf("MN@@@" + setting_.model + std::string(5, '\0'));
  if (name == "FV") return BytesOf("FV@@@" + setting_.firmware);
  if (name == "ST") return StateReply();
  if (name == "NR") return setting_.measurement;
  if (name == "MI") return BytesOf("MIB@@0," + std::to_string(setting_.memory.size()) + ",3");
  if (name == "MR") {
    auto reply = setting_.memory.at(std::stoul(command.substr(2)));
    reply.at(0) = std::byte{'M'};
    reply.at(1) = std::byte{'R'};
    return reply;
  }
  if (name == "RT") remote_ = command == "RT1";
  if (name == "RM") {
    measuring_ = true;
    busy_left_ = setting_.busy_polls_after;
  }
  return BytesOf(name + "@@@");
}

std::vector<std::byte> RecordedReply(const std::string& name) {
  auto bytes = BytesOf(ReadFile(SampleData("sekonic_replies/" + name)));
  if (bytes.empty()) throw std::runtime_error("no recorded reply " + name);
  return bytes;
}

std::vector<std::byte> WithFloat(std::vector<std::byte> reply, std::size_t at, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned i = 0; i < 4; ++i) {
    reply.at(at + i) = static_cast<std::byte>((bits >> (24U - 8U * i)) & 0xFFU);
  }
  return reply;
}

std::vector<std::byte> WithByte(std::vector<std::byte> reply, std::size_t at, std::byte value) {
  reply.at(at) = value;
  return reply;
}

}  // namespace lightcal::test
