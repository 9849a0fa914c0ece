// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/code_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "lightcal/imaging/bracket/align_frames.h"

namespace lightcal {
namespace {

constexpr double kBorderPeriods = 2.0;
constexpr double kNominalGamma = 2.2;
constexpr double kFullFrom = 247.0 / 255.0;  // of the highest code

// What is looked at of codes, on the nominal scale.
struct CodeRange {
  double lowest_share;  // of the highest code; below, codes say nothing
  NoiseProfile noise;
};
constexpr CodeRange kOf8Bits{12.0 / 255.0, {6e-5, 2e-8}};  // about a code
constexpr CodeRange kOfMore{0.001, {2e-6, 1e-14}};         // no code's width hides it
const CodeRange& RangeOf(const std::vector<float>& curve) {
  return curve.size() > 256 ? kOfMore : kOf8Bits;
}

// `top`: the highest code.
double NominalSignal(double code, double top) { return std::pow(code / top, kNominalGamma); }

ResponseCurves NominalCurves(const ResponseCurves& like) {
  ResponseCurves curves = like;
  for (auto& curve : curves.signal_of_code) {
    for (std::size_t code = 0; code < curve.size(); ++code) {
      curve[code] = static_cast<float>(
          NominalSignal(static_cast<double>(code), static_cast<double>(curve.size() - 1)));
    }
  }
  return curves;
}

// The power of each curve that meets the nominal one at both ends of what is looked at: a power is
// a gain of ln(signal), which every tile finds for itself, and noise stays what it is told to be.
// Below, where few codes tell, the nominal one.
ResponseCurves NearNominal(ResponseCurves curves) {
  for (auto& curve : curves.signal_of_code) {
    if (curve.empty()) continue;
    const double top = static_cast<double>(curve.size() - 1);
    const auto low = static_cast<std::size_t>(std::lround(RangeOf(curve).lowest_share * top));
    const auto high = static_cast<std::size_t>(std::lround(kFullFrom * top));
    const double ln_high = std::log(double{curve[high]});
    const double nominal_high = std::log(NominalSignal(static_cast<double>(high), top));
    const double nominal_low = std::log(NominalSignal(static_cast<double>(low), top));
    const double power = (nominal_high - nominal_low) / (ln_high - std::log(double{curve[low]}));
    for (std::size_t code = 0; code < curve.size(); ++code) {
      curve[code] = static_cast<float>(
          code < low ? NominalSignal(static_cast<double>(code), top)
                     : std::exp(nominal_high + power * (std::log(double{curve[code]}) - ln_high)));
    }
  }
  return curves;
}

Result<BracketMotion> LookThrough(const ResponseCurves& curves, const MovedCodes& codes,
                                  const MotionLook& look) {
  std::vector<SignalFrame> signals(codes.signals.begin(), codes.signals.end());
  for (SignalFrame& signal : signals) {
    signal.response = &curves;
    signal.clip.fill(static_cast<float>(NominalSignal(kFullFrom, 1.0)));
  }
  const CodeRange& range = RangeOf(curves.signal_of_code[0]);
  return MeasureMotion(signals, std::vector<NoiseProfile>(signals.size(), range.noise),
                       NominalSignal(range.lowest_share, 1.0), look);
}

// Codes as they would be had the camera stood still, for their curve alone.
Result<Frame> CodesInPlace(const Homography& h, const Region& region, const Frame& frame) {
  FrameInfo plain = frame.info;
  const auto top = static_cast<float>(HighestCode(plain));
  plain.meaning = SampleMeaning::kSensor;
  Frame codes{plain, frame.samples, frame.owner, false};
  auto signals = SignalOf(codes);
  if (!signals) return Propagate(std::move(signals));
  if (auto done = ResampleFrame(h, region, codes, *signals); !done) {
    return Propagate(std::move(done));
  }
  const auto values = std::get<View2d<const float>>(codes.samples);
  auto rounded = std::make_shared<std::vector<std::uint16_t>>();
  for (int y = 0; y < region.height; ++y) {
    for (const float value : values.row(y)) {
      rounded->push_back(
          static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * top)));
    }
  }
  codes.info.meaning = SampleMeaning::kEncoded;
  codes.samples = View2d<const std::uint16_t>(rounded->data(), region.width, region.height,
                                              codes.info.channels);
  codes.owner = std::move(rounded);
  return codes;
}

}  // namespace

Region RegionOf(const BracketMotion& motion, const SignalFrame& like) {
  std::vector<Homography> from_reference;
  for (const FrameMotion& frame : motion.frames) {
    if (!frame.left_out) from_reference.push_back(frame.from_reference);
  }
  return SharedRegion(from_reference, like.width, like.height, kBorderPeriods * ColorPeriod(like));
}

Result<RecoveredResponse> CurveInPlace(const MovedCodes& codes, const BracketMotion& motion,
                                       const Region& region) {
  std::vector<Frame> in_place;
  std::vector<double> exposure;
  for (std::size_t k = 0; k < codes.frames.size(); ++k) {
    if (motion.frames[k].left_out) continue;
    auto frame = CodesInPlace(motion.frames[k].from_reference, region, *codes.frames[k]);
    if (!frame) return Propagate(std::move(frame));
    in_place.push_back(std::move(*frame));
    exposure.push_back(codes.exposure[k]);
  }
  return RecoverResponse(in_place, exposure);
}

Result<BracketMotion> MotionOfCodes(const MovedCodes& codes) {
  const ResponseCurves nominal = NominalCurves(*codes.signals.front().response);
  const auto rough = LookThrough(nominal, codes, {.rough = true});
  if (!rough) return rough;
  const SignalFrame& reference = codes.signals[rough->reference];
  const Region region = RegionOf(*rough, reference);
  auto curves = CheckShared(region.width, region.height, reference, reference.name).and_then([&] {
    return CurveInPlace(codes, *rough, region);
  });
  if (!curves) return LookThrough(nominal, codes, {});
  return LookThrough(NearNominal(std::move(curves->curves)), codes, {.known = &*rough});
}

}  // namespace lightcal
