// SPDX-License-Identifier: Apache-2.0
// The pictures of `lightcal color` as PNG.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal {
namespace {

// GLib and fontconfig keep what they once allocated.
const std::vector<std::string> kNoLeakCheck = {"LSAN_OPTIONS=detect_leaks=0"};

test::CliResult Color(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "color");
  return test::RunLightcal(arguments, "", kNoLeakCheck);
}

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  using Rgb = std::array<int, 3>;
  [[nodiscard]] Rgb At(std::size_t x, std::size_t y) const {
    const std::size_t i = 3 * (y * width + x);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
  [[nodiscard]] int CountOf(const Rgb& color) const {
    int count = 0;
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      count += rgb[i] == color[0] && rgb[i + 1] == color[1] && rgb[i + 2] == color[2] ? 1 : 0;
    }
    return count;
  }
};

Picture Decoded(const std::string& bytes) {
  Picture picture;
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return picture;
  image.format = PNG_FORMAT_RGB;
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) return Picture();
  picture.width = image.width;
  picture.height = image.height;
  return picture;
}

TEST(PictureFile, APlotIsPaintedAtTwiceItsSizeInTheColoursOfALightScreen) {
  const test::TempDir folder;
  const std::string file = folder.path() + "/plot.png";
  EXPECT_EQ(Color({"--cct", "3200", "--sigma", "1%", "--plot", file}).exit_code, 0);
  const Picture plot = Decoded(test::ReadFile(file));
  EXPECT_EQ(plot.width, 960U);
  EXPECT_EQ(plot.height, 772U);  // the legend stands below
  EXPECT_EQ(plot.At(2, 2), (Picture::Rgb{255, 255, 255}));
  // Paper all round the 384 x 270 of the plot, less the labels and the legend.
  constexpr int kAround = 960 * 772 - 768 * 540;
  EXPECT_LT(plot.CountOf({255, 255, 255}), kAround + 1000);
  EXPECT_GT(plot.CountOf({255, 255, 255}), 0.95 * kAround);
  EXPECT_GT(plot.CountOf({0x15, 0x18, 0x1c}), 1000);  // the locus, the colour and its axes' names
  EXPECT_GT(plot.CountOf({0xe1, 0xdf, 0xda}), 1000);  // the grid
  EXPECT_EQ(plot.CountOf({0, 0, 0}), 0);              // nothing unstyled
}

TEST(PictureFile, AVectorGraphicIsPaintedToo) {
  const test::TempDir folder;
  const std::string file = folder.path() + "/graphic.PNG";
  EXPECT_EQ(Color({"--spectrum", "illuminant:FL4", "--vector-graphic", file}).exit_code, 0);
  const Picture graphic = Decoded(test::ReadFile(file));
  EXPECT_EQ(graphic.width, 960U);
  EXPECT_EQ(graphic.height, 1012U);
  // Paper round the disc of the hues, 1.36 times 150 px, less the labels and the legend.
  const double around = 960.0 * 1012.0 - std::numbers::pi * 408.0 * 408.0;
  EXPECT_NEAR(graphic.CountOf({255, 255, 255}), around, 0.02 * around);
}

TEST(PictureFile, TheSameColourGivesTheSameBytesAndReplacesItsOwnPictureOnly) {
  const test::TempDir folder;
  const std::string file = folder.path() + "/plot.png";
  EXPECT_EQ(Color({"--cct", "3200", "--plot", file}).exit_code, 0);
  const std::string first = test::ReadFile(file);
  EXPECT_NE(first.find(std::string("tEXtSoftware\0lightcal", 21)), std::string::npos);
  EXPECT_EQ(Color({"--cct", "3200", "--plot", file}).exit_code, 0);
  EXPECT_EQ(test::ReadFile(file), first);
  const std::string foreign = folder.Write("foreign.png", "a picture of my own");
  EXPECT_EQ(Color({"--cct", "3200", "--plot", foreign}).exit_code, 1);
  EXPECT_EQ(test::ReadFile(foreign), "a picture of my own");
}

TEST(PictureFile, ANameWithoutAKnownEndingIsWrongUsage) {
  const test::TempDir folder;
  for (const char* name : {"/plot.jpg", "/plot", "/png"}) {
    EXPECT_EQ(Color({"--cct", "3200", "--plot", folder.path() + name}).exit_code, 2) << name;
  }
  EXPECT_EQ(Color({"--spectrum", "illuminant:FL4", "--vector-graphic", folder.path() + "/g.pdf"})
                .exit_code,
            2);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(PictureFile, WithoutLibrsvgItSaysWhatToInstallAndWritesNothing) {
  const test::TempDir folder;
  folder.Write("lib/librsvg-2.so.2", "no library");
  const std::string file = folder.path() + "/plot.png";
  const auto run = test::RunLightcal({"color", "--cct", "3200", "--plot", file}, "",
                                     {"LD_LIBRARY_PATH=" + folder.path() + "/lib"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("apt install librsvg2-2"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace lightcal
