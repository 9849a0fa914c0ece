// SPDX-License-Identifier: Apache-2.0
// SYNTHETIC: a camera that never existed photographs scenes of known luminance. It is the truth the
// readers of brackets are held against, so it shares no code with them: no header of lightcal is
// included here. It adds what an estimator does not model: pixels of unequal gain, a knee below
// saturation, noise that whole rows share, shutters that jitter.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lightcal::test {

struct SyntheticCamera {
  int width = 600, height = 400;
  double base_iso = 100.0;
  double sensitivity = 1.0;      // true sensitivity / what the ISO says: what an anchor has to find
  double full_well_e = 60000.0;  // electrons at saturation and base ISO
  double black_dn = 512.0, white_dn = 15871.0;
  double read_noise_e = 3.5;
  double row_noise_e = 0.0;      // 1 sigma, one draw a row and frame
  double prnu_relative = 0.0;    // 1 sigma of the pixels' gain; the same in every frame
  double knee_relative = 0.0;    // signal missing at full well; grows as a square from 80 % on
  std::uint64_t pixel_seed = 1;  // of the gains
  bool monochrome = false;       // every pixel sees Y; written as LinearRaw
  bool x_trans = false;          // colour filters of 6 x 6 instead of RGGB
  // True black less black_dn, of red, green, blue; charge that gathers in the dark, and in some
  // pixels (x, y) more of it.
  std::array<double, 3> black_error_dn{};
  double dark_e_per_s = 0.0, hot_e_per_s = 0.0;
  std::vector<std::array<int, 2>> hot_pixels;
  // Share of the light that the lens lets through to a pixel, by colour 0, 1, 2; none = all.
  std::function<double(int x, int y, int color)> lens;
  // Camera RGB of XYZ, DNG ColorMatrix1 (D65): green of the D65 white at Y = 1 is 1.
  std::array<std::array<double, 3>, 3> camera_from_xyz{{{0.634534, -0.059942, -0.090904},
                                                        {-0.404678, 1.176181, 0.191436},
                                                        {-0.085712, 0.204085, 0.535040}}};
  double lens_q = 0.65;  // H = q L t/N^2
};

// With what no estimator models: pixels of unequal gain, a knee of 1 %, noise of whole rows.
[[nodiscard]] SyntheticCamera FlawedCamera(int width, int height);

struct SyntheticExposure {
  double true_time_s = 1.0 / 64;   // what the shutter does, jitter included
  double label_time_s = 1.0 / 60;  // EXIF ExposureTime; 0 writes 0/1
  double true_f_number = 8.0;
  double label_f_number = 8.0;
  double iso = 100.0;
  std::array<double, 3> filter{1.0, 1.0, 1.0};  // what a filter before the lens lets through
  bool apex_tags = false;  // also write ShutterSpeedValue and ApertureValue, from the label's
                           // neighbour on the third stop grid
  std::uint64_t seed = 1;
};

struct SyntheticXyz {
  double X = 0.0, Y = 0.0, Z = 0.0;  // Y in cd/m^2
};
// Colour of the scene at the pixel (x, y).
using SyntheticScene = std::function<SyntheticXyz(int x, int y)>;

// XYZ of luminance Y in the chromaticity (x, y); D65 by default.
[[nodiscard]] SyntheticXyz XyzOf(double luminance_nits, double x = 0.31272, double y = 0.32903);

// Luminance of a D65 surface that just saturates the green pixels:
//   78/(q S) N^2/t / sensitivity, with the true time and aperture.
[[nodiscard]] double SaturatingNits(const SyntheticCamera& camera,
                                    const SyntheticExposure& exposure);

// Colour (0 R, 1 G, 2 B) that the pixel (x, y) sees through its filter.
[[nodiscard]] int FilterAt(const SyntheticCamera& camera, int x, int y);

// Mosaic of DN. Each pixel: electrons from a Poisson law, gain of the pixel, knee, full well,
// read noise of a normal law, rounding, clipping to [0, white].
[[nodiscard]] std::vector<std::uint16_t> Expose(const SyntheticCamera& camera,
                                                const SyntheticExposure& exposure,
                                                const SyntheticScene& scene);

// `frames` exposures around ISO 100, `stops` apart, true times 2^(k/3) s on the third stop grid
// from `shortest_s` (given as the true time), labelled as dials label them and multiplied by a
// jitter of the given 1 sigma.
[[nodiscard]] std::vector<SyntheticExposure> ExposureSeries(double shortest_s, int frames,
                                                            double stops, double f_number,
                                                            double jitter_relative,
                                                            std::uint64_t seed);
// The dial's label for a true time on the third stop grid between 1/8000 and 30 s.
[[nodiscard]] double DialLabel(double true_time_s);

// Patches side by side in `columns` columns, each of one luminance.
struct StepWedge {
  std::vector<double> nits;
  int columns = 8;
  int width = 600, height = 400;
  double x = 0.31272, y = 0.32903;

  [[nodiscard]] int PatchAt(int px, int py) const;
  [[nodiscard]] SyntheticScene Scene() const;
};
// `count` luminances in equal ratios.
[[nodiscard]] std::vector<double> LogSteps(double lowest_nits, double highest_nits, int count);

}  // namespace lightcal::test
