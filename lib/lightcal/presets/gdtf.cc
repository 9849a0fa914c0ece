// SPDX-License-Identifier: Apache-2.0
// <stem>-<light>.gdtf of each lamp with an intensity: flux, angles and colour temperature of its
// beam; of a lamp that was read at states of its controls what each gives, and its dimmer's curve.
// GDTF holds no uncertainty; <stem>.preset.json does.
#include "lightcal/records/gdtf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "lightcal/core/crc32.h"
#include "lightcal/core/file_name.h"
#include "lightcal/core/generator_name.h"
#include "lightcal/core/interval_text.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/light_distribution.h"
#include "lightcal/presets/stored_zip.h"
#include "lightcal/records/stated_beam.h"

namespace lightcal {
namespace {

constexpr double kHalfPeak = 0.5, kTenthPeak = 0.1;
constexpr double kRoughProfile = 0.1;  // of the light read there
constexpr std::string_view kBeamName = "Beam";
constexpr std::string_view kDimmerProfile = "Dimmer measured";

// An identifier made of what it identifies, in the form of RFC 9562 version 8.
std::string IdOf(const std::string& text) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string hex;
  for (const char* salt : {"a", "b", "c", "d"}) {
    const std::uint32_t word = Crc32(text + salt + text);
    for (int i = 28; i >= 0; i -= 4) hex += kHex[(word >> static_cast<unsigned>(i)) & 0xFU];
  }
  hex[12] = '8';
  hex[16] = 'A';
  return hex.substr(0, 8) + "-" + hex.substr(8, 4) + "-" + hex.substr(12, 4) + "-" +
         hex.substr(16, 4) + "-" + hex.substr(20);
}

// One point of the dimmer's curve at the other controls of the reference.
struct DimmerPoint {
  double percent = 0.0;
  double of_full = 0.0;
};

bool OthersAsReference(const MeasuredState& state, const FixtureState& reference) {
  return std::ranges::all_of(state.state, [&](const ControlValue& control) {
    if (control.name == kDimmerControl) return true;
    const ControlValue* there = FindControl(reference, control.name);
    return there != nullptr && SameState({control}, {*there});
  });
}

std::vector<DimmerPoint> DimmerPoints(const FittedLight& lamp) {
  std::vector<DimmerPoint> points;
  if (lamp.states.empty()) return points;
  for (const MeasuredState& one : lamp.states) {
    const auto dimmer = NumberOfControl(one.state, kDimmerControl);
    if (!dimmer || !OthersAsReference(one, lamp.states.front().state)) continue;
    points.push_back({*dimmer, one.relative.value});
  }
  std::ranges::sort(points, {}, &DimmerPoint::percent);
  if (points.size() < 2) return {};
  const double full = points.back().of_full;
  for (DimmerPoint& point : points) point.of_full /= full;
  return points;
}

// The cubic sum_k c_k x^k, x the percent over 100, nearest to the points (least squares) of those
// that are nowhere negative and never fall: Bernstein coefficients that begin at 0 or above and do
// not fall (Farouki, "The Bernstein polynomial basis: a centennial retrospective", Computer Aided
// Geometric Design 29 (2012)). The brightest point, which is full, counts as a thousand; of few
// points a lower degree. At 0 it is dark, unless a lamp was measured there.
std::array<double, 4> RisingCubicNear(const std::vector<DimmerPoint>& points) {
  const bool dark_at_0 = points.front().percent > 0.0;
  const std::size_t degree = std::min<std::size_t>(3, points.size() - (dark_at_0 ? 0 : 1));
  constexpr std::array<std::array<double, 4>, 4> kBinomial = {
      {{1.0, 0.0, 0.0, 0.0}, {1.0, 1.0, 0.0, 0.0}, {1.0, 2.0, 1.0, 0.0}, {1.0, 3.0, 3.0, 1.0}}};
  // By its steps from one coefficient to the next: step j raises all from j on.
  std::array<std::array<double, 4>, 4> gram{};
  std::array<double, 4> product{};
  for (const DimmerPoint& point : points) {
    const double x = point.percent / 100.0;
    const double weight = &point == &points.back() ? 1000.0 : 1.0;
    std::array<double, 4> raised{};
    for (std::size_t k = degree + 1; k-- > 0;) {
      raised[k] = kBinomial[degree][k] * std::pow(x, static_cast<double>(k)) *
                  std::pow(1.0 - x, static_cast<double>(degree - k));
      if (k < degree) raised[k] += raised[k + 1];
    }
    for (std::size_t i = 0; i <= degree; ++i) {
      for (std::size_t j = 0; j <= degree; ++j) gram[i][j] += weight * raised[i] * raised[j];
      product[i] += weight * raised[i] * point.of_full;
    }
  }
  std::array<double, 4> steps{};
  for (int round = 0; round < 20000; ++round) {  // one after the other; of four it soon stands
    for (std::size_t i = dark_at_0 ? 1 : 0; i <= degree; ++i) {
      double pull = product[i];
      for (std::size_t j = 0; j <= degree; ++j) pull -= gram[i][j] * steps[j];
      if (gram[i][i] > 0.0) steps[i] = std::max(0.0, steps[i] + pull / gram[i][i]);
    }
  }
  std::array<double, 4> out{};
  double coefficient = 0.0;
  for (std::size_t k = 0; k <= degree; ++k) {
    coefficient += steps[k];
    for (std::size_t i = k; i <= degree; ++i) {
      const double sign = (i - k) % 2 == 0 ? 1.0 : -1.0;
      out[i] += sign * kBinomial[degree][i] * kBinomial[i][k] * coefficient;
    }
  }
  return out;
}

// One cubic: the official schema allows one point a profile.
GdtfProfile DimmerProfileOf(const std::vector<DimmerPoint>& points) {
  const std::array<double, 4> c = RisingCubicNear(points);
  return {std::string(kDimmerProfile), {{0.0, c[0], c[1] / 100.0, c[2] / 1e4, c[3] / 1e6}}};
}

// The point that a profile misses most by part of its own light, of those with any to see.
const DimmerPoint& MissedMost(const GdtfProfile& profile, const std::vector<DimmerPoint>& points) {
  constexpr double kSeen = 0.002;  // of full
  const auto missed = [&](const DimmerPoint& point) {
    const double told = GdtfOutput(profile, point.percent);
    return std::abs(std::log(std::max(told, kSeen) / std::max(point.of_full, kSeen)));
  };
  return *std::ranges::max_element(points, {}, missed);
}

// As irradiance at 1 m, of the candela beside it; nothing where no spectrum was read.
GdtfMeasurement MeasurementOf(double percent, double candela,
                              const std::optional<Spectrum>& spectrum) {
  GdtfMeasurement out{percent, candela, {}, {}};
  if (!spectrum) return out;
  Spectrum absolute = *spectrum;
  absolute.quantity = SpectralQuantity::kIrradiance;
  const auto xyz = XyzFromSpectrum(absolute);
  if (!xyz || !(xyz->Y > 0.0)) return out;
  out.wavelengths_nm = absolute.wavelengths_nm;
  for (const double value : absolute.values) out.energy.push_back(value * candela / xyz->Y);
  return out;
}

// States that differ in the dimmer alone are one emitter's measurements.
std::vector<GdtfEmitter> EmittersOf(const FittedLight& lamp) {
  std::vector<GdtfEmitter> emitters;
  if (lamp.states.empty()) {
    GdtfEmitter one{"Lamp", lamp.color.xy, 100.0, {}};
    one.measurements.push_back(MeasurementOf(100.0, lamp.intensity_cd->value, lamp.spectrum));
    return {one};
  }
  double most = 0.0;
  for (const MeasuredState& state : lamp.states) most = std::max(most, state.relative.value);
  std::vector<FixtureState> others;
  std::vector<double> highest;
  for (const MeasuredState& state : lamp.states) {
    FixtureState without = state.state;
    std::erase_if(without, [](const ControlValue& c) { return c.name == kDimmerControl; });
    const double percent = NumberOfControl(state.state, kDimmerControl).value_or(100.0);
    if (!state.intensity_cd || !(percent > 0.0)) continue;
    const auto same = std::ranges::find_if(
        others, [&](const FixtureState& other) { return SameState(other, without); });
    const auto index = static_cast<std::size_t>(same - others.begin());
    if (same == others.end()) {
      others.push_back(without);
      highest.push_back(0.0);
      emitters.push_back({without.empty() ? "Lamp" : StateText(without), {}, 0.0, {}});
    }
    GdtfEmitter& emitter = emitters[index];
    emitter.measurements.push_back(
        MeasurementOf(percent, state.intensity_cd->value, state.spectrum));
    if (percent <= highest[index]) continue;
    highest[index] = percent;
    emitter.xy = state.color.xy;
    emitter.Y_percent = 100.0 * state.relative.value / most;
  }
  for (GdtfEmitter& emitter : emitters) {
    std::ranges::sort(emitter.measurements, {}, &GdtfMeasurement::physical_percent);
  }
  return emitters;
}

// What a lamp's CCT control gives at its ends: measured, whatever the label says.
std::optional<GdtfChannel> TemperatureChannel(const FittedLight& lamp, int slot) {
  const MeasuredState* warm = nullptr;
  const MeasuredState* cool = nullptr;
  for (const MeasuredState& one : lamp.states) {
    const auto label = NumberOfControl(one.state, kCctControl);
    if (!label || !one.color.cct_K) continue;
    if (warm == nullptr || *label < *NumberOfControl(warm->state, kCctControl)) warm = &one;
    if (cool == nullptr || *label > *NumberOfControl(cool->state, kCctControl)) cool = &one;
  }
  if (warm == nullptr || warm == cool) return std::nullopt;
  if (SameState({*FindControl(warm->state, kCctControl)},
                {*FindControl(cool->state, kCctControl)})) {
    return std::nullopt;
  }
  GdtfChannel channel{"CTC", std::string(kBeamName), {slot, slot + 1}, {}, {}, {}, {}};
  channel.physical_from = warm->color.cct_K->value;
  channel.physical_to = cool->color.cct_K->value;
  return channel;
}

Result<GdtfBeam> GdtfBeamOf(const FittedLight& lamp) {
  GdtfBeam beam;
  beam.name = std::string(kBeamName);
  const auto table = DistributionOf(lamp);
  if (!table) return tl::unexpected(table.error());
  double full = 1.0;
  for (const MeasuredState& state : lamp.states) full = std::max(full, state.relative.value);
  if (lamp.flux_lm) beam.flux_lm = full * lamp.flux_lm->value;
  if (*table) {
    if (!beam.flux_lm) beam.flux_lm = full * (*table)->Flux().value();
    beam.beam_deg = DegreesFromRadians(LobeWidthsAt(**table, kHalfPeak).mean);
    beam.field_deg = DegreesFromRadians(LobeWidthsAt(**table, kTenthPeak).mean);
  }
  if (lamp.beam && lamp.beam->beam_deg) beam.beam_deg = lamp.beam->beam_deg->value;
  if (lamp.beam && lamp.beam->field_deg) beam.field_deg = lamp.beam->field_deg->value;
  // A spot's own angles are exact; the table's nodes lie a degree apart.
  if (lamp.color.cct_K) beam.cct_K = lamp.color.cct_K->value;
  if (lamp.diameter_m) beam.radius_m = *lamp.diameter_m / 2.0;
  return beam;
}

struct Described {
  GdtfFixture fixture;
  Warnings warnings;
};

Result<Described> FixtureOf(const FittedLight& lamp, const Provenance& provenance) {
  auto beam = GdtfBeamOf(lamp);
  if (!beam) return Propagate(std::move(beam));
  Described out;
  GdtfFixture& fixture = out.fixture;
  fixture.name = lamp.name;
  fixture.manufacturer = "lightcal";
  fixture.description = "Measured: " + PlainInterval(*lamp.intensity_cd, "cd") + ", " +
                        (OfStatedBeam(lamp) ? DistributionWords(lamp) + ", " : "") +
                        provenance.generator;
  fixture.emitters = EmittersOf(lamp);
  beam->emitter = fixture.emitters.front().name;
  fixture.beams = {*std::move(beam)};
  GdtfMode mode{"Assumed 16 bit", {}};
  GdtfChannel dimmer{"Dimmer", std::string(kBeamName), {1, 2}, 0.0, 1.0, {}, {}};
  if (const auto points = DimmerPoints(lamp); !points.empty()) {
    fixture.profiles = {DimmerProfileOf(points)};
    dimmer.profile = fixture.profiles.front().name;
    const DimmerPoint& worst = MissedMost(fixture.profiles.front(), points);
    const double told = GdtfOutput(fixture.profiles.front(), worst.percent);
    if (std::abs(told - worst.of_full) > kRoughProfile * worst.of_full) {
      out.warnings.push_back({"gdtf_rough_profile", lamp.name,
                              "its dimmer is no cubic, and GDTF's schema allows one alone: at " +
                                  RoundedText(worst.percent, 3) + " % it says " +
                                  PercentText(told) + " of full, " + PercentText(worst.of_full) +
                                  " was read; its emitters hold what was read"});
    }
  }
  mode.channels.push_back(std::move(dimmer));
  if (auto temperature = TemperatureChannel(lamp, 3)) {
    mode.channels.push_back(*std::move(temperature));
  }
  fixture.modes = {std::move(mode)};
  fixture.id = IdOf(lamp.name + fixture.description);
  return out;
}

}  // namespace

