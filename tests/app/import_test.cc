// SPDX-License-Identifier: Apache-2.0
// lightcal import, driven as a person drives it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "run_cli.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

constexpr const char* kSession =
    "lightcal = 1\n"
    "[[light]]\nname = \"key\"\nkind = \"point\"\n"
    "[[light]]\nname = \"sun\"\nkind = \"directional\"\n"
    "[[meter]]\nname = \"cv600\"\nsigma_relative = 0.04\n";
const std::string kCasper = "spectra/uprtek_cv600/Casper Glow High.xls";

class Import : public testing::Test {
 protected:
  Import() { temp_.Write("s/session.toml", kSession); }

  [[nodiscard]] std::string Session() const { return temp_.path() + "/s"; }
  [[nodiscard]] std::string InSession(const std::string& name) const {
    return Session() + "/" + name;
  }
  [[nodiscard]] CliResult Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "import");
    arguments.insert(arguments.end(), {"-s", Session()});
    return RunLightcal(arguments);
  }
  // The lines of the journal; none when it does not exist.
  [[nodiscard]] std::vector<json> Journal() const {
    std::vector<json> lines;
    if (!fs::exists(InSession("readings.jsonl"))) return lines;
    std::istringstream text(ReadFile(InSession("readings.jsonl")));
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
  }

  TempDir temp_;
};

TEST_F(Import, WhatTheControlsSaidMayStandOnTheLine) {
  const std::string file = temp_.Write("half.csv", "distance_m,illuminance_lx\n1,60\n");
  ASSERT_EQ(Run({file, "--light", "key", "--state", "dimmer=50"}).exit_code, 0);
  const std::string own =
      temp_.Write("own.csv", "distance_m,illuminance_lx,state.dimmer\n1,30,25\n");
  ASSERT_EQ(Run({own, "--light", "key", "--state", "dimmer=50"}).exit_code, 0);
  ASSERT_EQ(Journal().size(), 2U);
  EXPECT_EQ(Journal()[0]["state"], (json{{"dimmer", 50.0}}));
  EXPECT_EQ(Journal()[1]["state"], (json{{"dimmer", 25.0}})) << "the file's own word counts first";
  EXPECT_EQ(Run({file, "--light", "key", "--state", "dimmer"}).exit_code, 2);
}

TEST_F(Import, ZonesOfTimesAreKept) {
  const std::string file = temp_.Write("zones.csv",
                                       "distance_m,illuminance_lx,time\n"
                                       "1,120,2026-11-28T10:00:00+02:00\n"
                                       "2,30,2026-11-28T09:00:00Z\n"
                                       "3,13.33,2026-11-28T10:00:00-05:00\n");
  ASSERT_EQ(Run({file, "--light", "key"}).exit_code, 0);
  EXPECT_EQ(Journal()[0]["time"], "2026-11-28T10:00:00+02:00");
  EXPECT_THAT(RunLightcal({"fit", Session()}).err, Not(HasSubstr("earlier time")));
}

