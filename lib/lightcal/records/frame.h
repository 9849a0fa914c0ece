// SPDX-License-Identifier: Apache-2.0
// One picture as a measurement: its samples, what they mean, and under which exposure they came.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "lightcal/colorimetry/camera_neutral.h"
#include "lightcal/colorimetry/rgb_spaces.h"
#include "lightcal/core/result.h"
#include "lightcal/core/units.h"
#include "lightcal/core/view2d.h"
#include "lightcal/photometry/exposure.h"
#include "lightcal/records/projection.h"

namespace lightcal {

// A value that repeats over the picture: value(x, y) = values[(y % height) * width + x % width].
// (0, 0) is the first pixel of the frame's view.
template <class T>
struct Periodic2d {
  int width = 1, height = 1;
  std::vector<T> values;

  [[nodiscard]] const T& operator()(int x, int y) const {
    return values[static_cast<std::size_t>(y % height) * width + x % width];
  }
};

enum class SampleMeaning {
  kMosaic,   // sensor values behind a colour filter array, one a pixel: signal = sample - black
  kSensor,   // sensor values, every channel at every pixel (linear DNG, monochrome): likewise
  kLinear,   // scene-linear colour: EXR, Radiance HDR, float TIFF; black is 0
  kEncoded,  // codes through a camera's response curve: PNG, JPEG, integer TIFF
};

// The channels of camera and colour pictures.
inline constexpr int kRedChannel = 0, kGreenChannel = 1, kBlueChannel = 2;

// Where the sensor's scale begins and ends, in the units of the samples.
struct SensorLevels {
  Periodic2d<float> black;  // per place of the pattern: LibRaw's black + cblack + its pattern
  std::array<float, 4>
      white{};           // per channel: the end of the linear range the file or LibRaw names
                         // (linear_max where known, else the maximum), black included.
                         // Sensors may clip below it: a spike of the histogram tells.
  float maximum = 0.0F;  // largest value the encoding allows, black included
};

// Exposure as the tags say it, before anything was made of them; absent = no such tag.
struct WrittenExposure {
  std::optional<double> exposure_time_s{};  // EXIF ExposureTime: a label such as 1/60
  std::optional<double> shutter_apex{};     // EXIF ShutterSpeedValue, Tv
  std::optional<double> f_number{};         // EXIF FNumber
  std::optional<double> aperture_apex{};    // EXIF ApertureValue, Av
  std::optional<double> iso{};
  std::optional<double> t_stop{};             // cine lenses: f-number and transmittance in one
  std::optional<double> shutter_angle_deg{};  // cine cameras: open for angle/360 of a frame
  std::optional<double> frames_per_second{};
};

// Exposure as it is believed to have been. Absent where the file says nothing, zero, or nonsense:
// absolute use must refuse then (no_exposure_metadata), never assume 1 s or f/1.
struct FrameExposure {
  std::optional<Seconds> time;
  std::optional<double> f_number;
  std::optional<double> t_stop;  // measured transmission: for light it stands before the f-number
  std::optional<double> iso;
  bool time_snapped = false;      // moved from its label to the true grid (1/60 -> 2^-6 s)
  bool f_number_snapped = false;  // likewise (f/5.6 -> 2^(5/2))
  bool overridden = false;        // the session or the command line gave some of it
  WrittenExposure written;

  // N of H = q L t / N^2 with the q of ordinary lenses, whose transmittance is 0.9: N = T sqrt(0.9)
  // of a T-stop.
  [[nodiscard]] std::optional<double> light_f_number() const {
    return t_stop ? std::optional(*t_stop * std::sqrt(LensTransmission{}.transmittance)) : f_number;
  }
};

// DNG NoiseProfile of one plane: Var(x) = scale x + offset, x = (sample - black)/(white - black).
struct NoiseProfile {
  double scale = 0.0;
  double offset = 0.0;
};

// Everything about a picture but its samples; reading it costs well under a millisecond.
struct FrameInfo {
  std::string file;
  std::string format;  // "dng" "raw" "exr" "hdr" "tiff" "png" "jpeg"
  std::string camera;  // make and model, "" = unknown
  int width = 0, height = 0, channels = 1;
  // Of TIFF 6.0 and Exif: how viewers show it; 1 as it is stored. Finished pictures are turned when
  // they are read; codes and sensor values are as stored.
  int orientation = 1;
  SampleMeaning meaning = SampleMeaning::kLinear;

  FrameExposure exposure;
  std::optional<Metres> focal_length;
  std::optional<Metres> subject_distance;  // EXIF SubjectDistance, where the lens tells
  std::optional<int> image_counter;        // OpenEXR imageCounter
  std::string time;                        // ISO 8601 without zone, "" = unknown

  // Mosaic and sensor frames.
  Periodic2d<std::uint8_t> cfa;        // channel (0 R, 1 G, 2 B) per place; empty unless kMosaic
  std::optional<SensorLevels> levels;  // kMosaic, kSensor; kEncoded: black 0, white = top code
  std::vector<NoiseProfile> noise;     // one, or one a channel; empty = the file has none
  std::optional<CameraMatrices> matrices;  // AnalogBalance CameraCalibration ColorMatrix
  // ForwardMatrix of the warm and cool calibration light: XYZ(D50) from balanced camera RGB.
  std::optional<std::pair<Matrix3, Matrix3>> forward_matrices;
  std::optional<std::array<double, 3>> as_shot_neutral;
  double baseline_exposure_ev = 0.0;     // DNG BaselineExposure: a rendering wish, never photometry
  bool lens_shading_in_opcodes = false;  // DNG OpcodeList2 or 3 present; it is not applied here

  // Linear pictures.
  std::vector<std::string> channel_names;      // as in the file, in the order of the samples
  std::optional<RgbPrimaries> chromaticities;  // absent = the file does not say
  std::optional<Nits> white_luminance;         // luminance of RGB (1,1,1): EXR whiteLuminance
  double radiance_exposure = 1.0;    // Radiance: product of EXPOSURE lines, divide samples by it
  bool environment_latlong = false;  // EXR envmap = latlong
  std::optional<WrittenView> view;   // how it was projected: Radiance's VIEW lines
  // Text attributes the file carries that are ours ("lightcal:..."), without that prefix.
  std::vector<std::pair<std::string, std::string>> lightcal_attributes;

  Warnings warnings;  // what reading the tags found: exposure_tags_disagree, ...
};

// 16 bit sensor values or codes, or float; the view may leave out masked borders.
using SampleView = std::variant<View2d<const std::uint16_t>, View2d<const float>>;

// A picture with its samples. Copies share them.
struct Frame {
  FrameInfo info;
  SampleView samples;
  std::shared_ptr<const void> owner;  // keeps what `samples` looks at
  bool in_file = false;               // they lie in a mapped file, from which they can come back
};

// Where decoded samples live. A scratch file is mapped and already deleted: the system drops its
// pages when memory is short, so that any number of frames can be open at once.
enum class SampleStore { kMemory, kScratchFile };

}  // namespace lightcal
