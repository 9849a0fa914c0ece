// SPDX-License-Identifier: Apache-2.0
// What a camera's profile knows beside its scale: noise, lens, black, filters, colours; and what
// merge and captures make of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "camera_fixture.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

constexpr const char* kDaylight = "lamp_class = \"daylight\"\n";

class CameraParts : public CameraFolder {
 protected:
  // Light lost as an ideal lens loses it, s = tangent of the field angle in the corner, and by its
  // barrel; blue a little more.
  void SetLens(double s, double barrel) {
    const double cx = 0.5 * camera_.width, cy = 0.5 * camera_.height;
    camera_.lens = [=](int x, int y, int color) {
      const double r2 =
          (std::pow(x + 0.5 - cx, 2.0) + std::pow(y + 0.5 - cy, 2.0)) / (cx * cx + cy * cy);
      const double cosine2 = 1.0 / (1.0 + s * s * r2);
      return cosine2 * cosine2 * (1.0 - barrel * r2 * r2) * (1.0 - 0.02 * (color == 2 ? r2 : 0.0));
    };
  }
  static SyntheticScene Even(double nits) {
    return [nits](int, int) { return XyzOf(nits); };
  }
  // Three equal frames of an evenly lit wall.
  std::string FlatFrames(const std::string& stem, double f_number) {
    const double time = std::exp2(std::round(std::log2(f_number * f_number / 4096.0)));
    std::vector<SyntheticExposure> series;
    for (std::uint64_t i = 0; i < 3; ++i) {
      series.push_back(ExposureSeries(time, 1, 1.0, f_number, 0.0, 40 + i).front());
      series.back().seed = 400 + i;
    }
    return Frames("flat", Shoot(stem, series, Even(3000.0)));
  }
  // Several frames with the cap on.
  std::string DarkFrames(const std::string& stem, double time, int count = 4) {
    std::vector<SyntheticExposure> series;
    for (int i = 0; i < count; ++i) {
      series.push_back(ExposureSeries(time, 1, 1.0, 8.0, 0.0, 60).front());
      series.back().seed =
          600 + static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(1e4 * time);
    }
    return Frames("dark", Shoot(stem, series, Even(0.0)));
  }
};

TEST_F(CameraParts, NoiseIsThatOfTheSensorAndUsedByMerge) {
  camera_ = SyntheticCamera{};  // without unequal pixels, knee and row noise
  camera_.width = 240;
  camera_.height = 160;
  SyntheticDngOptions silent;
  silent.noise_profile = false;
  Shoot("noise", Steady(5, 8.0, 5), merge::Wedge(camera_, 1.0, 5e3).Scene(), silent);
  const json profile = Profile(Frames("noise", "noise_*.dng"));
  ASSERT_EQ(profile["noise"].size(), 1U);
  const double scale = profile["noise"][0]["scale"], offset = profile["noise"][0]["offset"];
  EXPECT_NEAR(1.0 / scale / camera_.full_well_e, 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(offset) / scale / camera_.read_noise_e, 1.0, 0.1);

  Shoot("scene", Steady(2, 8.0, 9), merge::Wedge(camera_).Scene(), silent);
  const json merged = MergeLast();
  EXPECT_EQ(merged["noise"]["source"], "camera");
  EXPECT_DOUBLE_EQ(merged["noise"]["scale"], scale);
}

TEST_F(CameraParts, AFlatFieldTakesTheLensOutWithinOnePercent) {
  SetLens(0.5, 0.1);
  const json profile = Profile(FlatFrames("flat8", 8.0));
  ASSERT_EQ(profile["flats"].size(), 1U);
  EXPECT_LT(double(profile["flats"][0]["sigma_relative"]), 0.01);

  Shoot("scene", Steady(4, 8.0, 11), Even(300.0));
  const auto corner = [&] {
    const auto picture = merge::ReadExr(Out());
    return picture.Mean(0, 0, 12, 12) / picture.Mean(80, 50, 20, 20);
  };
  const json merged = MergeLast();
  EXPECT_NEAR(corner(), 1.0, 0.01);
  EXPECT_DOUBLE_EQ(merged["camera"]["flat"]["f_number"], 8.0);
  MergeLast({"--no-flat"});
  EXPECT_LT(corner(), 0.7);
}

