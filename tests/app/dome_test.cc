// SPDX-License-Identifier: Apache-2.0
// lightcal dome, driven as a shell would. Truth is brute force: tests/tools/synthetic_sky.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "dome_pictures.h"

namespace lightcal::test::dome {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kWidth = 1024;
constexpr double kUnknownUnit = 1234.5;  // cd/m^2 of 1.0 in files that do not say

SkyPicture Photograph(const SkyScene& scene) {
  return Photograph(scene, LatLongView(kWidth, kWidth / 2), kWidth, kWidth / 2);
}

void Clip(SkyPicture& picture, float level) {
  for (float& v : picture.rgb) v = std::min(v, level);
}

struct Place {
  const char* name;
  double azimuth, elevation;
};
class SunInTheSky : public testing::TestWithParam<Place> {
 protected:
  void SetUp() override {
    scene_ = ClearSky(direction_);
    scene_.lamps = {Sun(direction_)};
    lux_ = TrueLux(scene_, kUp);
  }
  void ExpectTheSun(const json& document, double lux_tolerance) const {
    const Found sun = LightAt(document, direction_);
    EXPECT_NEAR(sun.light["illuminance_lx"]["value"].get<double>() / 9e4, 1.0, lux_tolerance);
    EXPECT_LT(sun.off_deg, 0.2);
    EXPECT_EQ(sun.light["name"], "sun");
    EXPECT_EQ(sun.light["extracted"], true);
  }

