// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/preset_document.h"

#include <utility>

#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/provenance_fields.h"

namespace lightcal {

using records::Node;

namespace {

Node NodeOfCard(const RigCard& card) {
  return {{"name", card.name},
          {"reflectance", card.reflectance},
          {"centre_m", NodeOf(card.centre_m)},
          {"illuminance_lx", card.illuminance},
          {"luminance_nits", card.luminance},
          // Of one light it is the illuminance.
          {"lights_lx", card.by_light.size() > 1 ? Node::List(card.by_light) : Node()}};
}

}  // namespace

Node NodeOf(const Rgb& color) { return NodeOf(std::array<double, 3>{color.r, color.g, color.b}); }

Node NodeOf(const RigExposure& exposure) {
  return {{"ev100", exposure.ev100}, {"exposure", exposure.scale}};
}

Node NodeOf(const Rig& rig) {
  const RigCamera& camera = rig.camera;
  return {{"light", rig.light},
          {"distance_m", rig.distance},
          {"separation_m", rig.separation},
          {"from_reading", rig.from_reading},
          {"normal", NodeOf(rig.normal)},
          {"row", NodeOf(rig.row)},
          {"side_m", rig.side},
          {"cards", Node::List(rig.cards, NodeOfCard)},
          {"off_axis_deg", rig.place.OnAxis() ? Node() : Node(rig.place.off_axis_deg)},
          {"round_deg", rig.place.OnAxis() ? Node() : Node(rig.place.round_deg)},
          {"camera", Node{{"position_m", NodeOf(camera.position_m)},
                          {"target_m", NodeOf(camera.target_m)},
                          {"up", NodeOf(camera.up)},
                          {"vertical_fov_deg", DegreesFromRadians(camera.vertical_fov)},
                          {"aspect_ratio", camera.aspect_ratio}}}};
}

Node NodeOf(const Provenance& provenance) {
  Provenance named = provenance;
  if (named.generator.empty()) named.generator = "lightcal";
  records::FieldWriter writer;
  records::VisitProvenance(writer, std::as_const(named));
  return *writer.TakeTable().Find("provenance");
}

Node NodeOf(const std::optional<Uncertain>& value) { return value ? DocumentOf(*value) : Node(); }

Node ColorNode(const PresetLight& light) {
  return NodeOf(light.environment ? Rgb{1.0, 1.0, 1.0} : light.color().max_normalised);
}

Node MeasuredNode(const FittedLight& lamp, const PresetLight& light) {
  return {{"kind", LightKindName(lamp.kind)},
          {"intensity_cd", NodeOf(lamp.intensity_cd)},
          {"illuminance_lx", NodeOf(lamp.illuminance_lx)},
          {"luminance_nits", NodeOf(lamp.luminance_nits)},
          {"distance_offset_m", NodeOf(lamp.distance_offset_m)},
          {"cct_K", NodeOf(lamp.color.cct_K)},
          {"duv", NodeOf(lamp.color.duv)},
          {"color_luminance", light.color().luminance},
          {"substituted", Node::UnlessEmpty(light.substitution)}};
}

DerivedLight DerivedFrom(const Node& light) {
  constexpr std::size_t kLongest = 4;
  DerivedLight derived;
  derived.type = light.TextAt("type");
  if (const Node* measured = light.Find("measured")) {
    derived.substitution = measured->TextAt("substituted");
  }
  for (const auto& [key, value] : light.members) {
    if (value.IsNumber()) derived.Put(key, value.number);
    const std::vector<Node>& items = value.items;
    if (items.empty() || items.size() > kLongest || !items.front().IsNumber()) continue;
    std::vector<double> numbers;
    for (const Node& item : items) numbers.push_back(item.number);
    derived.Put(key, std::move(numbers));
  }
  return derived;
}

Rig Turned(Rig rig, Vec3 (*map)(const Vec3&)) {
  for (RigCard& card : rig.cards) card.centre_m = map(card.centre_m);
  rig.normal = map(rig.normal);
  rig.row = map(rig.row);
  rig.camera.position_m = map(rig.camera.position_m);
  rig.camera.target_m = map(rig.camera.target_m);
  rig.camera.up = map(rig.camera.up);
  return rig;
}

Result<std::string> JsonText(const Node& document, const std::string& subject, Written written) {
  if (records::FindNotFinite(document)) {
    return Failed("not_finite", subject, "a number of the light is not finite; nothing exported");
  }
  if (written == Written::kFigures) return std::string();
  return PrintJson(document, records::JsonLayout::kPretty) + "\n";
}

}  // namespace lightcal
