// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/check/render_tint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "lightcal/colorimetry/srgb_encoding.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/reader_parts.h"
#include "lightcal/presets/check/rendered_color.h"

namespace lightcal {
namespace {

constexpr double kSameTint = 0.03;    // largest difference of max-normalised components
constexpr double kUndivided = 0.025;  // |ln| between what is seen and 1/Y
using Rgb3 = std::array<double, 3>;

Rgb3 MaxNormalised(const Rgb3& c) {
  const double top = std::max({c[0], c[1], c[2], 1e-30});
  return {c[0] / top, c[1] / top, c[2] / top};
}
bool SameTint(const Rgb3& a, const Rgb3& b) {
  double worst = 0.0;
  for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(a[c] - b[c]));
  return worst < kSameTint;
}
Rgb3 Mapped(const Rgb3& c, double (*map)(double)) { return {map(c[0]), map(c[1]), map(c[2])}; }

// What one of several lamps has for a colour if the others have theirs. Absent: that is none.
std::optional<Rgb3> TintOfOne(const CheckedRig& rig, const RenderVerdict& verdict, std::size_t k) {
  const auto rest = LightOfLamps(rig, k);
  if (!rest) return std::nullopt;
  Rgb3 own{};
  for (std::size_t c = 0; c < 3; ++c) {
    own[c] = verdict.rgb_lx[c] / verdict.lux - (*rest)[c];
    if (own[c] < 0.0) own[c] = own[c] > -kSameTint ? 0.0 : own[c];
  }
  const bool light = std::ranges::all_of(own, [](double part) { return part >= 0.0; });
  return light && Rec709Luminance(own) > 0.0 ? std::optional(MaxNormalised(own)) : std::nullopt;
}

}  // namespace

std::optional<RenderCause> TintIn(const CheckedLamp& lamp, const Rgb3& rgb, double seen) {
  const Rgb3 want = lamp.color, tint = MaxNormalised(rgb);
  if (SameTint(tint, want)) return std::nullopt;
  const Rgb3 decoded = Mapped(want, &SrgbDecoded);
  const Rgb3 encoded = Mapped(want, &SrgbEncoded);
  if (SameTint(tint, MaxNormalised({1.0, 1.0, 1.0}))) {
    const double undivided = 1.0 / lamp.color_luminance;
    return RenderCause{"color_missing",
                       std::abs(std::log(seen / undivided)) < kUndivided
                           ? "the cards are white though the lamp is not: its colour was not set, "
                             "while its intensity is divided by that colour's luminance"
                           : "the cards are white though the lamp is not: its colour was not set",
                       undivided};
  }
  if (SameTint(tint, MaxNormalised(decoded))) {
    return RenderCause{"color_read_as_srgb",
                       "the lamp's linear colour was read as sRGB codes: too "
                       "saturated; set it in linear (three.js: setRGB(.., LinearSRGBColorSpace))",
                       Rec709Luminance(decoded) / lamp.color_luminance};
  }
  if (SameTint(tint, MaxNormalised(encoded))) {
    return RenderCause{"color_encoded_twice",
                       "the lamp's colour was written as sRGB codes where "
                       "linear values belong: too pale",
                       Rec709Luminance(encoded) / lamp.color_luminance};
  }
  return RenderCause{"other_color",
                     "the cards have another tint than the lamp: its colour, the "
                     "picture's RGB space or its white balance is not what was exported"};
}

RenderCause TintAmong(const CheckedRig& rig, const RenderVerdict& verdict) {
  const std::string apart = " (" + RoundedText(verdict.color->apart_uv, 2) + " in u'v', " +
                            RoundedText(verdict.color->allowed_uv, 2) + " allowed)";
  constexpr double kShows = 0.2;
  for (std::size_t k = 0; k < rig.lamp_shares.size(); ++k) {
    if (rig.lamp_shares[k] < kShows) continue;
    const auto tint = TintOfOne(rig, verdict, k);
    auto cause = tint ? TintIn(rig.lamps[k], *tint, 1.0) : std::nullopt;
    if (!cause || cause->code == "other_color") continue;
    cause->message = rig.lamps[k].name + ": " + cause->message + apart;
    return *std::move(cause);
  }
  const auto most = std::ranges::max_element(rig.lamp_shares);
  const std::string whose =
      rig.lamps.size() > 1
          ? ", most of whose light is " +
                rig.lamps[static_cast<std::size_t>(most - rig.lamp_shares.begin())].name + "'s,"
          : "";
  return {"other_color",
          "the cards" + whose + " have another colour than the lamps give them" + apart +
              ": a lamp's colour, the picture's RGB space or its white balance is not what was "
              "exported"};
}

}  // namespace lightcal