  Ray direction_ = RayAt(GetParam().azimuth, GetParam().elevation);
  SkyScene scene_;
  double lux_ = 0.0;
  TempDir folder_;
  std::string out_ = folder_.path() + "/out";
};
INSTANTIATE_TEST_SUITE_P(At, SunInTheSky,
                         testing::Values(Place{"Noon", 37.3, 41.7}, Place{"Seam", 179.93, 30.2},
                                         Place{"Zenith", -12.34, 88.6}),
                         [](const auto& place) { return std::string(place.param.name); });

TEST_P(SunInTheSky, IsTakenOutWithItsLuxDirectionAndColour) {
  const std::string file =
      WritePicture(folder_, "sky.exr", Photograph(scene_), kUnknownUnit, false);
  const json got = DomeJson(file, out_, {"--lux", Text(lux_), "--extract", "1"});
  EXPECT_NEAR(got["scale"]["factor"].get<double>() / kUnknownUnit, 1.0, 0.02);
  EXPECT_EQ(got["scale"]["source"], "lux");
  ExpectTheSun(got, 0.01);
  const json sun = LightAt(got, direction_).light;
  EXPECT_EQ(sun["source"], "pixels");
  EXPECT_NEAR(sun["angular_diameter_deg"].get<double>(), 0.5, 0.12);
  EXPECT_NEAR(sun["color"]["xy"][0].get<double>(), 0.3264, 1e-3);
  EXPECT_NEAR(sun["color"]["xy"][1].get<double>(), 0.3457, 1e-3);
  // What stays is the sky with its aureole.
  const SkyPicture sky = ReadPictureFile(out_ + "/dome.exr");
  SkyScene without = scene_;
  without.lamps.clear();
  EXPECT_NEAR(LuxOfPicture(sky, kUp) / TrueLux(without, kUp), 1.0, 0.02);
  EXPECT_TRUE(fs::exists(out_ + "/dome.png"));
}

// A camera without a dense filter: the disc is lost, everything else is in cd/m^2.
TEST_P(SunInTheSky, ThatClippedIsInferredFromTheLux) {
  SkyPicture picture = Photograph(scene_);
  Clip(picture, 4e5F);
  const std::string file = WritePicture(folder_, "sky.exr", picture, 1.0, true);
  const json got = DomeJson(file, out_, {"--lux", Text(lux_), "--extract", "1"});
  ExpectTheSun(got, 0.01);
  EXPECT_EQ(LightAt(got, direction_).light["source"], "inferred");
  EXPECT_EQ(got["scale"]["source"], "white_luminance");
  EXPECT_NEAR(got["illuminance_lx"]["up"]["total"].get<double>() / lux_, 1.0, 1e-3);
}

TEST_P(SunInTheSky, ThatClippedInUnknownUnitsNeedsAShadedReading) {
  SkyPicture picture = Photograph(scene_);
  Clip(picture, 4e5F);
  const std::string file = WritePicture(folder_, "sky.exr", picture, kUnknownUnit, false);
  SkyScene shaded = scene_;
  shaded.lamps.clear();
  const std::string clip = Text(4e5 / kUnknownUnit * 0.999);
  ExpectRefused(file, out_, "clipped_scale_unknown", {"--lux", Text(lux_), "--clip", clip});
  const json got = DomeJson(file, out_,
                            {"--lux", Text(lux_), "--lux-shaded", Text(TrueLux(shaded, kUp)),
                             "--clip", clip, "--extract", "1"});
  EXPECT_NEAR(got["scale"]["factor"].get<double>() / kUnknownUnit, 1.0, 0.02);
  ExpectTheSun(got, 0.01);
}

// A half float's limit: so little is left of the disc that it is no light by what it shows. Neither
// may the whole dome pay for what it lacks, nor a stated clip change nothing.
TEST_P(SunInTheSky, ThatClippedAlmostWhollyIsInferredToo) {
  SkyPicture picture = Photograph(scene_);
  Clip(picture, 65504.0F);
  const std::string file = WritePicture(folder_, "sky.exr", picture, 1.0, true);
  for (const Words& more : {Words{}, Words{"--clip", "65504"}, Words{"--clip", "60000"}}) {
    Words words = {"--lux", Text(lux_), "--extract", "1", "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const json got = DomeJson(file, out_, words);
    EXPECT_EQ(got["scale"]["source"], "white_luminance");
    const Found sun = LightAt(got, direction_);
    EXPECT_NEAR(sun.light["illuminance_lx"]["value"].get<double>() / 9e4, 1.0, 0.02);
    EXPECT_EQ(sun.light["source"], "inferred");
    EXPECT_LT(sun.off_deg, 0.2);
  }
}

class DomeCommand : public testing::Test {
 protected:
  [[nodiscard]] SkyScene SunnyScene() const {
    SkyScene scene = ClearSky(sun_);
    scene.lamps = {Sun(sun_)};
    return scene;
  }
  const Ray sun_ = RayAt(37.3, 41.7);
  TempDir folder_;
  std::string out_ = folder_.path() + "/out";
};

TEST_F(DomeCommand, RefusesALuxReadingBelowWhatTheRestAloneGives) {
  SkyPicture picture = Photograph(SunnyScene());
  Clip(picture, 4e5F);
  const std::string file = WritePicture(folder_, "sky.exr", picture, 1.0, true);
  ExpectRefused(file, out_, "lux_below_rest", {"--lux", "9000", "--clip", "3.9e5"});
  ExpectRefused(file, out_, "lux_misses_light",
                {"--lux", "90000", "--lux-direction", "down", "--clip", "3.9e5"});
}

// An even sky but for four pixels, whose sun is 50 klx: what is left of it is a thousandth of the
// light, and still what the card shaded.
TEST_F(DomeCommand, ACardShadesWhatIsClippedToAFewPixels) {
  const Ray direction = RayAt(37.3, 41.7);
  SkyPicture picture;
  picture.width = 512;
  picture.height = 256;
  picture.rgb.assign(3UL * 512 * 256, 3000.0F);
  for (const int y : {68, 69}) {
    for (const int x : {308, 309}) {
      for (int c = 0; c < 3; ++c) picture.rgb[3UL * (y * 512 + x) + c] = 65504.0F;
    }
  }
  const double rest = 3000.0 * std::numbers::pi;
  const double lux = rest + 5e4 * std::sin(41.7 / 180.0 * std::numbers::pi);
  for (const bool absolute : {true, false}) {
    const std::string file =
        WritePicture(folder_, "sky.exr", picture, absolute ? 1.0 : 7.0, absolute);
    const json got = DomeJson(
        file, out_, {"--lux", Text(lux), "--lux-shaded", Text(rest), "--extract", "1", "--force"});
    EXPECT_NEAR(got["scale"]["factor"].get<double>(), absolute ? 1.0 : 7.0, 0.01);
    const Found sun = LightAt(got, direction);
    EXPECT_NEAR(sun.light["illuminance_lx"]["value"].get<double>() / 5e4, 1.0, 0.02);
    EXPECT_LT(sun.off_deg, 0.5);
  }
}

TEST_F(DomeCommand, AClipThatNothingReachesIsNamed) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(ClearSky(sun_)), 1.0, true);
  EXPECT_TRUE(Warns(DomeJson(file, out_, {"--clip", "1e9"}), "clip_unused"));
  EXPECT_FALSE(Warns(DomeJson(file, out_, {"--clip", "1000", "--force"}), "clip_unused"));
}

