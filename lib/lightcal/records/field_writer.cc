// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/field_writer.h"

#include <cmath>

#include "lightcal/core/numbers_text.h"

namespace lightcal::records {
namespace {

// The roundest number of degrees that reads back as the same radians: 30, never 30.000000000000004.
double RoundestDegrees(Radians angle) {
  const double exact = DegreesFromRadians(angle);
  constexpr int kEnoughDigits = 17;
  for (int digits = 1; digits <= kEnoughDigits; ++digits) {
    const auto rounded = ParseNumber(RoundedText(exact, digits));
    if (rounded && RadiansFromDegrees(*rounded) == angle) return *rounded;
  }
  // Multiplying by 180/pi may land beside the number that was read.
  for (const double end : {-360.0, 360.0}) {
    const double neighbour = std::nextafter(exact, end);
    if (RadiansFromDegrees(neighbour) == angle) return neighbour;
  }
  return exact;
}

}  // namespace

void FieldWriter::Controls(std::string_view key, const FixtureState& state) {
  Node table = Node::Table();
  for (const ControlValue& control : state) {
    table.Put(control.name,
              control.IsWord() ? Node(control.word) : Node(Unsigned0(control.number)));
  }
  if (!table.members.empty()) Put(key, std::move(table));
}

void FieldWriter::Degrees(std::string_view key, Radians value, const NumberRule& /*rule*/) {
  if (value.value() != 0.0) Put(key, RoundestDegrees(value));
}

std::optional<std::string> FindNotFinite(const Node& node) {
  if (node.kind == Node::Kind::kNumber && !std::isfinite(node.number)) return "";
  const auto below = [](const std::string& step, const Node& inner) -> std::optional<std::string> {
    const auto found = FindNotFinite(inner);
    if (!found) return std::nullopt;
    const bool joined = found->empty() || found->front() == '[';
    return step + (joined ? "" : ".") + *found;
  };
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (auto found = below("[" + std::to_string(i) + "]", node.items[i])) return found;
  }
  for (const auto& [key, value] : node.members) {
    if (auto found = below(key, value)) return found;
  }
  return std::nullopt;
}

}  // namespace lightcal::records
