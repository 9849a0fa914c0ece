// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/iio/frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::iio {
namespace {

constexpr std::size_t kLongestNumber = 40;
constexpr double kLargest = 1e15;

}  // namespace

Result<Number> DecodeNumber(std::string_view text, std::string_view attribute) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const std::string_view digits = TrimBlanks(text);
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; };
  const bool decimal = digits.size() <= kLongestNumber && std::ranges::all_of(digits, is_digit);
  const auto value = decimal ? ParseNumber(digits) : std::nullopt;
  if (!value || std::abs(*value) > kLargest) {
    return Failed(std::string(kBadReply), std::string(attribute),
                  "the kernel gave something other than a number; try again, then reload the "
                  "sensor's driver");
  }
  const auto point = digits.find('.');
  const auto decimals = point == std::string_view::npos ? 0 : digits.size() - point - 1;
  return Number{*value, std::pow(10.0, -static_cast<double>(decimals))};
}

std::optional<Number> ValueOf(const Channel& channel) {
  if (channel.input) return channel.input;
  if (!channel.raw) return std::nullopt;
  const double offset = channel.offset ? channel.offset->value : 0.0;
  const double scale = channel.scale ? channel.scale->value : 1.0;
  return Number{(channel.raw->value + offset) * scale, channel.raw->step * std::abs(scale)};
}

}  // namespace lightcal::devices::iio