// Six lamps in a real room: discs, blurred ones, two whose glow meets, one across the seam, one
// near the nadir.
class SixLamps : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(In, SixLamps, testing::Values("lobby", "studio", "sunset"),
                         [](const auto& room) { return std::string(room.param); });

TEST_P(SixLamps, AreFoundAndTakenOut) {
  const TempDir folder;
  SkyPicture room =
      ReadPictureFile(SampleData(std::string("pictures/latlong/") + GetParam() + ".hdr"));
  const double unlit = LuxOfPicture(room, kUp);
  const Rgb3 white = {1.0, 1.0, 1.0}, warm = {1.6 / 1.0276, 0.93 / 1.0276, 0.3 / 1.0276};
  std::vector<SkyLamp> lamps = {{RayAt(20.0, 62.0), 1.2, 9.0 * unlit, white, 0.0, false},
                                {RayAt(27.5, 62.0), 0.5, 4.5 * unlit, warm, 0.0, true},
                                {RayAt(179.9, 35.0), 2.1, 7.5 * unlit, white, 0.5, false},
                                {RayAt(-80.0, 15.0), 0.7, 3.3 * unlit, warm, 0.0, true},
                                {RayAt(100.0, -20.0), 0.4, 5.7 * unlit, white, 0.0, false},
                                {RayAt(-30.0, -84.0), 1.5, 6.6 * unlit, warm, 0.0, false}};
  AddLamps(lamps, LatLongView(room.width, room.height), room);
  const std::string file = WritePicture(folder, "room.exr", room, 17.0);
  const std::string out = folder.path() + "/out";
  const double lux = LuxOfPicture(room, kUp);
  // They were drawn, flat to their rims: no sample is clipped.
  const json got = DomeJson(file, out, {"--lux", Text(lux), "--extract", "6", "--clip", "1e12"});
  for (const SkyLamp& lamp : lamps) {
    const Found found = LightAt(got, lamp.direction);
    EXPECT_LT(found.off_deg, 0.5);
    EXPECT_NEAR(
        found.light["illuminance_lx"]["value"].get<double>() / (lamp.lux * Luminance(lamp.tint)),
        1.0, 0.02)
        << found.light.dump();
    EXPECT_EQ(found.light["extracted"], true) << found.light.dump();
  }
  // As sure in the file as in the answer: nothing but the lamp was cut out of the picture.
  const json lights = json::parse(ReadFile(out + "/light.json"));
  for (const json& told : got["lights"]) {
    const auto kept = std::ranges::find_if(
        lights["lights"], [&](const json& light) { return light["name"] == told["name"]; });
    if (kept == lights["lights"].end()) continue;
    const json& strength =
        kept->contains("illuminance_lx") ? (*kept)["illuminance_lx"] : (*kept)["luminance_nits"];
    const auto relative = [](const json& u) {
      return u["u95"].get<double>() / u["value"].get<double>();
    };
    EXPECT_NEAR(relative(strength) / relative(told["illuminance_lx"]), 1.0, 0.02) << told;
  }
  // The files alone give what the picture gave to planes whose horizon no lamp crosses.
  const SkyPicture dome = ReadPictureFile(out + "/dome.exr");
  for (const Ray& normal :
       {kUp, Ray{0.0, 0.0, -1.0}, RayAt(0.0, 0.0), RayAt(70.0, 10.0), RayAt(-135.0, 20.0)}) {
    const double total = LuxOfPicture(room, normal);
    EXPECT_NEAR((LuxOfLights(lights, normal) + LuxOfPicture(dome, normal)) / total, 1.0, 0.005);
  }
}

TEST_F(DomeCommand, TheLightsBecomePresets) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 1.0, true);
  DomeJson(file, out_, {"--extract", "1"});
  const json sun = json::parse(ReadFile(out_ + "/light.json"))["lights"][0];
  EXPECT_EQ(sun["kind"], "directional");
  EXPECT_NEAR(sun["angular_diameter_deg"].get<double>(), 0.5, 0.12);
  EXPECT_TRUE(sun["color"].contains("cct_K"));
  const CliResult exported = RunLightcal(
      {"export", out_ + "/light.json", "--to", "gltf,json", "-o", folder_.path() + "/presets"});
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  const json gltf = json::parse(ReadFile(folder_.path() + "/presets/light.gltf"));
  EXPECT_EQ(gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["type"], "directional");
}

