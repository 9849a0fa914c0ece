// SPDX-License-Identifier: Apache-2.0
// lightcal new: the session.toml it writes, by flags, by defaults, and what it refuses.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_cli.h"
#include "terminal_dialogue.h"
#include "usb_stand_in.h"

namespace lightcal::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

struct KindCase {
  const char* kind;
  std::vector<std::string> flags;
  std::vector<std::string> lines;  // of session.toml
};
void PrintTo(const KindCase& kind, std::ostream* os) { *os << kind.kind; }
class NewOfKind : public testing::TestWithParam<KindCase> {};
TEST_P(NewOfKind, WritesASessionThatThePlanAndAReadingTake) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  std::vector<std::string> command = {"new", session, "--kind", GetParam().kind, "--yes", "--json"};
  command.insert(command.end(), GetParam().flags.begin(), GetParam().flags.end());
  const CliResult begun = RunLightcal(command);
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_EQ(json::parse(begun.out)["kind"], GetParam().kind);
  const std::string text = ReadFile(session + "/session.toml");
  for (const std::string& line : GetParam().lines) EXPECT_THAT(text, HasSubstr(line));
  const CliResult read = RunLightcal(
      {"read", "-s", session, "--light", "key", "--distance", "1m", "--lux", "100", "--quiet"});
  EXPECT_EQ(read.exit_code, 0) << read.err << text;
  const CliResult fitted = RunLightcal({"fit", session});
  EXPECT_EQ(fitted.exit_code, 0) << fitted.err << text;
}
// The example under its comment marks is a capture as the session reads it.
TEST(New, ACamerasBracketHasItsExample) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  const CliResult begun = RunLightcal({"new", session, "--kind", "point", "--yes"});
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_THAT(begun.out, HasSubstr("[[capture]]"));
  std::string text = ReadFile(session + "/session.toml");
  const auto from = text.find("# [[capture]]");
  ASSERT_NE(from, std::string::npos) << text;
  for (auto at = from; at != std::string::npos && at < text.size();) {
    if (text.compare(at, 2, "# ") == 0) text.erase(at, 2);
    at = text.find('\n', at);
    if (at != std::string::npos) ++at;
  }
  home.Write("s/session.toml", text);
  const CliResult fitted = RunLightcal({"fit", session, "--json"});
  EXPECT_EQ(json::parse(fitted.out)["error"]["code"], "not_found") << fitted.out << text;
}

TEST(New, ARoomWithoutWallsIsWrittenAsOne) {
  const NoUsb machine;
  for (const std::string none : {"dark", "outdoors"}) {
    const TempDir home;
    const std::string session = home.path() + "/s";
    const CliResult begun =
        RunLightcal({"new", session, "--kind", "point", "--yes", "--room", none});
    ASSERT_EQ(begun.exit_code, 0) << begun.err;
    EXPECT_THAT(ReadFile(session + "/session.toml"), HasSubstr("[room]\n" + none + " = true"));
    EXPECT_EQ(RunLightcal({"new", home.path() + "/t", "--kind", "rect", "--yes", "--size", none})
                  .exit_code,
              2)
        << "no size";
    EXPECT_EQ(RunLightcal({"new", home.path() + "/t", "--kind", "rect", "--yes"}).exit_code, 2)
        << "a rect has a size";
  }
}

