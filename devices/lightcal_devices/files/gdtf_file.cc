// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/files/gdtf_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <utility>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/archive.h"
#include "lightcal_devices/files/file_bytes.h"

namespace lightcal::devices {
namespace {

constexpr std::size_t kMostDescription = std::size_t{8} << 20;
constexpr int kDeepestGeometry = 64;
constexpr std::size_t kMostOfAKind = 4096;  // emitters, beams, channels: no fixture has as many

// Attributes of one file, and the first that cannot be.
class GdtfReader {
 public:
  explicit GdtfReader(std::string_view name) : name_(name) {}

  std::optional<double> Number(const pugi::xml_node& node, const char* attribute, double least,
                               double most) {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found || *found.value() == '\0') return std::nullopt;
    const auto number = ParseNumber(found.value());
    if (!number || !(*number >= least) || !(*number <= most)) {
      Fail(node, std::string(attribute) + "=\"" + Shown(found.value()) + "\" is no number from " +
                     ShortestText(least) + " to " + ShortestText(most));
      return std::nullopt;
    }
    return number;
  }

  std::optional<Xy> Color(const pugi::xml_node& node, double& Y) {
    const std::string_view text = node.attribute("Color").value();
    if (text.empty() || text == "None") return std::nullopt;
    std::vector<double> parts;
    for (std::size_t from = 0; from <= text.size() && parts.size() < 4;) {
      const std::size_t comma = std::min(text.find(',', from), text.size());
      const auto number = ParseNumber(TrimBlanks(text.substr(from, comma - from)));
      if (!number) break;
      parts.push_back(*number);
      from = comma + 1;
    }
    const bool is_color = parts.size() == 3 && parts[0] >= 0.0 && parts[1] >= 0.0 &&
                          parts[0] + parts[1] <= 1.0 && parts[2] >= 0.0 && parts[2] <= 1e9;
    if (!is_color) {
      Fail(node, "Color=\"" + Shown(text) + "\" is no CIE x,y,Y");
      return std::nullopt;
    }
    Y = parts[2];
    // (0, 0) is what editors write for "not given".
    if (!(parts[1] > 0.0)) return std::nullopt;
    return Xy{parts[0], parts[1]};
  }

  void Fail(const pugi::xml_node& node, std::string why) {
    if (failure_) return;
    const std::string named = node.attribute("Name").value();
    failure_ = Error{ErrorKind::kRefused, "bad_gdtf", name_,
                     std::string(node.name()) + (named.empty() ? "" : " \"" + Shown(named) + "\"") +
                         ": " + std::move(why)};
  }
  // Whether one more of a kind may stand in a list.
  template <class Item>
  bool HasRoom(const std::vector<Item>& items, const pugi::xml_node& node) {
    if (items.size() < kMostOfAKind) return true;
    Fail(node, "there are more than " + std::to_string(kMostOfAKind) + " of them");
    return false;
  }
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }

 private:
  static std::string Shown(std::string_view text) {
    return std::string(text.substr(0, 60)) + (text.size() > 60 ? "..." : "");
  }
  std::string name_;
  std::optional<Error> failure_;
};

constexpr double kMostCandela = 1e12, kMostLumens = 1e12, kMostKelvin = 1e6, kFullTurn = 360.0;
constexpr double kAnyPhysical = 1e12;

GdtfEmitter EmitterFrom(const pugi::xml_node& node, GdtfReader& reader) {
  GdtfEmitter emitter;
  emitter.name = node.attribute("Name").value();
  emitter.xy = reader.Color(node, emitter.Y_percent);
  for (const pugi::xml_node& child : node.children("Measurement")) {
    if (!reader.HasRoom(emitter.measurements, child)) break;
    GdtfMeasurement one;
    const auto physical = reader.Number(child, "Physical", 0.0, 100.0);
    const auto candela = reader.Number(child, "LuminousIntensity", 0.0, kMostCandela);
    for (const pugi::xml_node& point : child.children("MeasurementPoint")) {
      const auto wavelength = reader.Number(point, "WaveLength", 1.0, 1e6);
      const auto energy = reader.Number(point, "Energy", -kAnyPhysical, kAnyPhysical);
      if (!wavelength || !energy) continue;
      if (!reader.HasRoom(one.energy, point)) break;
      one.wavelengths_nm.push_back(*wavelength);
      one.energy.push_back(*energy);
    }
    if (!physical || !(*physical > 0.0)) continue;
    one.physical_percent = *physical;
    one.luminous_intensity_cd = candela.value_or(0.0);
    emitter.measurements.push_back(std::move(one));
  }
  return emitter;
}

void TakeBeams(const pugi::xml_node& parent, int depth, GdtfReader& reader,
               std::vector<GdtfBeam>& beams) {
  for (const pugi::xml_node& node : parent.children()) {
    if (reader.failure()) return;
    if (depth > kDeepestGeometry) {
      reader.Fail(node, "geometries stand in one another more than " +
                            std::to_string(kDeepestGeometry) + " deep");
      return;
    }
    if (std::strcmp(node.name(), "Beam") == 0 && reader.HasRoom(beams, node)) {
      GdtfBeam beam;
      beam.name = node.attribute("Name").value();
      beam.type = node.attribute("BeamType").as_string("Wash");
      beam.flux_lm = reader.Number(node, "LuminousFlux", 0.0, kMostLumens);
      beam.cct_K = reader.Number(node, "ColorTemperature", 0.0, kMostKelvin);
      beam.beam_deg = reader.Number(node, "BeamAngle", 0.0, kFullTurn);
      beam.field_deg = reader.Number(node, "FieldAngle", 0.0, kFullTurn);
      beam.radius_m = reader.Number(node, "BeamRadius", 0.0, 1e6);
      beam.power_W = reader.Number(node, "PowerConsumption", 0.0, kAnyPhysical);
      beam.emitter = node.attribute("EmitterSpectrum").value();
      if (beam.emitter == "None") beam.emitter.clear();
      beams.push_back(std::move(beam));
    }
    TakeBeams(node, depth + 1, reader, beams);
  }
}

