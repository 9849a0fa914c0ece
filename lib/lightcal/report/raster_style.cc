// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/raster_style.h"

#include <cstddef>
#include <functional>
#include <map>
#include <string_view>

namespace lightcal::report {
namespace {

constexpr std::string_view kMedia = "@media";
constexpr std::string_view kRoot = ":root {";
constexpr std::string_view kVariable = "var(";

// Just behind the brace that closes the one at `open`.
std::size_t EndOfBlock(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '{' ? 1 : 0;
    depth -= text[i] == '}' ? 1 : 0;
    if (text[i] == '}' && depth == 0) return i + 1;
  }
  return text.size();
}

void DropMedia(std::string& css) {
  for (std::size_t at = css.find(kMedia); at != std::string::npos; at = css.find(kMedia, at)) {
    const std::size_t open = css.find('{', at);
    if (open == std::string::npos) return;
    css.erase(at, EndOfBlock(css, open) - at);
  }
}

using Properties = std::map<std::string, std::string, std::less<>>;

// "--ink: #16191d;" -> {"--ink", "#16191d"}, of the first :root.
Properties RootProperties(std::string_view css) {
  Properties properties;
  const std::size_t root = css.find(kRoot);
  if (root == std::string_view::npos) return properties;
  const std::size_t open = root + kRoot.size() - 1;
  const std::string_view block = css.substr(open, EndOfBlock(css, open) - open);
  for (std::size_t at = block.find("--"); at != std::string_view::npos; at = block.find("--", at)) {
    const std::size_t colon = block.find(':', at);
    const std::size_t end = block.find(';', at);
    if (colon == std::string_view::npos || end == std::string_view::npos || colon > end) break;
    const std::size_t value = block.find_first_not_of(' ', colon + 1);
    properties.emplace(block.substr(at, colon - at), block.substr(value, end - value));
    at = end;
  }
  return properties;
}

void Resolve(std::string& css, const Properties& properties) {
  std::size_t at = css.find(kVariable);
  while (at != std::string::npos) {
    const std::size_t end = css.find(')', at);
    if (end == std::string::npos) return;
    const std::size_t name = at + kVariable.size();
    const auto property = properties.find(std::string_view(css).substr(name, end - name));
    if (property != properties.end()) css.replace(at, end + 1 - at, property->second);
    at = css.find(kVariable, at + 1);
  }
}

}  // namespace

std::string ForRaster(std::string svg) {
  const std::size_t begin = svg.find("<style>");
  const std::size_t end = svg.find("</style>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return svg;
  std::string css = svg.substr(begin, end - begin);
  DropMedia(css);
  Resolve(css, RootProperties(css));
  return svg.replace(begin, end - begin, css);
}

}  // namespace lightcal::report
