// SPDX-License-Identifier: Apache-2.0
#include "lightcal/report/style.h"

namespace lightcal::report {

// Blue and vermilion are of Okabe and Ito's set, told apart by every common colour vision; used and
// rejected readings differ in shape as well.
std::string_view StyleSheet() {
  return R"css(
:root {
  color-scheme: light dark;
  --page: #ffffff; --panel: #f6f7f9; --ink: #16191d; --soft: #555f6b; --rule: #dfe3e8;
  --accent: #0067a8; --band: rgba(0, 114, 178, .16); --warn: #b84300;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #121417; --panel: #1b1f24; --ink: #eceff2; --soft: #a6b0bb; --rule: #2f363e;
    --accent: #63b8ee; --band: rgba(86, 180, 233, .20); --warn: #f0954a;
  }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  font-variant-numeric: tabular-nums;
}
main { max-width: 1120px; margin: 0 auto; padding: 48px 32px 64px; }
h1 { font-size: 30px; line-height: 1.2; letter-spacing: -.01em; margin: 0 0 6px; overflow-wrap: anywhere; }
h2 { font-size: 24px; line-height: 1.25; margin: 0; overflow-wrap: anywhere; }
h3 { font-size: 15px; margin: 0 0 10px; font-weight: 600; }
p { margin: 0 0 10px; }
.lead, .soft { color: var(--soft); }
.small { font-size: 14px; }
section.light { border-top: 1px solid var(--rule); margin-top: 44px; padding-top: 36px; }
.title { display: flex; align-items: center; gap: 14px; flex-wrap: wrap; }
.swatch { width: 26px; height: 26px; border-radius: 50%; border: 1px solid var(--rule); flex: none; }
.kind { color: var(--soft); font-size: 15px; }
.hero { font-size: 52px; line-height: 1.1; font-weight: 650; letter-spacing: -.02em; margin: 18px 0 4px; }
.hero .unit { font-size: 26px; font-weight: 500; letter-spacing: 0; }
.hero .pm { font-size: 26px; font-weight: 400; color: var(--soft); letter-spacing: 0; white-space: nowrap; }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(215px, 1fr)); gap: 12px; margin: 26px 0 0; padding: 0; }
.card { background: var(--panel); border-radius: 10px; padding: 14px 16px; }
.card dt { color: var(--soft); font-size: 14px; }
.card dd { margin: 2px 0 0; font-size: 19px; font-weight: 600; }
.card .sub { display: block; font-size: 13.5px; font-weight: 400; color: var(--soft); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); gap: 36px 32px; margin-top: 36px; }
figure { margin: 0; }
figcaption { font-size: 14px; color: var(--soft); margin-top: 8px; }
figcaption b { color: var(--ink); font-weight: 600; }
svg { display: block; width: 100%; height: auto; max-width: 560px; }
svg.wide { max-width: 980px; }
svg text { fill: var(--ink); font-family: inherit; font-size: 13px; }
svg .tick, svg .note { fill: var(--soft); font-size: 12.5px; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg .frame { fill: none; stroke: var(--soft); stroke-width: 1.2; }
svg .zero { stroke: var(--accent); stroke-width: 1.8; }
svg .model { fill: none; stroke: var(--accent); stroke-width: 2; }
svg .band { fill: var(--band); stroke: none; }
svg .whisker { stroke: var(--ink); stroke-width: 1.4; }
svg .used { fill: var(--ink); stroke: var(--page); stroke-width: 1.2; }
svg .rejected { fill: none; stroke: var(--warn); stroke-width: 2.4; stroke-linecap: round; }
svg .setting { fill: var(--soft); stroke: var(--page); stroke-width: 1; }
svg .chosen { fill: var(--warn); stroke: var(--page); stroke-width: 1.2; }
svg .locus { fill: none; stroke: var(--accent); stroke-width: 2; }
svg .second { fill: none; stroke: var(--warn); stroke-width: 2; stroke-dasharray: 7 4; }
svg .ring { fill: none; stroke: var(--rule); stroke-width: 1; }
svg .guide { fill: none; stroke: var(--accent); stroke-width: 1; stroke-dasharray: 4 4; opacity: .7; }
svg .isotherm { stroke: var(--soft); stroke-width: 1; }
svg .ellipse { fill: var(--band); stroke: var(--ink); stroke-width: 1.2; }
.key { white-space: nowrap; margin-right: 14px; }
.key svg { display: inline-block; width: 22px; height: 12px; vertical-align: -1px; margin-right: 5px; }
.below { margin-top: 36px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14.5px; }
th, td { text-align: left; padding: 7px 14px 7px 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
thead th { color: var(--soft); font-weight: 500; font-size: 13.5px; }
tbody th { font-weight: 500; }
td.n, th.n { text-align: right; white-space: nowrap; }
th:last-child, td:last-child { padding-right: 0; }
.overview { margin-top: 30px; }
.overview td, .overview tbody th { font-size: 15.5px; padding-top: 10px; padding-bottom: 10px; }
.overview tbody th { font-weight: 600; overflow-wrap: anywhere; }
.overview td { white-space: nowrap; }
.share { display: inline-block; height: 10px; min-width: 1px; background: var(--accent); border-radius: 2px; }
.off { color: var(--warn); font-weight: 600; }
.typein td, .typein tbody th { font-size: 16px; vertical-align: baseline; }
.typein .value { font-weight: 650; font-size: 18px; white-space: nowrap; }
code { font: 13px/1.5 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
footer { border-top: 1px solid var(--rule); margin-top: 52px; padding-top: 28px; }
a { color: var(--accent); }
@media (max-width: 640px) {
  main { padding: 26px 16px 40px; }
  h1 { font-size: 25px; }
  .hero { font-size: 42px; }
  .hero .unit, .hero .pm { font-size: 21px; }
  .cards { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 8px; }
  .card { padding: 12px; }
  .card dd { font-size: 17px; }
  svg text { font-size: 15px; }
  svg .tick, svg .note { font-size: 14px; }
  .overview thead, .effects thead { display: none; }
  .typein tr, .effects tr { display: flex; flex-wrap: wrap; gap: 0 14px; padding: 8px 0; border-bottom: 1px solid var(--rule); }
  .typein td, .typein tbody th, .effects td, .effects tbody th { border: 0; padding: 1px 0; }
  .typein tbody th, .typein .note, .effects .note { flex: 1 0 100%; }
  .effects tbody th { font-weight: 600; }
  .effects .n::before { content: attr(data-label); color: var(--soft); }
  .overview tr { display: grid; grid-template-columns: 1fr 1fr; padding: 12px 0; border-bottom: 1px solid var(--rule); gap: 0 12px; }
  .overview td, .overview tbody th { display: block; border: 0; padding: 2px 0; text-align: left; white-space: normal; }
  .overview tbody th { grid-column: 1 / -1; }
  .overview td::before { content: attr(data-label); display: block; color: var(--soft); font-size: 13px; }
}
@media print {
  :root {
    --page: #ffffff; --panel: #f3f4f6; --ink: #000000; --soft: #444b54; --rule: #cfd4da;
    --accent: #005a94; --band: rgba(0, 114, 178, .18); --warn: #a83c00;
  }
  @page { size: A4; margin: 14mm 13mm; }
  body { font-size: 12.5px; -webkit-print-color-adjust: exact; print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  h1 { font-size: 24px; }
  h2 { font-size: 20px; }
  .hero { font-size: 38px; margin-top: 10px; }
  .hero .unit, .hero .pm { font-size: 20px; }
  section.light { break-before: page; border-top: 0; margin-top: 0; padding-top: 0; }
  section.light.only { break-before: auto; margin-top: 24px; }
  figure, .card, tr, .block { break-inside: avoid; }
  .cards { grid-template-columns: repeat(4, 1fr); margin-top: 16px; gap: 8px; }
  .card { padding: 8px 10px; }
  .card dt, .card .sub, figcaption { font-size: 11.5px; }
  .card dd { font-size: 15px; }
  .figures { grid-template-columns: 1fr 1fr; gap: 20px; margin-top: 22px; }
  .below { margin-top: 22px; }
  table, .overview td, .overview tbody th, .typein td, .typein tbody th { font-size: 12px; }
  .typein .value { font-size: 14px; }
  .overview td, .overview tbody th { padding-top: 6px; padding-bottom: 6px; }
  .overview tbody th { overflow-wrap: break-word; min-width: 8em; }
  thead th { font-size: 11.5px; }
  code { font-size: 10.5px; }
}
)css";
}

std::string StandaloneSvg(std::string svg, std::string_view own_rules) {
  const std::string style =
      "\n<!-- written by lightcal -->\n<style><![CDATA[" + std::string(StyleSheet()) +
      "svg { background: var(--page); font-family: system-ui, sans-serif; }\n" +
      std::string(own_rules) + "]]></style>";
  return svg.insert(svg.find('>') + 1, style);
}

}  // namespace lightcal::report
