// SPDX-License-Identifier: Apache-2.0
// Matches as people and machines read them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console.h"
#include "lightcal/match/match_lights.h"
#include "lightcal/records/gel.h"

namespace lightcal::app {

// One quantity's u95, low95 and high95, each in a table of its own.
struct IntervalTables {
  Node u95 = Node::Table(), low = Node::Table(), high = Node::Table();
  void Put(std::string_view key, const std::optional<Uncertain>& value) {
    if (!value) return;
    u95.Put(key, value->u95);
    low.Put(key, value->low);
    high.Put(key, value->high);
  }
};

// A light by its name and colour.
[[nodiscard]] Node LightNode(const std::string& title, Xy xy, const CctResult& cct);
[[nodiscard]] Node MatchNode(const match::Match& match, const GelSet& set);
// A row a match, then the lamp without gels.
[[nodiscard]] std::string MatchTable(const std::vector<match::Match>& matches,
                                     const match::Match& unfiltered, const GelSet& set);
// "L204 Full C.T. Orange + L247 LEE Minus Green", "no gel".
[[nodiscard]] std::string StackTitle(const std::vector<std::size_t>& gels, const GelSet& set);

}  // namespace lightcal::app
