// SPDX-License-Identifier: Apache-2.0
#include "gdtf_import.h"

#include <algorithm>
#include <vector>

#include "input_files.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/files/gdtf_file.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

// What GDTF has a beam be that says nothing.
constexpr double kDefaultFluxLm = 10000.0, kDefaultCctK = 6000.0, kDefaultAngleDeg = 25.0;
constexpr double kWidestSpotDeg = 180.0;

std::string Figure(const std::optional<double>& value, int digits, const std::string& unit) {
  return value ? RoundedText(*value, digits) + unit : kNone;
}

bool SaysDefaults(const GdtfBeam& beam) {
  const auto is = [](const std::optional<double>& value, double by_default) {
    return !value || *value == by_default;
  };
  return is(beam.flux_lm, kDefaultFluxLm) && is(beam.cct_K, kDefaultCctK) &&
         is(beam.beam_deg, kDefaultAngleDeg) && is(beam.field_deg, kDefaultAngleDeg);
}

// A text as TOML holds it.
std::string TomlText(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
  }
  return out + "\"";
}

std::string LightBlock(const GdtfFixture& fixture) {
  const GdtfBeam* beam = fixture.beams.empty() ? nullptr : &fixture.beams.front();
  const bool spot =
      beam != nullptr && beam->beam_deg.value_or(0.0) > 0.0 && *beam->beam_deg < kWidestSpotDeg;
  std::string text = "[[light]]\nname = " + TomlText(fixture.name) + "\nkind = \"" +
                     (spot ? "spot" : "point") + "\"\n";
  if (beam == nullptr || SaysDefaults(*beam)) return text;
  if (beam->flux_lm.value_or(0.0) > 0.0 && fixture.beams.size() == 1) {
    text += "flux_lm = " + ShortestText(*beam->flux_lm) + "  # of the data sheet: priors\n";
  }
  if (!spot) return text;
  text += "beam_deg = " + ShortestText(*beam->beam_deg) + "\n";
  const bool wider =
      beam->field_deg && *beam->field_deg > *beam->beam_deg && *beam->field_deg <= kWidestSpotDeg;
  if (wider) text += "field_deg = " + ShortestText(*beam->field_deg) + "\n";
  return text;
}

std::string EmitterTable(const GdtfFixture& fixture) {
  std::vector<std::vector<std::string>> rows;
  for (const GdtfEmitter& emitter : fixture.emitters) {
    const auto samples = std::ranges::max_element(
        emitter.measurements, {}, [](const GdtfMeasurement& one) { return one.energy.size(); });
    const std::size_t most = samples == emitter.measurements.end() ? 0 : samples->energy.size();
    const std::string levels = Joined(emitter.measurements, ", ", [](const GdtfMeasurement& one) {
      return RoundedText(one.physical_percent, 3) +
             " %: " + RoundedText(one.luminous_intensity_cd, 4) + " cd";
    });
    rows.push_back(
        {emitter.name,
         emitter.xy ? RoundedText(emitter.xy->x, 4) + ", " + RoundedText(emitter.xy->y, 4) : kNone,
         levels.empty() ? kNone : levels, most == 0 ? kNone : std::to_string(most) + " samples"});
  }
  return TextTable({"emitter", "x, y", "measured", "spectrum"}, rows);
}

std::string BeamTable(const GdtfFixture& fixture) {
  std::vector<std::vector<std::string>> rows;
  for (const GdtfBeam& beam : fixture.beams) {
    rows.push_back({beam.name, Figure(beam.flux_lm, 4, " lm"), Figure(beam.beam_deg, 3, "°"),
                    Figure(beam.field_deg, 3, "°"), Figure(beam.cct_K, 4, " K"),
                    Figure(beam.radius_m, 3, " m")});
  }
  return TextTable({"beam", "flux", "beam", "field", "CCT", "radius"}, rows);
}

std::string ModeTable(const GdtfFixture& fixture) {
  std::vector<std::vector<std::string>> rows;
  for (const GdtfMode& mode : fixture.modes) {
    for (const GdtfChannel& channel : mode.channels) {
      rows.push_back(
          {mode.name, channel.attribute,
           channel.offset.empty()
               ? kNone
               : Joined(channel.offset, ",", [](int s) { return std::to_string(s); }),
           Figure(channel.physical_from, 4, "") + " … " + Figure(channel.physical_to, 4, ""),
           channel.profile.empty() ? kNone : channel.profile});
    }
  }
  return TextTable({"mode", "control", "slots", "from … to", "curve"}, rows);
}

