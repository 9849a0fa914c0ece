// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/compare_labels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kWarnEv = 0.25;
constexpr double kRefuseEv = 1.2;  // a stop mistaken, and what tags are off by themselves

std::string EvText(double ln) {
  const double ev = ln / std::numbers::ln2;
  return (ev > 0.0 ? "+" : "") + RoundedText(ev, 2) + " EV";
}

// What the exposures found are apart from their labels in common, ln.
struct Gauge {
  double ln = 0.0;
  double sd = 0.0;  // 0: most labels agree
};

// The mean over the labels that most agree on. Where no more than half agree, nobody knows which
// are right: the middle of all, and as far as either end.
Gauge GaugeOf(const std::vector<double>& off) {
  constexpr double kAgree = kWarnEv * std::numbers::ln2;
  std::vector<double> ranked = off;
  std::ranges::sort(ranked);
  Gauge gauge;
  std::size_t most = 0;
  for (std::size_t from = 0, to = 0; from < ranked.size(); ++from) {
    while (to < ranked.size() && ranked[to] - ranked[from] <= kAgree) ++to;
    if (to - from <= most) continue;
    most = to - from;
    gauge.ln = std::accumulate(ranked.begin() + static_cast<std::ptrdiff_t>(from),
                               ranked.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
               static_cast<double>(most);
  }
  if (2 * most > ranked.size()) return gauge;
  return {0.5 * (ranked.front() + ranked.back()), 0.5 * (ranked.back() - ranked.front())};
}

// Of frames that measurements join.
Result<void> CompareJoined(std::span<const std::size_t> joined, std::span<const double> label,
                           std::span<const std::string> names, ExposureRatios& answer) {
  std::vector<double> off;
  for (const std::size_t i : joined) off.push_back(answer.ln_exposure[i] - std::log(label[i]));
  const Gauge gauge = GaugeOf(off);
  for (const std::size_t i : joined) answer.ln_exposure[i] -= gauge.ln;
  if (gauge.sd == 0.0) {
    for (std::size_t i = 0; i < joined.size(); ++i) {
      auto named = NameOddLabel(off[i] - gauge.ln, names[joined[i]], answer.warnings);
      if (!named) return named;
    }
    return {};
  }
  const std::string frames = Joined(joined, ", ", [&](std::size_t i) { return names[i]; });
  const double apart = 2.0 * gauge.sd / std::numbers::ln2;
  if (apart > kRefuseEv) {
    return Refused("exposures_disagree", names[joined.front()],
                   "beside each other " + frames + " were exposed up to " + RoundedText(apart, 2) +
                       " EV otherwise than their tags or {merge.exposures} say, and no more than "
                       "half of these agree; give the exposures in the order of the files, or more "
                       "frames");
  }
  answer.gauge_sd = std::max(answer.gauge_sd, gauge.sd);
  answer.warnings.push_back(
      {"labels_disagree", names[joined.front()],
       "beside each other " + frames + " were exposed " + RoundedText(apart, 2) +
           " EV otherwise than their tags or {merge.exposures} say, and which of these is wrong "
           "they do not tell: the measured ratio is used, and the scale is as unsure; take three "
           "frames and more, or check the exposures"});
  return {};
}

}  // namespace

Result<void> NameOddLabel(double off, const std::string& name, Warnings& warnings) {
  const double ev = std::abs(off) / std::numbers::ln2;
  if (ev > kRefuseEv) {
    return Refused(
        "exposures_disagree", name,
        "its picture was exposed " + EvText(off) +
            " from what its tags or {merge.exposures} say, beside the other frames; give "
            "the exposures in the order of the files, or leave this frame out");
  }
  if (ev > kWarnEv) {
    warnings.push_back({"exposure_off", name,
                        "its picture was exposed " + EvText(off) +
                            " from what its tags say; the measured exposure is used"});
  }
  return {};
}

Result<void> CompareWithLabels(std::span<const double> label, std::span<const std::string> names,
                               std::span<const std::size_t> first, ExposureRatios& answer) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] != i) continue;
    std::vector<std::size_t> joined;
    for (std::size_t j = i; j < first.size(); ++j) {
      if (first[j] == i) joined.push_back(j);
    }
    if (auto ok = CompareJoined(joined, label, names, answer); !ok) return ok;
  }
  return {};
}

Result<void> WeighCurve(std::span<const double> label, std::span<const std::string> names,
                        const CurvePower& curve, ExposureRatios& answer) {
  std::vector<double> ln_label;
  for (const double l : label) ln_label.push_back(std::log(l));
  const WeighedLabels weighed = WeighLabels(ln_label, answer.ln_exposure, answer.measured, curve);
  for (std::size_t i = 0; i < label.size(); ++i) {
    answer.ln_exposure[i] = ln_label[i] + weighed.off[i];
    if (!weighed.certain) continue;
    auto named = NameOddLabel(weighed.off[i], names[i], answer.warnings);
    if (!named) return named;
  }
  answer.gauge_sd = weighed.gauge_sd;
  answer.power_sd = weighed.power_sd;
  if (weighed.certain) return {};
  answer.warnings.push_back(
      {"labels_disagree", names.front(),
       "under the stated response the frames were not exposed as their tags or {merge.exposures} "
       "say, and which exposure is wrong, or whether the response is another camera's, they do not "
       "tell: sigma holds each of these; take three frames and more, or check the exposures"});
  return {};
}

}  // namespace lightcal
