// SPDX-License-Identifier: Apache-2.0
#include "lightcal/presets/learnt_engine.h"

#include <algorithm>
#include <cmath>

#include "lightcal/presets/preset_document.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

constexpr std::string_view kEngineSchema = "lightcal.engine/1";

}  // namespace

double LearntEngine::FactorOf(LightKind kind) const {
  const auto it = std::ranges::find(kinds, kind, &LearntKind::kind);
  return it == kinds.end() ? 1.0 : it->factor;
}

bool LearntEngine::Knows(LightKind kind) const {
  return std::ranges::find(kinds, kind, &LearntKind::kind) != kinds.end();
}

Result<std::string> EngineText(const LearntEngine& engine, std::string_view generator,
                               const std::string& subject) {
  return JsonText({{"schema", kEngineSchema},
                   {"generator", generator},
                   {"absolute", engine.absolute},
                   {"kinds", records::Node::List(engine.kinds,
                                                 [](const LearntKind& kind) -> records::Node {
                                                   return {{"kind", LightKindName(kind.kind)},
                                                           {"factor", kind.factor},
                                                           {"u95_relative", kind.u95_relative},
                                                           {"cause", kind.cause}};
                                                 })}},
                  subject);
}

Result<LearntEngine> EngineFrom(const std::string& text, const std::string& path) {
  const auto root = records::ParseJson(text);
  const records::Node* kinds = root ? root->Find("kinds") : nullptr;
  if (kinds == nullptr || root->TextAt("schema") != kEngineSchema || kinds->items.empty()) {
    return Refused("bad_engine", path, "is no engine file; learn one from a renderer's pictures");
  }
  LearntEngine engine;
  const records::Node* absolute = root->Find("absolute");
  engine.absolute = absolute == nullptr || absolute->boolean;
  for (const records::Node& item : kinds->items) {
    const auto kind = LightKindFromName(item.TextAt("kind"));
    const records::Node* factor = item.Find("factor");
    if (!kind || factor == nullptr || !factor->IsNumber() || !std::isfinite(factor->number) ||
        !(factor->number > 1e-9 && factor->number < 1e9) || engine.Knows(*kind)) {
      return Refused("bad_engine", path,
                     "each of its kinds needs a \"kind\" of light, once, and a \"factor\" above 0");
    }
    const records::Node* u95 = item.Find("u95_relative");
    const bool sure = u95 != nullptr && u95->IsNumber() && u95->number >= 0.0;
    engine.kinds.push_back({*kind, factor->number, sure ? u95->number : 0.0, item.TextAt("cause")});
  }
  return engine;
}

}  // namespace lightcal
