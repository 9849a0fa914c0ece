// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/konica/frame.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices::konica {
namespace {

constexpr char kStx = '\x02';
constexpr char kEtx = '\x03';
constexpr std::size_t kStatusAt = 5;
constexpr std::size_t kDataAt = 9;
constexpr std::size_t kNumberBytes = 6;
// ETX, BCC and the end of line.
constexpr std::size_t kTailBytes = 5;

tl::unexpected<Error> BadReply(std::span<const std::byte> bytes, const std::string& what) {
  return Failed(std::string(kBadReply), "Konica Minolta meter",
                "the reply " + EscapedBytes(bytes) + " " + what);
}

// Two decimal digits.
std::string TwoDigits(int number) {
  return {static_cast<char>('0' + number / 10 % 10), static_cast<char>('0' + number % 10)};
}

std::string CheckCharacters(std::string_view from_head_to_etx) {
  unsigned char sum = 0;
  for (const char c : from_head_to_etx) sum ^= static_cast<unsigned char>(c);
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  return {kDigits[sum >> 4U], kDigits[sum & 0x0fU]};
}

std::string Text(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte byte : bytes) text.push_back(static_cast<char>(byte));
  return text;
}

// Length, frame and checksum; then whether it answers this head and command.
Result<std::string> CheckedText(std::span<const std::byte> bytes, std::size_t length, int head,
                                int command) {
  if (bytes.size() != length) {
    return BadReply(
        bytes, "has " + std::to_string(bytes.size()) + " bytes, not " + std::to_string(length));
  }
  std::string text = Text(bytes);
  const std::size_t etx_at = length - kTailBytes;
  if (text.front() != kStx || text[etx_at] != kEtx || !text.ends_with("\r\n")) {
    return BadReply(bytes, "is not framed by STX, ETX and the end of line");
  }
  std::string sum = text.substr(etx_at + 1, 2);
  std::ranges::transform(sum, sum.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const std::string expected = CheckCharacters(std::string_view(text).substr(1, etx_at));
  if (sum != expected) {
    return BadReply(bytes, "has the check characters " + sum + ", its bytes give " + expected);
  }
  const std::string address = TwoDigits(head) + TwoDigits(command);
  if (text.compare(1, address.size(), address) != 0) {
    return BadReply(bytes,
                    "does not answer head " + TwoDigits(head) + ", command " + TwoDigits(command));
  }
  return text;
}

std::optional<Condition> ConditionOf(char s1) {
  switch (s1) {
    case ' ':
      return Condition::kOk;
    case '1':
      return Condition::kHeadPowerOff;
    case '2':
    case '3':
      return Condition::kMemoryError;
    case '4':
      return Condition::kExtRefused;
    case '5':
      return Condition::kOverRange;
    case '6':
      return Condition::kLowLuminance;
    case '7':
      return Condition::kCctOutOfRange;
    default:
      return std::nullopt;
  }
}

// Six characters. False where they are neither blank nor a number.
bool ParseField(std::string_view text, std::optional<Number>& number) {
  number.reset();
  if (text.find_first_not_of(' ') == std::string_view::npos) return true;
  const char sign = text.front();
  const char exponent = text.back();
  std::string_view digits = text.substr(1, 4);
  digits.remove_prefix(std::min(digits.find_first_not_of(' '), digits.size()));
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (digits.empty() || !std::ranges::all_of(digits, is_digit) || !is_digit(exponent) ||
      std::string_view("+-=").find(sign) == std::string_view::npos) {
    return false;
  }
  int n = 0;
  for (const char digit : digits) n = 10 * n + (digit - '0');
  number = Number{sign == '-' ? -n : n, 4 - (exponent - '0')};
  return true;
}

}  // namespace

double Number::Value() const {
  const double scale = std::pow(10.0, std::abs(decimals));  // exact, at most 10^5
  return decimals > 0 ? n / scale : n * scale;
}

std::string EncodeCommand(int head, int command, std::string_view parameters) {
  const std::string body = TwoDigits(head) + TwoDigits(command) + std::string(parameters) + kEtx;
  return kStx + body + CheckCharacters(body) + "\r\n";
}

Result<Condition> DecodeShortReply(std::span<const std::byte> bytes, int head, int command) {
  const auto text = CheckedText(bytes, kShortReplyBytes, head, command);
  if (!text) return tl::unexpected(text.error());
  const auto condition = ConditionOf((*text)[kStatusAt + 1]);
  if (!condition) return BadReply(bytes, "has an unknown status");
  return *condition;
}

Result<LongReply> DecodeLongReply(std::span<const std::byte> bytes, int head, int command) {
  const auto text = CheckedText(bytes, kLongReplyBytes, head, command);
  if (!text) return tl::unexpected(text.error());
  const auto condition = ConditionOf((*text)[kStatusAt + 1]);
  const char battery = (*text)[kStatusAt + 3];
  if (!condition || battery < '0' || battery > '3') {
    return BadReply(bytes, "has an unknown status");
  }
  LongReply reply;
  reply.status = {*condition, battery == '1' || battery == '3'};
  for (std::size_t i = 0; i < reply.data.size(); ++i) {
    const auto field = std::string_view(*text).substr(kDataAt + kNumberBytes * i, kNumberBytes);
    if (!ParseField(field, reply.data[i])) {
      return BadReply(bytes,
                      "holds something else where number " + std::to_string(i + 1) + " should be");
    }
  }
  return reply;
}

}  // namespace lightcal::devices::konica
