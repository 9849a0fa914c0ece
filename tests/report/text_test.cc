// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/text.h"

#include <gtest/gtest.h>

namespace lightcal::report {
namespace {

TEST(Escaped, NothingAPersonTypesCanBecomeMarkup) {
  EXPECT_EQ(Escaped("<script>\"a\" & 'b'</script>"),
            "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;");
}

TEST(Escaped, BytesThatAreNoTextBecomeTheReplacementCharacter) {
  EXPECT_EQ(Escaped("a\x01z"), "a\xEF\xBF\xBDz");
  EXPECT_EQ(Escaped("\xff"), "\xEF\xBF\xBD");
  EXPECT_EQ(Escaped("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD") << "overlong";
  EXPECT_EQ(Escaped("\xE2\x82"), "\xEF\xBF\xBD\xEF\xBF\xBD") << "cut short";
  EXPECT_EQ(Escaped("é – 光 💡"), "é – 光 💡");
}

TEST(PlusMinusText, KeepsTheDigitsTheUncertaintyLeaves) {
  EXPECT_EQ(PlusMinus({1000.4, 40.2, {}, {}}, "cd"), "1000 ±\u00A040\u00A0cd");
  EXPECT_EQ(PlusMinus({12566.4, 502.7, {}, {}}, "lm"), "12\u202F570 ±\u00A0500\u00A0lm");
  EXPECT_EQ(PlusMinus({-0.0012, 0.0008, {}, {}}, ""), "\u22120.00120 ±\u00A00.00080");
  EXPECT_EQ(PlusMinus({0.06, 0.02, {}, {}}, "cm", 100.0), "6.0 ±\u00A02.0\u00A0cm");
  EXPECT_EQ(PlusMinus({1000.0, 40.9, 961.0, 1042.0}, "cd"), "1000 ±\u00A041\u00A0cd");
  EXPECT_EQ(PlusMinus({1260.0, 660.0, 11.0, 1331.0}, "lm"), "1260\u00A0lm, 11 … 1330");
  EXPECT_EQ(RelativePlusMinus({1260.0, 660.0, 12.6, 1332.0}), "\u221299 … +5.7\u00A0%");
}

TEST(FigureText, DropsTrailingZerosAndGroupsThousands) {
  EXPECT_EQ(Figure(0.5), "0.5");
  EXPECT_EQ(Figure(-2.0), "\u22122");
  EXPECT_EQ(Figure(20000.0), "20\u202F000");
  EXPECT_EQ(Figure(0.0), "0");
}

TEST(FixedText, ARoundedZeroHasNoSign) { EXPECT_EQ(Fixed(-0.001, 1), "0.0"); }

TEST(PercentText, AbsentIsADashNotZero) {
  EXPECT_EQ(Percent(std::nullopt), "—");
  EXPECT_EQ(Percent(0.012), "1.2\u00A0%");
  EXPECT_EQ(SignedPercent(0.35), "+35.0\u00A0%");
  EXPECT_EQ(SignedPercent(-0.015), "\u22121.50\u00A0%");
}

}  // namespace
}  // namespace lightcal::report
