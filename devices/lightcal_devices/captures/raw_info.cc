// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw_info.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <string_view>

#include "lightcal_devices/captures/exposure_tags.h"

namespace lightcal::devices {
namespace {

constexpr unsigned kNoFilters = 0, kCatchlight = 1, kXTrans = 9;
constexpr std::uint8_t kOtherChannel = 3;
constexpr Kelvin kD65{6502.71};  // as DNG readers round it
constexpr double kMostBaselineStops = 16.0;
constexpr double kUnknownDistance = 0.0, kInfiniteDistance = 4294967295.0;

// LibRaw's colour number (0 to 3, the second green being its own) of a place of the picture.
int LibRawColor(const libraw_iparams_t& camera, int x, int y) {
  if (camera.filters == kNoFilters) return 0;
  if (camera.filters == kXTrans) return camera.xtrans[y % 6][x % 6] & 3;
  return camera.filters >> (((y << 1 & 14) | (x & 1)) << 1) & 3;
}

std::uint8_t ChannelOf(const libraw_iparams_t& camera, int libraw_color) {
  switch (camera.cdesc[libraw_color]) {
    case 'R':
      return kRedChannel;
    case 'G':
      return kGreenChannel;
    case 'B':
      return kBlueChannel;
    default:
      return kOtherChannel;
  }
}

// The smallest pattern that repeats: 2 x 2 for Bayer, 6 x 6 for X-Trans.
Periodic2d<std::uint8_t> ColorFilterArray(const libraw_iparams_t& camera) {
  const auto fill = [&](int width, int height) {
    Periodic2d<std::uint8_t> cfa{width, height, {}};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        cfa.values.push_back(ChannelOf(camera, LibRawColor(camera, x, y)));
      }
    }
    return cfa;
  };
  if (camera.filters == kXTrans) return fill(6, 6);
  const Periodic2d<std::uint8_t> whole = fill(2, 8);
  for (const int height : {2, 4}) {
    const Periodic2d<std::uint8_t> part = fill(2, height);
    bool repeats = true;
    for (int y = 0; y < whole.height; ++y) {
      repeats = repeats && part(0, y) == whole(0, y) && part(1, y) == whole(1, y);
    }
    if (repeats) return part;
  }
  return whole;
}

Matrix3 Multiply(const Matrix3& a, const Matrix3& b) {
  Matrix3 product{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

// EXIF LightSource codes -> the temperature DNG readers take for them.
// Source: Adobe, Digital Negative Specification 1.6 (CalibrationIlluminant1) and EXIF 2.32,
// table 10.
Kelvin TemperatureOfLightSource(int code) {
  switch (code) {
    case 3:   // tungsten
    case 17:  // standard light A
      return Kelvin(2855.54);
    case 24:  // ISO studio tungsten
      return Kelvin(3200.0);
    case 23:
      return Kelvin(5002.78);  // D50
    case 1:                    // daylight
    case 4:                    // flash
    case 9:                    // fine weather
    case 20:                   // D55
      return Kelvin(5502.76);
    case 11:  // shade
    case 22:  // D75
      return Kelvin(7503.9);
    case 18:  // standard light B
      return Kelvin(4874.0);
    case 2:   // fluorescent
    case 14:  // cool white fluorescent
      return Kelvin(4230.0);
    default:  // unknown or other: what most files without the tag mean
      return kD65;
  }
}

struct DngColor {
  Kelvin temperature;
  Matrix3 camera_from_xyz;
  std::optional<Matrix3> forward;
};

template <class Array>
Matrix3 MatrixOf(const Array& rows) {
  Matrix3 matrix{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) matrix[i][j] = rows[i][j];
  }
  return matrix;
}
bool IsWritten(const Matrix3& matrix) { return matrix != Matrix3{}; }

// LibRaw 0.20 leaves parsedfields empty here: what was not written is all zeros.
std::optional<DngColor> DngColorOf(const libraw_colordata_t& color, int which) {
  const libraw_dng_color_t& dng = color.dng_color[which];
  const Matrix3 matrix = MatrixOf(dng.colormatrix);
  if (!IsWritten(matrix)) return std::nullopt;
  Matrix3 calibration = MatrixOf(dng.calibration);
  if (!IsWritten(calibration)) calibration = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double balance = color.dng_levels.analogbalance[i];
    if (!(balance > 0.0)) continue;
    for (double& entry : calibration[i]) entry *= balance;
  }
  DngColor result{TemperatureOfLightSource(dng.illuminant), Multiply(calibration, matrix),
                  std::nullopt};
  if (const Matrix3 forward = MatrixOf(dng.forwardmatrix); IsWritten(forward)) {
    result.forward = forward;
  }
  return result;
}

