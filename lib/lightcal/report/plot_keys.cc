// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/plot_keys.h"

#include <charconv>
#include <optional>

#include "lightcal/report/label_placement.h"
#include "lightcal/report/svg.h"

namespace lightcal::report {
namespace {

constexpr double kKeyMark = 22.0, kKeyLead = 6.0, kKeyGap = 18.0;  // px
constexpr double kKeyLine = 20.0, kKeyMargin = 12.0;

// Of HTML that is text with a few tags.
std::string WithoutTags(std::string_view html) {
  std::string out;
  bool tag = false;
  for (const char c : html) {
    if (c == '<') tag = true;
    if (!tag) out += c;
    if (c == '>') tag = false;
  }
  return out;
}

// The numbers after "0 0 " of a figure's viewBox.
struct ViewBox {
  std::size_t begin = 0, end = 0;  // of them in the text
  double width = 0.0, height = 0.0;
};
std::optional<ViewBox> ViewBoxOf(std::string_view svg) {
  constexpr std::string_view kBox = "viewBox=\"0 0 ";
  const std::size_t at = svg.find(kBox);
  if (at == std::string_view::npos) return std::nullopt;
  ViewBox box;
  box.begin = at + kBox.size();
  box.end = svg.find('"', box.begin);
  if (box.end == std::string_view::npos) return std::nullopt;
  const char* const last = svg.data() + box.end;
  const auto width = std::from_chars(svg.data() + box.begin, last, box.width);
  if (width.ec != std::errc() || width.ptr == last) return std::nullopt;
  const auto height = std::from_chars(width.ptr + 1, last, box.height);
  return height.ec == std::errc() ? std::optional(box) : std::nullopt;
}

}  // namespace

PlotKey LineKey(std::string_view css, std::string_view words) {
  return {"<line class=\"" + std::string(css) + "\" x1=\"0\" y1=\"6\" x2=\"22\" y2=\"6\"/>",
          std::string(words)};
}
PlotKey BandKey(std::string_view css, std::string_view words) {
  return {"<rect class=\"" + std::string(css) + "\" x=\"0\" y=\"1\" width=\"22\" height=\"10\"/>",
          std::string(words)};
}
PlotKey DotKey(std::string_view words) {
  return {"<circle class=\"used\" cx=\"11\" cy=\"6\" r=\"4\"/>", std::string(words)};
}
PlotKey ReadingKey(std::string_view words) {
  return {"<line class=\"whisker\" x1=\"11\" y1=\"0\" x2=\"11\" y2=\"12\"/>" + DotKey("").mark,
          std::string(words)};
}
PlotKey CrossKey(std::string_view words) {
  return {"<path class=\"rejected\" d=\"M7 2L15 10M7 10L15 2\"/>", std::string(words)};
}

std::string CaptionHtml(const PlotCaption& caption) {
  std::string out;
  for (const PlotKey& key : caption.keys) {
    out += "<span class=\"key\"><svg viewBox=\"0 0 22 12\" aria-hidden=\"true\">" + key.mark +
           "</svg>" + key.words + "</span>";
  }
  return out + caption.words;
}

std::string WithCaption(std::string svg, const PlotCaption& caption) {
  const std::optional<ViewBox> box = ViewBoxOf(svg);
  const std::string words = WithoutTags(caption.words);
  if (!box || (caption.keys.empty() && words.empty())) return svg;
  std::string marks;
  double x = kKeyMargin, y = box->height + kKeyLine - 6.0;
  const auto write = [&](const std::string& mark, const std::string& text) {
    const double lead = mark.empty() ? 0.0 : kKeyMark + kKeyLead;
    const double width = lead + NoteWidth(text);
    if (x > kKeyMargin && x + width > box->width - kKeyMargin) {
      x = kKeyMargin;
      y += kKeyLine;
    }
    if (!mark.empty()) {
      marks += "<g transform=\"translate(" + Px(x) + " " + Px(y - 10.0) + ")\">" + mark + "</g>";
    }
    marks +=
        "<text class=\"note\" x=\"" + Px(x + lead) + "\" y=\"" + Px(y) + "\">" + text + "</text>\n";
    x += width + kKeyGap;
  };
  for (const PlotKey& key : caption.keys) write(key.mark, key.words);
  if (!words.empty()) write("", words);
  svg.insert(svg.rfind("</svg>"), "<g class=\"keys\">\n" + marks + "</g>\n");
  return svg.replace(box->begin, box->end - box->begin, Px(box->width) + " " + Px(y + kKeyMargin));
}

}  // namespace lightcal::report