Result<Preset> ExportGdtf(const LightFile& lights, const std::string& stem,
                          const PresetOptions& options) {
  Preset preset;
  if (options.written == Written::kFigures) return preset;  // no engine's: derives none
  std::set<std::string> taken;
  std::vector<std::string> without;
  for (const FittedLight& lamp : lights.lights) {
    const bool fits = lamp.intensity_cd && lamp.intensity_cd->value > 0.0;
    if (!fits) {
      without.push_back(lamp.name);
      continue;
    }
    auto described = FixtureOf(lamp, lights.provenance);
    if (!described) return Propagate(std::move(described));
    const std::string name = DistinctFileName(stem + "-" + FileNamePart(lamp.name), taken);
    std::string description = GdtfDescription(described->fixture);
    description.insert(description.find('\n') + 1, "<!-- Written by " + GeneratorName() + " -->\n");
    const std::array<PresetFile, 1> entries = {
        PresetFile{"description.xml", std::move(description)}};
    preset.files.push_back({name + ".gdtf", StoredZip(entries)});
    preset.warnings.insert(preset.warnings.end(), described->warnings.begin(),
                           described->warnings.end());
  }
  if (!without.empty()) {
    preset.warnings.push_back(
        {"no_fixture", Joined(without), "no candela is known of it: no .gdtf is written"});
  }
  if (!preset.files.empty()) {
    // Nobody can read off a lamp which slots it listens to.
    preset.paste = "a console's or visualiser's own import: " + std::string(kPasteDirectory) + "/" +
                   preset.files.front().name +
                   " (slots assumed: dimmer 1 and 2, CCT 3 and 4, coarse and fine)";
  }
  return preset;
}

}  // namespace lightcal
