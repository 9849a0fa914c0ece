// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/learnt_engine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lightcal/presets/preset_document.h"
#include "lightcal/presets/turned_panorama.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using records::Node;

constexpr std::string_view kEngineSchema = "lightcal.engine/1";
constexpr double kRightAngle_rad = std::numbers::pi / 2.0;
constexpr double kHardShare = 0.999;  // inner over outer of a cone without a penumbra

// ---- JSON ----

Node ConeNode(const LearntCone& cone) {
  return {{"written", kConeLawWords[static_cast<std::size_t>(cone.written)]},
          {"law", kConeLawWords[static_cast<std::size_t>(cone.law)]},
          {"outer_times", cone.outer_times},
          {"inner_times", cone.inner_times},
          {"hard", cone.hard}};
}

Node TurnNode(const LearntTurn& turn) {
  return {{"way", MistakenTurns()[turn.way].word}, {"turn_deg", turn.turn_deg}};
}

Node EngineKindNode(const LearntKind& kind) {
  Node node = {{"kind", LightKindName(kind.kind)},
               {"factor", kind.factor},
               {"u95_relative", kind.u95_relative},
               {"cause", kind.cause}};
  if (kind.area_power != 0) node.Put("area_power", kind.area_power);
  if (kind.cone) node.Put("cone", ConeNode(*kind.cone));
  if (kind.turn) node.Put("panorama", TurnNode(*kind.turn));
  return node;
}

std::optional<EngineConeLaw> LawAt(const Node& cone, const char* key) {
  const auto it = std::ranges::find(kConeLawWords, cone.TextAt(key));
  if (it == kConeLawWords.end()) return std::nullopt;
  return static_cast<EngineConeLaw>(it - kConeLawWords.begin());
}

std::optional<double> NumberWithin(const Node& from, const char* key, double least, double most) {
  const Node* node = from.Find(key);
  if (node == nullptr || !node->IsNumber()) return std::nullopt;
  if (!(node->number >= least && node->number <= most)) return std::nullopt;
  return node->number;
}

std::optional<LearntCone> ConeFrom(const Node& node) {
  const auto written = LawAt(node, "written"), law = LawAt(node, "law");
  const auto outer = NumberWithin(node, "outer_times", 0.01, 100.0);
  const auto inner = NumberWithin(node, "inner_times", 0.0, 100.0);
  if (!written || !law || !outer || !inner) return std::nullopt;
  const Node* hard = node.Find("hard");
  return LearntCone{*written, *law, *outer, *inner, hard != nullptr && hard->boolean};
}

std::optional<LearntTurn> TurnFrom(const Node& node) {
  const auto ways = MistakenTurns();
  const auto it = std::ranges::find(ways, node.TextAt("way"), &MistakenTurn::word);
  const auto turn = NumberWithin(node, "turn_deg", -360.0, 360.0);
  if (it == ways.end() || !turn) return std::nullopt;
  return LearntTurn{static_cast<std::size_t>(it - ways.begin()), *turn};
}

// Absent: one of its parts cannot be.
std::optional<LearntKind> KindFrom(const Node& item) {
  const auto kind = LightKindFromName(item.TextAt("kind"));
  const auto factor = NumberWithin(item, "factor", 1e-9, 1e9);
  if (!kind || !factor) return std::nullopt;
  LearntKind learnt{.kind = *kind,
                    .factor = *factor,
                    .u95_relative = NumberWithin(item, "u95_relative", 0.0, 1e9).value_or(0.0),
                    .cause = item.TextAt("cause")};
  if (item.Find("area_power") != nullptr) {
    const auto power = NumberWithin(item, "area_power", -1.0, 1.0);
    if (!power || *power != std::round(*power)) return std::nullopt;
    learnt.area_power = static_cast<int>(*power);
  }
  if (const Node* cone = item.Find("cone")) {
    learnt.cone = ConeFrom(*cone);
    if (!learnt.cone) return std::nullopt;
  }
  if (const Node* turn = item.Find("panorama")) {
    learnt.turn = TurnFrom(*turn);
    if (!learnt.turn) return std::nullopt;
  }
  return learnt;
}

bool FalseAt(const Node& root, const char* key) {
  const Node* node = root.Find(key);
  return node != nullptr && !node->boolean;
}

}  // namespace

