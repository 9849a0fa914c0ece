// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/style.h"

namespace lightcal::report {
namespace {

// Blue and vermilion are of Okabe and Ito's set, told apart by every common colour vision; used and
// rejected readings differ in shape as well.
constexpr std::string_view kFigures = R"css(
:root {
  color-scheme: light dark;
  --page: #ffffff; --panel: #f6f5f2; --ink: #15181c; --soft: #565d67; --rule: #e1dfda;
  --accent: #0067a8; --band: rgba(0, 114, 178, .17); --warn: #b84300; --well: #2f7d32;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #101214; --panel: #1a1d20; --ink: #eff1f3; --soft: #a9b1ba; --rule: #2f343a;
    --accent: #63b8ee; --band: rgba(86, 180, 233, .22); --warn: #f0954a; --well: #7fce83;
  }
}
svg { display: block; width: 100%; height: auto; max-width: 560px; }
svg.wide { max-width: 980px; }
svg text { fill: var(--ink); font-family: inherit; font-size: 13.5px; }
svg .tick, svg .note { fill: var(--soft); font-size: 13px; }
svg .tick.halo, svg .note.halo { paint-order: stroke; stroke: var(--page); stroke-width: 4px; stroke-linejoin: round; }
svg .score { font-size: 24px; font-weight: 650; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg .frame { fill: none; stroke: var(--soft); stroke-width: 1.2; }
svg .zero { stroke: var(--accent); stroke-width: 1.8; }
svg .model { fill: none; stroke: var(--accent); stroke-width: 2.2; }
svg .band { fill: var(--band); stroke: none; }
svg .wedge { fill: var(--soft); opacity: .22; stroke: none; }
svg .whisker { stroke: var(--ink); stroke-width: 1.5; }
svg .used { fill: var(--ink); stroke: var(--page); stroke-width: 1.4; }
svg .rejected { fill: none; stroke: var(--warn); stroke-width: 2.4; stroke-linecap: round; }
svg .setting { fill: var(--soft); stroke: var(--page); stroke-width: 1; }
svg .chosen { fill: var(--warn); stroke: var(--page); stroke-width: 1.2; }
svg .locus { fill: none; stroke: var(--ink); stroke-width: 2; }
svg .second { fill: none; stroke: var(--warn); stroke-width: 2; stroke-dasharray: 7 4; }
svg .ring { fill: none; stroke: var(--rule); stroke-width: 1; }
svg .guide { fill: none; stroke: var(--ink); stroke-width: 1; stroke-dasharray: 4 4; opacity: .6; }
svg .isotherm { stroke: var(--soft); stroke-width: 1; }
svg .ellipse { fill: var(--band); stroke: var(--ink); stroke-width: 1.2; }
svg .field-across { opacity: .38; }
svg .field-up { opacity: .24; }
svg .spectrum { stroke: none; opacity: .88; }
svg .outline { fill: none; stroke: var(--ink); stroke-width: 1.3; stroke-linejoin: round; }
svg .hue { stroke: var(--page); stroke-width: 1; opacity: .22; }
svg .chroma { fill: none; stroke: var(--soft); stroke-width: 1; stroke-dasharray: 3 4; opacity: .6; }
svg .reference { fill: none; stroke: var(--ink); stroke-width: 2; }
svg .gamut { fill: none; stroke: var(--warn); stroke-width: 2.6; }
svg .shift { stroke: var(--ink); stroke-width: 2.2; }
svg .shifted { stroke: var(--ink); stroke-width: 1.2; }
svg .region { fill: none; stroke: #ffffff; stroke-width: 1.6; }
svg .region.halo { stroke: #000000; stroke-width: 4; stroke-opacity: .6; }
)css";

constexpr std::string_view kPage = R"css(
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  font-variant-numeric: tabular-nums;
}
main { max-width: 1160px; margin: 0 auto; padding: 56px 32px 72px; }
h1 { font-size: 38px; line-height: 1.15; letter-spacing: -.022em; font-weight: 700; margin: 0 0 8px; overflow-wrap: anywhere; }
h2 { font-size: 24px; line-height: 1.25; letter-spacing: -.01em; margin: 0; overflow-wrap: anywhere; }
h3 { font-size: 16px; margin: 0 0 12px; font-weight: 650; letter-spacing: -.003em; }
h4 { font-size: 14px; margin: 0; font-weight: 600; }
p { margin: 0 0 10px; }
.lead, .soft { color: var(--soft); }
.small { font-size: 14px; }
section.light { margin-top: 56px; }
.summary {
  display: grid; grid-template-columns: minmax(0, 9fr) minmax(0, 10fr); gap: 20px 44px; align-items: center;
  border-radius: 18px; padding: 30px 34px; background: var(--panel);
  background: radial-gradient(90% 180% at 0 0, color-mix(in srgb, var(--lamp, var(--rule)) 55%, transparent), transparent 78%), var(--panel);
}
.parts { display: flex; height: 12px; border-radius: 6px; overflow: hidden; margin: 16px 0 6px; max-width: 420px; background: var(--rule); }
.parts span { display: block; height: 100%; }
.part-walls { background: var(--soft); opacity: .75; }
.part-meter { background: var(--accent); }
.part-offset { background: var(--warn); }
.part-other { background: var(--rule); }
.legend { font-size: 14px; margin: 0 0 14px; }
.legend i { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 5px; }
.legend span { white-space: nowrap; margin-right: 14px; }
.advice { margin: 0 0 4px; font-size: 15px; overflow-wrap: anywhere; }
.advice b { font-weight: 620; }
.first { min-width: 0; }
details.rest { margin-top: 44px; }
details.rest > summary { cursor: pointer; font-weight: 620; padding: 10px 0; border-top: 1px solid var(--rule); }
.cards.below-first { margin-top: 30px; }
.title { display: flex; align-items: center; gap: 14px; flex-wrap: wrap; }
.swatch { width: 30px; height: 30px; border-radius: 50%; background: var(--lamp); border: 1px solid var(--rule); flex: none; }
.kind { color: var(--soft); font-size: 15px; }
.hero { font-size: 64px; line-height: 1.05; font-weight: 680; letter-spacing: -.03em; margin: 20px 0 8px; }
.hero .unit { font-size: 28px; font-weight: 500; letter-spacing: 0; }
.hero .pm { font-size: 24px; font-weight: 400; color: var(--soft); letter-spacing: 0; white-space: nowrap; }
.summary p:last-child { margin: 0; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(190px, 1fr)); gap: 20px 24px; margin: 0; padding: 0; }
.card { border-left: 2px solid var(--rule); padding: 0 0 0 14px; }
.card dt { color: var(--soft); font-size: 13.5px; }
.card dd { margin: 1px 0 0; font-size: 18px; font-weight: 620; }
.card .sub { display: block; font-size: 13.5px; font-weight: 400; color: var(--soft); }
.engines { list-style: none; display: grid; grid-template-columns: repeat(auto-fill, minmax(240px, 1fr)); gap: 12px; margin: 0; padding: 0; }
.engines li { border: 1px solid var(--rule); border-radius: 12px; padding: 14px 16px; break-inside: avoid; min-width: 0; }
.engines p { margin: 0; }
.engines .field { color: var(--soft); font-size: 13px; overflow-wrap: anywhere; }
.engines .number { margin: 8px 0 6px; font-size: 16px; }
.engines .copy { font-size: 22px; font-weight: 680; letter-spacing: -.01em; -webkit-user-select: all; user-select: all; cursor: copy; overflow-wrap: anywhere; }
.engines .copy.long { font-size: 16px; letter-spacing: 0; }
.engines .unit { color: var(--soft); white-space: nowrap; }
.engines .note { color: var(--soft); font-size: 13px; line-height: 1.4; overflow-wrap: anywhere; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 44px 40px; margin-top: 44px; align-items: start; }
figure { margin: 0; min-width: 0; }
figure.sheet img { display: block; width: 100%; max-width: 940px; height: auto; }
figcaption { font-size: 14px; color: var(--soft); margin-top: 10px; overflow-wrap: anywhere; }
figcaption b { color: var(--ink); font-weight: 600; }
.key { white-space: nowrap; margin-right: 14px; }
.key svg { display: inline-block; width: 22px; height: 12px; vertical-align: -1px; margin-right: 5px; }
.below { margin-top: 44px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14.5px; }
th, td { text-align: left; padding: 8px 16px 8px 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
thead th, thead td { color: var(--soft); font-weight: 500; font-size: 13.5px; }
tbody th { font-weight: 550; }
td.n, th.n { text-align: right; white-space: nowrap; }
th:last-child, td:last-child { padding-right: 0; }
.overview { margin-top: 34px; }
.overview td, .overview tbody th { font-size: 15.5px; padding-top: 10px; padding-bottom: 10px; }
.overview tbody th { font-weight: 600; overflow-wrap: anywhere; }
.overview td { white-space: nowrap; }
.stack td:not(.n), .stack thead th:not(.n):not(:first-child) { padding-left: 8px; }
.share { display: inline-block; height: 10px; min-width: 1px; background: var(--accent); border-radius: 2px; }
.off { color: var(--warn); font-weight: 600; }
.ran::before { content: "● "; color: var(--well); }
.notran::before { content: "○ "; color: var(--soft); }
.notran { color: var(--soft); }
.notrun { color: var(--soft); font-size: 13px; white-space: normal; }
code { font: 13px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
footer { border-top: 1px solid var(--rule); margin-top: 60px; padding-top: 30px; }
footer h3:not(:first-child) { margin-top: 26px; }
footer p { max-width: 78ch; }
a { color: var(--accent); }
@media (prefers-color-scheme: dark) {
  .summary { background: radial-gradient(90% 180% at 0 0, color-mix(in srgb, var(--lamp, var(--rule)) 20%, transparent), transparent 78%), var(--panel); }
}
@media (max-width: 860px) {
  .summary { grid-template-columns: minmax(0, 1fr); padding: 24px; }
}
@media (max-width: 640px) {
  main { padding: 28px 16px 44px; }
  h1 { font-size: 28px; }
  section.light { margin-top: 36px; }
  .summary { padding: 20px 18px; border-radius: 14px; }
  .hero { font-size: 46px; margin-top: 14px; }
  .hero .unit, .hero .pm { font-size: 20px; }
  .cards { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 14px; }
  .card { padding-left: 10px; }
  .card dd { font-size: 16px; }
  .engines { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 8px; }
  .engines li { padding: 12px; }
  .engines .copy { font-size: 18px; }
  .engines .copy.long { font-size: 14px; }
  .figures { gap: 34px; margin-top: 36px; }
  svg text { font-size: 16.5px; }
  svg .tick, svg .note { font-size: 15.5px; }
  svg.wide { min-width: 760px; }
  svg.wide text, svg.wide .tick { font-size: 14px; }
  .overview thead, .stack thead { display: none; }
  .stack tr { display: flex; flex-wrap: wrap; gap: 0 14px; padding: 9px 0; border-bottom: 1px solid var(--rule); }
  .stack td, .stack td:not(.n), .stack tbody th { border: 0; padding: 1px 0; }
  .stack tbody th, .stack .note { flex: 1 0 100%; }
  .stack tbody th { font-weight: 600; }
  .stack [data-label]::before { content: attr(data-label); color: var(--soft); }
  .readings th, .readings td { font-size: 13px; padding-right: 6px; }
  .overview tr { display: grid; grid-template-columns: 1fr 1fr; padding: 12px 0; border-bottom: 1px solid var(--rule); gap: 0 12px; }
  .overview td, .overview tbody th { display: block; border: 0; padding: 2px 0; text-align: left; white-space: normal; }
  .overview tbody th { grid-column: 1 / -1; }
  .overview td::before { content: attr(data-label); display: block; color: var(--soft); font-size: 13px; }
}
@media print {
  :root {
    --page: #ffffff; --panel: #f5f4f1; --ink: #000000; --soft: #444b54; --rule: #d3d0ca;
    --accent: #005a94; --band: rgba(0, 114, 178, .18); --warn: #a83c00; --well: #256a28;
  }
  @page { size: A4; margin: 14mm 13mm; }
  body { font-size: 12.5px; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  h1 { font-size: 27px; }
  h2 { font-size: 19px; }
  h3 { font-size: 13.5px; margin-bottom: 8px; break-after: avoid; }
  .summary { grid-template-columns: minmax(0, 9fr) minmax(0, 10fr); padding: 18px 20px; border-radius: 12px; gap: 12px 28px; }
  .summary { background: radial-gradient(90% 180% at 0 0, color-mix(in srgb, var(--lamp, var(--rule)) 55%, transparent), transparent 78%), var(--panel); }
  .hero { font-size: 40px; margin: 10px 0 4px; }
  .hero .unit, .hero .pm { font-size: 18px; }
  section.light { break-before: page; margin-top: 0; }
  section.light.only, section.light.first { break-before: auto; margin-top: 24px; }
  figure, .card, tr, .figures .block { break-inside: avoid; }
  .cards { grid-template-columns: repeat(2, 1fr); gap: 10px 16px; }
  .card dt, .card .sub, figcaption { font-size: 11.5px; }
  .card dd { font-size: 14px; }
  .engines { grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 7px; }
  .engines li { padding: 8px 10px; border-radius: 8px; }
  .engines h4 { font-size: 11.5px; }
  .engines .copy { font-size: 15px; }
  .engines .copy.long { font-size: 11.5px; }
  .engines .number { margin: 4px 0 3px; font-size: 12px; }
  .engines .field, .engines .note { font-size: 10.5px; }
  .figures { grid-template-columns: 1fr 1fr; gap: 22px; margin-top: 22px; }
  .below { margin-top: 22px; }
  table, .overview td, .overview tbody th { font-size: 12px; }
  th, td { padding-top: 5px; padding-bottom: 5px; }
  .overview td, .overview tbody th { padding-top: 6px; padding-bottom: 6px; }
  .overview tbody th { overflow-wrap: break-word; min-width: 8em; }
  thead th { font-size: 11.5px; }
  code { font-size: 10.5px; }
}
)css";

}  // namespace

std::string StyleSheet() { return std::string(kFigures) + std::string(kPage); }

std::string StandaloneSvg(std::string svg, std::string_view own_rules) {
  const std::string style =
      "\n<!-- written by lightcal -->\n<style><![CDATA[" + std::string(kFigures) +
      "svg { background: var(--page); font-family: system-ui, sans-serif; }\n" +
      std::string(own_rules) + "]]></style>";
  return svg.insert(svg.find('>') + 1, style);
}

}  // namespace lightcal::report
