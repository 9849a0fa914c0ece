// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/tm27_spdx.h"

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <string>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/spectrum_readings.h"

namespace lightcal::devices::files {
namespace {

constexpr std::string_view kRoot = "IESTM27";  // IESTM2714, and the 2020 edition's IESTM2720
// Quantities of light that are no irradiance: their colour is as good, their lux unknown.
constexpr std::array<std::string_view, 5> kColorOnly = {"relative", "flux", "intensity", "radiance",
                                                        "exitance"};

std::string_view LocalName(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

pugi::xml_node Child(const pugi::xml_node& parent, std::string_view name) {
  return parent.find_child([&](const pugi::xml_node& node) { return LocalName(node) == name; });
}

std::string TextOf(const pugi::xml_node& parent, std::string_view name) {
  return std::string(TrimBlanks(Child(parent, name).text().get()));
}

// Sets what the values are; a warning where only their colour can be used.
Result<std::optional<Warning>> TakeQuantity(FoundSpectrum& found, const std::string& written) {
  const std::string quantity = LowerAscii(written);
  if (quantity == "irradiance") {
    found.imported.spectrum.quantity = SpectralQuantity::kIrradiance;
    return std::nullopt;
  }
  found.imported.spectrum.quantity = SpectralQuantity::kRelative;
  if (quantity == "relative") return std::nullopt;
  const bool light =
      quantity.empty() || std::ranges::find(kColorOnly, quantity) != kColorOnly.end();
  if (!light) {
    return Refused("bad_spectrum", found.where,
                   "its SpectralQuantity is '" + written +
                       "', which is no light; irradiance or relative is needed");
  }
  return Warning{
      "relative_spectrum", found.where,
      "its SpectralQuantity is '" + written + "', not irradiance, so only its colour is used"};
}

Result<void> TakeSamples(FoundSpectrum& found, const pugi::xml_node& distribution) {
  for (const pugi::xml_node& sample : distribution.children()) {
    if (LocalName(sample) != "SpectralData") continue;
    const auto wavelength = ParseNumber(sample.attribute("wavelength").value());
    const auto value = ParseNumber(sample.text().get());
    if (!wavelength || !value) {
      return Refused("bad_spectrum", found.where,
                     "SpectralData wavelength=\"" +
                         std::string(sample.attribute("wavelength").value()) + "\" holds '" +
                         std::string(sample.text().get()) + "', which is no number");
    }
    found.imported.spectrum.wavelengths_nm.push_back(*wavelength);
    found.imported.spectrum.values.push_back(*value);
  }
  return {};
}

}  // namespace

bool IsTm27Spdx(std::string_view text) {
  const std::string_view beginning = TrimBlanks(text.substr(0, 4096));
  return beginning.starts_with('<') && beginning.find(kRoot) != std::string_view::npos;
}

Result<std::vector<Tm27Distribution>> Tm27Distributions(std::string_view text,
                                                        std::string_view name) {
  pugi::xml_document document;
  const auto parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  const pugi::xml_node root = document.document_element();
  if (!parsed || !LocalName(root).starts_with(kRoot)) {
    return Refused("bad_spectrum", std::string(name),
                   std::string("is no whole TM-27 document: ") +
                       (parsed ? "another root element" : parsed.description()));
  }
  std::vector<Tm27Distribution> all;
  for (const pugi::xml_node& distribution : root.children()) {
    if (LocalName(distribution) != "SpectralDistribution") continue;
    Tm27Distribution one;
    one.found.where = name;
    one.found.imported.name = TextOf(Child(root, "Header"), "Description");
    one.quantity = TextOf(distribution, "SpectralQuantity");
    if (auto taken = TakeSamples(one.found, distribution); !taken) {
      return Propagate(std::move(taken));
    }
    all.push_back(std::move(one));
  }
  if (all.empty()) {
    return Refused("bad_spectrum", std::string(name), "holds no SpectralDistribution");
  }
  return all;
}

Result<ImportedFile> ReadTm27Spdx(std::string_view text, std::string_view name) {
  auto distributions = Tm27Distributions(text, name);
  if (!distributions) return Propagate(std::move(distributions));
  std::vector<FoundSpectrum> all;
  Warnings warnings;
  for (Tm27Distribution& one : *distributions) {
    auto warning = TakeQuantity(one.found, one.quantity);
    if (!warning) return Propagate(std::move(warning));
    if (*warning) warnings.push_back(std::move(**warning));
    all.push_back(std::move(one.found));
  }
  return ImportedFromSpectra("tm27_spdx", std::move(all), std::move(warnings));
}

}  // namespace lightcal::devices::files