TEST_F(Import, SpectrometerFileBecomesAReadingWithItsSpectrum) {
  const CliResult result = Run(
      {SampleData(kCasper), "--light", "key", "--distance", "50cm", "--meter", "cv600", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_THAT(Journal(), SizeIs(1));
  const json reading = Journal()[0];
  EXPECT_EQ(reading["light"], "key");
  EXPECT_EQ(reading["meter"], "cv600");
  EXPECT_EQ(reading["distance_m"], 0.5);
  EXPECT_EQ(reading["illuminance_lx"], 2925.355469);  // the file's LUX
  EXPECT_EQ(reading["cct_K"], 2655.0);
  EXPECT_EQ(reading["time"], "2017-05-05T03:58:23");
  EXPECT_EQ(reading["spectrum"], "captures/Casper Glow High.xls");
  EXPECT_EQ(ReadFile(InSession("captures/Casper Glow High.xls")), ReadFile(SampleData(kCasper)));
  const json answer = json::parse(result.out);
  EXPECT_EQ(answer["imported"], 1);
  EXPECT_EQ(answer["files"][0]["format"], "uprtek_xls");
  EXPECT_EQ(answer["readings"][0], reading);
}

TEST_F(Import, TableShowsWhatWasImported) {
  const CliResult result = Run({SampleData(kCasper), "--light", "key", "--distance", "0.5m"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("uprtek_xls"), HasSubstr("0.5000 m"),
                                HasSubstr("2925 lx"), HasSubstr("2655 K")));
  EXPECT_THAT(result.err, HasSubstr("1 reading appended"));
}

TEST_F(Import, SameFileTwiceAddsNothingUnlessForced) {
  const std::vector<std::string> command = {SampleData(kCasper), "--light", "key", "--distance",
                                            "0.5m"};
  ASSERT_EQ(Run(command).exit_code, 0);
  const std::string before = ReadFile(InSession("readings.jsonl"));
  std::vector<std::string> as_json = command;
  as_json.emplace_back("--json");
  const CliResult again = Run(as_json);
  EXPECT_EQ(again.exit_code, 0);
  const json answer = json::parse(again.out);
  EXPECT_EQ(answer["imported"], 0);
  EXPECT_EQ(answer["warnings"][0]["code"], "already_imported");
  EXPECT_EQ(ReadFile(InSession("readings.jsonl")), before);
  std::vector<std::string> strict = command;
  strict.emplace_back("--strict");
  EXPECT_EQ(Run(strict).exit_code, 3);
  std::vector<std::string> forced = command;
  forced.emplace_back("--force");
  EXPECT_EQ(Run(forced).exit_code, 0);
  EXPECT_THAT(Journal(), SizeIs(2));
}

TEST_F(Import, SameFileNamedTwiceCountsOnce) {
  const CliResult result =
      Run({SampleData(kCasper), SampleData(kCasper), "--light", "key", "--distance", "0.5m"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(Journal(), SizeIs(1));
  EXPECT_THAT(result.err, HasSubstr("in the session already"));
}

TEST_F(Import, EqualReadingsWithinOneFileAreRepeatsNotDuplicates) {
  const std::string csv = temp_.Write("two.csv", "distance_m,lux\n1,48\n1,48\n");
  ASSERT_EQ(Run({csv, "--light", "key"}).exit_code, 0);
  EXPECT_THAT(Journal(), SizeIs(2));
  ASSERT_EQ(Run({csv, "--light", "key"}).exit_code, 0);
  EXPECT_THAT(Journal(), SizeIs(2));
}

TEST_F(Import, LogThatGrewAddsOnlyWhatIsNew) {
  const std::string head = "#ActLogModel=2.0.0\nDEVICE_ID : 7\nDATE/TIME;LIGHT\n";
  const std::string first = head + "28/08/2023 08:47:54;1.5\n28/08/2023 08:48:04;3.5\n";
  temp_.Write("log.txt", first);
  ASSERT_EQ(Run({temp_.path() + "/log.txt", "--light", "sun"}).exit_code, 0);
  temp_.Write("log.txt", first + "28/08/2023 08:48:14;7.5\n");
  const CliResult result = Run({temp_.path() + "/log.txt", "--light", "sun"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("2 of 3 readings"));
  ASSERT_THAT(Journal(), SizeIs(3));
  EXPECT_EQ(Journal()[2]["illuminance_lx"], 7.5);
  EXPECT_EQ(Journal()[2]["time"], "2023-08-28T08:48:14");
}

TEST_F(Import, OneBadFileLeavesTheSessionAsItWas) {
  const std::string bad = temp_.Write("bad.csv", "distance_m,lux\n1,48\n-2,12\n");
  const CliResult result = Run({SampleData(kCasper), bad, "-l", "key", "-d", "0.5m", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "bad_row");
  EXPECT_EQ(json::parse(result.out)["error"]["subject"], "bad.csv:3");
  EXPECT_THAT(Journal(), IsEmpty());
  EXPECT_FALSE(fs::exists(InSession("captures")));
}

TEST_F(Import, UnknownLightIsRefusedNamingTheNearest) {
  const CliResult result = Run({SampleData(kCasper), "--light", "kez", "--distance", "1m"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("did you mean \"key\"?"));
  const CliResult meter =
      Run({SampleData(kCasper), "--light", "key", "-d", "1m", "--meter", "cv60"});
  EXPECT_EQ(meter.exit_code, 3);
  EXPECT_THAT(meter.err, HasSubstr("did you mean \"cv600\"?"));
  EXPECT_THAT(Journal(), IsEmpty());
}

TEST_F(Import, LightMustBeNamedWhenTheSessionHasSeveral) {
  const CliResult result = Run({SampleData(kCasper), "--distance", "1m", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "light_missing");
}

TEST_F(Import, IlluminanceWithoutDistanceIsRefusedButNotOfTheSun) {
  const CliResult refused = Run({SampleData(kCasper), "--light", "key", "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  const json error = json::parse(refused.out)["error"];
  EXPECT_EQ(error["code"], "distance_missing");
  EXPECT_THAT(error["message"].get<std::string>(),
              AllOf(HasSubstr("--distance"), HasSubstr("--color-only")));
  EXPECT_EQ(Run({SampleData(kCasper), "--light", "sun"}).exit_code, 0);
  EXPECT_EQ(Run({SampleData(kCasper), "--light", "key", "--distance", "0m"}).exit_code, 3);
}

// A lamp of 100 cd at (0.2, -0.1, 1.5), read on the floor at a square's corners and its centre.
TEST_F(Import, APlaceInColumnsFindsALampWhosePlaceNobodyStates) {
  std::string csv = "position_x_m,position_y_m,position_z_m,normal_x,normal_y,normal_z,lux\n";
  for (const auto& [x, y] :
       {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}, {0.0, 0.0}, {0.5, -0.6}}) {
    const double d = std::hypot(x - 0.2, y + 0.1, 1.5);
    csv += std::to_string(x) + "," + std::to_string(y) + ",0,0,0,1," +
           std::to_string(100.0 * 1.5 / (d * d * d)) + "\n";
  }
  temp_.Write("where/session.toml",
              "lightcal = 1\n[room]\ndark = true\n[[light]]\nname = \"lamp\"\nkind = \"point\"\n");
  const std::string places = temp_.Write("places.csv", csv);
  const std::string session = temp_.path() + "/where";
  ASSERT_EQ(RunLightcal({"import", places, "-s", session}).exit_code, 0);
  const CliResult fit = RunLightcal({"fit", session, "--json"});
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  const json light = json::parse(fit.out)["lights"][0];
  EXPECT_NEAR(double(light["intensity_cd"]["value"]), 100.0, 2.0);
  EXPECT_NEAR(double(light["position_m"][0]), 0.2, 0.01);
  EXPECT_NEAR(double(light["position_m"][2]), 1.5, 0.01);

  const std::string part = temp_.Write("part.csv", "position_x_m,position_y_m,lux\n1,1,48\n");
  const CliResult refused = RunLightcal({"import", part, "-s", session, "--json"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(json::parse(refused.out)["error"]["code"], "bad_row");
}

TEST_F(Import, ColorAloneNeedsNoDistanceAndCarriesNoLux) {
  const CliResult result = Run({SampleData(kCasper), "--light", "key", "--color-only"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_THAT(Journal(), SizeIs(1));
  EXPECT_FALSE(Journal()[0].contains("illuminance_lx"));
  EXPECT_EQ(Journal()[0]["cct_K"], 2655.0);
  // The copy must not bring the lux back: it is relative.
  const std::string copy = ReadFile(InSession(Journal()[0]["spectrum"]));
  EXPECT_THAT(copy, HasSubstr("wavelength_nm,relative"));
}

TEST_F(Import, RelativeSpectrumNeedsNoDistance) {
  const CliResult result =
      Run({SampleData("spectra/colour_science/Fluorescent.spdx"), "--light", "key"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Journal().at(0)["spectrum"], "captures/Fluorescent.spdx");
}

TEST_F(Import, OneColumnOfManyBecomesASpectrumFileOfItsOwn) {
  const CliResult result = Run({SampleData("spectra/jeti/spectral_Jeti_50pct.csv"), "--light",
                                "key", "--distance", "1m", "--column", "560nm"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("warning")));  // the four odd columns are others
  ASSERT_THAT(Journal(), SizeIs(1));
  EXPECT_EQ(Journal()[0]["illuminance_lx"], 107.0);  // 1,07E+02
  EXPECT_EQ(Journal()[0]["spectrum"], "captures/spectral_Jeti_50pct-560nm.csv");
  // Imported again, the copy is the same spectrum: 107.386 lx is what its samples add up to.
  const CliResult copy = Run({InSession("captures/spectral_Jeti_50pct-560nm.csv"), "--light", "key",
                              "--distance", "2m", "--json"});
  ASSERT_EQ(copy.exit_code, 0) << copy.err;
  const json reading = json::parse(copy.out)["readings"][0];
  EXPECT_THAT(reading["illuminance_lx"].get<double>(), DoubleNear(107.386, 0.01));
  EXPECT_EQ(reading["spectrum"], "captures/spectral_Jeti_50pct-560nm.csv");  // where it lies
}

TEST_F(Import, UnknownColumnIsRefusedListingTheNames) {
  const CliResult result = Run({SampleData("spectra/jeti/spectral_Jeti_50pct.csv"), "--light",
                                "key", "--distance", "1m", "--column", "565nm"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, AllOf(HasSubstr("565nm"), HasSubstr("570nm")));
}

TEST_F(Import, FilesOfTheSameNameDoNotOverwriteOneAnother) {
  const std::string a = temp_.Write("a/lamp.csv", "wavelength_nm,relative\n400,1\n500,2\n600,3\n");
  const std::string b = temp_.Write("b/lamp.csv", "wavelength_nm,relative\n400,3\n500,2\n600,1\n");
  ASSERT_EQ(Run({a, b, "--light", "key"}).exit_code, 0);
  ASSERT_THAT(Journal(), SizeIs(2));
  EXPECT_EQ(ReadFile(InSession(Journal()[0]["spectrum"])), ReadFile(a));
  EXPECT_EQ(ReadFile(InSession(Journal()[1]["spectrum"])), ReadFile(b));
}

TEST_F(Import, TypedTableBringsItsOwnLightAndDistances) {
  const CliResult result = Run({SampleData("lux_tables/own/typed_readings.csv")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_THAT(Journal(), SizeIs(3));
  EXPECT_EQ(Journal()[2]["distance_m"], 2.0);
  EXPECT_EQ(Journal()[2]["illuminance_lx"], 11.9);
}

TEST_F(Import, ShadowCardAndLampOffAreMarked) {
  const std::string csv = temp_.Write("one.csv", "distance_m,lux\n1,2\n");
  ASSERT_EQ(Run({csv, "--light", "key", "--lamp-off"}).exit_code, 0);
  ASSERT_EQ(Run({csv, "--light", "key", "--shadow-card"}).exit_code, 0);
  ASSERT_THAT(Journal(), SizeIs(2));
  EXPECT_EQ(Journal()[0]["lamp"], "off");
  EXPECT_EQ(Journal()[1]["shadow_card"], true);
  EXPECT_EQ(Run({csv, "--light", "key", "--shadow-card", "--lamp-off"}).exit_code, 2);
}

TEST_F(Import, UnitsThatAreNotSaidAreRefused) {
  const std::string csv = temp_.Write("one.csv", "distance,lux\n1,2\n");
  const CliResult result = Run({csv, "--light", "key", "--json"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "units_ambiguous");
  EXPECT_THAT(Run({csv, "--light", "key"}).err, HasSubstr("--columns distance_m,illuminance_lx"));
  temp_.Write("bare.csv", "0.5,203\n1,58\n");
  EXPECT_THAT(Run({temp_.path() + "/bare.csv", "--light", "key"}).err,
              HasSubstr("--columns distance_m,illuminance_lx"));
}

TEST_F(Import, ColumnsMayBeNamedOnTheLine) {
  // A header that says nothing; none and blanks between; a title and a column to leave out.
  temp_.Write("room.csv", "h,epsilon\n0.5,192\n1,52\n");
  temp_.Write("tower.dat", "tower 3, night\n 2   13,0\n 3    5,9\n");
  temp_.Write("three.txt", "7;4;3,25\n8;5;2,08\n");
  const std::string wanted = "distance_m,illuminance_lx";
  const auto run = [&](const std::string& file, const std::string& columns) {
    return Run({temp_.path() + "/" + file, "--light", "key", "--columns", columns});
  };
  EXPECT_EQ(run("room.csv", wanted).exit_code, 0);
  EXPECT_EQ(run("tower.dat", wanted).exit_code, 0);
  EXPECT_EQ(run("three.txt", "-," + wanted).exit_code, 0);
  const auto journal = Journal();
  ASSERT_THAT(journal, SizeIs(6));
  const std::vector<std::pair<double, double>> truth = {{0.5, 192.0}, {1.0, 52.0}, {2.0, 13.0},
                                                        {3.0, 5.9},   {4.0, 3.25}, {5.0, 2.08}};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_DOUBLE_EQ(journal[i].at("distance_m").get<double>(), truth[i].first);
    EXPECT_DOUBLE_EQ(journal[i].at("illuminance_lx").get<double>(), truth[i].second);
  }
  for (const auto& [columns, says] : {std::pair("distance_m", "write - for each"),
                                      std::pair("distance,illuminance_lx", "has no unit"),
                                      std::pair("distanc_m,-", "did you mean distance_m?")}) {
    const auto refused = run("room.csv", columns);
    EXPECT_EQ(refused.exit_code, 3) << columns;
    EXPECT_THAT(refused.err, HasSubstr(says));
  }
  EXPECT_THAT(Journal(), SizeIs(6));
}

TEST_F(Import, ASpectrumBetweenBlanksIsKeptInAFormThatReadsBack) {
  std::string scan = "LI-1800\nDATE 1 2 3 4\n\n";
  for (int nm = 380; nm <= 780; nm += 5) scan += " " + std::to_string(nm) + "  1.0E-3\n";
  temp_.Write("scan.prn", scan);
  const auto imported = Run({temp_.path() + "/scan.prn", "--light", "key", "--distance", "1m",
                             "--columns", "wavelength_nm,irradiance_W_m2_nm"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  // 683 lm/W times the integral of V over wavelength, 106.857 nm (CIE 018), of 1 mW/(m2 nm).
  EXPECT_NEAR(Journal().at(0).at("illuminance_lx").get<double>(), 683.002 * 106.857e-3, 0.05);
  const auto fitted = RunLightcal({"fit", Session(), "-o", temp_.path() + "/light.json"});
  EXPECT_EQ(fitted.exit_code, 0) << fitted.err;
}

// One file, two doors: what header and spectrum say differently is lux by neither.
TEST_F(Import, AnIlluminanceThatHeaderAndSpectrumDisputeIsRefusedByBothDoors) {
  std::string text = ReadFile(SampleData(kCasper));
  const std::string lux = "2925.355469";
  ASSERT_NE(text.find(lux), std::string::npos);
  text.replace(text.find(lux), lux.size(), "123");
  temp_.Write("s/captures/wrong.xls", text);
  const auto import = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {InSession("captures/wrong.xls"), "--light", "key", "--json"});
    return Run(more);
  };
  const CliResult refused = import({"--distance", "50cm"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(json::parse(refused.out)["error"]["code"], "illuminance_ambiguous");
  EXPECT_EQ(import({"--color-only"}).exit_code, 0);
  const auto fit = [&](const std::string& more) {
    temp_.Write("t/session.toml", std::string(kSession) +
                                      "[[reading]]\nlight = \"key\"\ndistance_m = 0.5\n"
                                      "spectrum = \"" +
                                      InSession("captures/wrong.xls") + "\"\n" + more);
    return RunLightcal({"fit", temp_.path() + "/t", "--allow-outside", "--json"});
  };
  const CliResult unread = fit("");
  EXPECT_EQ(unread.exit_code, 3);
  EXPECT_EQ(json::parse(unread.out)["error"]["code"], "illuminance_ambiguous");
}

TEST_F(Import, APictureIsSaidToBelongIntoACapture) {
  for (const char* name : {"IMG_1.CR2", "a.dng", "b.jpeg", "c.exr", "d.hdr", "e.TIF"}) {
    const std::string picture = temp_.Write(name, std::string(4000, '\xff'));
    for (const std::vector<std::string>& more : {{"--light", "key"}, std::vector<std::string>()}) {
      std::vector<std::string> words = {picture, "--json"};
      words.insert(words.end(), more.begin(), more.end());
      const CliResult result = Run(words);
      EXPECT_EQ(result.exit_code, 3) << name;
      const json error = json::parse(result.out)["error"];
      EXPECT_EQ(error["code"], "picture_file");
      EXPECT_THAT(error["message"].get<std::string>(), HasSubstr("[[capture]]"));
      EXPECT_THAT(error["message"].get<std::string>(), HasSubstr("light = \"key\""));
    }
  }
}

TEST_F(Import, MissingFileFails) {
  const CliResult result = Run({temp_.path() + "/none.csv", "--light", "key", "--json"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(json::parse(result.out)["error"]["code"], "not_found");
  EXPECT_EQ(RunLightcal({"import"}).exit_code, 2);
}

TEST_F(Import, SessionThatIsASingleFileKeepsItsJournalBesideIt) {
  temp_.Write("lamp.toml", kSession);
  const std::string csv = temp_.Write("one.csv", "distance_m,lux\n1,2\n");
  const CliResult result =
      RunLightcal({"import", csv, "-s", temp_.path() + "/lamp.toml", "--light", "key"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(ReadFile(temp_.path() + "/lamp.readings.jsonl"), HasSubstr("\"illuminance_lx\":2"));
}

}  // namespace
}  // namespace lightcal::test
