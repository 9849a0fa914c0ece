// SPDX-License-Identifier: Apache-2.0
#include "check_render.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "calibration_options.h"
#include "input_files.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/card_picture.h"
#include "lightcal/presets/check/render_cause.h"
#include "lightcal/presets/check/render_lamps.h"
#include "lightcal/presets/check/render_shape.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::app {
namespace {

Node CauseNode(const RenderCause& cause) {
  return {{"code", cause.code},
          {"message", cause.message},
          {"factor", cause.factor},
          {"turn_deg", cause.turn_deg}};
}

Node ColorNode(const std::optional<RenderedColor>& color) {
  if (!color) return {};
  return {{"apart_uv", color->apart_uv}, {"allowed_uv", color->allowed_uv}, {"off", color->Off()}};
}

Node RenderedLampNode(const RenderedLamp& lamp) {
  return {{"name", lamp.name}, {"factor", lamp.factor}};
}

void PrintVerdict(const CheckedRig& rig, const RenderVerdict& verdict, Console& console) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < 2; ++i) {
    const double expected = rig.cards[i].expected_lx;
    rows.push_back({rig.cards[i].name, RoundedText(expected, 4) + " lx",
                    RoundedText(verdict.card_lx[i], 4) + " lx",
                    RoundedText(std::log2(verdict.card_lx[i] / expected), 2)});
  }
  console.Print(TextTable({"card", "meter", "picture", "stops"}, rows));
  console.Print("\n" + RoundedText(verdict.lux, 4) + " lx, " +
                RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2) +
                " stops off: " + verdict.cause.code + "\n  " + verdict.cause.message + "\n");
  for (const RenderCause& other : verdict.alternatives) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
}

struct SeenPicture {
  CheckedRig rig;
  std::array<CardPixels, 2> cards;
  RenderVerdict verdict;
};

Result<SeenPicture> SeePicture(const std::string& render, const std::string& rig_file,
                               const RenderCheck& options, Console& console) {
  const auto text = ReadInputFile(rig_file);
  if (!text) return tl::unexpected(text.error());
  auto rig = RigFromPreset(*text, rig_file);
  if (!rig) return Propagate(std::move(rig));
  NoteInput(render);
  const auto picture = devices::ReadPicture(render);
  if (!picture) return tl::unexpected(picture.error());
  const bool linear = picture->info.meaning == SampleMeaning::kLinear;
  const PixelUnit unit = linear ? LinearPixelsOf(options.engine) : PixelUnit::kExposed;
  const auto cards = MeasureCards(*picture, *rig);
  if (!cards) return tl::unexpected(cards.error());
  auto verdict = JudgeRender(*rig, *cards, unit, render);
  if (!verdict) return Propagate(std::move(verdict));
  for (std::size_t i = 0; i < 2; ++i) {
    const CardPixels& card = (*cards)[i];
    if (card.clipped[0] || card.clipped[1] || card.clipped[2]) {
      console.Warn(
          {"clipped", rig->cards[i].name, "is clipped in this picture and left out there"});
    }
    if (card.spread > 0.15) {
      console.Warn({"uneven_card", rig->cards[i].name,
                    "is uneven where the rig says it is: another camera, or too few samples"});
    }
  }
  return SeenPicture{*std::move(rig), *cards, *std::move(verdict)};
}

Node NodeOf(const SeenPicture& seen) {
  Node measured = Node::Array();
  for (std::size_t i = 0; i < 2; ++i) {
    measured.items.push_back({{"name", seen.rig.cards[i].name},
                              {"expected_lx", seen.rig.cards[i].expected_lx},
                              {"illuminance_lx", seen.verdict.card_lx[i]},
                              {"pixel", seen.cards[i].rgb}});
  }
  const RenderVerdict& verdict = seen.verdict;
  const std::array<SeenRig, 1> alone = {SeenRig{&seen.rig, &verdict}};
  return {{"illuminance_lx", verdict.lux},
          {"expected_lx", verdict.expected_lx},
          {"stops_off", std::log2(verdict.lux / verdict.expected_lx)},
          {"cause", CauseNode(verdict.cause)},
          {"alternatives", Node::List(verdict.alternatives, CauseNode)},
          {"color", ColorNode(verdict.color)},
          {"not_seen", Node::UnlessEmpty(Node::List(LampsNotSeen(alone)))},
          {"cards", measured}};
}

std::string PlaceText(const CheckedRig& rig) {
  std::string text = rig.lamps.size() > 1 ? rig.lamps[rig.lamp].name + ", " : "";
  text += RoundedText(rig.off_axis_deg, 4) + " deg";
  if (rig.round_deg != 0.0) text += " / " + RoundedText(rig.round_deg, 4);
  return text;
}

// ---- what fails ----

// Of one picture: "" where its light is as much as the meter says.
std::string LuxOff(const SeenPicture& seen, double max_error) {
  const auto off = [&](double lux, double expected, double u95) {
    return std::abs(lux / expected - 1.0) > max_error + u95;
  };
  const RenderVerdict& verdict = seen.verdict;
  const auto text = [&](const std::string& what, double lux, double expected) {
    return what + RoundedText(lux, 4) + " lx instead of " + RoundedText(expected, 4) + " lx";
  };
  if (off(verdict.lux, verdict.expected_lx, verdict.lux_u95)) {
    return text("", verdict.lux, verdict.expected_lx);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const CheckedCard& card = seen.rig.cards[i];
    if (verdict.card_u95[i] && off(verdict.card_lx[i], card.expected_lx, *verdict.card_u95[i])) {
      return text(card.name + " ", verdict.card_lx[i], card.expected_lx);
    }
  }
  return {};
}