// What is written is flattened, and so is what the meter read of it.
TEST_F(CameraParts, AnAnchorInTheCornerIsTheLuminanceThatIsWrittenThere) {
  SetLens(0.5, 0.1);
  Profile(FlatFrames("flat8", 8.0));
  Shoot("scene", Steady(4, 8.0, 11), Even(250.0));
  const json merged = MergeLast({"--anchor", "4,4,24,16=300"});
  EXPECT_NEAR(merge::ReadExr(Out()).Mean(4, 4, 24, 16), 300.0, 1.0);
  const double flat_sd = merged["camera"]["flat"]["sigma_relative"];
  EXPECT_GE(double(merged["scale"]["u95_relative"]), 1.96 * std::hypot(0.05, flat_sd) - 1e-4);
}

TEST_F(CameraParts, AFlatFieldCarriesAReadingInTheCornerToTheAxis) {
  SetLens(0.5, 0.1);
  const std::string flat = FlatFrames("flat8", 8.0);
  Shoot("spot", Steady(4, 8.0, 12), Even(300.0));
  const std::string spot =
      Frames("scale", "spot_*.dng",
             std::string("rect = [4, 4, 24, 16]\nluminance_nits = 300\n") + kDaylight);
  const json profile = Profile(flat + spot);
  EXPECT_NEAR(double(profile["scale"]["full_scale_constant"]) / kTrueConstant, 1.0, 0.012);
}

TEST_F(CameraParts, BetweenAperturesFlatFieldsAreUnsureAndOutsideThemRefused) {
  SetLens(0.5, 0.4);
  const std::string wide = FlatFrames("flat4", 4.0);
  SetLens(0.5, 0.0);
  const std::string narrow = FlatFrames("flat16", 16.0);
  const json profile = Profile(wide + narrow);
  ASSERT_EQ(profile["flats"].size(), 2U);
  SetLens(0.5, 0.2);
  Shoot("scene", Steady(4, 8.0, 11), Even(300.0));
  const json merged = MergeLast();
  const auto picture = merge::ReadExr(Out());
  const double off = picture.Mean(0, 0, 12, 12) / picture.Mean(80, 50, 20, 20) - 1.0;
  const double sigma = merged["camera"]["flat"]["sigma_relative"];
  EXPECT_GT(sigma, 0.02);
  EXPECT_LT(std::abs(off), 2.0 * sigma);
  const std::string text = ReadFile(ProfilePath());
  const std::string green = "\"green\": [";
  std::string broken = text;
  for (std::size_t at = broken.find(green); at != std::string::npos;
       at = broken.find(green, at + 1)) {
    broken.replace(at, broken.find(']', at) + 1 - at, green + "-5, 0, 0]");
  }
  ExpectMergeRefused({"--camera", folder_.Write("broken.json", broken)}, "bad_camera");
  Shoot("open", Steady(4, 2.0, 11, 1.0 / 8192), Even(300.0));
  ExpectMergeRefused({"--camera", ProfilePath()}, "flat_missing");
}

// A lens of 35 mm before a sensor whose corner it sees at tangent 0.5, and nothing else.
TEST_F(CameraParts, CosineFourthIsTakenOutWhenAskedAndCalledAPrior) {
  SetLens(0.5, 0.0);
  Shoot("scene", Steady(4, 8.0, 11), Even(300.0));
  const double width_mm = 2.0 * 0.5 * 35.0 / std::hypot(1.0, 120.0 / 180.0);
  const json merged =
      merge::MergeJson(files_, Out(), {"--cos4", std::to_string(width_mm) + "mm", "--force"});
  const auto picture = merge::ReadExr(Out());
  EXPECT_NEAR(picture.Mean(0, 0, 12, 12) / picture.Mean(80, 50, 20, 20), 1.0, 0.02);
  EXPECT_EQ(merged["camera"]["flat"]["source"], "cos4_prior");
  EXPECT_GT(double(merged["camera"]["flat"]["sigma_relative"]), 0.05);
  SyntheticDngOptions silent;
  silent.focal_length_mm = 0.0;
  Shoot("silent", Steady(), Even(300.0), silent);
  ExpectMergeRefused({"--cos4", "36mm"}, "no_focal_length");
}