// What a meter shows however it is turned: the picture's, by brute force. It was an even
// hemisphere's, half of the upward light to every side and nothing from below.
TEST_F(DomeCommand, SimulateLooksIntoThePicture) {
  const SkyScene scene = SunnyScene();
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(scene), 1.0, true);
  DomeJson(file, out_, {"--extract", "1"});
  for (const Ray& normal : {kUp, RayAt(0, 0), RayAt(90, 0), RayAt(180, 0), RayAt(-90, 0),
                            RayAt(30, 45), RayAt(-120, -30), Ray{0, 0, -1}}) {
    std::ostringstream turned;
    turned << "--normal=" << normal[0] << "," << normal[1] << "," << normal[2];
    const json seen = json::parse(
        RunLightcal({"simulate", out_ + "/light.json", "--at", "0,0,0", turned.str(), "--json"})
            .out)["points"][0]["illuminance_lx"];
    const double truth = TrueLux(scene, normal);
    EXPECT_NEAR(double(seen["value"]) / truth, 1.0, 0.01) << turned.str();
  }
}

// One reading that looks up says little of the sides: half a lobby's light came from them.
TEST_F(DomeCommand, ASkyThatNobodySawIsUnsureToItsSides) {
  folder_.Write("session.toml",
                "lightcal = 1\n[[light]]\nname = \"sky\"\nkind = \"dome\"\n[[reading]]\n"
                "light = \"sky\"\nilluminance_lx = 1000\nsigma_relative = 0.02\n");
  const auto seen = [&](const std::string& normal) {
    return json::parse(
        RunLightcal({"simulate", folder_.path(), "--at", "0,0,0", "--normal=" + normal, "--json"})
            .out)["points"][0]["illuminance_lx"];
  };
  EXPECT_NEAR(double(seen("0,0,1")["value"]), 1000.0, 1.0);
  EXPECT_LT(double(seen("0,0,1")["u95"]), 80.0);
  // The hall of sample_data's lobby.hdr, whose upward light is 1000 lx.
  for (const double truth : {962.0, 789.0, 729.0, 974.0}) {
    EXPECT_NEAR(double(seen("1,0,0")["value"]), truth, double(seen("1,0,0")["u95"]));
  }
  EXPECT_NEAR(double(seen("0,0,-1")["value"]), 452.0, double(seen("0,0,-1")["u95"]));
}

// L_max of f/8, 1/60 s, ISO 100 is 120 N^2/(t S) = 4608 cd/m^2.
TEST_F(DomeCommand, ThePlateExposureIsWhatSaturatesAtOne) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 1.0, true);
  const json got = DomeJson(file, out_, {"--extract", "1", "--plate-exposure", "f/8,1/60,100"});
  EXPECT_NEAR(got["white_luminance_nits"].get<double>(), 4608.0, 1e-6);
  const json seen = json::parse(RunLightcal({"inspect", out_ + "/dome.exr", "--json"}).out);
  EXPECT_NEAR(
      seen["illuminance_lx"].get<double>() / got["illuminance_lx"]["up"]["remaining"].get<double>(),
      1.0, 1e-4);
  EXPECT_EQ(Dome(file, out_ + "2", {"--plate-exposure", "f/8,1/60"}).exit_code, 2);
}

TEST_F(DomeCommand, NorthTurnsDomeAndLightsTogether) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 1.0, true);
  const json got = DomeJson(file, out_, {"--extract", "1", "--north", "50.3"});
  EXPECT_LT(LightAt(got, RayAt(37.3 - 50.3, 41.7)).off_deg, 0.05);
  SkyScene aureole = ClearSky(RayAt(37.3 - 50.3, 41.7));
  const Ray towards = RayAt(37.3 - 50.3, 0.0);
  EXPECT_NEAR(
      LuxOfPicture(ReadPictureFile(out_ + "/dome.exr"), towards) / TrueLux(aureole, towards), 1.0,
      0.01);
}

TEST_F(DomeCommand, SpaceAndWhiteKeepTheLuminance) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 1.0, true);
  const json plain = DomeJson(file, out_, {"--extract", "1"});
  const json adapted =
      DomeJson(file, out_ + "2", {"--extract", "1", "--space", "acescg", "--white", "5000K"});
  const auto lux = [](const std::string& path) {
    return json::parse(RunLightcal({"inspect", path, "--json"}).out)["illuminance_lx"]
        .get<double>();
  };
  EXPECT_NEAR(lux(out_ + "2/dome.exr") / lux(out_ + "/dome.exr"), 1.0, 1e-5);
  // 5000 K becomes ACES' white, and the sun with it: bluer than it was.
  EXPECT_LT(adapted["lights"][0]["color"]["xy"][0], plain["lights"][0]["color"]["xy"][0]);
}

