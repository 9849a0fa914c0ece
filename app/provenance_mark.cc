// SPDX-License-Identifier: Apache-2.0
#include "provenance_mark.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/json_codec.h"

namespace lightcal::app {
namespace {

using records::Node;

constexpr std::size_t kHeadBytes = std::size_t{64} << 10U;  // holds every format's header
constexpr std::size_t kMostOfADocument = std::size_t{256} << 20U;
constexpr std::size_t kHeadLines = 16;
constexpr std::string_view kOurName = "lightcal ";  // of "lightcal 0.1.0"
constexpr std::string_view kSchema = "lightcal.";   // how the "schema" of our documents begins
constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";
constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";

std::vector<std::string_view> HeadLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty() && lines.size() < kHeadLines) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
  }
  return lines;
}

bool IsOurs(const Node* generator) {
  return generator != nullptr && generator->text.starts_with(kOurName);
}

std::string SchemaOf(const Node& root) {
  const std::string schema = root.TextAt("schema");
  return schema.starts_with(kSchema) ? schema.substr(0, schema.find('/')) : std::string();
}

// Our documents begin with their schema: what follows can be millions of characters.
std::string FirstSchema(std::string_view json) {
  constexpr std::size_t kLongest = 200;
  const std::size_t end = json.substr(0, kLongest).find(',');
  if (end == std::string_view::npos) return {};
  const auto first_member = records::ParseJson(std::string(json.substr(0, end)) + '}');
  return first_member ? SchemaOf(*first_member) : std::string();
}

std::string OwnJson(std::string_view contents) {
  if (std::string schema = FirstSchema(contents); !schema.empty()) return schema;
  auto root = records::ParseJson(contents);
  // A tape is a document a line; its first says whose it is.
  if (!root) root = records::ParseJson(contents.substr(0, contents.find('\n')));
  if (!root || root->kind != Node::Kind::kTable) return {};
  if (std::string schema = SchemaOf(*root); !schema.empty()) return schema;
  if (const Node* asset = root->Find("asset"))
    return IsOurs(asset->Find("generator")) ? "gltf" : "";
  const Node* provenance = root->Find("provenance");
  const bool ours = IsOurs(root->Find("generator")) ||
                    (provenance != nullptr && IsOurs(provenance->Find("generator")));
  return ours ? "json" : "";
}

// The header chunk, then our text chunk.   Source: ISO/IEC 15948:2004, 5.3, 11.3.4.3.
std::string OwnPng(std::string_view head) {
  constexpr std::size_t kTextChunkAt = 8 + 25;
  if (head.size() < kTextChunkAt + 8) return {};
  std::string wanted = "tEXtSoftware";
  wanted += '\0';
  wanted += kOurName;
  return head.substr(kTextChunkAt + 4).starts_with(wanted) ? "png" : "";
}

// An attribute: name, type, size in four bytes, value.   Source: OpenEXR file layout.
std::string OwnExr(std::string_view head) {
  std::string wanted = "lightcal:generator";
  wanted += '\0';
  wanted += "string";
  wanted += '\0';
  const std::size_t at = head.find(wanted);
  if (at == std::string_view::npos || head.size() < at + wanted.size() + 4) return {};
  return head.substr(at + wanted.size() + 4).starts_with(kOurName) ? "exr" : "";
}

bool StartsAsComment(std::string_view line, std::string_view leader) {
  if (!line.starts_with(leader)) return false;
  line.remove_prefix(leader.size());
  constexpr std::array<std::string_view, 4> kMarks = {" Written by lightcal", " Lights by lightcal",
                                                      " written by lightcal", " lightcal "};
  return std::ranges::any_of(kMarks, [&](std::string_view mark) { return line.starts_with(mark); });
}

struct TextFormat {
  std::string_view name;
  std::string_view start;  // how a file of this format begins
  std::string_view mark;   // how a line of its head begins, if we wrote it ...
  bool comment = false;    // ... `mark` leads a comment that names us, or
  bool inside = false;     // ... holds it anywhere
};
// More special starts before less special ones.
constexpr std::array kTextFormats = {
    TextFormat{"svg", "<svg", "<!--", true},
    TextFormat{"html", "<!DOCTYPE html", "<meta name=\"generator\" content=\"lightcal"},
    TextFormat{"mitsuba", "<?xml", "<!--", true},
    TextFormat{"usd", "#usda", "  doc = \"lightcal "},
    TextFormat{"godot", "[gd_scene", ";", true},
    TextFormat{"unreal", "Begin Map", " Name=lightcal_", false, true},
    TextFormat{"ies", "IESNA", "[OTHER] written by lightcal"},
    TextFormat{"csv", "# written by lightcal ", "# written by lightcal "},
    TextFormat{"hdr", "#?RADIANCE", "# written by lightcal"},
    TextFormat{"script", "//", "//", true},
    TextFormat{"script", "#", "#", true},
};