TEST_F(CameraParts, FlatFramesThatTellNothingAreRefused) {
  auto series = Steady(2);
  series[1].label_f_number = series[1].true_f_number = 16.0;
  Shoot("mixed", series, Even(300.0));
  ExpectRefused(Frames("flat", "mixed_*.dng"), "mixed_aperture");
  Shoot("bright", Steady(2), Even(1e7));
  ExpectRefused(Frames("flat", "bright_*.dng"), "all_saturated");
  Shoot("part", Steady(2, 8.0, 3, 1.0 / 64),
        [](int x, int) { return XyzOf(x < 30 ? 1e5 : 500.0); });
  ExpectRefused(Frames("flat", "part_*.dng"), "flat_saturated");
  Shoot("uneven", Steady(), [](int x, int) { return XyzOf(x < 90 ? 300.0 : 400.0); });
  ExpectRefused(Frames("flat", "uneven_*.dng"), "flat_uneven");
}

TEST_F(CameraParts, DarkFramesTakeBlackAndHotPixelsOut) {
  camera_.black_error_dn = {6.0, -4.0, 9.0};
  camera_.hot_e_per_s = 200'000.0;
  for (int i = 0; i < 12; ++i) camera_.hot_pixels.push_back({20 + 3 * i, 95});
  const double shortest = 1.0 / 256, longest = 0.25;
  const json profile = Profile(DarkFrames("short", shortest) + DarkFrames("long", longest));
  ASSERT_EQ(profile["darks"].size(), 2U);
  const double dn = camera_.white_dn - camera_.black_dn;
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(double(profile["darks"][1]["black"][c]) * dn, camera_.black_error_dn[c], 0.2);
  }
  EXPECT_EQ(profile["darks"][1]["hot_pixels"].size(), 24U);

  constexpr double kDim = 0.5;
  Shoot("scene", Steady(4, 8.0, 15, shortest),
        [](int x, int y) { return XyzOf(y > 60 && x < 120 ? kDim : 200.0); });
  const auto dim = [&] {
    const auto picture = merge::ReadExr(Out());
    double worst = 0.0;
    for (const auto& [x, y] : camera_.hot_pixels) worst = std::max(worst, picture.Mean(x, y, 1, 1));
    // The profile has no reading: the scale is the ISO speed's.
    return std::pair{picture.Mean(10, 70, 100, 20) / kSensitivity, worst};
  };
  merge::MergeJson(files_, Out(), {"--force"});
  const auto [bare, glaring] = dim();
  EXPECT_GT(std::abs(bare / kDim - 1.0), 0.05);
  EXPECT_GT(glaring, 20.0 * kDim);
  const json merged = MergeLast();
  const auto [clean, calm] = dim();
  EXPECT_NEAR(clean / kDim, 1.0, 0.03);
  EXPECT_LT(calm, 4.0 * kDim);
  EXPECT_GT(double(merged["camera"]["black_sigma_nits"]), 0.0);
  EXPECT_LT(double(merged["camera"]["black_sigma_nits"]), 0.03 * kDim);
  EXPECT_EQ(merged["camera"]["hot_pixels"], 12);
}

TEST_F(CameraParts, DarkFramesThatAreNoneAreRefused) {
  Shoot("scene", Steady(1), merge::Wedge(camera_).Scene());
  ExpectRefused(Frames("dark", "scene_*.dng"), "dark_with_light");
  Shoot("mixed", Steady(2), Even(0.0));
  ExpectRefused(Frames("dark", "mixed_*.dng"), "mixed_dark");
}

TEST_F(CameraParts, AFilterIsMeasuredByColourAndTakenOut) {
  const std::array<double, 3> attenuation = {793.0, 812.0, 1197.0};
  const auto through = [&](std::vector<SyntheticExposure> series) {
    for (auto& exposure : series) {
      for (std::size_t c = 0; c < 3; ++c) exposure.filter[c] = 1.0 / attenuation[c];
    }
    return series;
  };
  Shoot("with", through(Steady(3, 8.0, 5, 0.5)), Even(1000.0));
  Shoot("without", Steady(3, 8.0, 6, 1.0 / 512), Even(1000.0));
  const json profile =
      Profile(Frames("nd", "with_*.dng", "name = \"nd3\"\nwithout = \"without_*.dng\"\n"));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(double(profile["nd_filters"][0]["attenuation"][c]) / attenuation[c], 1.0, 0.01);
  }
  Shoot("lamp", through(Steady(3, 8.0, 8, 0.5)), Even(800.0));
  MergeLast({"--nd", "nd3"});
  const double by_iso = merge::ReadExr(Out()).Mean(60, 40, 60, 40);
  EXPECT_NEAR(by_iso / kSensitivity / 800.0, 1.0, 0.02);
  ExpectMergeRefused({"--camera", ProfilePath(), "--nd", "nd9"}, "unknown_nd");
  ExpectRefused(Frames("nd", "with_*.dng", "name = \"nd3\"\n"), "bad_session");
  const std::string twice =
      Frames("nd", "with_*.dng", "name = \"nd3\"\nwithout = \"without_*.dng\"\n");
  ExpectRefused(twice + twice, "duplicate_name");
}