Node EmitterNode(const GdtfEmitter& emitter) {
  Node node = {{"name", emitter.name}};
  if (emitter.xy) node.Put("xy", Node{emitter.xy->x, emitter.xy->y});
  node.Put("Y_percent", emitter.Y_percent);
  node.Put("measurements", Node::List(emitter.measurements, [](const GdtfMeasurement& one) {
             Node level = {{"physical_percent", one.physical_percent},
                           {"intensity_cd", one.luminous_intensity_cd}};
             if (!one.energy.empty()) {
               level.Put("wavelength_nm", one.wavelengths_nm);
               level.Put("energy", one.energy);
             }
             return level;
           }));
  return node;
}

Node BeamNode(const GdtfBeam& beam) {
  return {{"name", beam.name},         {"type", beam.type},
          {"flux_lm", beam.flux_lm},   {"cct_K", beam.cct_K},
          {"beam_deg", beam.beam_deg}, {"field_deg", beam.field_deg},
          {"radius_m", beam.radius_m}, {"emitter", Node::UnlessEmpty(beam.emitter)}};
}

Node ProfileNode(const GdtfProfile& profile) {
  return {{"name", profile.name},
          {"points", Node::List(profile.points, [](const GdtfProfile::Point& point) {
             return Node{{"from_percent", point.from_percent},
                         {"coefficients", {point.c0, point.c1, point.c2, point.c3}}};
           })}};
}

Node ModeNode(const GdtfMode& mode) {
  return {{"name", mode.name},
          {"channels", Node::List(mode.channels, [](const GdtfChannel& channel) {
             return Node{{"attribute", channel.attribute},
                         {"geometry", channel.geometry},
                         {"slots", channel.offset},
                         {"from", channel.physical_from},
                         {"to", channel.physical_to},
                         {"profile", Node::UnlessEmpty(channel.profile)},
                         {"emitter", Node::UnlessEmpty(channel.emitter)}};
           })}};
}

void WarnOfGdtf(const std::string& path, const GdtfFixture& fixture, Console& console) {
  const bool bare = !fixture.beams.empty() && std::ranges::all_of(fixture.beams, SaysDefaults);
  if (bare) {
    console.Warn({"gdtf_defaults", path,
                  "its beam says no more than GDTF's defaults (10,000 lm, 6000 K, 25°): that is "
                  "no figure of this fixture, and none is taken"});
  }
  const bool measured = std::ranges::any_of(fixture.emitters, [](const GdtfEmitter& emitter) {
    return std::ranges::any_of(emitter.measurements, [](const GdtfMeasurement& one) {
      return one.luminous_intensity_cd > 1.0 || !one.energy.empty();
    });
  });
  if (!measured) {
    console.Warn({"gdtf_no_measurement", path,
                  "holds no measurement of its emitters; read the lamp at states of its controls"});
  }
}

}  // namespace

bool IsGdtfName(const std::string& path) { return LowerAscii(path).ends_with(".gdtf"); }

Result<Node> TellGdtf(const std::string& path, Console& console) {
  NoteInput(path);
  const auto fixture = devices::ReadGdtf(path);
  if (!fixture) return tl::unexpected(fixture.error());
  WarnOfGdtf(path, *fixture, console);
  const std::string block = LightBlock(*fixture);
  console.Print(fixture->name + (fixture->manufacturer.empty() ? "" : " by ") +
                fixture->manufacturer + "\n\n" + EmitterTable(*fixture) + "\n" +
                BeamTable(*fixture) + "\n" + ModeTable(*fixture) + "\nfor session.toml:\n\n" +
                block);
  return Node{{"file", path},
              {"name", fixture->name},
              {"manufacturer", fixture->manufacturer},
              {"emitters", Node::List(fixture->emitters, EmitterNode)},
              {"beams", Node::List(fixture->beams, BeamNode)},
              {"profiles", Node::List(fixture->profiles, ProfileNode)},
              {"modes", Node::List(fixture->modes, ModeNode)},
              {"light_toml", block}};
}

}  // namespace lightcal::app