GdtfProfile ProfileFrom(const pugi::xml_node& node, GdtfReader& reader) {
  GdtfProfile profile;
  profile.name = node.attribute("Name").value();
  for (const pugi::xml_node& child : node.children("Point")) {
    if (!reader.HasRoom(profile.points, child)) break;
    const auto coefficient = [&](const char* name) {
      return reader.Number(child, name, -kAnyPhysical, kAnyPhysical).value_or(0.0);
    };
    profile.points.push_back({reader.Number(child, "DMXPercentage", 0.0, 100.0).value_or(0.0),
                              coefficient("CFC0"), coefficient("CFC1"), coefficient("CFC2"),
                              coefficient("CFC3")});
  }
  return profile;
}

std::vector<int> SlotsFrom(const pugi::xml_node& node, GdtfReader& reader) {
  std::vector<int> slots;
  const std::string_view text = node.attribute("Offset").value();
  if (text.empty() || text == "None") return slots;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const auto slot = ParseNumber(TrimBlanks(text.substr(from, comma - from)));
    if (!slot || *slot < 1.0 || *slot > 512.0 || *slot != std::floor(*slot) || slots.size() > 8) {
      reader.Fail(node, "Offset names no DMX slots from 1 to 512");
      return {};
    }
    slots.push_back(static_cast<int>(*slot));
    from = comma + 1;
  }
  return slots;
}

GdtfMode ModeFrom(const pugi::xml_node& node, GdtfReader& reader) {
  GdtfMode mode;
  mode.name = node.attribute("Name").value();
  for (const pugi::xml_node& child : node.child("DMXChannels").children("DMXChannel")) {
    if (!reader.HasRoom(mode.channels, child)) break;
    const pugi::xml_node logical = child.child("LogicalChannel");
    const pugi::xml_node function = logical.child("ChannelFunction");
    GdtfChannel channel;
    channel.attribute = logical.attribute("Attribute").value();
    channel.geometry = child.attribute("Geometry").value();
    channel.offset = SlotsFrom(child, reader);
    channel.physical_from = reader.Number(function, "PhysicalFrom", -kAnyPhysical, kAnyPhysical);
    channel.physical_to = reader.Number(function, "PhysicalTo", -kAnyPhysical, kAnyPhysical);
    channel.profile = function.attribute("DMXProfile").value();
    channel.emitter = function.attribute("Emitter").value();
    mode.channels.push_back(std::move(channel));
  }
  return mode;
}

}  // namespace

Result<GdtfFixture> GdtfFromDescription(std::string_view xml, std::string_view name) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml.data(), xml.size());
  if (!parsed) {
    return Refused("bad_gdtf", std::string(name),
                   std::string("its description.xml is no XML: ") + parsed.description() +
                       " at byte " + std::to_string(parsed.offset));
  }
  const pugi::xml_node type = document.child("GDTF").child("FixtureType");
  if (!type) {
    return Refused("bad_gdtf", std::string(name),
                   "its description.xml holds no GDTF FixtureType; is it an MVR scene?");
  }
  GdtfReader reader(name);
  GdtfFixture fixture;
  fixture.name = type.attribute("Name").value();
  fixture.manufacturer = type.attribute("Manufacturer").value();
  fixture.description = type.attribute("Description").value();
  fixture.id = type.attribute("FixtureTypeID").value();
  const pugi::xml_node physical = type.child("PhysicalDescriptions");
  for (const pugi::xml_node& node : physical.child("Emitters").children("Emitter")) {
    if (!reader.HasRoom(fixture.emitters, node)) break;
    fixture.emitters.push_back(EmitterFrom(node, reader));
  }
  for (const pugi::xml_node& node : physical.child("DMXProfiles").children("DMXProfile")) {
    if (!reader.HasRoom(fixture.profiles, node)) break;
    fixture.profiles.push_back(ProfileFrom(node, reader));
  }
  TakeBeams(type.child("Geometries"), 0, reader, fixture.beams);
  for (const pugi::xml_node& node : type.child("DMXModes").children("DMXMode")) {
    if (!reader.HasRoom(fixture.modes, node)) break;
    fixture.modes.push_back(ModeFrom(node, reader));
  }
  if (reader.failure()) return tl::unexpected(*reader.failure());
  return fixture;
}

Result<GdtfFixture> GdtfFromArchive(std::string_view bytes, std::string_view name) {
  auto xml = files::FileInZip(bytes, "description.xml", kMostDescription, name);
  if (!xml) return Propagate(std::move(xml));
  return GdtfFromDescription(*xml, name);
}

Result<GdtfFixture> ReadGdtf(const std::string& path) {
  const files::FileBytes file = files::ReadFileBytes(path, files::kMaxFileBytes);
  switch (file.fault) {
    case files::FileFault::kNone:
      return GdtfFromArchive(file.bytes, path);
    case files::FileFault::kTooLarge:
      return Refused("too_large", path, "is larger than 256 MiB; no fixture is");
    case files::FileFault::kMissing:
      return Failed("not_found", path, "there is no such file");
    case files::FileFault::kDirectory:
    case files::FileFault::kUnreadable:
      break;
  }
  return Failed("unreadable", path, "cannot be read as a file");
}

}  // namespace lightcal::devices
