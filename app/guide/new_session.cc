// SPDX-License-Identifier: Apache-2.0
#include "guide/new_session.h"

#include "guide/shell_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/session_codec.h"

namespace lightcal::app {
namespace {

// A JSON string is a TOML basic string.
std::string TomlText(const std::string& text) {
  return PrintJson(records::Node(text), records::JsonLayout::kOneLine);
}

constexpr std::size_t kCommentColumn = 32;
constexpr const char* kRoomSize = "width, depth, height in metres";
constexpr const char* kReflectance = "0.3 dark walls, 0.5 ordinary, 0.8 white";

// key = value, and what it is.
std::string TomlLine(const std::string& key, const std::string& value, const std::string& comment) {
  std::string line = key + " = " + value;
  if (comment.empty()) return line + "\n";
  if (line.size() < kCommentColumn) line.resize(kCommentColumn, ' ');
  return line + "  # " + comment + "\n";
}

template <class Quantity>
std::string LineIf(const std::string& key, const std::optional<Quantity>& quantity,
                   const std::string& comment) {
  return quantity ? TomlLine(key, ShortestText(quantity->value()), comment) : "";
}

std::string RoomText(const std::optional<Room>& room, const std::string& surroundings) {
  const std::string why =
      "# Walls send light back to the meter; the room bounds how much (or dark, outdoors = "
      "true).\n";
  if (!surroundings.empty()) {
    return "[room]\n" +
           TomlLine(surroundings, "true",
                    surroundings == "dark" ? "nothing sends the lamp's light back"
                                           : "the ground alone sends light back") +
           "\n";
  }
  if (!room) {
    return why + "# [room]\n" + TomlLine("# size_m", "[5, 4, 2.6]", kRoomSize) +
           TomlLine("# reflectance", "0.5", kReflectance) + "\n";
  }
  const Vec3& size = room->size_m;
  return why + "[room]\n" +
         TomlLine("size_m",
                  "[" + ShortestText(size[0]) + ", " + ShortestText(size[1]) + ", " +
                      ShortestText(size[2]) + "]",
                  kRoomSize) +
         TomlLine("reflectance", ShortestText(room->reflectance), kReflectance) + "\n";
}

std::string LightText(const LightDescription& light) {
  std::string text = "[[light]]\n" + TomlLine("name", TomlText(light.name), "readings name it so") +
                     TomlLine("kind", TomlText(std::string(LightKindName(light.kind))),
                              "directional point spot sphere disk rect tube photometric dome");
  text +=
      light.fixture
          ? TomlLine("fixture", TomlText(std::string(FixtureName(*light.fixture))),
                     "how it is built: where its light starts")
          : TomlLine("# fixture", "\"bulb\"",
                     "cob_bare reflector fresnel panel softbox luminaire: where its light starts");
  text += TomlLine("# lamp_class", "\"white_led\"", "or tungsten: a filament follows the mains") +
          TomlLine("# minutes_on", "30", "before the first reading: what warming up leaves");
  text += LineIf("diameter_m", light.diameter, "");
  if (light.width && light.height) {
    text += TomlLine(
        "size_m",
        "[" + ShortestText(light.width->value()) + ", " + ShortestText(light.height->value()) + "]",
        "width, height");
  }
  text += LineIf("length_m", light.length, "") + LineIf("radius_m", light.radius, "");
  if (!light.distribution_file.empty()) {
    text += TomlLine("distribution", TomlText(light.distribution_file), "its IES or EULUMDAT file");
  }
  text += LineIf("electrical_W", light.electrical, "what the box says: a start, not a measurement");
  text += LineIf("flux_lm", light.flux, "what the box says");
  if (light.beam) {
    text += TomlLine("beam_deg", RoundedText(DegreesFromRadians(*light.beam), 6),
                     "what the box says: the full angle");
  }
  return text + "\n";
}

bool StatesSigma(const NewSession& session) {
  return session.device.empty() || session.meter_sigma_relative > 0.0;
}

std::string MeterText(const NewSession& session) {
  if (!StatesSigma(session)) return "";
  return "[[meter]]\n" + TomlLine("name", TomlText(kTypedMeterName), "") +
         TomlLine("sigma_relative", RoundedText(session.meter_sigma_relative, 4),
                  "1 sigma, alike in all it reads: half of the accuracy on its data sheet") +
         "\n";
}

std::string BoxColorText(const NewSession& session) {
  if (!session.cct) return "";
  return "# The colour temperature on the box; a measured one counts beside it.\n[[reading]]\n" +
         TomlLine("light", TomlText(session.light.name), "") +
         TomlLine("meter", TomlText(kDataSheetMeter), "") +
         TomlLine("cct_K", ShortestText(session.cct->value()), "") + "\n";
}

std::string CaptureText(const LightDescription& light) {
  return "# A camera's bracket of a grey card beside or instead of a meter; use = \"source\" is of "
         "the lamp\n# itself (fov_deg = 40), \"wall\" of its light on a wall, \"dome\" a "
         "panorama.\n"
         "# [[capture]]\n" +
         TomlLine("# light", TomlText(light.name), "") +
         TomlLine("# frames", "\"captures/*.dng\"", "RAW is best; JPEG with response = \"srgb\"") +
         TomlLine("# use", "\"card\"", "") +
         TomlLine("# reflectance", "0.18", "of the card, which faces the lamp") +
         TomlLine("# distance_m", "1.0", "from the lamp to the card") + "\n";
}

}  // namespace

std::string ReadLine(const NewSession& session) {
  std::string line = "lightcal read -s " + ShellWord(session.directory) + " --light " +
                     ShellWord(session.light.name);
  if (session.device.empty()) return line + " --typed";
  if (StatesSigma(session)) line += std::string(" --meter ") + kTypedMeterName;
  return line + " --device " + ShellWord(session.device);
}

std::string RunLine(const NewSession& session) {
  std::string line = "lightcal run " + ShellWord(session.directory);
  for (std::size_t i = 0; i < session.targets.size(); ++i) {
    line += (i == 0 ? " --to " : ",") + session.targets[i];
  }
  return line;
}

Result<std::string> SessionText(const NewSession& session) {
  std::string text =
      "# A lightcal session. It is yours: change and add what you like.\n"
      "# Readings go into readings.jsonl beside it, a line each:\n#   " +
      ReadLine(session) + "\n# Then the fit, the presets and the report, all in out/:\n#   " +
      RunLine(session) + "\nlightcal = 1\n\n";
  text += RoomText(session.room, session.surroundings) + LightText(session.light) +
          MeterText(session) + BoxColorText(session) + CaptureText(session.light);
  text.pop_back();
  if (auto read_back = ParseSessionToml(text, "session.toml"); !read_back) {
    return Propagate(std::move(read_back));
  }
  return text;
}

}  // namespace lightcal::app
