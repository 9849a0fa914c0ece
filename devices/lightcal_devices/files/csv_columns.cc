// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/csv_columns.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal::devices::files {
namespace {

struct KnownName {
  std::string_view name;
  CsvQuantity quantity;
  double scale = 1.0;
};
// The spelling to recommend first, then what other programs write.
constexpr std::array kScalarNames = {
    KnownName{"distance_m", CsvQuantity::kDistance},
    KnownName{"distance_cm", CsvQuantity::kDistance, 0.01},
    KnownName{"distance_mm", CsvQuantity::kDistance, 0.001},
    KnownName{"distance_ft", CsvQuantity::kDistance, 0.3048},
    KnownName{"distance_in", CsvQuantity::kDistance, 0.0254},
    KnownName{"illuminance_lx", CsvQuantity::kIlluminance},
    KnownName{"illuminance_klx", CsvQuantity::kIlluminance, 1000.0},
    KnownName{"illuminance_fc", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"card_lx", CsvQuantity::kCard},
    KnownName{"cct_K", CsvQuantity::kCct},
    KnownName{"duv", CsvQuantity::kDuv},
    KnownName{"x", CsvQuantity::kX},
    KnownName{"y", CsvQuantity::kY},
    KnownName{"tilt_deg", CsvQuantity::kTilt},
    KnownName{"off_axis_deg", CsvQuantity::kOffAxis},
    KnownName{"position_x_m", CsvQuantity::kPositionX},
    KnownName{"position_y_m", CsvQuantity::kPositionY},
    KnownName{"position_z_m", CsvQuantity::kPositionZ},
    KnownName{"normal_x", CsvQuantity::kNormalX},
    KnownName{"normal_y", CsvQuantity::kNormalY},
    KnownName{"normal_z", CsvQuantity::kNormalZ},
    KnownName{"sigma_relative", CsvQuantity::kSigma},
    KnownName{"light", CsvQuantity::kLight},
    KnownName{"meter", CsvQuantity::kMeter},
    KnownName{"time", CsvQuantity::kTime},
    KnownName{"lamp", CsvQuantity::kLamp},
    KnownName{"shadow_card", CsvQuantity::kShadowCard},
    KnownName{"wavelength_nm", CsvQuantity::kWavelength},
};
constexpr std::array kOtherNames = {
    KnownName{"position_x_cm", CsvQuantity::kPositionX, 0.01},
    KnownName{"position_y_cm", CsvQuantity::kPositionY, 0.01},
    KnownName{"position_z_cm", CsvQuantity::kPositionZ, 0.01},
    KnownName{"position_x_ft", CsvQuantity::kPositionX, 0.3048},
    KnownName{"position_y_ft", CsvQuantity::kPositionY, 0.3048},
    KnownName{"position_z_ft", CsvQuantity::kPositionZ, 0.3048},
    KnownName{"x_m", CsvQuantity::kPositionX},
    KnownName{"y_m", CsvQuantity::kPositionY},
    KnownName{"z_m", CsvQuantity::kPositionZ},
    KnownName{"lux", CsvQuantity::kIlluminance},
    KnownName{"lx", CsvQuantity::kIlluminance},
    KnownName{"e_lx", CsvQuantity::kIlluminance},
    KnownName{"ev_lx", CsvQuantity::kIlluminance},
    KnownName{"illuminance_lux", CsvQuantity::kIlluminance},
    KnownName{"reading_lux", CsvQuantity::kIlluminance},
    KnownName{"reading_lx", CsvQuantity::kIlluminance},
    KnownName{"reading_fc", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"measured_lux", CsvQuantity::kIlluminance},
    KnownName{"measured_lx", CsvQuantity::kIlluminance},
    KnownName{"measured_fc", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"klux", CsvQuantity::kIlluminance, 1000.0},
    KnownName{"fc", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"footcandles", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"foot_candles", CsvQuantity::kIlluminance, kLuxPerFootcandle},
    KnownName{"cct", CsvQuantity::kCct},
    KnownName{"tcp_k", CsvQuantity::kCct},
    KnownName{"cie_x", CsvQuantity::kX},
    KnownName{"cie_y", CsvQuantity::kY},
    KnownName{"cie1931_x", CsvQuantity::kX},
    KnownName{"cie1931_y", CsvQuantity::kY},
    KnownName{"nm", CsvQuantity::kWavelength},
    KnownName{"lambda_nm", CsvQuantity::kWavelength},
    KnownName{"wavelength_um", CsvQuantity::kWavelength, 1000.0},
    KnownName{"lambda_um", CsvQuantity::kWavelength, 1000.0},
    KnownName{"um", CsvQuantity::kWavelength, 1000.0},
    KnownName{"wavelength_m", CsvQuantity::kWavelength, 1e9},
    KnownName{"wavelength_a", CsvQuantity::kWavelength, 0.1},
    KnownName{"lambda_a", CsvQuantity::kWavelength, 0.1},
    KnownName{"wavelength_angstrom", CsvQuantity::kWavelength, 0.1},
    KnownName{"angstrom", CsvQuantity::kWavelength, 0.1},
    KnownName{"fixture", CsvQuantity::kFixture},
    KnownName{"fixture_name", CsvQuantity::kFixture},
    KnownName{"luminaire", CsvQuantity::kFixture},
    KnownName{"luminaire_name", CsvQuantity::kFixture},
    KnownName{"lamp_name", CsvQuantity::kFixture},
    KnownName{"light_name", CsvQuantity::kFixture},
    KnownName{"date", CsvQuantity::kDate},
    KnownName{"timestamp", CsvQuantity::kTimestamp},
    KnownName{"time_stamp", CsvQuantity::kTimestamp},
    KnownName{"datetime", CsvQuantity::kTimestamp},
    KnownName{"date_time", CsvQuantity::kTimestamp},
    KnownName{"distance", CsvQuantity::kNeedsUnit},
    KnownName{"dist", CsvQuantity::kNeedsUnit},
    KnownName{"d", CsvQuantity::kNeedsUnit},
    KnownName{"r", CsvQuantity::kNeedsUnit},
    KnownName{"illuminance", CsvQuantity::kNeedsUnit},
    KnownName{"e", CsvQuantity::kNeedsUnit},
    KnownName{"ev", CsvQuantity::kNeedsUnit},
    KnownName{"tilt", CsvQuantity::kNeedsUnit},
    KnownName{"angle", CsvQuantity::kNeedsUnit},
    KnownName{"wavelength", CsvQuantity::kNeedsUnit},
    KnownName{"irradiance", CsvQuantity::kNeedsUnit},
    KnownName{"intensity", CsvQuantity::kNeedsUnit},
    KnownName{"power", CsvQuantity::kNeedsUnit},
    KnownName{"value", CsvQuantity::kNeedsUnit},
    KnownName{"spectrum", CsvQuantity::kNeedsUnit},
};

// A spectral irradiance is written as a power, an area and "nm": W_m2_nm, mW/m^2/nm, uW cm-2 nm-1.
constexpr std::array kPowers = {KnownName{"w", CsvQuantity::kIrradiance, 1.0},
                                KnownName{"mw", CsvQuantity::kIrradiance, 1e-3},
                                KnownName{"uw", CsvQuantity::kIrradiance, 1e-6},
                                KnownName{"nw", CsvQuantity::kIrradiance, 1e-9}};
constexpr std::array kAreas = {KnownName{"m2nm", CsvQuantity::kIrradiance, 1.0},
                               KnownName{"m2nm1", CsvQuantity::kIrradiance, 1.0},
                               KnownName{"sqmnm", CsvQuantity::kIrradiance, 1.0},
                               KnownName{"m2um", CsvQuantity::kIrradiance, 1e-3},
                               KnownName{"m2um1", CsvQuantity::kIrradiance, 1e-3},
                               KnownName{"cm2nm", CsvQuantity::kIrradiance, 1e4},
                               KnownName{"cm2nm1", CsvQuantity::kIrradiance, 1e4},
                               KnownName{"sqcmnm", CsvQuantity::kIrradiance, 1e4}};

void ReplaceAll(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

struct Token {
  std::string text;       // lower-case letters and digits
  std::size_t begin = 0;  // in the simplified name
};

// The name with the signs of units spelled in ASCII.
std::string Simplified(std::string_view name) {
  std::string simple(TrimBlanks(name));
  ReplaceAll(simple, "\xC2\xB2", "2");               // superscript two
  ReplaceAll(simple, "\xC2\xB5", "u");               // micro sign
  ReplaceAll(simple, "\xCE\xBC", "u");               // Greek mu
  ReplaceAll(simple, "\xC3\x85", "A");               // A with ring
  ReplaceAll(simple, "\xE2\x84\xAB", "A");           // Angstrom sign
  ReplaceAll(simple, "\xC2\xB7", " ");               // middle dot
  ReplaceAll(simple, "\xE2\x81\xBB\xC2\xB9", "-1");  // superscript minus one
  ReplaceAll(simple, "\xE2\x81\xBB", "-");           // superscript minus
  return simple;
}

std::vector<Token> TokensOf(std::string_view simple) {
  std::vector<Token> tokens;
  bool in_token = false;
  for (std::size_t i = 0; i < simple.size(); ++i) {
    const auto c = static_cast<unsigned char>(simple[i]);
    const bool part =
        (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c >= 0x80;
    if (part && !in_token) tokens.push_back({"", i});
    if (part) tokens.back().text += LowerAscii(simple.substr(i, 1));
    in_token = part;
  }
  return tokens;
}

template <class Table>
const KnownName* Lookup(const Table& table, std::string_view name) {
  const auto known = std::ranges::find_if(
      table, [&](const KnownName& candidate) { return LowerAscii(candidate.name) == name; });
  return known == table.end() ? nullptr : &*known;
}

// What every table of lamps holds, as other languages' software names it.
struct ForeignWord {
  std::string_view word, name;
};
constexpr std::array kForeignWords = {
    ForeignWord{"abstand", "distance"},
    ForeignWord{"entfernung", "distance"},
    ForeignWord{"distanz", "distance"},
    ForeignWord{"distancia", "distance"},
    ForeignWord{"distanza", "distance"},
    ForeignWord{"\xE8\xB7\x9D\xE9\x9B\xA2", "distance"},  // kyori
    ForeignWord{"beleuchtungsst\xC3\xA4rke", "illuminance"},
    ForeignWord{"beleuchtungsstaerke", "illuminance"},
    ForeignWord{"\xC3\xA9"
                "clairement",
                "illuminance"},
    ForeignWord{"\xC3\x89"
                "clairement",
                "illuminance"},
    ForeignWord{"eclairement", "illuminance"},
    ForeignWord{"iluminancia", "illuminance"},
    ForeignWord{"illuminamento", "illuminance"},
    ForeignWord{"\xE7\x85\xA7\xE5\xBA\xA6", "illuminance"},  // shodo
    ForeignWord{"leuchte", "fixture"},
    ForeignWord{"lampe", "fixture"},
    ForeignWord{"scheinwerfer", "fixture"},
    ForeignWord{"projecteur", "fixture"},
    ForeignWord{"luminaria", "fixture"},
    ForeignWord{"l\xC3\xA1mpara", "fixture"},
    ForeignWord{"lampada", "fixture"},
    ForeignWord{"\xE7\x81\xAF\xE5\x85\xB7", "fixture"},  // togu
    ForeignWord{"datum", "date"},
    ForeignWord{"uhrzeit", "time"},
    ForeignWord{"zeit", "time"},
};
std::string InEnglish(const Token& token) {
  const auto known = std::ranges::find(kForeignWords, token.text, &ForeignWord::word);
  return known == kForeignWords.end() ? token.text : std::string(known->name);
}

std::string SeriesName(std::string_view before_unit) {
  std::string series(before_unit);
  const std::string lower = LowerAscii(series);
  const std::size_t word = lower.rfind("irradiance");
  if (word != std::string::npos) series.resize(word);
  const auto last = series.find_last_not_of(" _-:,;/([");
  series.resize(last == std::string::npos ? 0 : last + 1);
  return series;
}

// u_irradiance_W_m2_nm, irradiance_sd_mW_m2_nm: how sure the spectrum beside it is, and none
// itself.
bool IsUncertainty(const std::vector<Token>& before_unit) {
  constexpr std::array<std::string_view, 9> kWords = {
      "u", "u95", "sigma", "sd", "std", "stdev", "uncertainty", "error", "stderr"};
  return std::ranges::any_of(before_unit, [&](const Token& token) {
    return std::ranges::find(kWords, token.text) != kWords.end();
  });
}

std::optional<CsvColumn> SpectralColumn(const std::string& simple,
                                        const std::vector<Token>& tokens) {
  if (!tokens.empty() && tokens.back().text == "relative") {
    return CsvColumn{CsvQuantity::kRelative, 1.0, simple,
                     SeriesName(std::string_view(simple).substr(0, tokens.back().begin))};
  }
  std::string area;
  for (std::size_t i = tokens.size(); i-- > 0;) {
    const KnownName* power = Lookup(kPowers, tokens[i].text);
    const KnownName* known_area = Lookup(kAreas, area);
    if (power != nullptr && known_area != nullptr) {
      if (IsUncertainty({tokens.begin(), tokens.begin() + static_cast<std::ptrdiff_t>(i)})) {
        return CsvColumn{CsvQuantity::kLeftOut, 1.0, simple, ""};
      }
      return CsvColumn{CsvQuantity::kIrradiance, power->scale * known_area->scale, simple,
                       SeriesName(std::string_view(simple).substr(0, tokens[i].begin))};
    }
    area.insert(0, tokens[i].text);
  }
  return std::nullopt;
}

// dimmer, "Level (%)", intensity_percent: what the lamp was dimmed to.
std::optional<CsvColumn> DimmerColumn(const std::string& simple, std::vector<Token> tokens) {
  constexpr std::array<std::string_view, 5> kWords = {"dimmer", "dim", "level", "intensity",
                                                      "brightness"};
  if (tokens.empty()) return std::nullopt;
  bool percent = simple.find('%') != std::string::npos;
  if (tokens.size() > 1 && (tokens.back().text == "percent" || tokens.back().text == "pct")) {
    percent = true;
    tokens.pop_back();
  }
  const std::string& word = tokens.front().text;
  if (tokens.size() != 1 || std::ranges::find(kWords, word) == kWords.end()) return std::nullopt;
  if (percent) return CsvColumn{CsvQuantity::kState, 1.0, simple, std::string(kDimmerControl)};
  if (word != kDimmerControl) return std::nullopt;
  return CsvColumn{CsvQuantity::kDimmerUnsaid, 1.0, simple, std::string(kDimmerControl)};
}

}  // namespace

CsvColumn ColumnFromName(std::string_view name) {
  const std::string simple = Simplified(name);
  const std::vector<Token> tokens = TokensOf(simple);
  if (auto spectral = SpectralColumn(simple, tokens)) {
    spectral->written = name;
    return *spectral;
  }
  constexpr std::string_view kState = "state.";
  if (simple.size() > kState.size() && LowerAscii(simple).starts_with(kState)) {
    return {CsvQuantity::kState, 1.0, std::string(name), simple.substr(kState.size())};
  }
  if (auto dimmer = DimmerColumn(simple, tokens)) {
    dimmer->written = name;
    return *dimmer;
  }
  const std::string joined = Joined(tokens, "_", InEnglish);
  const KnownName* known = Lookup(kScalarNames, joined);
  if (known == nullptr) known = Lookup(kOtherNames, joined);
  if (known == nullptr) return {CsvQuantity::kUnknown, 1.0, std::string(name), ""};
  return {known->quantity, known->scale, std::string(name), ""};
}

std::string KnownColumnNames() {
  return Joined(kScalarNames, ", ", &KnownName::name) +
         " with irradiance_W_m2_nm, irradiance_mW_m2_nm, irradiance_uW_cm2_nm or relative; "
         "state.dimmer, state.cct_K and the like of a fixture's controls";
}

std::string NearestColumnName(std::string_view name) {
  std::vector<std::string_view> names;
  names.reserve(kScalarNames.size() + 3);
  for (const KnownName& known : kScalarNames) names.push_back(known.name);
  names.insert(names.end(), {"irradiance_W_m2_nm", "irradiance_mW_m2_nm", "relative"});
  return NearestWord(name, names);
}

}  // namespace lightcal::devices::files
