// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/gossen/frame.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/transport/framing.h"
#include "lightcal_devices/transport/tape.h"

namespace lightcal::devices::gossen {
namespace {

constexpr std::string_view kDigits = "0123456789";
constexpr std::size_t kMostMantissaDigits = 5;
constexpr int kLargestExponent = 9;

tl::unexpected<Error> BadReply(std::string_view line, const std::string& what) {
  return Failed(std::string(kBadReply), "Gossen meter",
                "the reply \"" + EscapedBytes(AsBytes(line)) + "\" " + what);
}

// Takes digits from the front of `text`.
std::string_view TakeDigits(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_not_of(kDigits), text.size());
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

int IntegerFrom(std::string_view digits) {
  int number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

// Takes "E-01", "E00", "E +02", blanks anywhere before its digits.
std::optional<int> TakeExponent(std::string_view& text) {
  text = TrimBlanks(text);
  if (!text.starts_with('E')) return std::nullopt;
  text = TrimBlanks(text.substr(1));
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text = TrimBlanks(text.substr(1));
  const std::string_view digits = TakeDigits(text);
  if (digits.empty() || digits.size() > 2) return std::nullopt;
  const int exponent = IntegerFrom(digits);
  if (exponent > kLargestExponent) return std::nullopt;
  return negative ? -exponent : exponent;
}

}  // namespace

std::optional<int> DecodeError(std::string_view line) {
  line = TrimBlanks(line);
  if (!line.starts_with("ERROR")) return std::nullopt;
  const auto digit = line.find_first_of(kDigits);
  if (digit == std::string_view::npos) return 0;
  line.remove_prefix(digit);
  return IntegerFrom(TakeDigits(line).substr(0, 4));
}

Error ErrorOf(int number, const std::string& device) {
  const auto error = [&](const char* code, const std::string& message) {
    return Error{ErrorKind::kFailed, code, device,
                 "error " + std::to_string(number) + ": " + message};
  };
  switch (number) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 8:
      return error("serial_error", "bytes were lost or damaged on the way; check the cable");
    case 19:
    case 203:
      return error("over_range", "the light is above the meter's range");
    case 202:
      return error("wrong_head", "the sensor does not fit the unit; attach the photometric head");
    case 17:
    case 18:
    case 21:
    case 22:
    case 201:
      return error("hardware_error",
                   "the meter reports a fault; switch it off and on, then have it serviced");
    default:
      return error("refused_command",
                   "the meter refused the command; is it a MAVOLUX 5032 B or C USB? (MAVOPROBE and "
                   "MAVOMASTER speak otherwise)");
  }
}

Result<Identity> DecodeIdentity(std::string_view line) {
  std::string_view rest = TrimBlanks(line);
  if (rest.starts_with("*IDN")) rest.remove_prefix(std::min(rest.find(' '), rest.size()));
  std::vector<std::string> fields;
  while (true) {
    const auto comma = rest.find(',');
    fields.emplace_back(TrimBlanks(rest.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  if (fields.size() != 5 || fields[0] != "GOSSEN") {
    return BadReply(line, "is not how a Gossen meter names itself");
  }
  return Identity{fields[1], fields[2], fields[4]};
}

Result<DisplayedIlluminance> DecodeMeasurement(std::string_view line) {
  std::string_view rest = line;
  rest.remove_prefix(std::min(rest.find_first_of(kDigits), rest.size()));
  const std::string_view before = line.substr(0, line.size() - rest.size());
  const std::string_view mantissa = TakeDigits(rest);
  const auto exponent = TakeExponent(rest);
  const std::string_view unit = TrimBlanks(rest);
  if (mantissa.empty() || mantissa.size() > kMostMantissaDigits || !exponent) {
    return BadReply(line, "holds no number such as 1234E-01");
  }
  if (before.ends_with('-')) return BadReply(line, "is a negative illuminance");
  if (unit == "CD_M2" || unit == "FL") {
    return Failed("luminance_head", "Gossen meter",
                  "the meter measures luminance (" + std::string(unit) +
                      "); take off the luminance attachment and set it to lx or fc");
  }
  if (unit != "LX" && unit != "FC") return BadReply(line, "has no unit we know: LX or FC");
  return DisplayedIlluminance{IntegerFrom(mantissa), -*exponent, unit == "FC"};
}

}  // namespace lightcal::devices::gossen
