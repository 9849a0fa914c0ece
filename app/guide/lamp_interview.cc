// SPDX-License-Identifier: Apache-2.0
#include "guide/lamp_interview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "calibration_options.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/light/beam_ensemble.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal_devices/meters/find_meters.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct KindChoice {
  LightKind kind;
  Choice choice;
};
constexpr std::array<KindChoice, 8> kKinds = {{
    {LightKind::kPoint, {"point", "a bulb, a lantern, anything small that shines all around"}},
    {LightKind::kSpot, {"spot", "a spotlight, a torch, a lamp in a reflector"}},
    {LightKind::kSphere, {"sphere", "a ball or globe that glows all over"}},
    {LightKind::kDisk, {"disk", "a round panel or softbox"}},
    {LightKind::kRect, {"rect", "a rectangular panel, softbox or screen"}},
    {LightKind::kTube, {"tube", "a tube or a strip"}},
    {LightKind::kPhotometric, {"photometric", "any lamp whose IES or LDT file you have"}},
    {LightKind::kDirectional,
     {"directional", "the sun, or a lamp so far off that it lights evenly"}},
}};

std::vector<Choice> KindChoices() {
  std::vector<Choice> choices;
  for (const KindChoice& row : kKinds) choices.push_back(row.choice);
  return choices;
}

Result<LightKind> ParseKindChoice(const std::string& text) {
  const auto at = ParseChoice(text, KindChoices());
  if (!at) return tl::unexpected(at.error());
  return kKinds[*at].kind;
}

constexpr std::string_view WordsOf(Fixture fixture) {
  switch (fixture) {
    case Fixture::kBulb:
      return "read from its glass";
    case Fixture::kCobBare:
      return "a chip on a board, without optics";
    case Fixture::kReflector:
      return "a chip in a reflector";
    case Fixture::kFresnel:
      return "behind a lens";
    case Fixture::kPanel:
      return "a luminous surface";
    case Fixture::kSoftbox:
      return "or a lantern";
    case Fixture::kLuminaire:
      return "mounted at a stated place, with its photometric file";
  }
  return {};
}

std::vector<Choice> FixtureChoices() {
  std::vector<Choice> choices;
  for (std::size_t i = 0; i < kFixtureNames.size(); ++i) {
    choices.push_back({kFixtureNames[i], WordsOf(static_cast<Fixture>(i))});
  }
  return choices;
}

Result<std::optional<Fixture>> ParseFixture(const std::string& text) {
  if (text.empty()) return std::optional<Fixture>();
  const auto at = ParseChoice(text, FixtureChoices());
  if (!at) return tl::unexpected(at.error());
  return std::optional(static_cast<Fixture>(*at));
}

Result<std::string> ParseDirectory(const std::string& text) {
  if (text.empty()) return WrongUsage("", "a folder needs a name");
  return text;
}

Result<std::string> ParseLampName(const std::string& text) {
  if (text.find('/') == std::string::npos && !text.empty()) return text;
  return WrongUsage("\"" + text + "\"", "names become parts of file names: no slash, not empty");
}

Result<std::optional<Metres>> ParseSomeLength(const std::string& text) {
  if (text.empty()) return std::optional<Metres>();
  const auto length = ParseLength(text);
  if (!length) return tl::unexpected(length.error());
  if (!(length->value() > 0.0)) return WrongUsage(text, "must be above zero");
  return std::optional(*length);
}

// Of a surface, whose law is another near it.
Result<std::optional<Metres>> ParseLengthAboveZero(const std::string& text) {
  if (text.empty()) return WrongUsage("its size", "is needed, for example 40cm");
  return ParseSomeLength(text);
}

Result<double> ParseReflectance(const std::string& text) {
  const auto number = ParseNumber(text);
  if (number && *number >= 0.0 && *number < 1.0) return *number;
  return WrongUsage("\"" + text + "\"", "must be a fraction from 0 (black) to below 1 (white)");
}

