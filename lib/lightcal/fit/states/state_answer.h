// SPDX-License-Identifier: Apache-2.0
// A lamp at a state of its controls: one that was read, or one between those.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/records/fitted_light.h"

namespace lightcal {

// How an answer stands to the states that were read.
enum class StateBasis : std::uint8_t {
  kMeasured,  // is one of them
  kBetween,   // between two that differ from it in one control alone
  kCombined,  // within the range of every control, but no two such: put together from others
};

// The spectrum of a lamp at a state.
struct StateSpectrum {
  // W m-2 nm-1 at 1 m; of a directional lamp, and of one without an intensity, where it was read.
  Spectrum spectrum;
  std::vector<double> u95;     // of each value, its level's included; empty where nothing tells it
  std::vector<double> shares;  // of its light, one of each of the lamp's emitters; or empty
};

// A meter repeats a colour within this, 1 sigma; what its readings share comes on top.
inline constexpr double kRepeatsLnMired = 0.001;
inline constexpr double kRepeatsDuv = 2e-4;

// Of an answer's uncertainty, 1 sigma, what no other state of the lamp has: how its meter repeats,
// and between states what lies there. The rest (the meter's own error, walls, the reference) is in
// every state alike, so that it is in no difference of two.
struct OwnErrors {
  double ln_light = 0.0, ln_mired = 0.0, duv = 0.0;
};

struct StateAnswer {
  FixtureState state;
  StateBasis basis = StateBasis::kMeasured;
  Uncertain relative;                                     // over the reference state
  std::optional<Uncertain> intensity_cd, illuminance_lx;  // as the light gives it
  // Over the brightest that the same lamp is at the highest dimmer that was read, other controls as
  // asked; of a lamp without a dimmer over its brightest state that was read.
  FixtureState full;
  Uncertain relative_to_full;
  FittedColor color;
  OwnErrors own{};
  // As it was read, or what its emitters mix; absent where nothing tells it.
  std::optional<StateSpectrum> spectrum{};
  std::optional<double> promised_of_full;  // by the label: dimmer/100
  std::optional<double> promised_cct_K;
};

// Light and colour of `light` at a state. One that was read answers with what was read. Between
// them: light by fit/states/control_curve.h; colour by the same law of ln mired and Duv, and where
// the lamp mixes two emitters (its states' chromaticities lie on a line) the Duv of that line at
// the CCT, so that no colour is answered that its emitters cannot make. Where spectra told the
// emitters (fit/states/emitters.h) what they mix to that colour is its spectrum, and of two a
// colour beside their line gives way to the nearest on it. Intervals hold what the reference's
// intensity has.
//
// Refused: no_states (the lamp has no controls), state_controls (other controls than were read),
// outside_states (beyond what was read in a control: nothing tells how the fixture goes on),
// state_word (a word that was never read), too_few_states (one state alone).
[[nodiscard]] Result<StateAnswer> AnswerState(const FittedLight& light, const FixtureState& at);

// AnswerState of one lamp at many states: the curves through its states are found once. The light
// must outlive it; for one thread at a time.
class StateAnswers {
 public:
  explicit StateAnswers(const FittedLight& light);
  ~StateAnswers();
  StateAnswers(const StateAnswers&) = delete;
  StateAnswers& operator=(const StateAnswers&) = delete;

  [[nodiscard]] Result<StateAnswer> At(const FixtureState& at);

 private:
  struct Curves;
  const FittedLight& light_;
  std::unique_ptr<Curves> curves_;
};

// The spectrum of an answer. Refused: no_spectra (none was read), spectra_too_few (there are no
// fewer emitters than spectra, so that nothing shows them mixing), state_spectrum (none of the
// states with these words has a spectrum).
[[nodiscard]] Result<StateSpectrum> SpectrumOf(const FittedLight& light, const StateAnswer& answer);

// Whose offset, size and beam a state has.
enum class GeometryBasis : std::uint8_t {
  kLights,   // the light's own: zoom and front are the reference's, or no distance law asks for one
  kOwn,      // of its own, fitted or described
  kBetween,  // put between those of two zooms
  kUnknown,  // nothing tells: the light's own stands in
};
struct GeometryOfState {
  GeometryBasis basis = GeometryBasis::kUnknown;
  StateGeometry geometry{};  // kOwn and kBetween; flux and luminance are those at the state
};
// Between two zooms of plain cones: ln of half angles and of flux over intensity along ln of
// zoom_deg, the offset along the same way; unsure by a quarter of what lies between them, 95 %, in
// the middle.
[[nodiscard]] GeometryOfState GeometryAt(const FittedLight& light, const FixtureState& at,
                                         const std::optional<Uncertain>& intensity_cd);

// The light as it is at that state: intensity, flux, luminance and colour, offset, size and beam by
// GeometryAt. Refused: as AnswerState.
[[nodiscard]] Result<FittedLight> LightAtState(const FittedLight& light, const FixtureState& at);

// The measured state `index` as the others predict it, as if it had not been read; absent where it
// is not between two others along one control. What leave-one-out judges the curves by.
[[nodiscard]] std::optional<StateAnswer> AnswerWithout(const FittedLight& light, std::size_t index);

}  // namespace lightcal
