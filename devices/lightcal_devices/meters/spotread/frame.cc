// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/spotread/frame.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal::devices::spotread {
namespace {

constexpr double kWattsPerMilliwatt = 1e-3;
constexpr double kBrightestLx = 1e7;  // a hundred suns
constexpr int kFewestSamples = 2;
constexpr int kMostSamples = 10000;
constexpr std::size_t kLongestQuote = 160;
constexpr std::size_t kLongestInstructions = 400;
constexpr int kRenderingIndices = 14;

tl::unexpected<Error> BadReply(std::string what) {
  return Failed(std::string(kBadReply), "spotread",
                std::move(what) + "; try again, and keep a tape ({meter.tape}) to report it");
}

bool Contains(std::string_view text, std::string_view piece) {
  return text.find(piece) != std::string_view::npos;
}

// The next line of `rest`, which loses it.
std::string_view TakeLine(std::string_view& rest) {
  const auto end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return line;
}

// The number a text begins with, blanks before it allowed; `text` loses it. Absent: none, or not
// finite.
std::optional<double> TakeNumber(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

// The number behind a label.
std::optional<double> NumberAfter(std::string_view line, std::string_view label) {
  const auto at = line.find(label);
  if (at == std::string_view::npos) return std::nullopt;
  line.remove_prefix(at + label.size());
  return TakeNumber(line);
}

// Printable characters behind a label, at most a quote of them.
std::string TextAfter(std::string_view line, std::string_view label) {
  const auto at = line.find(label);
  std::string text(at == std::string_view::npos ? "" : line.substr(at + label.size()));
  std::erase_if(text, [](char c) { return c < ' ' || c > '~'; });
  return std::string(TrimBlanks(text)).substr(0, kLongestQuote);
}

Result<void> TakeIlluminance(std::optional<double> lux, Report& report) {
  if (!lux || *lux < 0.0 || *lux > kBrightestLx) {
    return BadReply("printed a result that is no number of lux");
  }
  report.illuminance_lx = lux;
  return {};
}

// " Result is XYZ: %f %f %f, Yxy: ..." or " Result is Y: %f, L*: %f".
Result<void> TakeResult(std::string_view line, Report& report) {
  constexpr std::string_view kThree = "Result is XYZ:";
  constexpr std::string_view kOne = "Result is Y:";
  if (const auto at = line.find(kThree); at != std::string_view::npos) {
    std::string_view rest = line.substr(at + kThree.size());
    const auto x = TakeNumber(rest);
    const auto y = TakeNumber(rest);
    const auto z = TakeNumber(rest);
    if (!x || !z) return BadReply("printed a result that is no colour");
    if (auto taken = TakeIlluminance(y, report); !taken) return taken;
    report.xyz = Xyz{*x, *y, *z};
    return {};
  }
  if (Contains(line, kOne)) return TakeIlluminance(NumberAfter(line, kOne), report);
  return {};
}

// "Spectrum from %.3f to %.3f nm in %d steps", then one line of numbers between commas.
Result<void> TakeSpectrum(std::string_view line, std::string_view& rest, Report& report) {
  constexpr std::string_view kLabel = "Spectrum from";
  const auto label_at = line.find(kLabel);
  if (label_at == std::string_view::npos) return {};
  line.remove_prefix(label_at);  // the prompt before it has no newline
  const auto from = NumberAfter(line, kLabel);
  const auto to = NumberAfter(line, " to ");
  const auto steps = NumberAfter(line, " in ");
  const bool sane = from && to && steps && *from > 0.0 && *to > *from && *to < 1e5 &&
                    *steps >= kFewestSamples && *steps <= kMostSamples &&
                    *steps == std::floor(*steps);
  if (!sane) return BadReply("printed a spectrum without a range of wavelengths");
  Spectrum spectrum;
  spectrum.quantity = SpectralQuantity::kIrradiance;
  std::string_view values = TakeLine(rest);
  const int count = static_cast<int>(*steps);
  for (int i = 0; i < count; ++i) {
    const auto value = TakeNumber(values);
    const bool followed = i + 1 == count ? TrimBlanks(values).empty() : values.starts_with(',');
    if (!value || !followed) {
      return BadReply("printed a spectrum that does not have its " + std::to_string(count) +
                      " samples");
    }
    values.remove_prefix(values.empty() ? 0 : 1);
    spectrum.wavelengths_nm.push_back(*from + (*to - *from) * i / (count - 1));
    spectrum.values.push_back(*value * kWattsPerMilliwatt);
  }
  report.spectrum = std::move(spectrum);
  return {};
}

void TakeColorTemperature(std::string_view line, Report& report) {
  if (!Contains(line, "Ambient =")) return;
  report.cct_K = NumberAfter(line, "CCT =");
  report.duv = NumberAfter(line, "(Duv");
  if (!report.cct_K || *report.cct_K <= 0.0) report.cct_K.reset();
}

// "  R1  = 98.1  R2  = 97.3 ..." over two lines.
void TakeIndices(std::string_view line, std::vector<double>& indices) {
  if (!TrimBlanks(line).starts_with("R")) return;
  for (;;) {
    const auto next = static_cast<int>(indices.size()) + 1;
    std::string label = "R" + std::to_string(next);
    if (next <= 9) label += " ";
    const auto value = NumberAfter(line, label + " =");
    if (!value || next > kRenderingIndices) return;
    indices.push_back(*value);
  }
}

void TakeRendering(std::string_view line, Report& report) {
  if (Contains(line, "Color Rendering Index (Ra)")) {
    report.cri_Ra = NumberAfter(line, "(Ra) =");
  } else if (Contains(line, "Television Lighting Consistency Index")) {
    report.tlci_Qa = NumberAfter(line, "(Qa) =");
  } else if (Contains(line, "IES TM-30")) {
    report.tm30_Rf = NumberAfter(line, "Rf =");
    report.tm30_Rg = NumberAfter(line, "Rg =");
  } else {
    TakeIndices(line, report.cri_R);
    return;
  }
  report.rendering_doubtful = report.rendering_doubtful || Contains(line, "(Caution)");
}

void TakeIdentity(std::string_view line, Report& report) {
  for (const std::string_view label : {"Instrument Type:", "Product Name:"}) {
    if (const std::string name = TextAfter(line, label); !name.empty()) report.instrument = name;
  }
  for (const std::string_view label : {"Serial Number:", "Serial No:"}) {
    if (const std::string serial = TextAfter(line, label); !serial.empty()) report.serial = serial;
  }
}

struct Phrase {
  std::string_view text;
  Ending ending;
};
// The first that is found tells why; the more particular stand before the more general.
constexpr std::array<Phrase, 17> kPhrases = {{
    {"Requested ambient light capability", Ending::kNoAmbient},
    {"Need spectral information", Ending::kNoSpectrum},
    {"didn't return spectral data", Ending::kNoSpectrum},
    {"sensor being in the wrong position", Ending::kWrongPosition},
    {"Got bad cct", Ending::kTooDark},
    {"Got bad vct", Ending::kTooDark},
    {"saturat", Ending::kSaturated},
    {"Saturat", Ending::kSaturated},
    {"failed due to misread", Ending::kMisread},
    {"failed due to communication problem", Ending::kCommunication},
    {"No instrument at port", Ending::kNoInstrument},
    {"no instrument detected", Ending::kNoInstrument},
    {"Failed to initialise communications", Ending::kNoConnection},
    {"Instrument initialisation failed", Ending::kNoConnection},
    {"Got fatal error", Ending::kFatal},
    {"Colorimeter Cal", Ending::kBadOption},
    {"Reading CCMX/CCSS File", Ending::kBadOption},
}};

}  // namespace

Result<Report> DecodeReport(std::string_view text) {
  Report report;
  while (!text.empty()) {
    const std::string_view line = TakeLine(text);
    if (auto taken = TakeResult(line, report); !taken) return tl::unexpected(taken.error());
    if (auto taken = TakeSpectrum(line, text, report); !taken) return tl::unexpected(taken.error());
    TakeColorTemperature(line, report);
    TakeRendering(line, report);
    TakeIdentity(line, report);
  }
  if (report.cri_R.size() != kRenderingIndices) report.cri_R.clear();
  return report;
}

Situation NextSituation(std::string_view text, std::size_t& from) {
  struct Prompt {
    std::string_view text;
    Situation situation;
  };
  constexpr std::array<Prompt, 3> kPrompts = {{
      {"any other key to retry:", Situation::kAsksToRetry},
      {"Hit any key to retry, or Esc or Q to abort:", Situation::kAsksToRetry},
      {"sensor being in the wrong position", Situation::kWrongPosition},
  }};
  std::size_t first = std::string_view::npos;
  Situation found = Situation::kNone;
  std::size_t behind = from;
  for (const Prompt& prompt : kPrompts) {
    const auto at = text.find(prompt.text, from);
    if (at >= first) continue;
    first = at;
    found = prompt.situation;
    behind = at + prompt.text.size();
  }
  from = behind;
  return found;
}

std::string CalibrationInstructions(std::string_view text) {
  constexpr std::array<std::string_view, 10> kOrders = {
      "Place the instrument", "Place cap",
      "Place ambient",        "or place on",
      "Set instrument",       "Do a ",
      "Click the instr",      "Change filter",
      "Use the app",          "Place instrument on its"};
  std::string instructions;
  while (!text.empty()) {
    const std::string_view line = TakeLine(text);
    const bool is_order = std::ranges::any_of(
        kOrders, [&](std::string_view order) { return TrimBlanks(line).starts_with(order); });
    if (!is_order) continue;
    std::string order = TextAfter(line, "");
    while (order.ends_with(',')) order.pop_back();
    if (Contains(instructions, order)) continue;  // it asks for the same again
    if (instructions.size() + order.size() > kLongestInstructions) break;
    instructions += (instructions.empty() ? "" : ", ") + order;
  }
  return instructions;
}

Ending EndingOf(std::string_view text) {
  for (const Phrase& phrase : kPhrases) {
    if (Contains(text, phrase.text)) return phrase.ending;
  }
  const bool calibrates = Contains(text, "Calibration complete") ||
                          Contains(text, "needs a calibration before continuing") ||
                          Contains(text, "instruments needs calibration");
  if (!calibrates) return Ending::kUnknown;
  return CalibrationInstructions(text).empty() ? Ending::kCalibrated : Ending::kPlacedToCalibrate;
}

std::string TellingLine(std::string_view text, Ending ending) {
  std::string last;
  while (!text.empty()) {
    const std::string line = TextAfter(TakeLine(text), "");
    const bool tells = std::ranges::any_of(kPhrases, [&](const Phrase& phrase) {
      return phrase.ending == ending && Contains(line, phrase.text);
    });
    if (tells) return line;
    if (!line.empty()) last = line;
  }
  return last;
}

std::optional<std::string> VersionIn(std::string_view usage) {
  constexpr std::string_view kLabel = "Version ";
  const auto at = usage.find(kLabel);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = usage.substr(at + kLabel.size());
  const auto end = std::min(rest.find_first_not_of("0123456789."), std::size_t{16});
  const std::string_view version = rest.substr(0, end);
  if (version.empty()) return std::nullopt;
  return std::string(version);
}

}  // namespace lightcal::devices::spotread
