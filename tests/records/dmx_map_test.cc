// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/dmx_map.h"

#include <gtest/gtest.h>

#include <string>

namespace lightcal {
namespace {

constexpr const char* kMap = R"(lightcal = 1
universe = 3
address = 101
priority = 90
[[control]]
name = "dimmer"
slots = [1, 2]
range = [0, 100]
[[control]]
name = "cct_K"
slots = [3]
labels = [6500, 4000, 2700]
values = [0, 100, 255]
[[control]]
name = "mode"
slots = [4]
words = { white = 10, rgb = 128 }
[[hold]]
slot = 5
value = 255
)";

DmxMap Map() { return *DmxMapFromToml(kMap, "map.toml"); }

FixtureState At(const std::string& text) { return *ParseFixtureState(text); }

Error ErrorOf(const std::string& was, const std::string& becomes) {
  std::string text = kMap;
  const auto at = text.find(was);
  EXPECT_NE(at, std::string::npos) << was;
  text.replace(at, was.size(), becomes);
  const auto map = DmxMapFromToml(text, "map.toml");
  EXPECT_FALSE(map.has_value()) << becomes;
  return map ? Error{} : map.error();
}

TEST(DmxMap, AStateBecomesTheSlotsOfTheFixture) {
  const auto slots = SlotsAt(Map(), At("dimmer=25,cct_K=3350,mode=rgb"));
  ASSERT_TRUE(slots.has_value()) << slots.error().message;
  ASSERT_EQ(slots->size(), 512U);
  // 0.25 x 65535 = 16383.75: 16384 = 0x4000. Half way between 4000 and 2700: 177.5, to 178.
  EXPECT_EQ((*slots)[100], 0x40);
  EXPECT_EQ((*slots)[101], 0x00);
  EXPECT_EQ((*slots)[102], 178);
  EXPECT_EQ((*slots)[103], 128);
  EXPECT_EQ((*slots)[104], 255);
  int others = 0;
  for (std::size_t i = 0; i < slots->size(); ++i) others += i < 100 || i > 104 ? (*slots)[i] : 0;
  EXPECT_EQ(others, 0);
  EXPECT_EQ(*Map().universe, 3);
  EXPECT_EQ(Map().priority, 90);
}

TEST(DmxMap, TheEndsOfARangeAreReached) {
  const auto full = SlotsAt(Map(), At("dimmer=100,cct_K=6500,mode=white"));
  EXPECT_EQ((*full)[100], 255);
  EXPECT_EQ((*full)[101], 255);
  EXPECT_EQ((*full)[102], 0);
  const auto out = SlotsAt(Map(), At("dimmer=0,cct_K=2700,mode=white"));
  EXPECT_EQ((*out)[100] + (*out)[101], 0);
  EXPECT_EQ((*out)[102], 255);
}

TEST(DmxMap, RefusesStatesThatItCannotSet) {
  const auto code = [](const std::string& state) {
    const auto slots = SlotsAt(Map(), At(state));
    return slots ? std::string() : slots.error().code;
  };
  EXPECT_EQ(code("dimmer=50,cct_K=4000"), "map_controls") << "mode is not said";
  EXPECT_EQ(code("dimmer=50,cct_K=4000,mode=rgb,tint=0"), "map_controls");
  EXPECT_EQ(code("dimmer=50,cct_K=2000,mode=rgb"), "map_range");
  EXPECT_EQ(code("dimmer=50,cct_K=4000,mode=party"), "map_word");
  EXPECT_EQ(code("dimmer=50,cct_K=4000,mode=7"), "map_word");
}

TEST(DmxMap, RefusesFilesThatMeanTwoThingsOrNone) {
  EXPECT_EQ(ErrorOf("slots = [3]", "slots = [2]").code, "bad_map");
  EXPECT_NE(ErrorOf("slots = [3]", "slots = [2]").message.find("dimmer"), std::string::npos);
  EXPECT_EQ(ErrorOf("slot = 5", "slot = 4").code, "bad_map");
  EXPECT_EQ(ErrorOf("slots = [4]", "slots = [413]").code, "bad_map");
  EXPECT_EQ(ErrorOf("slots = [1, 2]", "slots = [1, 2, 9]").code, "bad_map");
  EXPECT_EQ(ErrorOf("values = [0, 100, 255]", "values = [0, 100, 256]").code, "bad_map");
  EXPECT_EQ(ErrorOf("values = [0, 100, 255]", "values = [0, 255]").code, "bad_map");
  EXPECT_EQ(ErrorOf("labels = [6500, 4000, 2700]", "labels = [6500, 2700, 4000]").code, "bad_map");
  EXPECT_EQ(ErrorOf("range = [0, 100]", "range = [50, 50]").code, "bad_map");
  EXPECT_EQ(ErrorOf("range = [0, 100]", "").code, "bad_map");
  EXPECT_EQ(ErrorOf("range = [0, 100]", "range = [0, 100]\nwords = { on = 1 }").code, "bad_map");
  EXPECT_EQ(ErrorOf("universe = 3", "universe = 64000").code, "bad_map");
  EXPECT_EQ(ErrorOf("priority = 90", "priority = 201").code, "bad_map");
  EXPECT_EQ(ErrorOf("address = 101", "address = 0").code, "bad_map");
  EXPECT_EQ(ErrorOf("white = 10", "white = 300").code, "bad_map");
  EXPECT_EQ(ErrorOf("lightcal = 1", "lightcal = 2").code, "bad_map");
  EXPECT_EQ(ErrorOf("priority = 90", "prioriti = 90").code, "unknown_key");
  EXPECT_EQ(ErrorOf("name = \"mode\"", "name = \"dimmer\"").code, "bad_map");
  EXPECT_EQ(ErrorOf("lightcal = 1", "lightcal = ").code, "bad_map") << "no TOML";
}

}  // namespace
}  // namespace lightcal
