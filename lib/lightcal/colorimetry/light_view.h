// SPDX-License-Identifier: Apache-2.0
// How far apart two lights make the same things look, to one observer or one camera that stays set
// to the first of them.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lightcal/colorimetry/cam02_ucs.h"
#include "lightcal/colorimetry/gel_stack.h"
#include "lightcal/colorimetry/rendering_input.h"
#include "lightcal/core/matrix3.h"
#include "lightcal/core/result.h"

namespace lightcal {

// Three channels' answer to each whole nanometre of 380-780: an observer's colour-matching
// functions or a camera's sensitivities, any scale.
struct ViewChannels {
  std::string name;
  std::array<NanometrePowers, 3> channels{};
};
enum class ObserverAngle { kTwoDegrees, kTenDegrees };
[[nodiscard]] ViewChannels ObserverChannels(ObserverAngle angle);

// What is looked at: a perfect white, the 99 samples of CIE 224 (TM-30), and the two skin tones of
// CIE 13.3 (sample 13) and JIS Z 8726 (sample 15).
inline constexpr int kViewedCount = 102;
inline constexpr int kViewedSamples = 101;  // without the white

// Deviations to look through: at each node a factor of the lamp's light (its meter's error, the
// gel), one of the target's, and one of each channel.
struct ViewFactors {
  NodeValues lamp{}, target{};
  std::array<NodeValues, 3> channel{};
};

// One viewer, a lamp and the target that it is to look like. The channels are balanced on the
// target's white, then made XYZ by the 3 x 3 matrix that is exact for that white and least squares
// over the samples under the target (for an observer: the identity, to rounding). Balance and
// matrix stay when the lamp takes the target's place, as a camera's do whose white balance is
// locked; a camera balanced anew on each lamp would hide what gels do. The level is trimmed until
// the white has the target's luminance.
//   dE = mean over the 101 samples of the distance in CAM02-UCS, both lights seen by an eye
//   adapted to the target's white.
class LightView {
 public:
  // Refused: "blind_view" (a channel does not see the target or the lamp, or the channels cannot
  // tell colours apart).
  [[nodiscard]] static Result<LightView> Make(const ViewChannels& view, const NanometrePowers& lamp,
                                              const NanometrePowers& target, ObserverAngle angle);

  // dE of the lamp behind a filter. Stops where it must exceed `give_up`, and answers a lower
  // bound above it then. Infinite where the viewer sees nothing of the light.
  [[nodiscard]] double Difference(const NodeValues& transmittance,
                                  double give_up = std::numeric_limits<double>::infinity()) const;

  // The same through deviations: the target moves too, and the channels are balanced on it anew.
  [[nodiscard]] double Difference(const ViewFactors& factors) const;

  struct Seen {
    std::vector<Xyz> samples;  // white first, then as listed above; Y = 100: the target's white
    std::vector<double> difference;  // dE of each against the target; of the white its own
    double mean = 0.0, worst = 0.0;  // over the 101 samples
    double skin = 0.0;  // mean of the four skin tones: samples 15 and 18 of CIE 224 (TM-30's
                        // Rf,skin), 13 of CIE 13.3, 15 of JIS Z 8726
  };
  [[nodiscard]] Seen See(const NodeValues& transmittance) const;
  [[nodiscard]] std::vector<Xyz> Target() const;
  [[nodiscard]] const Xyz& target_white() const { return white_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  explicit LightView(const Xyz& white) : white_(white), ucs_(white) {}

  static constexpr std::size_t kLanes = 4;
  static constexpr std::size_t kBlocks = (kViewedCount + kLanes - 1) / kLanes;
  using Block = std::array<std::array<double, kLanes>, 3>;  // [channel][sample]
  using Weights = std::vector<Block>;                       // [block][node]
  struct Factors {
    const double *red, *green, *blue;
  };
  static void Sum(const Block* weights, const Factors& factors, Block& sum);
  [[nodiscard]] static Weights WeightsOf(const ViewChannels& view, const NanometrePowers& light);
  [[nodiscard]] Xyz ColorOf(const Block& sum, std::size_t lane, const Column3& balance,
                            double level) const;
  [[nodiscard]] Result<void> FitMatrix(const std::vector<Xyz>& wanted);

  std::string name_;
  Weights lamp_, target_;
  Column3 balance_{};  // makes the target's white 1 in each channel
  Matrix3 xyz_from_balanced_{};
  Xyz white_;  // the target's, Y = 100
  Cam02UcsUnder ucs_;
  std::vector<Cam02Ucs> target_ucs_;
};

}  // namespace lightcal
