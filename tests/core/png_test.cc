// SPDX-License-Identifier: Apache-2.0
#include "lightcal/core/png.h"

#include <gtest/gtest.h>

#include "lightcal/core/base64.h"

namespace lightcal {
namespace {

TEST(Base64, AgreesWithTheVectorsOfRfc4648) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64("\xFF\xFE\xFD"), "//79");
}

TEST(Png, EndsWithTheEmptyChunkWhoseCheckSumEveryFileHas) {
  using namespace std::string_literals;
  EXPECT_EQ(PngChunk("IEND", ""), "\0\0\0\0IEND\xAE\x42\x60\x82"s);
}

TEST(Png, SaysItsSizeAndThatItHoldsEightBitsASample) {
  using namespace std::string_literals;
  const std::string file = PngFile(300, 2, PngColor::kRgb, "rows");
  EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n"s);
  EXPECT_EQ(file.substr(8, 21), "\0\0\0\x0DIHDR\0\0\x01\x2C\0\0\0\2\x08\x02\0\0\0"s);
  EXPECT_EQ(file.substr(33, 12), "\0\0\0\4IDATrows"s);
}

}  // namespace
}  // namespace lightcal
