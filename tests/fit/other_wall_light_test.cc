// SPDX-License-Identifier: Apache-2.0
// What a picture of a lit wall shows beside the lamp's own light.
#include "lightcal/fit/distribution/other_wall_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "lightcal/records/session_codec.h"

namespace lightcal {
namespace {

constexpr OtherWallLight kAbout{.foot_x_m = 0.5, .foot_z_m = 0.3, .distance_m = 1.2};

// A wall that shows so many lux everywhere.
std::vector<SeenPlace> Even(double lux) {
  std::vector<SeenPlace> out;
  for (int x = 0; x < 20; ++x) {
    for (int z = 0; z < 20; ++z) out.push_back({0.1 * x - 0.5, 0.1 * z - 0.7, lux, 0.01});
  }
  return out;
}

LampAsSeen Beam() {
  return {.flux_lm = 300.0,
          .flux_lm_per_lx = 1.5,
          .edge_cd = 20.0,
          .edge_cd_per_lx = 2.0,
          .half_angle_rad = 0.6};
}

TEST(OtherWallLight, GlareAloneIsWhatTheLensIsSaidToScatter) {
  OtherLightPrior prior;
  prior.least_glare_lx = prior.most_glare_lx = 2.5;
  const auto found = FindOtherLight(prior, Beam(), 0.8, kAbout, Even(100.0), {});
  EXPECT_NEAR(found.mean.lux, 2.5, 1e-9);
  EXPECT_NEAR(found.sd_lx, 0.0, 1e-6);
}

TEST(OtherWallLight, AKnownRoomGivesItsClosedForm) {
  // E = k (rho (Phi - E a) + beta pi cos(g) (I - E c))
  OtherLightPrior prior;
  prior.room = {std::log(0.02), 1e-6};
  prior.ln_beyond = 0.5;
  prior.sd_beyond = 1e-6;
  const LampAsSeen beam = Beam();
  const double beyond = std::exp(0.5) * std::numbers::pi * std::cos(0.6);
  const double loose = 0.8 * beam.flux_lm + beyond * beam.edge_cd;
  const double per_lx = 0.8 * beam.flux_lm_per_lx + beyond * beam.edge_cd_per_lx;
  const auto found = FindOtherLight(prior, beam, 0.8, kAbout, Even(100.0), {});
  EXPECT_NEAR(found.mean.lux, 0.02 * loose / (1.0 + 0.02 * per_lx), 1e-4);
  EXPECT_LT(found.sd_lx, 1e-3);
}

TEST(OtherWallLight, TheDarkestPlaceBoundsIt) {
  OtherLightPrior prior;
  prior.room = {std::log(0.02), 1.0};
  prior.most_ambient_lx = 3.0;
  const auto free = FindOtherLight(prior, Beam(), 0.8, kAbout, Even(100.0), {});
  std::vector<SeenPlace> wall = Even(100.0);
  for (std::size_t i = 0; i < 20; ++i) wall[i].lux = 1.0;  // one side is all but dark
  const auto bounded = FindOtherLight(prior, Beam(), 0.8, kAbout, wall, {});
  EXPECT_GT(free.mean.lux, 3.0);
  EXPECT_LT(bounded.mean.lux, 1.5);
  EXPECT_LT(bounded.sd_lx, 0.4 * free.sd_lx);
  for (std::size_t i = 0; i < 20; ++i) wall[i].lux = 0.0;
  const auto none = FindOtherLight(prior, Beam(), 0.8, kAbout, wall, {});
  EXPECT_LT(none.mean.lux, 0.1);
  EXPECT_TRUE(std::isfinite(none.sd_lx));
}

TEST(OtherWallLight, AShadowShowsItAndTwoShowItsSlope) {
  OtherLightPrior prior;
  prior.room = {std::log(0.02), 1.0};
  const OtherWallLight truth{7.0, 0.5, 0.0, -0.1, 0.5, 0.3, 1.2};
  const auto at = [&](double x, double z) { return SeenPlace{x, z, truth.At(x, z), 0.001}; };
  const auto one = FindOtherLight(prior, Beam(), 0.8, kAbout, Even(100.0), {at(0.5, 0.3)});
  EXPECT_NEAR(one.mean.lux, 7.0, 0.05);
  EXPECT_NEAR(one.sd_lx, 0.09 * 7.0, 0.03);
  const auto two =
      FindOtherLight(prior, Beam(), 0.8, kAbout, Even(100.0), {at(-0.3, 0.3), at(1.3, 0.3)});
  EXPECT_NEAR(two.mean.by_x, 0.5, 0.05);
  EXPECT_NEAR(two.mean.lux, 7.0, 0.7);
}

TEST(OtherWallLight, AShadowShowsWhatTheSessionDenies) {
  OtherLightPrior dark;
  const auto found =
      FindOtherLight(dark, Beam(), 0.8, kAbout, Even(100.0), {{0.5, 0.3, 5.0, 0.01}});
  EXPECT_NEAR(found.mean.lux, 5.0, 0.1);
  // One of no light at all is no logarithm of it.
  OtherLightPrior room;
  room.room = {std::log(0.02), 1.0};
  const auto none = FindOtherLight(room, Beam(), 0.8, kAbout, Even(100.0), {{0.5, 0.3, -0.1, 0.2}});
  EXPECT_LT(none.mean.lux, 0.6);
  for (const OtherWallLight& shift : none.shifts) EXPECT_TRUE(std::isfinite(shift.At(0.7, 0.1)));
}

TEST(OtherWallLight, ALambertianLampIsSeenWithItsFluxAndItsRim) {
  // I = 100 cos(gamma) on a wall 2 m away: Phi = 100 pi sin^2(g), E lux everywhere are d^2/cos^3.
  std::vector<IntensitySample> samples;
  for (double x = -0.6; x <= 0.6; x += 0.01) {
    for (double z = -0.6; z <= 0.6; z += 0.01) {
      if (x > 0.2 && z > 0.2 && x < 0.4 && z < 0.4) continue;  // the board
      const Vec3 away = Vec3{x, 1.0, z} * (1.0 / std::sqrt(1.0 + x * x + z * z));
      samples.push_back({away, 100.0 * away[1], 1.0});
    }
  }
  const LampAsSeen seen = LampOf(samples, {0, 1, 0}, Metres(2.0));
  const double g = seen.half_angle_rad, t = std::tan(g);
  EXPECT_GT(g, 0.54);  // the corners reach further than the sides
  EXPECT_NEAR(seen.flux_lm, 100.0 * std::numbers::pi * std::pow(std::sin(g), 2), 1.0);
  EXPECT_NEAR(seen.flux_lm_per_lx, std::numbers::pi * 4.0 * t * t, 0.1);
  EXPECT_NEAR(seen.edge_cd, 100.0 * std::cos(g), 1.0);
}

TEST(OtherWallLight, WhatTheSessionSaysNarrowsIt) {
  const auto prior_of = [](const std::string& room, const std::string& lamp,
                           const std::string& wall) {
    const auto session = ParseSessionToml(
        "lightcal = 1\nname = \"s\"\n" + room +
            "[[light]]\nname = \"a\"\nkind = \"photometric\"\nposition_m = [0, -1, 0]\n" + lamp +
            "[[capture]]\nlight = \"a\"\nuse = \"wall\"\nframes = \"w.exr\"\nreflectance = 0.8\n" +
            (wall.starts_with("lens") ? wall : "") + "[capture.wall]\nsquare_m = 0.03\n" +
            (wall.starts_with("off") ? wall : ""),
        "session.toml");
    EXPECT_TRUE(session) << session.error().message;
    return PriorOfOtherLight(*session, session->lights[0], session->captures[0], 200.0);
  };
  const auto nothing = prior_of("", "", "");
  EXPECT_NEAR(nothing.most_ambient_lx, 10.0, 1e-9);
  EXPECT_NEAR(nothing.most_glare_lx, 6.0, 1e-9);
  const auto room = prior_of("[room]\nsize_m = [5, 4, 2.6]\nreflectance = 0.5\n", "", "");
  ASSERT_TRUE(nothing.room && room.room);
  EXPECT_LT(room.room->sd, nothing.room->sd);
  EXPECT_GT(room.room->ln_k, nothing.room->ln_k);  // f = .0115, an ordinary one's is .0088
  const auto dark = prior_of("[room]\ndark = true\n", "", "lens_glare = 0.0\n");
  EXPECT_FALSE(dark.room);
  EXPECT_EQ(dark.most_ambient_lx, 0.0);
  EXPECT_EQ(dark.most_glare_lx, 0.0);
  EXPECT_EQ(prior_of("", "", "off_frames = \"off.exr\"\n").most_ambient_lx, 0.0);
  EXPECT_GT(prior_of("", "fixture = \"bulb\"\n", "").ln_beyond,
            prior_of("", "fixture = \"panel\"\n", "").ln_beyond);
}

}  // namespace
}  // namespace lightcal