EngineCone LearntCone::Of(const EngineCone& file) const {
  EngineCone cone = file;
  cone.law = law;
  const double outer = std::min(kRightAngle_rad, outer_times * file.cone.outer.value());
  const double inner = hard ? kHardShare * outer : inner_times * file.cone.inner.value();
  cone.cone = {Radians(std::min(inner, kHardShare * outer)), Radians(outer)};
  return cone;
}

EngineCone LearntCone::ToWrite(const BeamProfile& beam) const {
  EngineCone cone = hard                 ? RefitCone(law, beam, kHardShare)
                    : inner_times == 0.0 ? RefitCone(law, beam, 0.0)
                                         : RefitCone(law, beam);
  const double outer = std::min(kRightAngle_rad, cone.cone.outer.value() / outer_times);
  const double inner =
      hard || inner_times == 0.0 ? 0.5 * outer : cone.cone.inner.value() / inner_times;
  cone.law = written;
  cone.cone = {Radians(std::min(inner, 0.9999 * outer)), Radians(outer)};
  return cone;
}

double LearntEngine::FactorOf(LightKind kind, double area_m2) const {
  const auto it = std::ranges::find(kinds, kind, &LearntKind::kind);
  if (it == kinds.end()) return 1.0;
  return area_m2 > 0.0 ? it->factor * std::pow(area_m2, it->area_power) : it->factor;
}

bool LearntEngine::Knows(LightKind kind) const {
  return std::ranges::find(kinds, kind, &LearntKind::kind) != kinds.end();
}

const LearntCone* LearntEngine::ConeWrittenFor(EngineConeLaw law) const {
  for (const LearntKind& kind : kinds) {
    if (kind.cone && kind.cone->written == law) return &*kind.cone;
  }
  return nullptr;
}

std::optional<LearntTurn> LearntEngine::TurnOfDomes() const {
  for (const LearntKind& kind : kinds) {
    if (kind.turn && !kind.turn->IsNone()) return kind.turn;
  }
  return std::nullopt;
}

double SurfaceOf(LightKind kind, std::optional<double> diameter_m, std::optional<double> width_m,
                 std::optional<double> height_m, std::optional<double> length_m,
                 std::optional<double> radius_m) {
  const double pi = std::numbers::pi;
  switch (kind) {
    case LightKind::kSphere:
      return diameter_m ? pi * *diameter_m * *diameter_m : 0.0;
    case LightKind::kDisk:
      return diameter_m ? pi / 4.0 * *diameter_m * *diameter_m : 0.0;
    case LightKind::kRect:
      return width_m && height_m ? *width_m * *height_m : 0.0;
    case LightKind::kTube:
      return length_m && radius_m ? 2.0 * pi * *radius_m * *length_m : 0.0;
    default:
      return 0.0;
  }
}

Node EngineNode(const LearntEngine& engine) {
  return {{"absolute", engine.absolute},
          {"exposure_applied", engine.exposure_applied},
          {"kinds", Node::List(engine.kinds, EngineKindNode)}};
}

Result<std::string> EngineText(const LearntEngine& engine, std::string_view generator,
                               const std::string& subject) {
  Node document = {{"schema", kEngineSchema}, {"generator", generator}};
  document.Put(EngineNode(engine));
  return JsonText(document, subject);
}

Result<LearntEngine> EngineFrom(const std::string& text, const std::string& path) {
  const auto root = records::ParseJson(text);
  const Node* kinds = root ? root->Find("kinds") : nullptr;
  if (kinds == nullptr || root->TextAt("schema") != kEngineSchema || kinds->items.empty()) {
    return Refused("bad_engine", path, "is no engine file; learn one from a renderer's pictures");
  }
  LearntEngine engine;
  engine.absolute = !FalseAt(*root, "absolute");
  engine.exposure_applied = !FalseAt(*root, "exposure_applied");
  for (const Node& item : kinds->items) {
    auto kind = KindFrom(item);
    if (!kind || engine.Knows(kind->kind)) {
      return Refused("bad_engine", path,
                     "each of its kinds needs a \"kind\" of light, once, a \"factor\" above 0, and "
                     "where it has them a whole \"cone\" and \"panorama\"");
    }
    engine.kinds.push_back(*std::move(kind));
  }
  return engine;
}

}  // namespace lightcal