TEST_F(DomeCommand, ALargeLightBecomesAnAreaLight) {
  SkyScene scene;
  scene.background = [](const Ray&) { return Rgb3{10.0, 10.0, 10.0}; };
  scene.lamps = {{RayAt(-60.0, 30.0), 8.0, 500.0, {1.0, 1.0, 1.0}, 0.0, false}};
  const std::string file = WritePicture(folder_, "room.exr", Photograph(scene), 1.0, true);
  DomeJson(file, out_, {"--extract", "1"});
  const json light = json::parse(ReadFile(out_ + "/light.json"))["lights"][0];
  EXPECT_EQ(light["kind"], "rect");
  // The square that looks as large as the disc, as bright.
  const double side = light["width_m"].get<double>();
  EXPECT_NEAR(2.0 * std::atan(side / 2.0) * 180.0 / std::numbers::pi, 16.0 * std::sqrt(0.75), 0.3);
  EXPECT_NEAR(light["luminance_nits"]["value"].get<double>(), scene.lamps[0].MiddleNits(),
              0.08 * scene.lamps[0].MiddleNits());
}

TEST_F(DomeCommand, TheConventionIsAPersonsWord) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 179.0, false);
  const json assumed = DomeJson(file, out_, {});
  EXPECT_TRUE(Warns(assumed, "relative_scale"));
  EXPECT_EQ(assumed["scale"]["source"], "assumed_nits");
  const json radiance = DomeJson(file, out_, {"--luminance-convention", "radiance"});
  EXPECT_FALSE(Warns(radiance, "relative_scale"));
  EXPECT_EQ(radiance["scale"]["source"], "radiance_179");
  // Nothing was taken out: the dome alone.
  const json lights = json::parse(ReadFile(out_ + "/light.json"))["lights"];
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_EQ(lights[0]["environment"],
            json({{"file", "dome.exr"}, {"projection", "latlong"}, {"nits_per_unit", 1.0}}));
  EXPECT_EQ(lights[0]["illuminance_lx"]["value"], radiance["illuminance_lx"]["up"]["remaining"]);
}

// What nobody states is not known to .01 %, however often it is written out and read again.
TEST_F(DomeCommand, AUnitThatNobodyStatesGivesNoLux) {
  const std::string file = WritePicture(folder_, "sky.exr", Photograph(SunnyScene()), 179.0, false);
  const auto widest = [](const json& lux) {
    return lux["high95"].get<double>() / lux["low95"].get<double>();
  };
  const json assumed = DomeJson(file, out_, {"--extract", "1"});
  EXPECT_GT(widest(assumed["lights"][0]["illuminance_lx"]), 1e7);
  for (const json& light : json::parse(ReadFile(out_ + "/light.json"))["lights"]) {
    EXPECT_GT(widest(light["illuminance_lx"]), 1e7) << light["name"];
  }
  const json again = DomeJson(out_ + "/dome.exr", out_ + "2", {});
  EXPECT_TRUE(Warns(again, "relative_scale"));
  const CliResult people = RunLightcal({"dome", file, "-o", out_ + "3"});
  EXPECT_THAT(people.out, AllOf(HasSubstr("not in lux"), Not(HasSubstr("±"))));

  // In cd/m^2, but by a file that does not say how sure.
  const std::string stated = WritePicture(folder_, "nits.exr", Photograph(SunnyScene()), 1.0, true);
  const json known = DomeJson(stated, out_ + "4", {"--extract", "1"});
  EXPECT_NEAR(known["scale"]["u95_relative"], 0.2, 1e-12);
  const json& sun = known["lights"][0]["illuminance_lx"];
  EXPECT_GE(sun["u95"].get<double>() / sun["value"].get<double>(), 0.2);
  EXPECT_FALSE(Warns(DomeJson(out_ + "4/dome.exr", out_ + "5", {}), "relative_scale"));
}

