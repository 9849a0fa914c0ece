// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/label_placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightcal::report {
namespace {

const LabelGround kEmpty{{0.0, 0.0, 400.0, 300.0}, {}, {}};

TEST(LabelPlacement, ALoneLabelStandsBesideItsPoint) {
  const std::vector<LabelWish> wishes = {{{200.0, 150.0}, "alone"}};
  const auto placed = PlaceLabels(wishes, kEmpty);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_FALSE(placed[0].leader.has_value());
  EXPECT_NEAR(placed[0].box.left, 209.0, 1e-9);
  EXPECT_NEAR((placed[0].box.top + placed[0].box.bottom) / 2.0, 150.0, 1e-9);
}

TEST(LabelPlacement, LabelsStayInside) {
  const std::vector<LabelWish> wishes = {{{399.0, 1.0}, "corner"}, {{1.0, 299.0}, "other corner"}};
  const auto placed = PlaceLabels(wishes, kEmpty);
  ASSERT_EQ(placed.size(), 2U);
  for (const PlacedLabel& label : placed) {
    EXPECT_GE(label.box.left, 0.0);
    EXPECT_LE(label.box.right, 400.0);
    EXPECT_GE(label.box.top, 0.0);
    EXPECT_LE(label.box.bottom, 300.0);
  }
}

TEST(LabelPlacement, TwelveLabelsOfOnePointAllFindRoomAndLinesToIt) {
  const std::vector<LabelWish> wishes(12, {{200.0, 150.0}, "the same place"});
  const auto placed = PlaceLabels(wishes, kEmpty);
  ASSERT_EQ(placed.size(), 12U);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(Overlap(placed[i].box, placed[k].box));
  }
}

TEST(LabelPlacement, WhatNeedNotStandIsLeftOutBeforeWhatMust) {
  const LabelGround narrow{{190.0, 140.0, 270.0, 160.0}, {}, {}};
  const std::vector<LabelWish> wishes = {{{200.0, 150.0}, "may", false},
                                         {{200.0, 150.0}, "must", true}};
  const auto placed = PlaceLabels(wishes, narrow);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_EQ(placed[0].wish, 1U);
}

TEST(LabelPlacement, ALineIsAvoidedWhereThereIsRoomBesideIt) {
  LabelGround ground = kEmpty;
  ground.lines = {{{0.0, 150.0}, {400.0, 150.0}}};
  const std::vector<LabelWish> wishes = {{{200.0, 150.0}, "on a line"}};
  const auto placed = PlaceLabels(wishes, ground);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_TRUE(placed[0].box.bottom < 150.0 || placed[0].box.top > 150.0);
}

}  // namespace
}  // namespace lightcal::report
