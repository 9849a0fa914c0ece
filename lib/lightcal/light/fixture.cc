// SPDX-License-Identifier: Apache-2.0
#include "lightcal/light/fixture.h"

#include <cmath>
#include <cstddef>

namespace lightcal {
namespace {

constexpr std::array<OffsetPart, 7> kOffsets = {{
    {1.0, 0.0, 0.03},    // bulb
    {1.0, 0.06, 0.04},   // cob_bare
    {1.0, -0.10, 0.06},  // reflector
    {1.0, 0.06, 0.08},   // fresnel: few tables
    {1.0, 0.0, 0.03},    // panel
    {1.0, -0.30, 0.08},  // softbox, from its mount as in makers' tables
    {1.0, 0.0, 0.02},    // luminaire
}};
// From its mount, or from its front, where a person finds a point again.
constexpr std::array<OffsetPart, 2> kOffsetsOfSoftbox = {{{0.5, -0.30, 0.08}, {0.5, 0.0, 0.05}}};
constexpr std::array<OffsetPart, 2> kOffsetsOfAny = {{{0.72, 0.03, 0.06}, {0.28, -0.20, 0.12}}};

}  // namespace

std::span<const OffsetPart> OffsetParts(std::optional<Fixture> fixture) {
  if (!fixture) return kOffsetsOfAny;
  if (*fixture == Fixture::kSoftbox) return kOffsetsOfSoftbox;
  return {&kOffsets[static_cast<std::size_t>(*fixture)], 1};
}

OffsetPart MatchedOffset(std::span<const OffsetPart> parts) {
  double mean = 0.0;
  double square = 0.0;
  for (const OffsetPart& part : parts) {
    mean += part.weight * part.mean_m;
    square += part.weight * (part.mean_m * part.mean_m + part.sd_m * part.sd_m);
  }
  return {1.0, mean, std::sqrt(square - mean * mean)};
}

}  // namespace lightcal
