// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/work_precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <random>
#include <set>

namespace lightcal::report {
namespace {

struct Box {
  std::string text;
  double left, top, right, bottom;
};

// Every text inside the frame as a box: 13 px high letters, each as wide as 0.6 of that, which no
// usual sans-serif face exceeds on average.
std::vector<Box> TextBoxes(const std::string& svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  std::vector<Box> boxes;
  for (const auto& found : document.select_nodes("//text[starts-with(@class,'note')]")) {
    const pugi::xml_node node = found.node();
    const std::string text = node.text().get();
    const double width = 0.6 * 13.0 * static_cast<double>(text.size());
    const double x = node.attribute("x").as_double(), y = node.attribute("y").as_double();
    const bool ends = std::string_view(node.attribute("text-anchor").value()) == "end";
    boxes.push_back({text, ends ? x - width : x, y - 10.0, ends ? x : x + width, y + 3.0});
  }
  return boxes;
}

// Three settings on the best line, `others` between 1 and 3 ms with any error.
WorkPrecision Study(int others, double error_from, double error_to) {
  WorkPrecision study;
  study.title = "crowded";
  study.points.push_back({"as usual", 2e-3, 1.9e-3, 2.2e-3, 1e-5, WorkPointKind::kUsual});
  const std::vector<WorkPoint> best = {
      {"readings third", 1.00e-3, 0.98e-3, 1.03e-3, 4e-3},
      {"solver closed_form", 1.02e-3, 1.00e-3, 1.06e-3, 3.5e-3},
      {"effects none, source_model point, solver loose, rejection none", 1.05e-3, 1.0e-3, 1.1e-3,
       3e-3, WorkPointKind::kRecommended}};
  study.best = best;
  study.points.insert(study.points.end(), best.begin(), best.end());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < others; ++i) {
    const double t = 1e-3 * std::pow(3.0, share(random));
    const double error = error_from * std::pow(error_to / error_from, share(random));
    study.points.push_back({"bounce_patches " + std::to_string(i), t, 0.97 * t, 1.04 * t, error});
  }
  study.allowed = 0.009;  // close to the tolerance: their names too must not meet
  return study;
}

void ExpectNoOverlap(const WorkPrecision& study, std::size_t least_names) {
  const std::vector<Box> boxes = TextBoxes(WorkPrecisionPlot(study));
  EXPECT_GE(boxes.size(), least_names);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const Box &a = boxes[i], &b = boxes[k];
      const bool overlap =
          a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
      EXPECT_FALSE(overlap) << a.text << " lies on " << b.text;
    }
  }
}

std::set<std::string> Names(const WorkPrecision& study) {
  std::set<std::string> names;
  for (const Box& box : TextBoxes(WorkPrecisionPlot(study))) names.insert(box.text);
  return names;
}

TEST(WorkPrecision, NamesOfAScatteredCrowdDoNotOverlap) {
  ExpectNoOverlap(Study(30, 1e-6, 1e-1), 8);
}

TEST(WorkPrecision, NamesOfPointsWithoutErrorDoNotOverlap) {
  ExpectNoOverlap(Study(40, 1e-9, 1e-8), 6);
}

TEST(WorkPrecision, NamesOfOnePileDoNotOverlap) { ExpectNoOverlap(Study(60, 2.9e-3, 3.1e-3), 6); }

TEST(WorkPrecision, TheBestLineIsNamedHoweverCrowded) {
  for (const int others : {0, 60}) {
    const auto names = Names(Study(others, 2.9e-3, 3.1e-3));
    for (const char* name : {"readings third", "solver closed_form", "recommended", "as usual"}) {
      EXPECT_TRUE(names.contains(name)) << name << " beside " << others;
    }
  }
}

TEST(WorkPrecision, ACombinationIsNamedByItsFirstKnob) {
  WorkPrecision study = Study(0, 1e-3, 1e-2);
  study.best.back().kind = WorkPointKind::kSetting;
  study.points.back().kind = WorkPointKind::kSetting;
  EXPECT_TRUE(Names(study).contains("effects none + 3 more"));
}

TEST(WorkPrecision, ATimeOutsideItsQuartilesIsInTheFrame) {
  WorkPrecision study = Study(0, 1e-3, 1e-2);
  study.points.push_back({"rejection none", 0.2e-3, 1e-3, 2e-3, 1e-3});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(WorkPrecisionPlot(study).c_str()));
  for (const auto& found : document.select_nodes("//circle")) {
    const double x = found.node().attribute("cx").as_double();
    EXPECT_TRUE(x > 84.0 && x < 468.0) << found.node().child("title").text().get();
  }
}

TEST(WorkPrecision, TheSameStudyDrawsTheSameBytes) {
  EXPECT_EQ(WorkPrecisionPlot(Study(30, 1e-6, 1e-1)), WorkPrecisionPlot(Study(30, 1e-6, 1e-1)));
}

}  // namespace
}  // namespace lightcal::report