void TakeDngColors(const libraw_colordata_t& color, FrameInfo& info) {
  std::optional<DngColor> first = DngColorOf(color, 0);
  std::optional<DngColor> second = DngColorOf(color, 1);
  if (!first) first = second;
  if (!first) return;
  if (!second) second = first;
  if (first->temperature > second->temperature) std::swap(first, second);
  info.matrices = CameraMatrices{first->camera_from_xyz, second->camera_from_xyz,
                                 first->temperature, second->temperature};
  if (first->forward && second->forward) {
    info.forward_matrices = std::pair(*first->forward, *second->forward);
  }
}

// The D65 matrix LibRaw knows of cameras that are no DNG.
void TakeBuiltInColors(const libraw_colordata_t& color, FrameInfo& info) {
  const Matrix3 matrix = MatrixOf(color.cam_xyz);
  if (IsWritten(matrix)) info.matrices = CameraMatrices{matrix, matrix, kD65, kD65};
}

void TakeNeutral(const libraw_colordata_t& color, FrameInfo& info) {
  std::array<double, 3> neutral{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double written = color.dng_levels.asshotneutral[i];
    const double balance = color.cam_mul[i];
    neutral[i] = written > 0.0 ? written : (balance > 0.0 ? color.cam_mul[1] / balance : 0.0);
  }
  const auto usable = [](double v) { return std::isfinite(v) && v > 0.0; };
  if (std::all_of(neutral.begin(), neutral.end(), usable)) info.as_shot_neutral = neutral;
}

// Files without EXIF (CRW, old KDC): LibRaw's numbers out of their maker's own tags. Its 1 s and
// f/1 are what it says when it knows nothing.
void FillFromLibRaw(const libraw_imgother_t& other, WrittenExposure& written) {
  const auto fill = [](std::optional<double>& value, double libraw, double unknown) {
    if (!value && std::isfinite(libraw) && libraw > 0.0 && libraw != unknown) value = libraw;
  };
  fill(written.exposure_time_s, other.shutter, 1.0);
  fill(written.f_number, other.aperture, 1.0);
  if (written.iso.value_or(0.0) <= 0.0) written.iso.reset();
  fill(written.iso, other.iso_speed, 0.0);
}

// LibRaw's flip: 1 mirrors columns, 2 rows, 4 exchanges them (libraw_image_sizes_t).
int OrientationOf(int flip) {
  constexpr std::array<int, 8> kOrientation{1, 2, 4, 3, 5, 8, 6, 7};
  return flip >= 0 && flip < 8 ? kOrientation[static_cast<std::size_t>(flip)] : 1;
}

std::string CameraName(const libraw_iparams_t& camera) {
  const std::string_view make(camera.make, strnlen(camera.make, sizeof(camera.make)));
  const std::string_view model(camera.model, strnlen(camera.model, sizeof(camera.model)));
  if (make.empty() || model.starts_with(make)) return std::string(model);
  return std::string(make) + " " + std::string(model);
}