std::string OwnText(std::string_view head) {
  const auto lines = HeadLines(head);
  for (const TextFormat& format : kTextFormats) {
    if (!head.starts_with(format.start)) continue;
    // A script says it in its first line; elsewhere the head holds other lines before it.
    const std::size_t count = format.name == "script" ? 1 : lines.size();
    for (std::size_t i = 0; i < count; ++i) {
      const bool ours = format.comment  ? StartsAsComment(lines[i], format.mark)
                        : format.inside ? lines[i].find(format.mark) != std::string_view::npos
                                        : lines[i].starts_with(format.mark);
      if (ours) return std::string(format.name);
    }
    return {};
  }
  // EULUMDAT names its own file in the eleventh line.   Source: EULUMDAT, line 11.
  constexpr std::size_t kFileNameLine = 10;
  const bool eulumdat =
      lines.size() > kFileNameLine && lines[kFileNameLine] == "written by lightcal";
  return eulumdat ? "ldt" : "";
}

struct Ending {
  std::string_view ending;
  std::string_view formats;  // between blanks; a name without one is no output of ours
};
constexpr std::string_view kAny = "";  // of an engine or a picture: not checked against it
constexpr std::array kEndings = {
    Ending{".exr", " exr "},    Ending{".png", " png "},   Ending{".svg", " svg "},
    Ending{".pdf", " pdf "},    Ending{".html", " html "}, Ending{".htm", " html "},
    Ending{".ies", " ies "},    Ending{".ldt", " ldt "},   Ending{".csv", " csv "},
    Ending{".gltf", " gltf "},  Ending{".usda", " usd "},  Ending{".json", " json "},
    Ending{".zip", " zip "},    Ending{".gdtf", " gdtf "}, Ending{".toml", " "},
    Ending{".jsonl", " tape "}, Ending{".py", " script "}, Ending{".jpg", " "},
    Ending{".jpeg", " "},       Ending{".tif", " "},       Ending{".tiff", " "},
    Ending{".hdr", " hdr "},    Ending{".dng", " "},       Ending{".tscn", kAny},
    Ending{".pbrt", kAny},      Ending{".xml", kAny},      Ending{".js", kAny},
    Ending{".t3d", kAny},       Ending{".cs", kAny},       Ending{".h", kAny},
    Ending{".glb", kAny},       Ending{".usd", kAny},
};

const Ending* EndingOf(const std::string& path) {
  const std::string ending = LowerAscii(std::filesystem::path(path).extension().string());
  const auto known = std::ranges::find(kEndings, ending, &Ending::ending);
  return known == kEndings.end() ? nullptr : &*known;
}

// Archives of ours are not compressed: the first file follows its own name.
std::string OwnArchive(std::string_view head) {
  const auto begins = [&](std::string_view file, std::string_view text) {
    return head.find(std::string(file) + std::string(text)) != std::string_view::npos;
  };
  if (begins("lightcal/__init__.py", "# Written by lightcal")) return "zip";
  constexpr std::string_view kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  const bool gdtf = begins("description.xml", std::string(kXml) + "<!-- Written by lightcal ");
  return gdtf ? "gdtf" : "";
}

}  // namespace

std::string OwnFormatOf(std::string_view contents) {
  const std::string_view head = contents.substr(0, kHeadBytes);
  if (head.starts_with('{')) return OwnJson(contents);
  if (head.starts_with(kPngMagic)) return OwnPng(head);
  if (head.starts_with(kExrMagic)) return OwnExr(head);
  if (head.starts_with("%PDF")) {
    return contents.find("/Creator (lightcal ") != std::string_view::npos ? "pdf" : "";
  }
  if (head.starts_with("PK")) return OwnArchive(head);
  return OwnText(head);
}

std::string OwnFormatOfFile(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream stream(path, std::ios::binary);
  std::string contents(kHeadBytes, '\0');
  stream.read(contents.data(), static_cast<std::streamsize>(contents.size()));
  contents.resize(static_cast<std::size_t>(stream.gcount()));
  if (std::string schema = FirstSchema(contents); !schema.empty()) return schema;
  const auto size = std::filesystem::file_size(path, error);
  const bool document = contents.starts_with('{') || contents.starts_with("%PDF");
  if (document && !error && size > contents.size() && size <= kMostOfADocument) {
    std::string rest(size - contents.size(), '\0');
    stream.read(rest.data(), static_cast<std::streamsize>(rest.size()));
    contents += rest.substr(0, static_cast<std::size_t>(stream.gcount()));
  }
  return OwnFormatOf(contents);
}

Result<void> CheckEnding(const std::string& path, std::string_view format) {
  const Ending* const known = EndingOf(path);
  if (format.empty() || known == nullptr || known->formats == kAny) return {};
  std::string wanted = " json ";
  if (!format.starts_with(kSchema)) wanted = " " + std::string(format) + " ";
  if (format == kTapeFormat) wanted = " tape ";
  const auto holds = [&](const Ending& one) {
    return one.formats.find(wanted) != std::string_view::npos;
  };
  if (holds(*known)) return {};
  const auto fits = std::ranges::find_if(kEndings, holds);
  return Refused("wrong_ending", path,
                 "ends as another kind of file than what would be written there (" +
                     std::string(format) + "); nothing was written, choose a name that " +
                     (fits == kEndings.end() ? std::string("fits")
                                             : "ends in " + std::string(fits->ending)));
}

bool EndsAsOurs(const std::string& path) {
  const Ending* const known = EndingOf(path);
  return known != nullptr && known->formats != " ";
}

}  // namespace lightcal::app
