// SPDX-License-Identifier: Apache-2.0
// What a lamp is built like, and where the light of such a lamp starts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace lightcal {

enum class Fixture : std::uint8_t {
  kBulb,       // read from its glass or filament
  kCobBare,    // a chip on a board without optics
  kReflector,  // a chip in a reflector
  kFresnel,    // behind a lens
  kPanel,      // a luminous surface; its size is modelled
  kSoftbox,    // lanterns too
  kLuminaire,  // mounted at a stated place, with its photometric file
};

inline constexpr std::array<std::string_view, 7> kFixtureNames = {
    "bulb", "cob_bare", "reflector", "fresnel", "panel", "softbox", "luminaire"};

[[nodiscard]] constexpr std::string_view FixtureName(Fixture fixture) {
  return kFixtureNames[static_cast<std::size_t>(fixture)];
}
[[nodiscard]] constexpr std::optional<Fixture> FixtureFromName(std::string_view name) {
  for (std::size_t i = 0; i < kFixtureNames.size(); ++i) {
    if (kFixtureNames[i] == name) return static_cast<Fixture>(i);
  }
  return std::nullopt;
}

// Whether such a lamp lights one side of itself alone.
[[nodiscard]] constexpr bool ShinesOneWay(Fixture fixture) {
  return fixture != Fixture::kBulb && fixture != Fixture::kLuminaire;
}

// Where the light seems to start: r = d + offset, metres, one part of a normal mixture.
struct OffsetPart {
  double weight = 1.0;
  double mean_m = 0.0;
  double sd_m = 0.0;
};

// The offset of such a fixture, in metres at any distance: a virtual source does not move when one
// steps back. From 205 published photometric tables of film fixtures with three to five distances
// each (fits of E = I/(d + offset)^2 with rms under 2 %); bulb, panel and luminaire by judgement.
// The tables count from a softbox's mount, people as often from its front: half of each.
// An unknown fixture: most start near their reference point, lamps behind a front diffuser or in a
// reflector well in front of it; one reading of it is best told by E d^2, the mixture's median
// being 0, and it holds 95 % of the 205.
[[nodiscard]] std::span<const OffsetPart> OffsetParts(std::optional<Fixture> fixture);

// One normal of a mixture's mean and variance, for where a single one must do.
[[nodiscard]] OffsetPart MatchedOffset(std::span<const OffsetPart> parts);

}  // namespace lightcal