// Of surroundings that hang another way colours may tell it alone.
bool IsOfSurroundings(const RenderCause& cause) {
  return cause.code.starts_with("panorama_") || cause.code == "other_surroundings";
}

std::string ColorOffText(const std::vector<SeenPicture>& pictures) {
  std::string text;
  for (const SeenPicture& one : pictures) {
    const auto& color = one.verdict.color;
    if (!color || !color->Off()) continue;
    text += (text.empty() ? "" : ", ") + RoundedText(color->apart_uv, 2) + " in u'v' at " +
            PlaceText(one.rig) + " (" + RoundedText(color->allowed_uv, 2) + " allowed)";
  }
  return text;
}

std::optional<Error> FaultOf(const std::vector<SeenPicture>& pictures,
                             const std::vector<RenderCause>& causes, double max_error,
                             const std::string& subject) {
  const RenderCause& cause = causes.front();
  std::vector<std::string> off;
  const bool engines_own = cause.code == "cone_as_exported";  // as near as its engine comes
  for (const SeenPicture& one : pictures) {
    if (engines_own && one.rig.off_axis_deg != 0.0) continue;
    const std::string lux = LuxOff(one, max_error);
    if (!lux.empty()) off.push_back(pictures.size() > 1 ? PlaceText(one.rig) + ": " + lux : lux);
  }
  const std::string why = ". " + Joined(causes, "; or ", [](const RenderCause& one) {
                            return one.code + ": " + one.message;
                          });
  if (!off.empty()) {
    return Error{ErrorKind::kFailed, "render_off", subject,
                 "shows " + Joined(off, "; ") + ", more than " + PercentText(max_error) + " off" +
                     why + "; --max-error allows more"};
  }
  if (IsOfSurroundings(cause)) {
    return Error{ErrorKind::kFailed, "render_off", subject, "shows other surroundings" + why};
  }
  const std::string colors = ColorOffText(pictures);
  if (colors.empty()) return std::nullopt;
  return Error{ErrorKind::kFailed, "color_off", subject,
               "shows cards in another colour than the lamps give them: " + colors + why};
}

// The whole answer, and an error beside it where the pictures are off.
Result<void> EndWith(const std::vector<SeenPicture>& pictures,
                     const std::vector<RenderCause>& causes, double max_error,
                     const RenderCheck& options, Node document, Console& console) {
  document.Put("max_error", max_error);
  const std::string& subject = options.renders.front();
  if (const auto fault = FaultOf(pictures, causes, max_error, subject)) {
    return EndWithError(console, std::move(document), *fault);
  }
  console.PrintDocument(std::move(document));
  return {};
}

// One scene, its cards at several places: one cause for all.
Result<void> SayTogether(const std::vector<SeenPicture>& pictures, double max_error,
                         const RenderCheck& options, Console& console) {
  std::vector<SeenRig> seen;
  std::vector<std::vector<std::string>> rows;
  Node list = Node::Array();
  for (const SeenPicture& picture : pictures) {
    const RenderVerdict& verdict = picture.verdict;
    seen.push_back({&picture.rig, &picture.verdict});
    list.items.push_back(NodeOf(picture));
    rows.push_back({PlaceText(picture.rig), RoundedText(verdict.expected_lx, 4) + " lx",
                    RoundedText(verdict.lux, 4) + " lx",
                    RoundedText(std::log2(verdict.lux / verdict.expected_lx), 2)});
  }
  const std::vector<RenderCause> causes = JudgeTogether(seen);
  console.Print(TextTable({"cards at", "meter", "picture", "stops"}, rows));
  console.Print("\n" + causes.front().code + "\n  " + causes.front().message + "\n");
  const std::vector<RenderCause> others(causes.begin() + 1, causes.end());
  for (const RenderCause& other : others) {
    console.Print("or " + other.code + ": " + other.message + "\n");
  }
  Node document = {{"cause", CauseNode(causes.front())},
                   {"alternatives", Node::List(others, CauseNode)},
                   {"lamps", Node::UnlessEmpty(Node::List(RenderedLamps(seen), RenderedLampNode))},
                   {"not_seen", Node::UnlessEmpty(Node::List(LampsNotSeen(seen)))},
                   {"pictures", std::move(list)}};
  return EndWith(pictures, causes, max_error, options, std::move(document), console);
}

}  // namespace

Result<void> CheckRender(const RenderCheck& options, Console& console) {
  if (options.rigs.size() != options.renders.size()) {
    return WrongUsage("--rig",
                      "is the STEM.preset.json that was exported with the rig: one for each "
                      "--render, in their order");
  }
  const auto max_error = ParseTolerance(options.max_error);
  if (!max_error) return tl::unexpected(max_error.error());
  std::vector<SeenPicture> pictures;
  for (std::size_t i = 0; i < options.renders.size(); ++i) {
    auto seen = SeePicture(options.renders[i], options.rigs[i], options, console);
    if (!seen) return Propagate(std::move(seen));
    pictures.push_back(*std::move(seen));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (pictures.size() > 1) return SayTogether(pictures, *max_error, options, console);
  const SeenPicture& alone = pictures.front();
  PrintVerdict(alone.rig, alone.verdict, console);
  std::vector<RenderCause> causes = {alone.verdict.cause};
  const auto& others = alone.verdict.alternatives;
  causes.insert(causes.end(), others.begin(), others.end());
  return EndWith(pictures, causes, *max_error, options, NodeOf(alone), console);
}

}  // namespace lightcal::app
