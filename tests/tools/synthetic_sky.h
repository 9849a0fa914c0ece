// SPDX-License-Identifier: Apache-2.0
// Surroundings that never existed: lamps with sharp, darkened or blurred edges over any background,
// looked at by brute force (many rays a pixel), and what they truly are. Includes nothing of the
// room that reads such pictures.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace lightcal::test {

using Ray = std::array<double, 3>;  // unit vector: right-handed, Z up, the picture's centre is +Y
using Rgb3 = std::array<double, 3>;

double AngleBetween(const Ray& a, const Ray& b);  // rad
// Degrees right of +Y, and above the horizon.
Ray RayAt(double azimuth_deg, double elevation_deg);

struct SkyLamp {
  Ray direction{0.0, 1.0, 0.0};
  double radius_deg = 1.0;   // of the disc; of a blurred lamp its standard deviation
  double lux = 100.0;        // at normal incidence
  Rgb3 tint{1.0, 1.0, 1.0};  // RGB at luminance 1
  double limb = 0.0;         // L(mu) = 1 - limb (1 - mu), mu = sqrt(1 - (r/R)^2); the sun: 0.6
  bool blurred = false;      // L = exp(-r^2/2 s^2)

  [[nodiscard]] double Shape(double angle) const;  // L / L of the middle
  [[nodiscard]] double Reach() const;              // rad; 0 beyond
  // L of the middle [cd/m^2], from lux = integral of L cos dOmega.
  [[nodiscard]] double MiddleNits() const;
};

struct SkyScene {
  std::function<Rgb3(const Ray&)> background;
  std::vector<SkyLamp> lamps;
};

struct SkyPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

// Where a point of a picture looks (pixel centres at .5); no value: nowhere.
struct SkyRay {
  bool seen = false;
  Ray ray{};
};
using SkyView = std::function<SkyRay(double x, double y)>;
SkyView LatLongView(int width, int height);
enum class Lens {
  kRect,         // r = f tan theta, fov across the width
  kEquidistant,  // r = f theta, fov across the circle that touches the shorter sides
  kEquisolid,    // r = 2 f sin(theta/2), likewise
};
// The axis looks to azimuth, elevation; the camera's top leans to its right by roll.
SkyView LensView(Lens lens, int width, int height, double fov_deg, double azimuth_deg,
                 double elevation_deg, double roll_deg);
// r = f theta over `fov_deg` across the circle; the axis looks to azimuth, elevation; the picture's
// top is towards the zenith.
SkyView FisheyeView(int size, double fov_deg, double azimuth_deg, double elevation_deg);

// Each pixel is the mean of many rays: 3 x 3, and 24 x 24 where a lamp's edge may cross it.
SkyPicture Photograph(const SkyScene& scene, const SkyView& view, int width, int height);
// The lamps alone, added to a picture.
void AddLamps(const std::vector<SkyLamp>& lamps, const SkyView& view, SkyPicture& picture);

// E of a plane, by rays spread evenly over the sphere for the background and exactly n . d lux for
// each lamp in front of the plane.
double TrueLux(const SkyScene& scene, const Ray& normal);
// Rec. 709 luminance.
double Luminance(const Rgb3& rgb);

}  // namespace lightcal::test
