// SPDX-License-Identifier: Apache-2.0
// What a calibration found: one lamp, with the uncertainty of every number.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lightcal/colorimetry/chromaticity.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/records/fixture_state.h"

namespace lightcal {

// The one named instrument that read a colour: 1 sigma of what its x and its y are off by, alike in
// every colour it reads.
struct ColorMeter {
  std::string name;
  double sigma_xy = 0.0;

  [[nodiscard]] bool operator==(const ColorMeter&) const = default;
};

struct FittedColor {
  std::optional<Uncertain> cct_K;  // absent where a CCT means nothing (|Duv| > .05 ...)
  std::optional<Uncertain> duv;
  std::optional<Xy> xy;
  std::optional<ColorMeter> meter{};  // absent of a camera, of a nameless one, and of several
};

// Among priors, effects and causes: what a camera is off by in all its pictures.
inline constexpr const char* kCameraScale = "camera_scale";

struct FitDiagnostics {
  int readings = 0;                    // rows of this light in the session
  int used = 0;                        // rows that carried the estimate
  std::vector<int> rejected;           // 0-based over the light's readings
  std::optional<double> rms_relative;  // of the used rows; absent with no degree of freedom left
  std::optional<double> chi2_dof;
  int degrees_of_freedom = 0;  // used rows minus learned parameters, never below 0
  std::optional<double>
      leave_one_out;                 // rms relative error of each used row predicted by the others
  std::optional<double> condition;   // of the scaled Jacobian
  std::vector<std::string> learned;  // parameters the readings decided
  std::vector<std::string> prior;    // parameters the priors decided
};

enum class EffectState { kOff, kOn, kFitted };
struct EffectReport {
  std::string name;
  EffectState state = EffectState::kOff;
  double bound = 0.0;                  // |relative contribution to E| it cannot exceed
  std::optional<double> contribution;  // found
  double cost_ns = 0.0;                // declared price of one evaluation
  std::string reason;
  std::string key{};  // of the session: what states it, or makes it smaller
};

// One cause of a light's uncertainty.
struct BudgetPart {
  std::string name;          // "readings", a held parameter, or an effect's name
  double sd_relative = 0.0;  // standard deviation of the intensity it causes alone
  double share = 0.0;        // of the variance; all parts make 1
  std::string halve;         // a sentence: what would halve it
};

// One used or rejected row against the model, for tables and plots.
struct ResidualRow {
  int index = 0;  // 0-based over the light's readings
  std::optional<double> distance_m;
  double measured_lx = 0.0;  // direct light: off and shadow-card readings subtracted
  double predicted_lx = 0.0;
  double relative = 0.0;  // measured/predicted - 1
  double sigma_relative = 0.0;
  bool used = true;
  std::optional<double>
      walls_lx{};  // of predicted_lx, what came off the walls; where it was fitted
  // Instead of predicted_lx of the same meter turned to the lamp, where the lamp shines brightest,
  // as far away. Absent where it was so turned.
  std::optional<double> facing_lx{};
};

// A lamp in its room, as one of the things that both may be: facing it a meter sees
//   E = I (s(r)/r^2 + b exp(slope x + bend x^2)) + E0,  r = d + d0,  x = ln(d / 3 m)
// s being 1, or of a luminous rectangle where the lamp is taken for one; no b where no walls throw
// its light back. ln of E_walls scatters by `scatter` from place to place. All of a light's make
// its posterior; weights make 1.
struct LampInRoom {
  double weight = 1.0;
  double ln_intensity = 0.0;       // of cd
  double distance_offset_m = 0.0;  // d0
  double ambient_lx = 0.0;         // E0
  std::optional<double> ln_b{};
  double slope = 0.0, bend = 0.0, scatter = 0.0;
  double width_m = 0.0, height_m = 0.0;  // 0 = a point
  static constexpr int kCount = 5;
  std::array<double, std::size_t{kCount} * kCount> covariance{};  // of (ln I, d0, E0, ln b, slope)
};

// How a point may shine to its sides: ln I towards the unit vector u scatters about what is given
// by |sd (u - middle)| (1 sigma, axis by axis), middle the mean direction of its readings.
struct UnevenLight {
  Vec3 gradient_sd{}, middle{};
};
[[nodiscard]] inline double SdTowards(const UnevenLight& uneven, const Vec3& u) {
  const Vec3 off = u - uneven.middle;
  const Vec3& sd = uneven.gradient_sd;
  return Length(Vec3{sd[0] * off[0], sd[1] * off[1], sd[2] * off[2]});
}

// The walls' light about a lamp, as LocatedLamp has it.
struct WallsFound {
  double ln_b = 0.0, slope = 0.0, bend = 0.0, scatter = 0.0;
};

// A lamp whose place was sought, as its readings leave it: at a place P a meter of normal n sees
//   E = I [exp(g.(u - middle)) s(P, n) + b exp(slope x + bend x^2)] + E0,  x = ln(r / 3 m)
// u the unit vector from the lamp to P, r their distance, s [1/m^2] as its kind shines evenly, b 0
// where no walls shine. ln of E_walls scatters by `scatter` from place to place. Mean and
// covariance over all that lamp and room may be.
struct LocatedLamp {
  static constexpr int kCount = 10;
  double ln_intensity = 0.0;  // of cd
  Vec3 position_m{};
  double ambient_lx = 0.0;  // E0
  std::optional<WallsFound> walls{};
  Vec3 gradient{}, middle{};                         // g of ln I, and the mean u of its readings
  std::array<double, kCount * kCount> covariance{};  // of (ln I, x, y, z, E0, ln b, slope, g)
};

// Intensity by direction as it was measured, and why it is no surer.
struct MeasuredDistribution {
  // In the lamp's own frame, which stands in the room as AxesOfAim says. Ends where the measurement
  // does; nothing is known of directions beyond.
  IntensityTable table;
  double interpolated_share = 0.0;  // of the flux, in directions within that were not seen
  // Relative standard deviations by cause.
  struct Part {
    std::string name;
    double peak = 0.0, flux = 0.0;
  };
  std::vector<Part> budget{};
  // Of a lamp round about its aim, at each vertical angle: 1 sigma of the intensity there beside
  // the peak's own, in parts of the peak; beyond the last angle as there. Empty: not known.
  std::vector<double> pattern_sd{};
};

// The picture that a dome was measured as: linear, lat-long; its middle looks along +Y, its right
// side to +X, its upper edge to +Z.
struct EnvironmentFile {
  std::string file;  // beside the light.json, or a whole path
  std::string projection = "latlong";
  double nits_per_unit = 1.0;  // cd/m^2 of a sample of luminance 1
};

// A beam that readings off the axis told: what its distribution says in short.
struct MeasuredBeam {
  std::optional<Uncertain> axial;                // cd along the aim; the peak may lie beside it
  std::optional<Uncertain> beam_deg, field_deg;  // full angles at a half and a tenth of `axial`
  // The families of shapes, and how much the readings are for each (together 1).
  struct Family {
    std::string name;
    double share = 0.0;
    double leave_one_out = 0.0;  // rms of each reading predicted by the others, over its sigma
  };
  std::vector<Family> families{};
  std::optional<double> falling_share;  // of the smooth curves: those held to fall outwards alone
};

// Where its light starts, how large it is and how wide it shines at another zoom, or with another
// front, than at the light's own state.
struct StateGeometry {
  FixtureState state;  // one that was read; all of its zoom_deg and words share this
  LightKind kind = LightKind::kPoint;
  std::optional<Uncertain> distance_offset_m{};            // absent: as at the light's own state
  std::optional<Uncertain> flux_lm{}, luminance_nits{};    // at `state`
  std::optional<double> inner_deg{}, outer_deg{};          // half angles
  std::optional<double> inner_u95_deg{}, outer_u95_deg{};  // where the readings told them
  std::optional<double> diameter_m{}, width_m{}, height_m{}, length_m{}, radius_m{};
  std::optional<MeasuredDistribution> distribution{};
  std::optional<MeasuredBeam> beam{};
};

// The one instrument that read a lamp: 1 sigma of its scale is in the intensity, and alike in that
// of every other lamp it read.
struct MeterShare {
  std::string name;  // "" = nobody named it
  double calibration_relative = 0.0;
};

// One state of a lamp's controls that was read. relative is its light over that of the state the
// light itself is given at, everything the two share gone: the meter's scale, the offset, the
// walls.
struct MeasuredState {
  FixtureState state;
  Uncertain relative;
  double repeatability = 0.0;  // 1 sigma, relative: of this state's readings alone
  // Of states read where the reference was not: 1 sigma, relative, of what the fit predicts of it
  // there. Such states share it; absent where the reference was read too.
  std::optional<double> predicted_reference{};
  std::optional<Uncertain> intensity_cd{}, illuminance_lx{};
  FittedColor color{};
  int readings = 0;                    // that told its light
  std::optional<Spectrum> spectrum{};  // of the first of them that has one, by 5 nm
  // Of each of the light's emitters; empty where they, or this state's spectrum, are not known.
  std::vector<double> emitter_amounts{};
};

// The emitters of a fixture as the spectra of its states tell them: S = sum over k of a_k e_k, no
// a_k below 0. S is of the state's relative.value lx in W m-2 nm-1, each e_k has its peak at 1.
// What no state shows (nearly) alone can be told no further than that the states lie between.
struct FixtureEmitter {
  std::vector<double> values;  // on wavelengths_nm
  std::optional<Xy> xy;        // of them; absent of one beyond the visible
  FixtureState purest;         // the state that shows most of it
  double purest_share = 0.0;   // of that state's power, what is this emitter's
};
struct FixtureEmitters {
  std::vector<double> wavelengths_nm;
  std::vector<FixtureEmitter> found;
  int spectra = 0;        // of states, that tell them
  double residual = 0.0;  // rms of what no mixture gives of them, each over its own rms
};

// E = I/(d + d0)^2 (cos tilt) + E0. Keys that do not apply are absent. intensity is axial (peak of
// the model); flux integrates the model. d0 is positive when the effective source lies behind the
// point the distance was measured from.
struct FittedLight {
  std::string name;
  LightKind kind = LightKind::kPoint;
  std::optional<Uncertain> intensity_cd;
  std::optional<Uncertain> flux_lm;
  std::optional<Uncertain> illuminance_lx;  // directional, dome
  std::optional<Uncertain> luminance_nits;  // sphere, disk, rect, tube
  std::optional<Uncertain> distance_offset_m;
  std::optional<Uncertain> ambient_lx;
  std::optional<double> inner_deg, outer_deg;                       // half angles
  std::optional<double> inner_u95_deg, outer_u95_deg, aim_u95_deg;  // where the readings told them
  std::optional<double> diameter_m, width_m, height_m, length_m, radius_m;
  std::optional<double> angular_diameter_deg;  // directional: full angle of the disc it shines from
  std::optional<Vec3> position_m;
  std::optional<Vec3> position_u95_m;  // of each coordinate; where the readings told the position
  std::optional<Vec3> aim;
  std::optional<Vec3> axis{};                        // of a tube's length or a rect's width
  std::optional<MeasuredDistribution> distribution;  // photometric
  std::optional<EnvironmentFile> environment{};      // dome; illuminance_lx is the upward one
  std::optional<MeasuredBeam> beam{};
  FittedColor color;
  FitDiagnostics fit;
  std::vector<EffectReport> effects;
  std::vector<ResidualRow> residuals;
  // Covariance of (ln I, d0, E0), for predictions: u of a reading at another distance.
  std::optional<std::array<double, 9>> covariance_lnI_d0_E0;
  std::vector<BudgetPart> budget{};    // of intensity_cd or illuminance_lx, largest first
  std::optional<MeterShare> meter{};   // where one took every reading
  std::optional<Uncertain> of_file{};  // of a luminaire: its intensity over its photometric file's
  // Lamp and room as all that they may be, for what a meter will see. Empty: one normal says it
  // (covariance_lnI_d0_E0), and no walls are known.
  std::vector<LampInRoom> in_room{};
  std::optional<LocatedLamp> located{};  // in its stead where the lamp's place was sought
  std::optional<UnevenLight> uneven{};   // of a point read in known directions from a known place
  FixtureState state{};                  // the light is given at, "reference"; empty = no controls
  std::vector<MeasuredState> states{};   // the reference first
  std::optional<Spectrum> spectrum{};    // of the lamp at its own state; by 5 nm
  std::optional<FixtureEmitters> emitters{};
  std::vector<StateGeometry> geometries{};  // other than the light's own, where they are known
};

struct InputFile {
  std::string path;    // relative to the session where possible
  std::string sha256;  // hex
};
struct Provenance {
  std::string generator;  // "lightcal 0.1.0"
  std::vector<InputFile> inputs;
  std::string time;                    // newest time found in the inputs, "" = none
  std::vector<std::string> devices{};  // that read them, "driver:serial", each once
};

// A light.json: schema lightcal.light/1.
struct LightFile {
  std::vector<FittedLight> lights;
  Provenance provenance;
};

}  // namespace lightcal
