// SPDX-License-Identifier: Apache-2.0
// three.js 0.187 IESLoader: an IES reader that shares nothing with ours.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lightcal/presets/exporters.h"
#include "lightcal/presets/light_distribution.h"
#include "lightcal/records/photometric_codec.h"
#include "run_cli.h"
#include "sample_lights.h"

namespace lightcal::test {
namespace {

using nlohmann::json;

json ThreeReads(const std::string& ies) {
  const TempDir folder;
  const std::string path = folder.Write("lamp.ies", ies);
  const CliResult result = RunProgram({"node", LIGHTCAL_READ_IES, LIGHTCAL_THREE_MODULES, path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out);
}

// Every texel against our interpolant, both relative to the peak.
void ExpectSameShape(const json& three, const IntensityTable& table) {
  EXPECT_EQ(three["revision"], "187");
  ASSERT_GE(three["rows"].size(), 1U);
  for (std::size_t c = 0; c < three["rows"].size(); ++c) {
    const json& row = three["rows"][c];
    ASSERT_EQ(row.size(), 180U);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double gamma = 180.0 * static_cast<double>(i) / 179.0;
      const double want =
          table.At(RadiansFromDegrees(static_cast<double>(c)), RadiansFromDegrees(gamma)) /
          table.peak().intensity;
      ASSERT_NEAR(row[i].get<double>(), want, 1e-5) << c << " " << gamma;
    }
  }
}

TEST(ThreeIesLoader, ReadsWhatEulumdatFilesBecome) {
  for (const char* name : {"sample1", "sample2", "sample5", "sample10"}) {
    const TempDir folder;
    const std::string path = folder.path() + "/lamp.ies";
    const CliResult made =
        RunLightcal({"photometric", SampleData(std::string("photometric/") + name + ".ldt"), "--to",
                     "ies", "-o", path});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string text = ReadFile(path);
    const auto read = PhotometricFromText(text, name);
    ASSERT_TRUE(read);
    const bool ends_at_horizon = read->file.table.grid().vertical_deg.back() < 180.0;
    const json three = ThreeReads(text);
    // It goes on in a straight line beyond the last angle: compare such files where they hold.
    if (!ends_at_horizon) ExpectSameShape(three, read->file.table);
  }
}

TEST(ThreeIesLoader, ReadsEveryKindThatExportWrites) {
  for (const LightKind kind : {LightKind::kPoint, LightKind::kSphere, LightKind::kDisk,
                               LightKind::kRect, LightKind::kTube}) {
    const FittedLight lamp = SimpleLight("lamp", kind, 300.0);
    const auto preset = ExportIes(FileOf({lamp}), "s", {});
    ASSERT_TRUE(preset);
    ExpectSameShape(ThreeReads(preset->files.at(0).contents), **DistributionOf(lamp));
  }
  const auto spot = ExportIes(FileOf({Spot()}), "s", {});
  ASSERT_TRUE(spot);
  ExpectSameShape(ThreeReads(spot->files.at(0).contents), **DistributionOf(Spot()));
}

TEST(ThreeIesLoader, GateCatchesNumbersOnOneLine) {
  std::string ies = ExportIes(FileOf({Spot()}), "s", {})->files.at(0).contents;
  // Ten and three numbers on one line: a file people do write.
  ies.replace(ies.find("\r\n1 1 0\r\n"), 2, " ");
  const TempDir folder;
  const std::string path = folder.Write("lamp.ies", ies);
  EXPECT_NE(RunProgram({"node", LIGHTCAL_READ_IES, LIGHTCAL_THREE_MODULES, path}).exit_code, 0);
}

}  // namespace
}  // namespace lightcal::test
