// SPDX-License-Identifier: Apache-2.0
// Rows C01 to C09: colours at the ends of the locus, off it, and of no light at all.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hard_case.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/colorimetry/daylight.h"
#include "lightcal/colorimetry/planckian.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/matrix3.h"

namespace lightcal::test::hard {
namespace {

Answer OfXy(double x, double y) { return Ask({"color", "--xy", Text(x), Text(y)}); }
double Number(const Answer& answer, const char* key) {
  return answer.document.at(key).get<double>();
}

// What every colour without a temperature must still have.
void ExpectColorWithoutCct(const Answer& answer, const char* status) {
  ExpectAnswered(answer);
  EXPECT_EQ(answer.document["cct_valid"], false);
  EXPECT_FALSE(answer.document.contains("cct_K"));
  EXPECT_EQ(answer.document["cct_status"], status);
  EXPECT_EQ(answer.document["xy"].size(), 2U);
  for (const char* space : {"srgb_linear", "acescg", "rec2020"}) {
    EXPECT_EQ(answer.document["rgb"][space].size(), 3U) << space;
  }
}

TEST(HardCaseC, C01TemperaturesFrom500KToInfinity) {
  for (const double kelvin : {1000.0, 2856.0, 6504.0, 25000.0, 1e5, 1e6}) {
    const Answer answer = Ask({"color", "--cct", Text(kelvin)});
    ExpectAnswered(answer);
    EXPECT_NEAR(Number(answer, "cct_K") / kelvin, 1.0, 1e-7) << kelvin;
    const Answer back = OfXy(answer.document["xy"][0], answer.document["xy"][1]);
    EXPECT_NEAR(Number(back, "cct_K") / kelvin, 1.0, 1e-7) << kelvin;
  }
  for (const double kelvin : {500.0, 999.0}) {
    ExpectColorWithoutCct(Ask({"color", "--cct", Text(kelvin)}), "below_1000_K");
  }
  // Past the end of the locus, where the reciprocal temperature would be below 0.
  ExpectColorWithoutCct(OfXy(0.2396, 0.2338), "beyond_infinity");
  for (const char* no_temperature : {"inf", "nan", "0", "-5"}) {
    EXPECT_EQ(Ask({"color", std::string("--cct=") + no_temperature}).exit_code, 3);
  }
  const double infinity = std::numeric_limits<double>::infinity();
  const Xy end = XyFromCct(Kelvin(infinity));
  EXPECT_NEAR(Uv1960FromXy(end).u, 0.18006436, 1e-8);
  EXPECT_NEAR(Uv1960FromXy(end).v, 0.26352122, 1e-8);
}

TEST(HardCaseC, C02FarFromTheLocusTheCctIsWithheld) {
  ExpectColorWithoutCct(OfXy(0.3, 0.6), "far_from_locus");
  ExpectColorWithoutCct(Ask({"color", "--cct", "4000", "--duv", "0.0501"}), "far_from_locus");
  EXPECT_EQ(Ask({"color", "--cct", "4000", "--duv", "0.0499"}).document["cct_valid"], true);
  const Answer lamp =
      KeySession("point", "[room]\ndark = true\n").At(1, 100, "xy = [0.3, 0.6]").Run();
  ExpectWarned(lamp, "cct_withheld");
  EXPECT_FALSE(Lamp(lamp)["color"].contains("cct_K"));
  EXPECT_NEAR(Lamp(lamp)["color"]["xy"][1].get<double>(), 0.6, 1e-12);
}

TEST(HardCaseC, C03AGreenishLampStaysGreenish) {
  const Answer typed = Ask({"color", "--cct", "4000", "--duv", "0.02"});
  EXPECT_NEAR(Number(typed, "duv"), 0.02, 1e-12);
  const Answer lamp = KeySession().At(1, 100, "cct_K = 4000\nduv = 0.02").Run();
  ExpectAnswered(lamp);
  const Xy xy{Lamp(lamp)["color"]["xy"][0], Lamp(lamp)["color"]["xy"][1]};
  EXPECT_NEAR(CctFromXy(xy).duv, 0.02, 1e-4);
  // And in the preset: more green for its red than the same temperature on the locus has.
  const auto green_of = [](const char* duv) {
    KeySession session;
    ExpectAnswered(session.At(1, 100, std::string("cct_K = 4000\nduv = ") + duv).Run());
    const json color =
        session.Preset(".gltf")["extensions"]["KHR_lights_punctual"]["lights"][0]["color"];
    return color[1].get<double>() / color[0].get<double>();
  };
  EXPECT_GT(green_of("0.02") / green_of("0.0"), 1.2);
}

TEST(HardCaseC, C04SingleColouredLedsHaveNoTemperature) {
  const std::vector<std::pair<const char*, const char*>> leds = {
      {"gaussian:630:20", "below_1000_K"},
      {"gaussian:532:30", "far_from_locus"},
      {"gaussian:465:20", "beyond_infinity"}};
  for (const auto& [led, status] : leds) {
    const Answer kept = Ask({"color", "--spectrum", led});
    ExpectColorWithoutCct(kept, status);
    EXPECT_EQ(kept.document["rgb_gamut"]["policy"], "keep");
    const Answer clipped = Ask({"color", "--spectrum", led, "--gamut", "clip"});
    const Answer mixed = Ask({"color", "--spectrum", led, "--gamut", "desaturate"});
    for (const Answer* answer : {&clipped, &mixed}) {
      for (const json& component : answer->document["rgb"]["srgb_linear"]) {
        EXPECT_GE(component.get<double>(), -1e-15) << led;
      }
    }
  }
}

TEST(HardCaseC, C05WithoutLightThereIsNoColour) {
  for (const auto& xyz : std::vector<std::array<const char*, 3>>{
           {"0", "0", "0"}, {"1", "0", "1"}, {"1", "-1", "1"}}) {
    ExpectRefused(Ask({"color", "--xyz", xyz[0], xyz[1], xyz[2]}), "bad_chromaticity");
  }
  ExpectRefused(OfXy(0.3, 0.0), "bad_chromaticity");
  const TempDir folder;
  const std::string dark =
      folder.Write("dark.csv", "wavelength_nm,irradiance_mW_m2_nm\n400,0\n500,0\n600,0\n700,0\n");
  EXPECT_EQ(Ask({"color", "--spectrum", dark}).exit_code, 3);
}

TEST(HardCaseC, C06XAndYThatAddToNothingAreRefusedOrDefined) {
  // A deep red, as a meter rounds it or is off by .002.
  EXPECT_EQ(OfXy(0.7347, 0.2654).exit_code, 0);
  EXPECT_EQ(OfXy(0.7360, 0.2670).exit_code, 0);
  ExpectRefused(OfXy(0.7400, 0.2700), "bad_chromaticity");
  ExpectRefused(OfXy(0.0, 0.0), "bad_chromaticity");
  ExpectRefused(OfXy(0.3, -0.3), "bad_chromaticity");
  ExpectRefused(OfXy(-0.3, 0.3), "bad_chromaticity");  // imaginary, as files refuse it
  EXPECT_EQ(CctFromXy({0.0, 0.0}).status, CctStatus::kNotAChromaticity);
  EXPECT_EQ(CctFromXy({std::nan(""), 0.3}).status, CctStatus::kNotAChromaticity);
}

TEST(HardCaseC, C07TheTwoDaylightFormulasMeet) {
  const auto x_at = [](double kelvin) {
    return Ask({"color", "--cct", Text(kelvin), "--locus", "daylight"})
        .document.at("xy")
        .at(0)
        .get<double>();
  };
  // CIE's coefficients step by 4.64e-7; d65's slope adds 1.4e-5 a kelvin.
  EXPECT_LE(std::abs(x_at(7000.0) - x_at(std::nextafter(7000.0, 8000.0))), 5e-7);
  double last = 1.0;
  for (int kelvin = 4000; kelvin <= 25000; kelvin += 10) {
    const auto xy = DaylightXy(Kelvin(kelvin));
    ASSERT_TRUE(xy.has_value());
    ASSERT_LT(xy->x, last) << kelvin;
    last = xy->x;
  }
  for (const char* outside : {"3999", "25001"}) {
    ExpectRefused(Ask({"color", "--cct", outside, "--locus", "daylight"}), "out_of_range");
  }
}

TEST(HardCaseC, C08PlancksLawNeverOverflows) {
  EXPECT_EQ(PlanckRatio(0.0), 1.0);
  EXPECT_EQ(PlanckRatio(1e4), 0.0);
  EXPECT_EQ(PlanckRatio(1e300), 0.0);
  double last = 1.0;
  for (double x = 1e-12; x < 1e6; x *= 1.7) {
    const double ratio = PlanckRatio(x);
    ASSERT_TRUE(ratio >= 0.0 && ratio <= last) << x;
    last = ratio;
  }
  for (const char* kelvin : {"1", "30", "100"}) {
    const Answer answer = Ask({"color", "--cct", kelvin});
    EXPECT_TRUE(answer.exit_code == 0 || answer.exit_code == 3) << kelvin;
  }
}

// 380-780 nm every 5 nm, three bells of 15 nm at these wavelengths mixed to one colour.
std::string MixedSpectrum(const std::array<double, 3>& bells_nm, const Xyz& wanted) {
  const auto bell = [](double nm, double middle) {
    return std::exp(-0.5 * std::pow((nm - middle) / 15.0, 2.0));
  };
  Matrix3 parts{};
  for (std::size_t b = 0; b < 3; ++b) {
    for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
      const Xyz c = ColorMatchingAt(Nanometres(nm));
      parts[0][b] += c.X * bell(nm, bells_nm[b]);
      parts[1][b] += c.Y * bell(nm, bells_nm[b]);
      parts[2][b] += c.Z * bell(nm, bells_nm[b]);
    }
  }
  const Column3 weight = Times(Inverse(parts), {wanted.X, wanted.Y, wanted.Z});
  std::string csv = "wavelength_nm,irradiance_mW_m2_nm\n";
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
    double value = 0.0;
    for (std::size_t b = 0; b < 3; ++b) value += weight[b] * bell(nm, bells_nm[b]);
    csv += Text(nm) + "," + Text(value) + "\n";
  }
  return csv;
}

TEST(HardCaseC, C09TwoSpectraOfOneColourAreOneColour) {
  const TempDir folder;
  const Xyz white{0.95, 1.0, 1.09};
  std::vector<json> answers;
  int i = 0;
  for (const auto& bells : {std::array{450.0, 540.0, 610.0}, std::array{465.0, 530.0, 630.0}}) {
    const std::string path =
        folder.Write("lamp" + std::to_string(i++) + ".csv", MixedSpectrum(bells, white));
    answers.push_back(Ask({"color", "--spectrum", path}).document);
  }
  for (const std::size_t k : {0U, 1U}) {
    EXPECT_NEAR(answers[0]["xy"][k].get<double>(), answers[1]["xy"][k].get<double>(), 1e-9);
  }
  EXPECT_NEAR(answers[0]["cct_K"].get<double>() / answers[1]["cct_K"].get<double>(), 1.0, 1e-6);
  // Not one light: its colour rendering differs.
  EXPECT_GT(std::abs(answers[0]["cri"]["Ra"].get<double>() - answers[1]["cri"]["Ra"].get<double>()),
            1.0);
}

}  // namespace
}  // namespace lightcal::test::hard
