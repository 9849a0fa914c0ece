// SPDX-License-Identifier: Apache-2.0
// Pictures that lightcal merged, as OpenColorIO understands their space.
#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lightcal_devices/captures/picture.h"
#include "merge_brackets.h"

namespace lightcal {
namespace {

namespace OCIO = OCIO_NAMESPACE;
using namespace test::merge;  // the words of these tests
using test::SyntheticCamera;

using Rgb3 = std::array<float, 3>;

// One of OpenColorIO's own transforms, its numbers, its code.
class BuiltIn {
 public:
  BuiltIn(const char* style, OCIO::TransformDirection direction) {
    const auto transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    processor_ =
        OCIO::Config::CreateRaw()->getProcessor(transform, direction)->getDefaultCPUProcessor();
  }
  Rgb3 operator()(Rgb3 color) const {
    processor_->applyRGB(color.data());
    return color;
  }

 private:
  OCIO::ConstCPUProcessorRcPtr processor_;
};

// The wall: a luminance and chromaticity for each of four patches.
struct Patch {
  double nits, x, y;
};
constexpr std::array kPatches = {Patch{100.0, 0.31272, 0.32903}, Patch{80.0, 0.45, 0.41},
                                 Patch{60.0, 0.25, 0.27}, Patch{90.0, 0.33, 0.45}};

class OpenColorIo : public testing::Test {
 protected:
  // Mean R, G, B of every patch as merge writes it.
  std::vector<Rgb3> Merged(const std::string& space) {
    SyntheticCamera camera = Camera(160, 64);
    camera.prnu_relative = camera.row_noise_e = camera.knee_relative = 0.0;
    camera.full_well_e = 1e9;
    camera.read_noise_e = 1e5;
    const auto scene = [](int x, int) {
      const Patch& patch = kPatches[static_cast<std::size_t>(x / 40)];
      return test::XyzOf(patch.nits, patch.x, patch.y);
    };
    const auto series = test::ExposureSeries(1.0 / 64, 2, 2.0, 4.0, 0.0, 5);
    const std::string output = folder_.path() + "/" + space + ".exr";
    static_cast<void>(MergeJson(ShootAll(folder_, camera, series, scene), output,
                                {"--space", space, "--anchor", "4,4,32,56=100"}));
    const auto info = devices::ReadPictureInfo(output);
    EXPECT_TRUE(info && info->chromaticities);
    if (info && info->chromaticities) chromaticities_ = *info->chromaticities;
    const Picture picture = ReadExr(output);
    std::vector<Rgb3> means;
    for (int patch = 0; patch < 4; ++patch) {
      Rgb3& mean = means.emplace_back();
      for (int c = 0; c < 3; ++c) {
        mean[static_cast<std::size_t>(c)] =
            static_cast<float>(picture.Mean(40 * patch + 4, 4, 32, 56, c));
      }
    }
    return means;
  }
  static void ExpectSeen(const std::array<double, 3>& xyz, const Patch& patch, double scale) {
    EXPECT_NEAR(xyz[1] * scale / patch.nits, 1.0, 1e-3);
    const double sum = xyz[0] + xyz[1] + xyz[2];
    EXPECT_NEAR(xyz[0] / sum, patch.x, 2e-4);
    EXPECT_NEAR(xyz[1] / sum, patch.y, 2e-4);
  }
  test::TempDir folder_;
  RgbPrimaries chromaticities_{};
};

// ACEScg -> ACES2065-1 by OpenColorIO, then to XYZ by SMPTE ST 2065-1, table 1.
TEST_F(OpenColorIo, ReadsAcescgAsItWasMeant) {
  const BuiltIn to_aces("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_FORWARD);
  const auto merged = Merged("acescg");
  for (std::size_t i = 0; i < merged.size(); ++i) {
    const Rgb3 aces = to_aces(merged[i]);
    ExpectSeen({0.9525523959 * aces[0] + 0.0000936786 * aces[2],
                0.3439664498 * aces[0] + 0.7281660966 * aces[1] - 0.0721325464 * aces[2],
                1.0088251844 * aces[2]},
               kPatches[i], 1.0);
    const BuiltIn back("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_INVERSE);
    const Rgb3 again = back(aces);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(again[c] / merged[i][c], 1.0, 1e-5);
  }
  EXPECT_NEAR(chromaticities_.red.x, 0.713, 1e-6);
  EXPECT_NEAR(chromaticities_.white.y, 0.33767, 1e-6);
}

// OpenColorIO has Rec. 2020 as a display: code values of gamma 2.4 back to XYZ under D65.
TEST_F(OpenColorIo, ReadsRec2020AsItWasMeant) {
  const BuiltIn to_xyz("DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.2020", OCIO::TRANSFORM_DIR_INVERSE);
  const auto merged = Merged("rec2020");
  for (std::size_t i = 0; i < merged.size(); ++i) {
    Rgb3 code = merged[i];
    for (float& c : code) c = std::pow(c / 200.0F, 1.0F / 2.4F);
    const Rgb3 xyz = to_xyz(code);
    ExpectSeen({double{xyz[0]}, double{xyz[1]}, double{xyz[2]}}, kPatches[i], 200.0);
  }
  EXPECT_NEAR(chromaticities_.green.x, 0.170, 1e-6);
  EXPECT_NEAR(chromaticities_.white.x, 0.3127, 1e-6);
}

}  // namespace
}  // namespace lightcal