// Black, white and maximum as they stood at the end: LibRaw knows some only after it decoded the
// samples.
SensorLevels SensorLevelsOf(const RawAnswer& answer, const Periodic2d<std::uint8_t>& cfa) {
  const libraw_colordata_t& color = answer.color;
  const libraw_iparams_t& camera = answer.camera;
  // cblack[4], [5]: rows and columns of a further pattern from [6] on.
  const auto bounded = [](unsigned n) {
    constexpr unsigned kMost = LIBRAW_CBLACK_SIZE - 6;
    return static_cast<int>(std::min(n, kMost));
  };
  int rows = bounded(color.cblack[4]), columns = bounded(color.cblack[5]);
  if (static_cast<unsigned>(rows * columns) > LIBRAW_CBLACK_SIZE - 6) rows = columns = 0;
  const bool pattern = rows > 0 && columns > 0;

  SensorLevels levels;
  levels.black.width = std::lcm(std::max(cfa.width, 1), pattern ? columns : 1);
  levels.black.height = std::lcm(std::max(cfa.height, 1), pattern ? rows : 1);
  for (int y = 0; y < levels.black.height; ++y) {
    for (int x = 0; x < levels.black.width; ++x) {
      unsigned black = color.black + color.cblack[LibRawColor(camera, x, y)];
      if (pattern) black += color.cblack[6 + y % rows * columns + x % columns];
      levels.black.values.push_back(
          static_cast<float>(static_cast<double>(black) - answer.tags.black_of_deltas));
    }
  }

  levels.maximum = static_cast<float>(color.maximum);
  levels.white.fill(levels.maximum);
  for (int c = 0; c < 4; ++c) {
    const auto limit = static_cast<float>(color.linear_max[c]);
    if (limit > 0.0F && limit < levels.maximum) {
      float& white = levels.white[ChannelOf(camera, c)];
      white = std::min(white, limit);
    }
  }
  return levels;
}

}  // namespace

Result<FrameInfo> FrameInfoOf(const RawAnswer& answer, const std::string& path) {
  const libraw_iparams_t& camera = answer.camera;
  const RawTags& tags = answer.tags;
  if (camera.filters == kCatchlight || camera.is_foveon != 0) {
    return Refused("unsupported_picture", path,
                   "its sensor has neither a Bayer nor an X-Trans colour filter array; convert it "
                   "to a linear DNG");
  }
  FrameInfo info;
  info.file = path;
  info.format = camera.dng_version != 0 ? "dng" : "raw";
  info.camera = CameraName(camera);
  info.width = answer.sizes.width;
  info.height = answer.sizes.height;
  info.orientation = OrientationOf(answer.sizes.flip);
  info.meaning = camera.filters != kNoFilters ? SampleMeaning::kMosaic : SampleMeaning::kSensor;
  if (info.meaning == SampleMeaning::kMosaic) info.cfa = ColorFilterArray(camera);
  if (std::ranges::find(info.cfa.values, kOtherChannel) != info.cfa.values.end()) {
    return Refused(
        "unsupported_picture", path,
        "its mosaic has filters of other colours (LibRaw calls them " +
            std::string(camera.cdesc, strnlen(camera.cdesc, sizeof(camera.cdesc))) +
            "), and lightcal knows red, green and blue alone; convert it to a linear DNG "
            "(three colours a pixel) or a 16 bit TIFF in a RAW converter");
  }
  if (info.meaning == SampleMeaning::kSensor) info.channels = camera.colors == 1 ? 1 : 3;
  if (answer.color.maximum == 0) {
    return Refused("unsupported_picture", path,
                   "it tells no white level (WhiteLevel), and LibRaw knows none for its samples; "
                   "convert it to a DNG of 16 bit integers");
  }
  info.levels = SensorLevelsOf(answer, info.cfa);

  WrittenExposure written = tags.exposure;
  FillFromLibRaw(answer.other, written);
  info.exposure = ExposureFromTags(written, path, info.warnings);
  if (answer.other.focal_len > 0.0F) {
    info.focal_length = Metres(answer.other.focal_len * 1e-3);
  }
  const double distance = tags.subject_distance_m.value_or(kUnknownDistance);
  if (distance > kUnknownDistance && distance < kInfiniteDistance) {
    info.subject_distance = Metres(distance);
  }
  info.time = IsoTimeFromExif(
      std::string(tags.time.begin(), std::find(tags.time.begin(), tags.time.end(), '\0')));

  const auto numbers = static_cast<std::size_t>(std::clamp(tags.noise_numbers, 0, 8));
  for (std::size_t i = 0; i + 1 < numbers; i += 2) {
    info.noise.push_back({tags.noise_profile[i], tags.noise_profile[i + 1]});
  }
  TakeDngColors(answer.color, info);
  if (!info.matrices) TakeBuiltInColors(answer.color, info);
  TakeNeutral(answer.color, info);
  const double baseline = answer.color.dng_levels.baseline_exposure;
  if (std::abs(baseline) <= kMostBaselineStops) info.baseline_exposure_ev = baseline;
  info.lens_shading_in_opcodes = tags.has_gain_map;
  return info;
}

}  // namespace lightcal::devices
