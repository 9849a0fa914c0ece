// SPDX-License-Identifier: Apache-2.0
#include "lightcal/colorimetry/resample.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

// The integral from the first edge to l, piecewise linear between the edges.
class Cumulated {
 public:
  Cumulated(const Spectrum& spectrum, std::vector<double> edges)
      : edges_(std::move(edges)), integral_(edges_.size(), 0.0) {
    for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
      integral_[i + 1] = integral_[i] + spectrum.values[i] * (edges_[i + 1] - edges_[i]);
    }
  }
  [[nodiscard]] double To(double l) const {
    const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, l);
    const auto i = static_cast<std::size_t>(above - edges_.begin()) - 1;
    const double share = std::clamp((l - edges_[i]) / (edges_[i + 1] - edges_[i]), 0.0, 1.0);
    return integral_[i] + share * (integral_[i + 1] - integral_[i]);
  }
  [[nodiscard]] double front() const { return edges_.front(); }
  [[nodiscard]] double back() const { return edges_.back(); }

 private:
  std::vector<double> edges_, integral_;
};

}  // namespace

std::vector<double> BinEdgesNm(const Spectrum& spectrum) {
  const auto& l = spectrum.wavelengths_nm;
  const std::size_t n = l.size();
  std::vector<double> edges(n + 1);
  edges[0] = l[0] - (l[1] - l[0]) / 2.0;
  for (std::size_t i = 1; i < n; ++i) edges[i] = (l[i - 1] + l[i]) / 2.0;
  edges[n] = l[n - 1] + (l[n - 1] - l[n - 2]) / 2.0;
  return edges;
}

Result<Spectrum> ResampleByArea(const Spectrum& spectrum, Nanometres first, Nanometres step,
                                int count) {
  if (const auto readable = XyzFromSpectrum(spectrum); !readable) {
    return tl::unexpected(readable.error());
  }
  const Cumulated cumulated(spectrum, BinEdgesNm(spectrum));
  const double width = step.value();
  const double from = first.value() - width / 2.0;
  const double to = from + count * width;
  constexpr double kRounding = 1e-6;
  if (!(width > 0.0) || count < 2 || !(from >= cumulated.front() - kRounding) ||
      !(to <= cumulated.back() + kRounding)) {
    return Refused("out_of_range", "spectrum",
                   "holds " + ShortestText(cumulated.front()) + " to " +
                       ShortestText(cumulated.back()) +
                       " nm; ask for two or more bins within that range");
  }
  Spectrum out;
  out.quantity = spectrum.quantity;
  for (int j = 0; j < count; ++j) {
    const double left = from + j * width;
    out.wavelengths_nm.push_back(first.value() + j * width);
    out.values.push_back((cumulated.To(left + width) - cumulated.To(left)) / width);
  }
  return out;
}

}  // namespace lightcal