TEST_F(CameraParts, SensitivitiesComeAlongAndNarrowWhatALampsClassLeavesOpen) {
  Shoot("spot", Steady(), Even(300.0));
  const std::string own = "[camera]\nsensitivities = \"" +
                          SampleData("camera_sensitivities/Canon_EOS_5D_380_780_5.json") + "\"\n";
  const json profile = Profile(own + Frames("scale", "spot_*.dng", "luminance_nits = 300\n"));
  EXPECT_EQ(profile["color"]["source"], "sensitivities");
  EXPECT_TRUE(profile.contains("sensitivities"));
  const double unknown = MergeLast()["scale"]["u95_relative"];
  const double led = MergeLast({"--lamp-class", "white_led"})["scale"]["u95_relative"];
  EXPECT_LT(led, unknown);
}

// Twelve patches as a camera with this matrix sees them, the chart a little askew.
TEST_F(CameraParts, AChartGivesTheMatrixBackWithItsResiduals) {
  constexpr int kColumns = 4, kRows = 3;
  std::vector<SyntheticXyz> colors;
  const std::string corners = "corners, 25,24, 163,18, 160,98, 22,104\n";
  const std::string mirrored = "corners, 163,18, 25,24, 22,104, 160,98\n";
  std::string file = "lamp_xy, 0.31272, 0.32903\nname,column,row,X,Y,Z # SYNTHETIC\n";
  for (int i = 0; i < kColumns * kRows; ++i) {
    const double y = i == 0 ? 90.0 : 8.0 + 5.0 * i;
    const double angle = 2.0 * std::numbers::pi * i / 11.0, chroma = i == 0 ? 0.0 : 0.06;
    colors.push_back(
        XyzOf(y, 0.31272 + chroma * std::cos(angle), 0.32903 + chroma * std::sin(angle)));
  }
  const SyntheticScene scene = [&](int x, int y) {
    const double v = (y - 24.0 + 6.0 * (x - 25.0) / 138.0) / 80.0 * (kRows - 1);
    const double u = (x - 25.0 + 3.0 * (y - 24.0) / 80.0) / 138.0 * (kColumns - 1);
    const int column = static_cast<int>(std::lround(u)), row = static_cast<int>(std::lround(v));
    if (column < 0 || row < 0 || column >= kColumns || row >= kRows) return XyzOf(2.0);
    return colors[static_cast<std::size_t>(row * kColumns + column)];
  };
  // References are of D50: what Bradford's cone responses make of the colours in daylight.
  constexpr double kD50X = 0.96422, kD50Z = 0.82521, kD65X = 0.950430, kD65Z = 1.088801;
  const auto adapted = [&](const SyntheticXyz& c) {
    const auto cones = [](double x, double y, double z) {
      return std::array<double, 3>{0.8951 * x + 0.2664 * y - 0.1614 * z,
                                   -0.7502 * x + 1.7135 * y + 0.0367 * z,
                                   0.0389 * x - 0.0685 * y + 1.0296 * z};
    };
    const auto from = cones(kD65X, 1.0, kD65Z), to = cones(kD50X, 1.0, kD50Z);
    auto seen = cones(c.X, c.Y, c.Z);
    for (std::size_t k = 0; k < 3; ++k) seen[k] *= to[k] / from[k];
    return SyntheticXyz{0.9869929 * seen[0] - 0.1470543 * seen[1] + 0.1599627 * seen[2],
                        0.4323053 * seen[0] + 0.5183603 * seen[1] + 0.0492912 * seen[2],
                        -0.0085287 * seen[0] + 0.0400428 * seen[1] + 0.9684867 * seen[2]};
  };
  for (int i = 0; i < kColumns * kRows; ++i) {
    const SyntheticXyz d50 = adapted(colors[static_cast<std::size_t>(i)]);
    file += "p" + std::to_string(i) + "," + std::to_string(i % kColumns + 1) + "," +
            std::to_string(i / kColumns + 1) + "," + std::to_string(d50.X) + "," +
            std::to_string(d50.Y) + "," + std::to_string(d50.Z) + "\n";
  }
  folder_.Write("chart.csv", corners + file);
  Shoot("chart", Steady(3, 8.0, 4, 1.0 / 64), scene);
  const std::string frames = Frames("chart", "chart_*.dng", "chart = \"chart.csv\"\n");
  const json profile = Profile(frames);
  EXPECT_EQ(profile["color"]["source"], "chart");
  EXPECT_LT(double(profile["color"]["delta_e_mean"]), 0.5);
  // M times the camera's own matrix is the identity, in D65's scale.
  const char* const rows[] = {"X", "Y", "Z"};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double product = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        product +=
            double(profile["color"]["xyz_from_raw"][rows[i]][k]) * camera_.camera_from_xyz[k][j];
      }
      EXPECT_NEAR(product, i == j ? 1.0 : 0.0, 0.03) << i << j;
    }
  }
  folder_.Write("turned.csv", mirrored + file);
  ExpectRefused(Frames("chart", "chart_*.dng", "chart = \"turned.csv\"\n"), "chart_disagrees");
  folder_.Write("empty.csv", "nothing\n");
  ExpectRefused(Frames("chart", "chart_*.dng", "chart = \"empty.csv\"\n"), "bad_chart");
  ExpectRefused(frames + frames, "two_colour_sources");
}

