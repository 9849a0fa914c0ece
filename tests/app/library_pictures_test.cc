// SPDX-License-Identifier: Apache-2.0
// Whoever links the library gets the pictures that whoever types the command gets.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dome_pictures.h"
#include "lightcal/calibrate/dome/make_dome.h"
#include "lightcal/calibrate/inspect_picture.h"
#include "lightcal/calibrate/merge_bracket.h"
#include "lightcal_devices/captures/picture.h"
#include "lightcal_devices/disk_sources.h"
#include "merge_brackets.h"

namespace lightcal::test {
namespace {

using devices::DiskSources;

using nlohmann::json;

TEST(MergeBracket, GivesTheSamplesThatTheCommandWrites) {
  const TempDir folder;
  const SyntheticCamera camera = merge::Camera();
  const auto files = merge::ShootAll(folder, camera, merge::Series(), merge::Wedge(camera).Scene());
  const std::string output = folder.path() + "/lum.exr";
  const json answer = merge::MergeJson(files, output);
  const auto merged = MergeBracket(files, DiskSources(), {});
  ASSERT_TRUE(merged) << merged.error().message;
  EXPECT_EQ(merged->picture, merge::ReadExr(output).samples);
  EXPECT_EQ(WordOf(merged->scale_source), answer["scale"]["source"].get<std::string>());
  EXPECT_EQ(merged->nits_per_unit, answer["scale"]["nits_per_unit"].get<double>());
}

TEST(MakeDome, GivesTheSamplesThatTheCommandWrites) {
  const TempDir folder;
  SkyScene scene = dome::ClearSky(RayAt(37.3, 41.7));
  scene.lamps = {dome::Sun(RayAt(37.3, 41.7))};
  const SkyPicture sky = Photograph(scene, LatLongView(256, 128), 256, 128);
  const std::string file = dome::WritePicture(folder, "sky.exr", sky, 1.0, true);
  const std::string out = folder.path() + "/out";
  const json answer = dome::DomeJson(file, out, {"--extract", "1"});
  DomeSettings settings;
  settings.extract = 1;
  const auto made = MakeDome({file}, DiskSources(), settings);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->measured.input.dome.samples, dome::ReadPictureFile(out + "/dome.exr").rgb);
  ASSERT_FALSE(made->light_file.lights.empty());
  EXPECT_EQ(made->light_file.lights.front().name, answer["lights"][0]["name"].get<std::string>());
  EXPECT_EQ(made->light_file.provenance.inputs.size(), 1U);
}

TEST(MergeBracket, OfNoFrameIsRefused) {
  const auto merged = MergeBracket(Bracket{}, DiskSources(), {});
  ASSERT_FALSE(merged);
  EXPECT_EQ(merged.error().code, "no_frames");
}

TEST(MakeDome, OfNoPictureOrAnImpossibleSettingIsRefused) {
  const auto code = [](const std::vector<std::string>& files, const DomeSettings& settings) {
    const auto made = MakeDome(files, DiskSources(), settings);
    return made ? std::string("made") : made.error().code;
  };
  EXPECT_EQ(code({}, {}), "no_pictures");
  const TempDir folder;
  const SkyPicture sky = Photograph(dome::ClearSky(RayAt(37.3, 41.7)), LatLongView(64, 32), 64, 32);
  const std::string file = dome::WritePicture(folder, "sky.exr", sky, 1.0, true);
  DomeSettings settings;
  settings.white = Xy{0.0, 0.0};
  EXPECT_EQ(code({file}, settings), "bad_chromaticity");
  settings.white.reset();
  settings.plate = CameraSettings{0.0, Seconds(0.01), 100.0};
  EXPECT_EQ(code({file}, settings), "not_positive");
  settings.plate->f_number = 8.0;
  EXPECT_EQ(code({file}, settings), "made");
}

TEST(InspectPicture, GivesTheLuminanceThatTheCommandPrints) {
  const TempDir folder;
  const std::string file = folder.path() + "/flat.exr";
  const std::vector<float> nits(64, 12.5F);
  devices::ExrPicture exr;
  exr.samples = View2d<const float>(nits.data(), 8, 8);
  exr.channel_names = {"Y"};
  exr.white_luminance = Nits(2.0);
  ASSERT_TRUE(devices::WriteExr(file, exr));
  const auto seen = InspectPicture(file, DiskSources(), {}, LuminanceConvention::kPhotometric);
  ASSERT_TRUE(seen) << seen.error().message;
  const CliResult printed = RunLightcal({"inspect", file, "--json"});
  EXPECT_EQ(json::parse(printed.out)["luminance_nits"]["mean"], 25.0);
  EXPECT_EQ(seen->luminance.nits, std::vector<float>(64, 25.0F));
}

TEST(DiskSources, HashTheBytesThatWereReadAndNotThoseThatCameLater) {
  const TempDir folder;
  const std::string file = folder.Write("camera.json", "one");
  const Sources sources = DiskSources();
  ASSERT_EQ(*sources.read_text(file), "one");
  folder.Write("camera.json", "other");
  EXPECT_EQ(*sources.read_text(file), "one");
  // SHA-256 of "one" and of "other".
  EXPECT_EQ(*sources.sha256(file),
            "7692c3ad3540bb803c020b3aee66cd8887123234ea0c6e7143c0add73ff431ed");
  EXPECT_EQ(*DiskSources().sha256(file),
            "d9298a10d1b0735837dc4bd85dac641b0f3cef27a47e5d53a54f2f3f5b2fcffa");
}

TEST(DiskSources, SayWhichFileIsNotThere) {
  const auto text = DiskSources().read_text("/nowhere/camera.json");
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, "not_found");
  EXPECT_EQ(text.error().subject, "/nowhere/camera.json");
}

}  // namespace
}  // namespace lightcal::test