TEST_F(DomeCommand, HostilePicturesAreNamed) {
  const auto picture = [&](const std::string& name, int width, int height, auto value) {
    SkyPicture p{width, height, std::vector<float>(std::size_t(width) * height * 3, 1.0F)};
    value(p.rgb);
    return WritePicture(folder_, name, p, 1.0, true);
  };
  ExpectRefused(picture("black.exr", 64, 32, [](auto& v) { v.assign(v.size(), 0.0F); }), out_,
                "all_black", {});
  ExpectRefused(picture("white.exr", 64, 32, [](auto& v) { v.assign(v.size(), 65504.0F); }), out_,
                "all_saturated", {});
  ExpectRefused(picture("hot.exr", 64, 32, [](auto& v) { v[600] = 1e30F; }), out_, "over_range",
                {"--lux", "100"});
  ExpectRefused(picture("square.exr", 64, 64, [](auto& v) { v[0] = 2.0F; }), out_, "bad_view", {});
  // Uniform: E = pi L. Said, but measured.
  const json even =
      DomeJson(picture("even.exr", 64, 32, [](auto&) {}), out_, {"--lux", "314.159265"});
  EXPECT_TRUE(Warns(even, "all_saturated"));
  EXPECT_NEAR(even["scale"]["factor"].get<double>(), 100.0, 1e-6);
  EXPECT_TRUE(even["lights"].empty());

  // Our writer refuses NaN and infinity: they are put into its file by hand.
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32 +X 64\n";
  hdr += std::string(std::size_t{32} * 64 * 4, '\x80');
  ExpectRefused(folder_.Write("cut.hdr", hdr.substr(0, hdr.size() / 2)), out_ + "3", "bad_picture",
                {});
  constexpr float kMark = 12345.0F;
  const std::string whole = ReadFile(picture("whole.exr", 64, 32, [](auto& v) { v[0] = kMark; }));
  const auto bytes = [](float v) {
    std::string text(sizeof v, '\0');
    std::memcpy(text.data(), &v, sizeof v);
    return text;
  };
  for (const float bad : {std::nanf(""), HUGE_VALF, 2e30F}) {
    std::string spoilt = whole;
    spoilt.replace(spoilt.find(bytes(kMark)), sizeof bad, bytes(bad));
    const json masked =
        DomeJson(folder_.Write("bad.exr", spoilt), out_ + "3", {"--lux", "314.159265"});
    EXPECT_TRUE(Warns(masked, "bad_samples"));
    EXPECT_NEAR(masked["scale"]["factor"].get<double>(), 100.0, 1e-6);
  }
}

TEST_F(DomeCommand, AskedWrongItSaysWhatToWrite) {
  const std::string file = SampleData("pictures/latlong/lobby.hdr");
  const auto fails = [&](const Words& more, int exit_code, const char* says) {
    const CliResult result = Dome(file, out_, more);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, HasSubstr(says));
  };
  fails({"--lux", "100", "--lux-direction", "north"}, 2, "AZIMUTH,ELEVATION");
  fails({"--lux-shaded", "10"}, 2, "--lux");
  fails({file}, 2, "need --aim auto, or --aim YAW,PITCH[,ROLL] once each");
  fails({"--aim", "10"}, 2, "YAW,PITCH[,ROLL]");
  fails({"--projection", "equisolid"}, 3, "give --fov");
  fails({"--aim", "0,0", "--width", "101"}, 2, "even count of pixels");
  fails({"--lux", "0"}, 3, "above 0");
  fails({"--lux", "100", "--lux-sigma", "2"}, 2, "2%");
  fails({"--extract", "-1"}, 2, "count");
  fails({"--plate-exposure", "8"}, 2, "f/8,1/60,100");
  fails({"--clip", "x"}, 2, "--clip");
  fails({"--space", "srgb2"}, 2, "rec709");
  EXPECT_FALSE(fs::exists(out_));
  const json got = DomeJson(file, out_, {"--lux", "420", "--extract", "50"});
  EXPECT_TRUE(Warns(got, "fewer_lights"));
  EXPECT_EQ(Dome(file, out_ + "2", {"--strict"}).exit_code, 3);  // relative
}

TEST_F(DomeCommand, SaysTheSameTwice) {
  const std::string file = SampleData("pictures/latlong/lobby.hdr");
  DomeJson(file, out_, {"--lux", "420", "--extract", "3"});
  const std::string exr = ReadFile(out_ + "/dome.exr"), light = ReadFile(out_ + "/light.json");
  DomeJson(file, out_, {"--lux", "420", "--extract", "3"});  // and replaces what it wrote
  EXPECT_EQ(ReadFile(out_ + "/dome.exr"), exr);
  EXPECT_EQ(ReadFile(out_ + "/light.json"), light);
}

}  // namespace
}  // namespace lightcal::test::dome