TEST_F(CameraParts, AProfileServesItsOwnCameraOnly) {
  Shoot("spot", Steady(), Even(300.0));
  Profile(Frames("scale", "spot_*.dng", "luminance_nits = 300\n"));
  camera_.width = 240;
  Shoot("large", Steady(), Even(300.0));
  ExpectMergeRefused({"--camera", ProfilePath()}, "other_camera");
  ExpectMergeRefused({"--camera", SampleData("camera_sensitivities/Canon_EOS_5D_380_780_5.json")},
                     "no_profile");
  EXPECT_EQ(RunLightcal(merge::MergeWords(files_, Out(), {"--nd", "nd3"})).exit_code, 2);
}

// A lamp of 200 cd in daylight's colour, 0.8 m from a card of 18 % and without walls.
TEST_F(CameraParts, ACaptureByAProfiledCameraRestsOnNoPrior) {
  constexpr double kCandela = 200.0, kDistance = 0.8, kReflectance = 0.18;
  Shoot("spot", Steady(), Even(300.0));
  Profile(Frames("scale", "spot_*.dng",
                 std::string("luminance_nits = 300\nsigma_relative = 0.02\n") + kDaylight));
  const double nits = kCandela / (kDistance * kDistance) * kReflectance / std::numbers::pi;
  Shoot("card", Steady(4, 8.0, 31, 1.0 / 256), Even(nits));
  const std::string capture =
      "[room]\ndark = true\n[[light]]\nname = \"lamp\"\nkind = \"point\"\nfixture = \"bulb\"\n"
      "[[capture]]\nlight = \"lamp\"\n"
      "frames = \"card_*.dng\"\nuse = \"card\"\nreflectance = 0.18\ndistance_m = 0.8\n"
      "camera = \"camera.json\"\n" +
      std::string(kDaylight);
  const std::string out = folder_.path() + "/light.json";
  const json light = LightcalJson("fit", {Session(capture), "-o", out})["lights"].at(0);
  const double found = light["intensity_cd"]["value"], u95 = light["intensity_cd"]["u95"];
  EXPECT_NEAR(found / kCandela, 1.0, 0.015);
  std::string bare = capture;
  bare.erase(bare.find("camera = "), std::string("camera = \"camera.json\"\n").size());
  const json by_iso = LightcalJson("fit", {Session(bare), "-o", out, "--force"})["lights"].at(0);
  EXPECT_LT(u95, double(by_iso["intensity_cd"]["u95"]));
  const json& prior = light["fit"]["prior"];
  EXPECT_EQ(std::ranges::find(prior, "camera_scale"), prior.end());
  ExpectRefusal({"fit", Session(capture + "nd = \"nd3\"\n"), "-o", out, "--force"}, "unknown_nd");
}

}  // namespace
}  // namespace lightcal::test
