// SPDX-License-Identifier: Apache-2.0
// The colours that go with what is typed in: "+ colour" names them, this spells them out.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "lamp_words.h"
#include "lightcal/records/document.h"

namespace lightcal::app {

// "0.94, 0.67, 0.43 (linear)" of a figure's note; "" where it has no colour.
[[nodiscard]] inline std::string ColorOf(const EngineFigure& figure) {
  return HasColor(figure) ? figure.color : "";
}

// A line a colour, with the engines that take it.
[[nodiscard]] inline std::string ColorLines(const std::vector<EngineFigure>& figures) {
  std::vector<std::string> colors;
  std::string text;
  for (const EngineFigure& figure : figures) {
    const std::string color = ColorOf(figure);
    if (color.empty() || std::ranges::find(colors, color) != colors.end()) continue;
    colors.push_back(color);
    std::string engines;
    for (const EngineFigure& same : figures) {
      if (ColorOf(same) == color) engines += (engines.empty() ? "" : ", ") + same.engine;
    }
    text += LabelledLine(text.empty() ? "colour" : "", engines + " " + color);
  }
  return text;
}

[[nodiscard]] inline Node TypeInNode(const EngineFigure& figure) {
  Node node = {{"engine", figure.engine}, {"field", figure.field}, {"value", figure.value}};
  if (!figure.unit.empty()) node.Put("unit", figure.unit);
  if (!figure.note.empty()) node.Put("note", figure.note);
  return node;
}

}  // namespace lightcal::app
