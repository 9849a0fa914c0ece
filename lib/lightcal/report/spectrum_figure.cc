// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/spectrum_figure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lightcal/report/svg.h"
#include "lightcal/report/swatch.h"
#include "lightcal/report/text.h"

namespace lightcal::report {
namespace {

constexpr double kFirst_nm = 380.0, kLast_nm = 780.0;
constexpr double kStop_nm = 10.0;
constexpr double kSpectrumHeadroom = 1.08;
constexpr double kMilliwatts = 1e3;

struct Sample {
  double nm, power;
};

std::vector<Sample> Shown(const Spectrum& spectrum) {
  std::vector<Sample> samples;
  const double unit = spectrum.quantity == SpectralQuantity::kIrradiance ? kMilliwatts : 1.0;
  for (std::size_t i = 0; i < spectrum.wavelengths_nm.size(); ++i) {
    const double nm = spectrum.wavelengths_nm[i];
    if (nm < kFirst_nm || nm > kLast_nm) continue;
    samples.push_back({nm, unit * std::max(0.0, spectrum.values[i])});
  }
  return samples;
}

// The eye sees less and less towards both ends.
double Brightness(double nm) {
  if (nm < 430.0) return 0.25 + 0.75 * (nm - kFirst_nm) / 50.0;
  if (nm > 670.0) return 0.25 + 0.75 * (kLast_nm - nm) / 110.0;
  return 1.0;
}

std::string ColorOf(double nm) {
  const Xyz seen = ColorMatchingAt(Nanometres(nm));
  const Rgb c = LinearSrgbFromXyz(seen);
  const double largest = std::max({c.r, c.g, c.b});
  const double scale = largest > 0.0 ? Brightness(nm) / largest : 0.0;
  return HexOf({c.r * scale, c.g * scale, c.b * scale});
}

std::string Gradient(const std::string& id, const Axis& x) {
  std::string markup = "<linearGradient id=\"" + id +
                       "\" gradientUnits=\"userSpaceOnUse\" y1=\"0\" y2=\"0\" x1=\"" +
                       Px(x.At(kFirst_nm)) + "\" x2=\"" + Px(x.At(kLast_nm)) + "\">";
  for (double nm = kFirst_nm; nm <= kLast_nm; nm += kStop_nm) {
    markup += "<stop offset=\"" + Px((nm - kFirst_nm) / (kLast_nm - kFirst_nm)) +
              "\" stop-color=\"" + ColorOf(nm) + "\"/>";
  }
  return markup + "</linearGradient>";
}

}  // namespace

std::string SpectrumFigure(const LightSpectrum& light, std::string_view id) {
  std::vector<Sample> samples = Shown(light.spectrum);
  if (samples.size() < 2) return "";
  const double most = std::ranges::max_element(samples, {}, &Sample::power)->power;
  if (!(most > 0.0)) return "";
  const bool absolute = light.spectrum.quantity == SpectralQuantity::kIrradiance;
  const double unit = absolute ? 1.0 : most;
  const PlotArea& area = Svg::Area();
  const Axis x{AxisScale::kLinear, kFirst_nm, kLast_nm, area.left, area.right};
  const Axis y{AxisScale::kLinear, 0.0, kSpectrumHeadroom * most / unit, area.bottom, area.top};
  const std::string name(id);
  Svg svg(name, "Spectrum",
          absolute ? "Spectral irradiance against wavelength, written by lightcal"
                   : "Relative spectral power against wavelength, written by lightcal");
  svg.Element(Gradient(name + "-colors", x));
  svg.Axes(x, y, "wavelength (nm)",
           absolute ? "irradiance (mW m⁻² nm⁻¹)" : "relative spectral power");
  std::vector<PagePoint> line;
  for (const Sample& sample : samples)
    line.emplace_back(x.At(sample.nm), y.At(sample.power / unit));
  std::vector<PagePoint> filled = line;
  filled.emplace_back(line.back().first, area.bottom);
  filled.emplace_back(line.front().first, area.bottom);
  svg.BeginPlot();
  svg.Element("<path class=\"spectrum\" fill=\"url(#" + name + "-colors)\" d=\"" +
              PathData(filled, true) + "\"/>");
  svg.Path("outline", line);
  svg.EndPlot();
  return svg.Finish();
}

}  // namespace lightcal::report
