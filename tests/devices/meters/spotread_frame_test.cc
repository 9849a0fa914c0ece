// SPDX-License-Identifier: Apache-2.0
// Truth: the printf formats of spotread.c, ArgyllCMS 2.3.1; the equal-energy spectrum's illuminance
// follows from the sum of CIE's V(lambda).
#include <gmock/gmock.h>

#include "lightcal_devices/meters/spotread/frame.h"
#include "lightcal_devices/meters/spotread/meter.h"
#include "spotread_texts.h"
#include "warning_codes.h"

namespace lightcal::devices::spotread {
namespace {

using test::Codes;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Report Decoded(const std::string& text) {
  const auto report = DecodeReport(text);
  EXPECT_TRUE(report) << report.error().message;
  return report.value_or(Report{});
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(SpotreadFrame, AColorimeterGivesLuxWithSixDecimalsAndItsColour) {
  const Report report = Decoded(test::kSpotreadColorimeter);
  EXPECT_EQ(report.illuminance_lx, 192.512345);
  EXPECT_EQ(report.xyz->X, 210.523114);
  EXPECT_EQ(report.xyz->Z, 65.100009);
  EXPECT_EQ(report.cct_K, 2857.0);
  EXPECT_EQ(report.duv, 0.0012);
  EXPECT_FALSE(report.spectrum || report.cri_Ra || report.tlci_Qa || report.tm30_Rf);
  EXPECT_EQ(report.instrument, "i1Display3");
  EXPECT_EQ(report.serial, "I1-15.A-01.111111.11");
}

TEST(SpotreadFrame, AHeadWithOneChannelGivesLuxAlone) {
  const Report report = Decoded(test::kSpotreadOneChannel);
  EXPECT_EQ(report.illuminance_lx, 17.25);
  EXPECT_FALSE(report.xyz || report.cct_K || report.duv);
}

TEST(SpotreadFrame, ASpectrometerGivesSpectrumAndRendering) {
  const Report report = Decoded(test::kSpotreadSpectral);
  ASSERT_TRUE(report.spectrum);
  EXPECT_EQ(report.spectrum->wavelengths_nm.size(), 36U);
  EXPECT_EQ(report.spectrum->wavelengths_nm[1], 390.0);
  EXPECT_EQ(report.spectrum->values[35], 0.010);  // mW to W
  EXPECT_EQ(report.cri_Ra, 95.2);
  ASSERT_EQ(report.cri_R.size(), 14U);
  EXPECT_EQ(report.cri_R[0], 96.1);
  EXPECT_EQ(report.cri_R[8], 84.8);
  EXPECT_EQ(report.cri_R[13], 97.4);
  EXPECT_EQ(report.tlci_Qa, 98.7);
  EXPECT_EQ(report.tm30_Rf, 96.12);
  EXPECT_EQ(report.tm30_Rg, 101.34);
  EXPECT_FALSE(report.rendering_doubtful);
}

TEST(SpotreadFrame, AnIndexWithCautionIsDoubtful) {
  EXPECT_TRUE(
      Decoded(Replaced(test::kSpotreadSpectral, "98.7\n", "98.7 (Caution)\n")).rendering_doubtful);
}

TEST(SpotreadFrame, AnOutputCutAnywhereIsAnAnswerOrAGoodError) {
  const std::string whole = test::kSpotreadSpectral;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto report = DecodeReport(std::string_view(whole).substr(0, size));
    if (report) continue;
    EXPECT_EQ(report.error().code, kBadReply) << size;
  }
}

TEST(SpotreadFrame, NumbersThatAreNoneAreRefused) {
  for (const char* lux : {"nan", "-0.5", "1e30", "inf", "lots"}) {
    EXPECT_FALSE(DecodeReport(Replaced(test::kSpotreadOneChannel, "17.250000", lux))) << lux;
    EXPECT_FALSE(DecodeReport(Replaced(test::kSpotreadColorimeter, "192.512345", lux))) << lux;
  }
  EXPECT_FALSE(Decoded(Replaced(test::kSpotreadColorimeter, "2857K", "nanK")).cct_K);
}

TEST(SpotreadFrame, ASpectrumMustHaveTheSamplesItSays) {
  for (const char* steps : {"35", "37", "1", "0", "-4", "36.5", "1000000", "x"}) {
    const auto report = DecodeReport(
        Replaced(test::kSpotreadSpectral, "in 36 steps", std::string("in ") + steps + " steps"));
    ASSERT_FALSE(report) << steps;
    EXPECT_EQ(report.error().code, kBadReply);
  }
  EXPECT_FALSE(DecodeReport(Replaced(test::kSpotreadSpectral, "to 730.000", "to 380.000")));
}

TEST(SpotreadFrame, EveryPromptIsSeenOnceInItsPlace) {
  const std::string text =
      test::kSpotreadMisread + "\n" + test::kSpotreadMisread +
      "\nSpot read failed due to the sensor being in the wrong position\n(x)\n";
  std::size_t from = 0;
  EXPECT_EQ(NextSituation(text, from), Situation::kAsksToRetry);
  EXPECT_EQ(from, test::kSpotreadMisread.size());
  EXPECT_EQ(NextSituation(text, from), Situation::kAsksToRetry);
  EXPECT_EQ(NextSituation(text, from), Situation::kWrongPosition);
  EXPECT_EQ(NextSituation(text, from), Situation::kNone);
  from = 0;
  EXPECT_EQ(NextSituation(test::kSpotreadColorimeter, from), Situation::kNone);
}

TEST(SpotreadFrame, EveryWayToEndWithoutAReadingIsKnown) {
  EXPECT_EQ(EndingOf(test::kSpotreadNoAmbient), Ending::kNoAmbient);
  EXPECT_EQ(EndingOf(test::kSpotreadNoSpectrum), Ending::kNoSpectrum);
  EXPECT_EQ(EndingOf(test::kSpotreadCalibratedItself), Ending::kCalibrated);
  EXPECT_EQ(EndingOf(test::kSpotreadPlacedToCalibrate), Ending::kPlacedToCalibrate);
  EXPECT_EQ(EndingOf(test::kSpotreadMisread), Ending::kMisread);
  EXPECT_EQ(EndingOf("spotread: Error - Got bad cct\n"), Ending::kTooDark);
  EXPECT_EQ(EndingOf("spotread: Error - No instrument at port 1\n"), Ending::kNoInstrument);
  EXPECT_EQ(EndingOf("Diagnostic: Unknown, inappropriate or no instrument detected\n"),
            Ending::kNoInstrument);
  EXPECT_EQ(EndingOf("Failed to initialise communications with instrument\n"),
            Ending::kNoConnection);
  EXPECT_EQ(EndingOf("\n\nGot fatal error 'x' (y)\n"), Ending::kFatal);
  EXPECT_EQ(EndingOf("failed due to misread (Sensor is saturated)"), Ending::kSaturated);
  EXPECT_EQ(EndingOf("\nReading CCMX/CCSS File 'a' failed with error 1:'b'\n"), Ending::kBadOption);
  EXPECT_EQ(EndingOf(""), Ending::kUnknown);
}

TEST(SpotreadFrame, TheOrdersToThePersonAreQuoted) {
  EXPECT_EQ(CalibrationInstructions(test::kSpotreadPlacedToCalibrate),
            "Place the instrument on its reflective white reference S/N 1234567");
  EXPECT_EQ(CalibrationInstructions("\nSet instrument sensor to calibration position,\n"),
            "Set instrument sensor to calibration position");
  EXPECT_EQ(CalibrationInstructions(test::kSpotreadColorimeter), "");
}

TEST(SpotreadFrame, TheLineThatTellsTheEndingFitsAMessage) {
  EXPECT_EQ(TellingLine(test::kSpotreadMisread, Ending::kMisread),
            "Spot read failed due to misread (Readings are inconsistent)");
  EXPECT_EQ(TellingLine("a\nb\x01\x1b[0m c\n\n", Ending::kUnknown), "b[0m c");
  EXPECT_LE(TellingLine(std::string(5000, 'x'), Ending::kUnknown).size(), 200U);
  EXPECT_EQ(TellingLine("", Ending::kFatal), "");
}

TEST(SpotreadFrame, TheVersionStandsInTheUsageOfItsSisters) {
  EXPECT_EQ(VersionIn("Lookup ICC or CAL colors, Version 2.3.1\nAuthor: G"), "2.3.1");
  EXPECT_EQ(VersionIn("no such thing"), std::nullopt);
}

TEST(SpotreadReading, QualityFollowsFromWhatCame) {
  const auto spectral = ReadingFromReport(Decoded(test::kSpotreadSpectral), "s:1");
  EXPECT_EQ(spectral.reading.quality, MeterQuality::kSpectral);
  EXPECT_EQ(spectral.reading.color_source, ColorSource::kSpectrometer);
  EXPECT_THAT(Codes(spectral.warnings), IsEmpty());  // the spectrum integrates to its lux
  EXPECT_EQ(spectral.tlci_Qa, 98.7);
  const auto three = ReadingFromReport(Decoded(test::kSpotreadColorimeter), "s:1");
  EXPECT_EQ(three.reading.quality, MeterQuality::kColorimeter);
  EXPECT_NEAR(three.reading.xy->x, 0.449706, 2e-6);
  EXPECT_NEAR(three.reading.xy->y, 0.411232, 2e-6);
  EXPECT_EQ(three.reading.cct->value(), 2857.0);
  const auto one = ReadingFromReport(Decoded(test::kSpotreadOneChannel), "s:1");
  EXPECT_EQ(one.reading.quality, MeterQuality::kPhotometer);
  EXPECT_FALSE(one.reading.xy || one.reading.cct);
  EXPECT_GT(*one.reading.sigma_relative, *three.reading.sigma_relative);
}

TEST(SpotreadReading, ASpectrumOfOtherLightThanTheLuxIsSaid) {
  const auto reading = ReadingFromReport(
      Decoded(Replaced(test::kSpotreadSpectral, "10, 10, 10", "10, 10, 1000000")), "s:1");
  EXPECT_THAT(Codes(reading.warnings), ElementsAre("self_check"));
}

TEST(SpotreadReading, AColourTemperatureFarFromWhiteIsLeftOut) {
  const auto reading = ReadingFromReport(
      Decoded(Replaced(test::kSpotreadColorimeter, "(Duv 0.0012)", "(Duv 0.2000)")), "s:1");
  EXPECT_FALSE(reading.reading.cct || reading.reading.duv);
  EXPECT_TRUE(reading.reading.xy);
  EXPECT_THAT(Codes(reading.warnings), ElementsAre("cct_out_of_range"));
}

}  // namespace
}  // namespace lightcal::devices::spotread