INSTANTIATE_TEST_SUITE_P(
    NewSession, NewOfKind,
    testing::Values(KindCase{"point",
                             {"--box", "9W 806lm 2900K"},
                             {"electrical_W = 9", "flux_lm = 806", "cct_K = 2900"}},
                    KindCase{"spot", {"--box", "36deg"}, {"beam_deg = 36"}},
                    KindCase{"sphere", {"--diameter", "6cm"}, {"diameter_m = 0.06"}},
                    KindCase{"disk", {"--diameter", "20in"}, {"diameter_m = 0.508"}},
                    KindCase{"rect", {"--size", "120x60cm"}, {"size_m = [1.2, 0.6]"}},
                    KindCase{"tube",
                             {"--length", "1.2m", "--radius", "13mm"},
                             {"length_m = 1.2", "radius_m = 0.013"}},
                    KindCase{"photometric",
                             {"--distribution", SampleData("photometric/sample2.ldt")},
                             {"distribution = "}},
                    KindCase{"directional", {}, {"kind = \"directional\""}},
                    KindCase{
                        "point",
                        {"--room", "5,4,2.6", "--reflectance", "0.8", "--accuracy", "3%"},
                        {"size_m = [5, 4, 2.6]", "reflectance = 0.8", "sigma_relative = 0.015"}},
                    KindCase{"point",
                             {"--meter", "line:!echo 5", "--accuracy", "3%"},
                             {"sigma_relative = 0.01531 ", "--meter my_meter --device"}}),
    [](const auto& kind_case) {
      return std::string(kind_case.param.kind) + std::to_string(kind_case.index);
    });

TEST(NewSession, NamesThatNeedQuotesStandInFileAndShell) {
  const NoUsb machine;
  const TempDir home;
  const CliResult begun = RunLightcal(
      {"new", home.path() + "/grandma's lamps", "--lamp", "the \"big\" one\\", "--yes", "--json"});
  ASSERT_EQ(begun.exit_code, 0) << begun.err;
  const std::string line = json::parse(begun.out)["next"][0];
  const CliResult walked = RunProgram(
      {"/bin/sh", "-c", LIGHTCAL_BINARY + line.substr(line.find(' ')) + " --guided"}, "50lx@1m\n");
  EXPECT_EQ(walked.exit_code, 0) << line << walked.err;
  EXPECT_THAT(ReadFile(home.path() + "/grandma's lamps/readings.jsonl"),
              HasSubstr(R"(the \"big\" one\\)"));
}

TEST(NewSession, WithoutATerminalAMissingFlagIsNamed) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  const CliResult kind = RunLightcal({"new", session});
  EXPECT_EQ(kind.exit_code, 2);
  EXPECT_THAT(kind.err, HasSubstr("--kind"));
  const CliResult meter = RunLightcal({"new", session, "--kind", "point"});
  EXPECT_EQ(meter.exit_code, 2);
  EXPECT_THAT(meter.err, HasSubstr("--meter"));
  EXPECT_FALSE(fs::exists(session));
  const CliResult all =
      RunLightcal({"new", session, "--kind", "point", "--meter", "none", "--to", "gltf"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
}

TEST(NewSession, AFlagThatCannotBeReadIsNamedAndNothingWritten) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  const std::vector<std::vector<std::string>> wrong = {
      {"--kind", "bulb"},        {"--diameter", "6cm"},     {"--box", "9"},
      {"--box", "806lm 200deg"}, {"--meter", "sekonik:1"},  {"--accuracy", "300%"},
      {"--to", "maya"},          {"--room", "5,4"},         {"--reflectance", "0.5"},
      {"--lamp", "a/b"},         {"--kind", "photometric"}, {"--kind", "tube", "--length", "-1m"}};
  for (const auto& flags : wrong) {
    std::vector<std::string> command = {"new", session, "--yes"};
    command.insert(command.end(), flags.begin(), flags.end());
    const CliResult result = RunLightcal(command);
    EXPECT_EQ(result.exit_code, 2) << flags[0] << " " << flags[1];
    const std::string named =
        flags[1] == "photometric" ? "--distribution" : flags[flags.size() - 2];
    EXPECT_THAT(result.err, HasSubstr(named));
    EXPECT_FALSE(fs::exists(session));
  }
}