Result<std::vector<std::string>> ParseTargets(const std::string& text) {
  std::vector<std::string> targets;
  if (LowerAscii(TrimBlanks(text)) == "all") return targets;
  std::string spaced = text;
  std::ranges::replace(spaced, ',', ' ');
  std::istringstream words(spaced);
  for (std::string word; words >> word;) {
    const auto target = FindPresetTarget(LowerAscii(word));
    if (!target) return tl::unexpected(target.error());
    const std::string name(target->name);
    if (std::ranges::find(targets, name) == targets.end()) targets.push_back(name);
  }
  if (targets.empty()) return WrongUsage("\"" + text + "\"", "names no engine; all is one answer");
  return targets;
}

std::string TargetMenu() {
  std::string line = "  ";
  std::string menu;
  for (const PresetTarget& target : PresetTargets()) {
    if (line.size() + target.name.size() > 72) {
      menu += line + "\n";
      line = "  ";
    }
    line += std::string(target.name) + "  ";
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return menu + line + "\n";
}

// "9W 806lm 2900K 36deg", in any order.
Result<NewSession> ParseBox(const std::string& text) {
  constexpr const char* kBoxForm =
      "is not understood; write watts, lumens, kelvin and the full beam angle with their units, no "
      "blank between: 9W 806lm 2900K 36deg";
  NewSession box;
  std::string spaced = text;
  std::ranges::replace(spaced, ',', ' ');
  std::istringstream words(spaced);
  for (std::string word; words >> word;) {
    const auto split = SplitNumberAndUnit(word);
    if (!split) return WrongUsage("\"" + word + "\"", "\"" + word + "\" " + kBoxForm);
    const std::string unit = LowerAscii(split->unit);
    const bool positive = split->number > 0.0;
    const bool degrees = unit == "deg" || unit == "°";
    if (degrees && !(RadiansFromDegrees(split->number) < kWidestBeam)) {
      return WrongUsage(
          "\"" + word + "\"",
          word +
              " is no beam: a beam angle goes to below 170 degrees; a box that says 200 to "
              "360 is a bulb's, which shines to all sides: leave the angle out");
    }
    if (positive && unit == "w") {
      box.light.electrical = Watts(split->number);
    } else if (positive && unit == "lm") {
      box.light.flux = Lumens(split->number);
    } else if (positive && unit == "k") {
      box.cct = Kelvin(split->number);
    } else if (positive && degrees) {
      box.light.beam = RadiansFromDegrees(split->number);
    } else {
      return WrongUsage("\"" + word + "\"", "\"" + word + "\" " + kBoxForm);
    }
  }
  return box;
}

class Interview {
 public:
  Interview(const Questions& questions, const LampFlags& flags)
      : questions_(questions), flags_(flags) {}

  Result<NewSession> Run() {
    using Step = Result<void> (Interview::*)();
    constexpr std::array<Step, 9> kSteps = {
        &Interview::AskDirectory, &Interview::AskLamp,    &Interview::AskFixture,
        &Interview::AskSize,      &Interview::AskBox,     &Interview::AskMeter,
        &Interview::AskAccuracy,  &Interview::AskTargets, &Interview::AskRoom};
    for (const Step step : kSteps) {
      if (auto done = (this->*step)(); !done) return Propagate(std::move(done));
    }
    return std::move(session_);
  }

 private:
  // The parsed answer into `target`.
  template <class Target, class Parse>
  Result<void> Take(Target& target, const Question& question,
                    const std::optional<std::string>& given, Parse parse) const {
    auto answer = questions_.Answer(question, given, parse);
    if (!answer) return Propagate(std::move(answer));
    target = *std::move(answer);
    return {};
  }

  Result<void> AskDirectory() {
    return Take(session_.directory, {"DIR", "A folder for this session:", "my_lamp", "", true},
                flags_.directory, ParseDirectory);
  }

  Result<void> AskLamp() {
    LightDescription& light = session_.light;
    auto named = Take(light.name, {"--lamp", "What do you call the lamp?", "key"}, flags_.lamp,
                      ParseLampName);
    if (!named) return named;
    return Take(
        light.kind,
        {"--kind", "What is it? A number or a word:", "point", MenuText(KindChoices()), true},
        flags_.kind, ParseKindChoice);
  }

  // What tells where the light of a lamp starts whose kind does not.
  Result<void> AskFixture() {
    LightDescription& light = session_.light;
    const bool open = light.kind == LightKind::kPoint || light.kind == LightKind::kSpot;
    if (!open && !flags_.fixture) return {};
    return Take(
        light.fixture,
        {"--fixture", "How is it built? That tells where its light starts (Enter: not known):", "",
         MenuText(FixtureChoices())},
        flags_.fixture, ParseFixture);
  }

  // The sizes that this kind has; a flag of another kind is a mistake.
  Result<void> AskSize() {
    LightDescription& light = session_.light;
    const LightKind kind = light.kind;
    if (kind == LightKind::kSphere || kind == LightKind::kDisk) {
      const bool needed = kind == LightKind::kDisk;
      return Take(light.diameter, {"--diameter", "Its diameter, for example 6cm:", "", "", needed},
                  flags_.diameter, needed ? ParseLengthAboveZero : ParseSomeLength);
    }
    if (kind == LightKind::kRect) return AskSides();
    if (kind == LightKind::kTube) {
      auto length = Take(light.length, {"--length", "Its length, for example 1.2m:", "", "", true},
                         flags_.length, ParseLengthAboveZero);
      if (!length) return length;
      return Take(light.radius, {"--radius", "Its radius, for example 13mm:", ""}, flags_.radius,
                  ParseSomeLength);
    }
    if (kind == LightKind::kPhotometric) return AskDistribution();
    return CheckNoSize();
  }

  [[nodiscard]] Result<void> CheckNoSize() const {
    const std::array<std::pair<const char*, bool>, 4> given = {
        {{"--diameter", flags_.diameter.has_value()},
         {"--size", flags_.size.has_value()},
         {"--length", flags_.length.has_value()},
         {"--radius", flags_.radius.has_value()}}};
    for (const auto& [flag, is_given] : given) {
      if (!is_given) continue;
      return WrongUsage(flag, "a " + std::string(LightKindName(session_.light.kind)) +
                                  " has no size; did you mean another --kind?");
    }
    return {};
  }

  Result<void> AskSides() {
    std::vector<double> sides;
    const auto parse = [](const std::string& text) -> Result<std::vector<double>> {
      const char* form = "WIDTHxHEIGHT, for example 120x60cm";
      if (text.empty()) return WrongUsage("its size", std::string("is needed: ") + form);
      return ParseSides(text, 2, form);
    };
    const Question question{"--size", "Its width and height, for example 120x60cm:", "", "", true};
    if (auto taken = Take(sides, question, flags_.size, parse); !taken) return taken;
    session_.light.width = Metres(sides[0]);
    session_.light.height = Metres(sides[1]);
    return {};
  }

  Result<void> AskDistribution() {
    const auto parse = [](const std::string& text) -> Result<std::string> {
      std::error_code error;
      if (fs::is_regular_file(text, error)) return text;
      return Failed("not_found", "\"" + text + "\"", "there is no such file");
    };
    std::string path;
    auto taken = Take(path, {"--distribution", "Its IES or LDT file:", "", "", true},
                      flags_.distribution, parse);
    if (!taken) return taken;
    session_.light.distribution_file =
        fs::proximate(fs::absolute(path), fs::absolute(session_.directory)).generic_string();
    return {};
  }

  Result<void> AskBox() {
    NewSession box;
    const bool spot = session_.light.kind == LightKind::kSpot;
    const std::string example = spot ? "35W 500lm 3000K 36deg" : "9W 806lm 2900K";
    auto taken =
        Take(box, {"--box", "What its box or data sheet says, for example " + example + ":", ""},
             flags_.box, ParseBox);
    if (!taken) return taken;
    session_.light.electrical = box.light.electrical;
    session_.light.flux = box.light.flux;
    session_.light.beam = box.light.beam;
    session_.cct = box.cct;
    // What shines into an angle is no point, whoever takes the first kind that is offered.
    const bool bulb = session_.light.fixture == Fixture::kBulb;
    if (box.light.beam && session_.light.kind == LightKind::kPoint && !bulb && !flags_.kind) {
      session_.light.kind = LightKind::kSpot;
    }
    return {};
  }

  Result<void> AskMeter() {
    std::vector<devices::FoundMeter> found;
    if (auto meters = devices::FindMeters()) found = *std::move(meters);
    std::vector<Choice> choices = {{"none", "no cable: you type what the display shows"}};
    for (const devices::FoundMeter& meter : found) choices.push_back({meter.id, meter.row->models});
    const auto only = devices::ChooseMeter(found, "");
    const auto parse = [&](const std::string& text) -> Result<std::string> {
      const auto at = ParseChoice(text, choices);
      if (at) return *at == 0 ? std::string() : found[*at - 1].id;
      const auto named = devices::ChooseMeter(found, text);
      if (named) return text;
      return WrongUsage("\"" + text + "\"",
                        "is no meter here: type none, a number, or driver:PORT as lightcal devices "
                        "lists them");
    };
    std::string explained = MenuText(choices);
    if (found.empty())
      explained += "  (no meter is plugged in; lightcal devices lists the drivers)\n";
    return Take(session_.device,
                {"--meter", "Which meter?", only ? only->id : "none", explained, true},
                flags_.meter, parse);
  }

  Result<void> AskAccuracy() {
    if (!session_.device.empty() && !flags_.accuracy) return {};  // as its driver knows it
    return Take(
        session_.meter_sigma_relative,
        {"--accuracy", "How far may it be off, as its data sheet says, for example 3%?", "10%"},
        flags_.accuracy, SigmaOfMeter);
  }

  Result<void> AskTargets() {
    return Take(session_.targets,
                {"--to", "Which engines shall it shine in? Words with commas, or all:", "all",
                 TargetMenu(), true},
                flags_.targets, ParseTargets);
  }

  Result<void> AskRoom() {
    std::vector<double> sides;
    const auto parse = [this](const std::string& text) -> Result<std::vector<double>> {
      session_.surroundings = text == "dark" || text == "outdoors" ? text : "";
      if (!session_.surroundings.empty()) return std::vector<double>{};
      return ParseSides(text, 3, "WIDTH,DEPTH,HEIGHT, for example 5,4,2.6 (metres)");
    };
    auto taken = Take(
        sides,
        {"--room",
         "The room's width, depth, height in metres, for example 5,4,2.6 (or dark, outdoors):", "",
         "Its walls send light back to the meter; the size bounds how much.\n"},
        flags_.room, parse);
    if (!taken) return taken;
    if (sides.empty()) {
      if (!flags_.reflectance) return {};
      return WrongUsage("--reflectance", "goes with --room");
    }
    session_.room = Room{{sides[0], sides[1], sides[2]}, 0.5};
    return Take(
        session_.room->reflectance,
        {"--reflectance", "How bright are its walls? 0.3 dark, 0.5 ordinary, 0.8 white:", "0.5"},
        flags_.reflectance, ParseReflectance);
  }

  const Questions& questions_;
  const LampFlags& flags_;
  NewSession session_;
};

}  // namespace

Result<NewSession> InterviewAboutLamp(const Questions& questions, const LampFlags& flags) {
  return Interview(questions, flags).Run();
}

}  // namespace lightcal::app
