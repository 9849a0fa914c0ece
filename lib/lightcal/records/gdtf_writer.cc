// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/xml_text.h"
#include "lightcal/records/gdtf.h"

namespace lightcal {
namespace {

class Attributes {
 public:
  Attributes& Text(std::string_view name, std::string_view value) {
    text_ += " " + std::string(name) + "=\"" + XmlEscaped(value) + "\"";
    return *this;
  }
  Attributes& Number(std::string_view name, double value) {
    return Text(name, ShortestText(value));
  }
  Attributes& Number(std::string_view name, const std::optional<double>& value) {
    return value ? Number(name, *value) : *this;
  }
  Attributes& TextIfAny(std::string_view name, std::string_view value) {
    return value.empty() ? *this : Text(name, value);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class XmlWriter {
 public:
  void Open(const std::string& name, const Attributes& attributes = {}) {
    Line("<" + name + attributes.text() + ">");
    ++depth_;
  }
  void Close(const std::string& name) {
    --depth_;
    Line("</" + name + ">");
  }
  void Leaf(const std::string& name, const Attributes& attributes = {}) {
    Line("<" + name + attributes.text() + "/>");
  }
  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  void Line(const std::string& line) {
    text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + line + "\n";
  }
  std::string text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  int depth_ = 0;
};

// "0.396212,0.373284,100.000000": the schema takes no exponents.
std::string ColorCie(Xy xy, double Y) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.6f,%.6f,%.6f", xy.x, xy.y, Y);
  return text.data();
}

bool IsTemperatureAttribute(std::string_view name) {
  return name == "CTC" || name == "CTO" || name == "CTB";
}

void WriteAttributes(const GdtfFixture& fixture, XmlWriter& xml) {
  std::set<std::string> used;
  for (const GdtfMode& mode : fixture.modes) {
    for (const GdtfChannel& channel : mode.channels) used.insert(GdtfName(channel.attribute));
  }
  xml.Open("AttributeDefinitions");
  xml.Leaf("ActivationGroups");
  xml.Open("FeatureGroups");
  for (const char* group : {"Dimmer", "Color", "Control"}) {
    xml.Open("FeatureGroup", Attributes().Text("Name", group).Text("Pretty", group));
    xml.Leaf("Feature", Attributes().Text("Name", group));
    xml.Close("FeatureGroup");
  }
  xml.Close("FeatureGroups");
  xml.Open("Attributes");
  for (const std::string& name : used) {
    const bool color = IsTemperatureAttribute(name) || name.starts_with("ColorAdd_");
    const bool dimmer = name == "Dimmer";
    xml.Leaf("Attribute", Attributes()
                              .Text("Name", name)
                              .Text("Pretty", dimmer ? "Dim" : name)
                              .Text("Feature", dimmer  ? "Dimmer.Dimmer"
                                               : color ? "Color.Color"
                                                       : "Control.Control")
                              .Text("PhysicalUnit", IsTemperatureAttribute(name) ? "Temperature"
                                                    : dimmer ? "LuminousIntensity"
                                                             : "None"));
  }
  xml.Close("Attributes");
  xml.Close("AttributeDefinitions");
}

void WriteEmitter(const GdtfEmitter& emitter, XmlWriter& xml) {
  Attributes own;
  own.Text("Name", GdtfName(emitter.name));
  if (emitter.xy) own.Text("Color", ColorCie(*emitter.xy, emitter.Y_percent));
  xml.Open("Emitter", own);
  for (const GdtfMeasurement& one : emitter.measurements) {
    const Attributes measured = Attributes()
                                    .Number("Physical", one.physical_percent)
                                    .Number("LuminousIntensity", one.luminous_intensity_cd)
                                    .Text("InterpolationTo", "Linear");
    xml.Open("Measurement", measured);
    for (std::size_t i = 0; i < one.wavelengths_nm.size() && i < one.energy.size(); ++i) {
      xml.Leaf(
          "MeasurementPoint",
          Attributes().Number("WaveLength", one.wavelengths_nm[i]).Number("Energy", one.energy[i]));
    }
    xml.Close("Measurement");
  }
  xml.Close("Emitter");
}

void WritePhysical(const GdtfFixture& fixture, XmlWriter& xml) {
  xml.Open("PhysicalDescriptions");
  xml.Open("Emitters");
  for (const GdtfEmitter& emitter : fixture.emitters) WriteEmitter(emitter, xml);
  xml.Close("Emitters");
  xml.Open("DMXProfiles");
  for (const GdtfProfile& profile : fixture.profiles) {
    xml.Open("DMXProfile", Attributes().Text("Name", GdtfName(profile.name)));
    for (const GdtfProfile::Point& point : profile.points) {
      xml.Leaf("Point", Attributes()
                            .Number("DMXPercentage", point.from_percent)
                            .Number("CFC0", point.c0)
                            .Number("CFC1", point.c1)
                            .Number("CFC2", point.c2)
                            .Number("CFC3", point.c3));
    }
    xml.Close("DMXProfile");
  }
  xml.Close("DMXProfiles");
  xml.Close("PhysicalDescriptions");
}

void WriteGeometries(const GdtfFixture& fixture, XmlWriter& xml) {
  constexpr std::string_view kUnmoved = "{1,0,0,0}{0,1,0,0}{0,0,1,0}{0,0,0,1}";
  xml.Open("Geometries");
  xml.Open("Geometry", Attributes().Text("Name", "Body").Text("Position", kUnmoved));
  for (const GdtfBeam& beam : fixture.beams) {
    xml.Leaf("Beam",
             Attributes()
                 .Text("Name", GdtfName(beam.name))
                 .Text("Position", kUnmoved)
                 .Number("PowerConsumption", beam.power_W)
                 .Number("LuminousFlux", beam.flux_lm)
                 .Number("ColorTemperature", beam.cct_K)
                 .Number("BeamAngle", beam.beam_deg)
                 .Number("FieldAngle", beam.field_deg)
                 .Number("BeamRadius", beam.radius_m)
                 .Text("BeamType", beam.type)
                 .TextIfAny("EmitterSpectrum", beam.emitter.empty() ? "" : GdtfName(beam.emitter)));
  }
  xml.Close("Geometry");
  xml.Close("Geometries");
}

void WriteChannel(const GdtfChannel& channel, XmlWriter& xml) {
  const std::string attribute = GdtfName(channel.attribute);
  const std::string geometry = GdtfName(channel.geometry);
  const std::string offset =
      Joined(channel.offset, ",", [](int slot) { return std::to_string(slot); });
  const std::string bytes = std::to_string(std::max<std::size_t>(1, channel.offset.size()));
  const bool dimmer = attribute == "Dimmer";
  xml.Open(
      "DMXChannel",
      Attributes()
          .Text("DMXBreak", "1")
          .Text("Offset", offset.empty() ? "None" : offset)
          .Text("InitialFunction", geometry + "_" + attribute + "." + attribute + "." + attribute)
          .Text("Highlight", dimmer ? (bytes == "2" ? "65535/2" : "255/1") : "None")
          .Text("Geometry", geometry));
  xml.Open("LogicalChannel", Attributes()
                                 .Text("Attribute", attribute)
                                 .Text("Snap", "No")
                                 .Text("Master", dimmer ? "Grand" : "None"));
  xml.Leaf("ChannelFunction",
           Attributes()
               .Text("Name", attribute)
               .Text("Attribute", attribute)
               .Text("DMXFrom", "0/" + bytes)
               .Text("Default", "0/" + bytes)
               .Number("PhysicalFrom", channel.physical_from)
               .Number("PhysicalTo", channel.physical_to)
               .TextIfAny("Emitter", channel.emitter.empty() ? "" : GdtfName(channel.emitter))
               .TextIfAny("DMXProfile", channel.profile.empty() ? "" : GdtfName(channel.profile)));
  xml.Close("LogicalChannel");
  xml.Close("DMXChannel");
}

}  // namespace

double GdtfOutput(const GdtfProfile& profile, double percent) {
  const GdtfProfile::Point* last = nullptr;
  for (const GdtfProfile::Point& point : profile.points) {
    if (point.from_percent > percent) continue;
    if (last == nullptr || point.from_percent >= last->from_percent) last = &point;
  }
  if (last == nullptr) return 0.0;
  const double t = percent - last->from_percent;
  return last->c0 + t * (last->c1 + t * (last->c2 + t * last->c3));
}

std::string GdtfName(std::string_view name) {
  constexpr std::string_view kOthers = "#%()*+-/:;<=>@_`\"' ";
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    out += plain || kOthers.find(c) != std::string_view::npos ? c : '_';
  }
  return out;
}

std::string GdtfDescription(const GdtfFixture& fixture) {
  XmlWriter xml;
  xml.Open("GDTF", Attributes().Text("DataVersion", "1.2"));
  xml.Open("FixtureType", Attributes()
                              .Text("Name", GdtfName(fixture.name))
                              .Text("ShortName", fixture.name)
                              .Text("LongName", fixture.name)
                              .Text("Manufacturer", fixture.manufacturer)
                              .Text("Description", fixture.description)
                              .Text("FixtureTypeID", fixture.id)
                              .Text("CanHaveChildren", "No"));
  WriteAttributes(fixture, xml);
  xml.Leaf("Wheels");
  WritePhysical(fixture, xml);
  xml.Leaf("Models");
  WriteGeometries(fixture, xml);
  xml.Open("DMXModes");
  for (const GdtfMode& mode : fixture.modes) {
    xml.Open("DMXMode", Attributes().Text("Name", GdtfName(mode.name)).Text("Geometry", "Body"));
    xml.Open("DMXChannels");
    for (const GdtfChannel& channel : mode.channels) WriteChannel(channel, xml);
    xml.Close("DMXChannels");
    xml.Close("DMXMode");
  }
  xml.Close("DMXModes");
  xml.Leaf("Revisions");
  xml.Leaf("FTPresets");
  xml.Leaf("Protocols");
  xml.Close("FixtureType");
  xml.Close("GDTF");
  return xml.Take();
}

}  // namespace lightcal