TEST(NewSession, ASessionIsReplacedOnlyByForceAndItsReadingsStay) {
  const NoUsb machine;
  const TempDir home;
  const std::string session = home.path() + "/s";
  ASSERT_EQ(RunLightcal({"new", session, "--yes"}).exit_code, 0);
  home.Write("s/readings.jsonl", "{\"light\":\"key\",\"distance_m\":1,\"illuminance_lx\":50}\n");
  const CliResult again = RunLightcal({"new", session, "--yes", "--lamp", "fill"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.err, HasSubstr("--force"));
  EXPECT_THAT(ReadFile(session + "/session.toml"), Not(HasSubstr("fill")));
  const CliResult forced = RunLightcal({"new", session, "--yes", "--kind", "spot", "--force"});
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_THAT(forced.err, HasSubstr("earlier session"));
  EXPECT_TRUE(fs::exists(session + "/readings.jsonl"));
}

TEST(NewSession, HowTheLampIsBuiltIsWritten) {
  const TempDir home;
  const std::string session = home.path() + "/s";
  const CliResult made =
      RunLightcal({"new", session, "--yes", "--kind", "point", "--fixture", "fresnel"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(ReadFile(session + "/session.toml"), HasSubstr("\nfixture = \"fresnel\""));
  const CliResult wrong =
      RunLightcal({"new", session + "2", "--yes", "--kind", "point", "--fixture", "fresnle"});
  EXPECT_EQ(wrong.exit_code, 2) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("fresnel"));
}

// A reflector with an angle on its box is no point to any engine; a bulb is, and who says so.
TEST(NewSession, ABeamOnTheBoxMakesASpot) {
  const NoUsb machine;
  const TempDir home;
  int at = 0;
  const auto begun = [&](std::vector<std::string> words) {
    const std::string session = home.path() + "/s" + std::to_string(++at);
    words.insert(words.begin(), {"new", session, "--yes", "--box", "30W 36deg"});
    EXPECT_EQ(RunLightcal(words).exit_code, 0);
    EXPECT_EQ(RunLightcal({"read", "-s", session, "--lux", "600", "--distance", "5m"}).exit_code,
              0);
    return session;
  };
  const std::string reflector = begun({"--fixture", "reflector"});
  EXPECT_THAT(ReadFile(reflector + "/session.toml"), HasSubstr("kind = \"spot\""));
  EXPECT_THAT(RunLightcal({"fit", reflector}).err, Not(HasSubstr("shines all round")));
  const std::string bulb = begun({"--fixture", "bulb"});
  EXPECT_THAT(ReadFile(bulb + "/session.toml"), HasSubstr("kind = \"point\""));
  const std::string point = begun({"--kind", "point"});
  EXPECT_THAT(ReadFile(point + "/session.toml"), HasSubstr("kind = \"point\""));
  EXPECT_THAT(RunLightcal({"fit", point}).err,
              HasSubstr("its beam angle is stated, 36.0 degrees, and its kind is a point"));
}

TEST(NewSession, ThePlanExpectsWhatTheBoxSays) {
  const TempDir home;
  const std::string session = home.path() + "/s";
  ASSERT_EQ(
      RunLightcal({"new", session, "--yes", "--kind", "point", "--box", "9W 806lm"}).exit_code, 0);
  const json step =
      json::parse(RunLightcal({"plan", session, "--json"}).out)["lights"][0]["steps"][0];
  const double distance = step["distance_m"];
  // 806 lm over 4 pi sr.
  EXPECT_NEAR(double(step["expected_lx"]) * distance * distance, 64.1, 15.0) << step;
}

TEST(NewSession, TheEndOfInputWritesNothing) {
  const NoUsb machine;
  for (const char key : {'\x03', '\x04'}) {
    const TempDir home;
    TerminalDialogue begin({"new", "s"}, home.path());
    ASSERT_TRUE(begin.WaitFor("call the lamp")) << begin.transcript();
    ASSERT_TRUE(begin.WaitFor("] "));
    begin.Press(key);
    EXPECT_EQ(begin.Finish(), 1) << begin.transcript();
    EXPECT_THAT(begin.transcript(), HasSubstr("nothing was written"));
    EXPECT_FALSE(fs::exists(home.path() + "/s"));
  }
}

}  // namespace
}  // namespace lightcal::test
