// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/color_fidelity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lightcal/colorimetry/cie_tables/samples.h"
#include "lightcal/colorimetry/sample_colors.h"

namespace lightcal {
namespace {

const SampleSet& CfiSampleSet() {
  static const SampleSet samples({CfiSamples().front().data(), kCfiRowCount * kCfiSampleCount},
                                 kCfiFirstNm, kCfiSampleCount);
  return samples;
}

double TenDegreeY(const NanometrePowers& powers) {
  double sum = 0.0;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    sum += powers[k] * Cie1964Cmf()[k + (kRenderingFirstNm - kCmfFirstNm)].y_bar;
  }
  return sum;
}

NanometrePowers Reference(const RenderingInput& light, const FidelityEdition& edition) {
  const Kelvin t = light.color.temperature;
  const auto black_body = [&] {
    return ReferencePowers(light, BlackBodyAt(t, light.reference_nm));
  };
  const auto daylight = [&] { return ReferencePowers(light, DaylightAt(t, light.reference_nm)); };
  if (t <= edition.last_black_body) return black_body();
  if (t >= edition.first_daylight) return daylight();
  NanometrePowers mixed = black_body();
  const NanometrePowers day = daylight();
  const double share =
      (t - edition.last_black_body) / (edition.first_daylight - edition.last_black_body);
  const double of_black_body = (1.0 - share) / TenDegreeY(mixed);
  const double of_daylight = share / TenDegreeY(day);
  for (std::size_t k = 0; k < mixed.size(); ++k) {
    mixed[k] = of_black_body * mixed[k] + of_daylight * day[k];
  }
  return mixed;
}

double FidelityOf(double difference, double scale) {
  return 10.0 * std::log1p(std::exp((100.0 - scale * difference) / 10.0));
}

std::size_t BinOf(const Cam02Ucs& color) {
  const double turn = std::atan2(color.b, color.a) / (2.0 * std::numbers::pi);
  const double positive = turn < 0.0 ? turn + 1.0 : turn;
  return std::min(static_cast<std::size_t>(positive * kHueBinCount), std::size_t{kHueBinCount - 1});
}

// Sums of (a', b') become means, and what follows from them.
void Finish(HueBin& bin, std::size_t index, double Rf) {
  const double n = bin.samples;
  bin.test_a /= n;
  bin.test_b /= n;
  bin.reference_a /= n;
  bin.reference_b /= n;
  bin.Rf = Rf;
  const double centre = (static_cast<double>(index) + 0.5) * 2.0 * std::numbers::pi / kHueBinCount;
  const double chroma = std::hypot(bin.reference_a, bin.reference_b);
  const double da = (bin.test_a - bin.reference_a) / chroma;
  const double db = (bin.test_b - bin.reference_b) / chroma;
  bin.chroma_shift = da * std::cos(centre) + db * std::sin(centre);
  bin.hue_shift_rad = db * std::cos(centre) - da * std::sin(centre);
}

// Twice the areas of the polygons through the bins' means.
struct Areas {
  double test = 0.0, reference = 0.0;
};
Areas AreasOf(const std::array<HueBin, kHueBinCount>& bins) {
  std::array<const HueBin*, kHueBinCount> corners{};
  std::size_t count = 0;
  for (const HueBin& bin : bins) {
    if (bin.samples > 0) corners[count++] = &bin;
  }
  Areas areas;
  for (std::size_t i = 0; i < count; ++i) {
    const HueBin& p = *corners[i];
    const HueBin& q = *corners[(i + 1) % count];
    areas.test += p.test_a * q.test_b - q.test_a * p.test_b;
    areas.reference += p.reference_a * q.reference_b - q.reference_a * p.reference_b;
  }
  return areas;
}

}  // namespace

ColorFidelity ColorFidelityOf(const RenderingInput& light, const FidelityEdition& edition) {
  const auto [test, reference] =
      CfiSampleSet().Under(light.powers, Reference(light, edition), Cie1964Cmf());
  const Cam02UcsUnder under_test(test.white);
  const Cam02UcsUnder under_reference(reference.white);
  ColorFidelity result;
  result.scale = edition.scale;
  double sum = 0.0;
  for (std::size_t i = 0; i < result.test.size(); ++i) {
    const Cam02Ucs a = under_test.Of(test.samples[i]);
    const Cam02Ucs b = under_reference.Of(reference.samples[i]);
    result.test[i] = a;
    result.reference[i] = b;
    result.difference[i] = std::hypot(a.J - b.J, a.a - b.a, a.b - b.b);
    result.sample_Rf[i] = FidelityOf(result.difference[i], edition.scale);
    sum += result.difference[i];
  }
  result.Rf = FidelityOf(sum / kFidelitySampleCount, edition.scale);
  return result;
}

GamutAndBins GamutAndBinsOf(const ColorFidelity& fidelity) {
  GamutAndBins result;
  std::array<double, kHueBinCount> summed_difference{};
  for (std::size_t i = 0; i < fidelity.reference.size(); ++i) {
    const std::size_t index = BinOf(fidelity.reference[i]);
    HueBin& bin = result.bins[index];
    bin.samples += 1;
    bin.test_a += fidelity.test[i].a;
    bin.test_b += fidelity.test[i].b;
    bin.reference_a += fidelity.reference[i].a;
    bin.reference_b += fidelity.reference[i].b;
    summed_difference[index] += fidelity.difference[i];
  }
  for (std::size_t i = 0; i < result.bins.size(); ++i) {
    HueBin& bin = result.bins[i];
    if (bin.samples == 0) continue;
    Finish(bin, i, FidelityOf(summed_difference[i] / bin.samples, fidelity.scale));
  }
  const Areas areas = AreasOf(result.bins);
  result.Rg = 100.0 * areas.test / areas.reference;
  return result;
}

}  // namespace lightcal
