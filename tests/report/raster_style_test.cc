// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/raster_style.h"

#include <gtest/gtest.h>

#include <string>

#include "lightcal/report/chromaticity_plot.h"

namespace lightcal {
namespace {

using report::ForRaster;

TEST(RasterStyle, PutsTheValuesOfTheFirstRootInPlaceOfTheirNames) {
  EXPECT_EQ(ForRaster("<svg><style>:root { --ink: #123; --band: rgba(0, 1, 2, .5); }\n"
                      "@media print { :root { --ink: #000; } a { b: c; } }\n"
                      "text { fill: var(--ink); stroke: var(--band); }</style>"
                      "<text>var(--ink)</text></svg>"),
            "<svg><style>:root { --ink: #123; --band: rgba(0, 1, 2, .5); }\n\n"
            "text { fill: #123; stroke: rgba(0, 1, 2, .5); }</style><text>var(--ink)</text></svg>");
}

TEST(RasterStyle, LeavesAloneWhatItDoesNotKnow) {
  for (const char* svg :
       {"", "<svg/>", "<svg><style>a { b: var(--c); }</style></svg>", "</style><style>",
        "<svg><style>:root { --c: 1", "<style>@media</style>", "<style>a { b: var(--c </style>",
        "<style>:root { --a: var(--a); } b { c: var(--a); }</style>"}) {
    const std::string once = ForRaster(svg);
    EXPECT_LE(once.size(), std::string(svg).size() + 16) << svg;
  }
  EXPECT_EQ(ForRaster("<svg/>"), "<svg/>");
}

TEST(RasterStyle, OfThePlotIsResolvedThroughout) {
  FittedColor color;
  color.xy = Xy{0.4476, 0.4074};
  const std::string svg = ForRaster(report::ChromaticityPlot(color));
  EXPECT_EQ(svg.find("var("), std::string::npos);
  EXPECT_EQ(svg.find("@media"), std::string::npos);
  EXPECT_NE(svg.find("svg .locus { fill: none; stroke: #15181c;"), std::string::npos);
}

}  // namespace
}  // namespace lightcal
