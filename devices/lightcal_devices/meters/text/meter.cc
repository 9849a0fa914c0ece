// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/text/meter.h"

#include <algorithm>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/meters/frame_search.h"
#include "lightcal_devices/transport/framing.h"

namespace lightcal::devices::text {
namespace {

struct NamedQuality {
  std::string_view name;
  MeterQuality quality;
};
constexpr std::array<NamedQuality, 4> kQualities = {{{"photometer", MeterQuality::kPhotometer},
                                                     {"colorimeter", MeterQuality::kColorimeter},
                                                     {"spectral", MeterQuality::kSpectral},
                                                     {"bare_sensor", MeterQuality::kBareSensor}}};

// "5%" or "0.05"; absent where it is neither, or not between 0 and 1.
std::optional<double> ParseSigma(std::string_view text) {
  const bool per_cent = text.ends_with('%');
  if (per_cent) text.remove_suffix(1);
  const auto number = ParseNumber(text);
  if (!number) return std::nullopt;
  const double sigma = per_cent ? *number / 100.0 : *number;
  if (sigma <= 0.0 || sigma >= 1.0) return std::nullopt;
  return sigma;
}

}  // namespace

TextMeter::TextMeter(Transport& transport, const MeterSetup& setup, TextKind kind)
    : transport_(transport), setup_(setup), kind_(std::move(kind)) {}

std::string TextMeter::DeviceName() const {
  if (kind_.driver == "typed") return "";  // by hand
  return kind_.driver + ":" + (setup_.serial.empty() ? "text" : setup_.serial);
}

Result<MeterIdentity> TextMeter::Identify() {
  if (const auto given = setup_.options.find("sigma"); given != setup_.options.end()) {
    kind_.sigma = ParseSigma(given->second);
    if (!kind_.sigma) {
      return WrongUsage("{meter.option} sigma=" + given->second,
                        "give more than 0 and less than 1, or 5%");
    }
  }
  if (const auto given = setup_.options.find("quality"); given != setup_.options.end()) {
    const auto* known = std::ranges::find(kQualities, given->second, &NamedQuality::name);
    if (known == kQualities.end()) {
      return WrongUsage("{meter.option} quality=" + given->second,
                        "give photometer, colorimeter, spectral or bare_sensor");
    }
    kind_.quality = known->quality;
  }
  return MeterIdentity{"text", "", {}};
}

Result<TextReading> TextMeter::NextReading(const Cancellation& cancellation, int& bad_lines) {
  Error last;
  for (int lines = 0; lines < kMostLines; ++lines) {
    if (cancellation.Requested()) return Interrupted(DeviceName());
    const auto bytes = transport_.Read(kLongestLineBytes, setup_.timing.reply);
    if (!bytes && cancellation.Requested()) return Interrupted(DeviceName());
    if (!bytes) {
      Error error = bytes.error();
      if (bad_lines > 0) error.message += "; it printed " + last.subject + ": " + last.message;
      return tl::unexpected(std::move(error));
    }
    std::string line;
    for (const std::byte byte : *bytes) line.push_back(static_cast<char>(byte));
    auto reading = DecodeLine(line);
    if (reading && *reading) return **reading;
    if (reading) continue;
    last = reading.error();
    if (++bad_lines > kind_.most_bad_lines) return tl::unexpected(std::move(last));
  }
  return Failed(std::string(kBadReply), transport_.Name(),
                "no reading in " + std::to_string(kMostLines) + " lines, only comments");
}

Result<MeterReading> TextMeter::Measure(const Cancellation& cancellation) {
  int bad_lines = 0;
  const auto text = NextReading(cancellation, bad_lines);
  if (!text) return tl::unexpected(text.error());
  MeterReading result;
  Reading& reading = result.reading;
  reading.device = DeviceName();
  reading.quality = kind_.quality;
  reading.sigma_relative = kind_.sigma;
  reading.illuminance = text->illuminance;
  reading.cct = text->cct;
  reading.over_range = text->over_range;
  reading.under_range = text->under_range;
  if (bad_lines > 0) {
    result.warnings.push_back({"bad_lines", transport_.Name(),
                               std::to_string(bad_lines) +
                                   " lines before the reading were no illuminance and were "
                                   "skipped"});
  }
  return result;
}

std::unique_ptr<Meter> MakeLine(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<TextMeter>(
      transport, setup,
      TextKind{"line", kUndeclaredSigma, MeterQuality::kBareSensor, kMostBadLines});
}

std::unique_ptr<Meter> MakeTyped(Transport& transport, const MeterSetup& setup) {
  return std::make_unique<TextMeter>(transport, setup,
                                     TextKind{"typed", std::nullopt, MeterQuality::kUnknown, 0});
}

}  // namespace lightcal::devices::text
