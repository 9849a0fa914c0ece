// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/calibrate_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "lightcal_devices/disk_sources.h"
#include "run_cli.h"

namespace lightcal {
namespace {

using test::SampleData;
using test::TempDir;
using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

// 48 cd by the inverse square: nothing sends light back.
const char* const kTwoReadings = R"(lightcal = 1
[room]
dark = true
[[light]]
name = "key"
kind = "point"
[[reading]]
light = "key"
distance_m = 0.5
illuminance_lx = 192.0
spectrum = "lamp"
[[reading]]
light = "key"
distance_m = 1.0
illuminance_lx = 48.0
)";

// Files asked for by their contents, how often.
struct Asked {
  std::map<std::string, int> spectra, hashes;
};

// Sources that have one spectrum, of any name, and no disk but for session.toml.
Sources OneSpectrumSources(const std::shared_ptr<Asked>& asked) {
  Sources sources = devices::DiskSources();
  sources.read_spectra = [asked](const std::string& path) -> Result<ImportedFile> {
    ++asked->spectra[path];
    ImportedFile file;
    file.spectra.resize(1);
    file.spectra[0].spectrum.wavelengths_nm = {400.0, 500.0, 600.0, 700.0};
    file.spectra[0].spectrum.values = {1.0, 1.0, 1.0, 1.0};
    file.warnings = {{"relative_spectrum", path, "has no unit"}};
    return file;
  };
  sources.sha256 = [asked](const std::string& path) -> Result<std::string> {
    ++asked->hashes[path];
    return std::string(64, 'a');
  };
  return sources;
}

TEST(CalibrateSession, OpensWhatASessionNamesThroughItsSourcesAlone) {
  const TempDir folder;
  const std::string toml = folder.Write("session.toml", kTwoReadings);
  const std::string lamp = folder.path() + "/lamp";  // which no disk has
  const auto asked = std::make_shared<Asked>();
  const auto done = CalibrateSession(folder.path(), OneSpectrumSources(asked), {});
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_THAT(asked->spectra, ElementsAre(Pair(lamp, 1)));
  EXPECT_THAT(asked->hashes, UnorderedElementsAre(Pair(toml, 1), Pair(lamp, 1)));
  ASSERT_EQ(done->lights.provenance.inputs.size(), 2U);
  EXPECT_EQ(done->lights.provenance.inputs[1].path, "lamp");
  EXPECT_EQ(done->lights.provenance.inputs[1].sha256, std::string(64, 'a'));
  ASSERT_EQ(done->lights.lights.size(), 1U);
  EXPECT_NEAR(done->lights.lights[0].intensity_cd->value, 48.0, 1.0);
  EXPECT_TRUE(done->lights.lights[0].color.xy);
}

TEST(CalibrateSession, GivesTheSpectrumAsItsFileHasItAndTheWarningsOfItsFiles) {
  const TempDir folder;
  folder.Write("session.toml", kTwoReadings);
  CalibrationSettings coarse;
  coarse.profile.spectral_step_nm = 150.0;
  const auto done =
      CalibrateSession(folder.path(), OneSpectrumSources(std::make_shared<Asked>()), coarse);
  ASSERT_TRUE(done) << done.error().message;
  ASSERT_EQ(done->spectra.size(), 1U);
  EXPECT_EQ(done->spectra[0].light, "key");
  EXPECT_EQ(done->spectra[0].file, "lamp");
  EXPECT_EQ(done->spectra[0].spectrum.wavelengths_nm.size(), 4U);
  ASSERT_FALSE(done->remarks.warnings.empty());
  EXPECT_EQ(done->remarks.warnings[0].code, "relative_spectrum");
}

TEST(CalibrateSession, GivesThePicturesThatItMeasured) {
  const auto done =
      CalibrateSession(SampleData("sessions/grey_card_exr"), devices::DiskSources(), {});
  ASSERT_TRUE(done) << done.error().message;
  ASSERT_EQ(done->pictures.size(), 1U);
  const RecordedPicture& picture = done->pictures[0];
  EXPECT_EQ(picture.use, "card");
  EXPECT_LE(picture.width, kLongestRecordedSide);
  EXPECT_EQ(picture.nits.size(), static_cast<std::size_t>(picture.width * picture.height));
}

TEST(CalibrateSession, ARefusalComesWithTheWarningsBeforeIt) {
  const TempDir folder;
  folder.Write("session.toml", std::string(kTwoReadings));
  folder.Write("readings.jsonl", "{\"light\": \"nobody\"}\n");
  const auto done = CalibrateSession(folder.path(), devices::DiskSources(), {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, "not_found");
  ASSERT_EQ(done.error().remarks.warnings.size(), 1U);
  EXPECT_EQ(done.error().remarks.warnings[0].code, "bad_reading");
}

TEST(CalibrateSession, TheTimeOfProvenanceIsTheOneGivenElseThatOfTheNewestReading) {
  const TempDir folder;
  folder.Write("session.toml", R"(lightcal = 1
[[light]]
name = "key"
kind = "point"
[[reading]]
light = "key"
distance_m = 0.5
illuminance_lx = 192.0
time = "2026-01-02T03:04:05Z"
[[reading]]
light = "key"
distance_m = 1.0
illuminance_lx = 48.0
time = "2026-01-02T03:05:05Z"
)");
  CalibrationSettings settings;
  const auto newest = CalibrateSession(folder.path(), devices::DiskSources(), settings);
  settings.time = "2027-01-01T00:00:00Z";
  const auto given = CalibrateSession(folder.path(), devices::DiskSources(), settings);
  ASSERT_TRUE(newest && given);
  EXPECT_EQ(newest->lights.provenance.time, "2026-01-02T03:05:05Z");
  EXPECT_EQ(given->lights.provenance.time, settings.time);
}

TEST(CalibrateSession, IsTheSameMeasuredFirstAndFittedThen) {
  const std::string session = SampleData("sessions/lit_wall");
  const Sources sources = devices::DiskSources();
  const auto whole = CalibrateSession(session, sources, {});
  auto measured = MeasureSession(session, sources, {});
  ASSERT_TRUE(whole && measured);
  const auto fitted = FitMeasured(*std::move(measured), sources, {});
  ASSERT_TRUE(fitted);
  ASSERT_EQ(whole->lights.lights.size(), fitted->lights.lights.size());
  EXPECT_EQ(whole->lights.lights[0].flux_lm->value, fitted->lights.lights[0].flux_lm->value);
  EXPECT_EQ(whole->remarks.warnings.size(), fitted->remarks.warnings.size());
  EXPECT_EQ(whole->pictures.size(), 1U);
}

}  // namespace
}  // namespace lightcal
