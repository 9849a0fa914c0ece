// SPDX-License-Identifier: Apache-2.0
// Grammar: ANSI/IESNA LM-63-1986, -91, -95, -02 and IES LM-63-19; the differences as Radiance's
// ies2rad and the standards' own summaries tell them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"
#include "lightcal/records/ies_numbers.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/photometric_text.h"

namespace lightcal {
namespace {

using records::BadPhotometric;
using records::HeaderText;
using records::kLeastLumens;
using records::kMostLumens;
using records::Numbers;

constexpr std::string_view kTilt = "TILT=";
constexpr double kMostAngles = 1e6;

enum class Edition : std::uint8_t { k1986, k1991, k1995, k2002, k2019 };
struct EditionName {
  std::string_view begins;
  Edition edition;
  std::string_view name;
};
constexpr std::array<EditionName, 5> kEditions = {
    {{"IESNA91", Edition::k1991, "LM-63-1991"},
     {"IESNA:LM-63-1995", Edition::k1995, "LM-63-1995"},
     {"IESNA:LM-63-2002", Edition::k2002, "LM-63-2002"},
     {"IES:LM-63-2019", Edition::k2019, "LM-63-2019"},
     {"IES", Edition::k2002, ""}}};

bool StartsWithTilt(std::string_view line) {
  return line.size() >= kTilt.size() &&
         LowerAscii(line.substr(0, kTilt.size())) == LowerAscii(kTilt);
}

// ---- the header ----

void TakeKeyword(std::string_view line, PhotometricHeader& header, std::string*& last) {
  const std::size_t close = line.find(']');
  if (!line.starts_with('[') || close == std::string_view::npos) {
    // Before keywords existed the first line was free text, mostly the luminaire's name.
    if (header.luminaire.empty() && !line.empty()) header.luminaire = HeaderText(line);
    return;
  }
  const std::string key = LowerAscii(TrimBlanks(line.substr(1, close - 1)));
  const std::string value = HeaderText(line.substr(close + 1));
  const std::array<std::pair<std::string_view, std::string*>, 8> known = {
      {{"test", &header.report},
       {"testlab", &header.laboratory},
       {"issuedate", &header.date},
       {"date", &header.date},
       {"manufac", &header.manufacturer},
       {"lumcat", &header.catalogue},
       {"luminaire", &header.luminaire},
       {"lamp", &header.lamps.front().type}}};
  if (key == "more") {
    if (last != nullptr && !value.empty()) *last = HeaderText(*last + " " + value);
    return;
  }
  last = nullptr;
  for (const auto& [name, field] : known) {
    if (name == key && field->empty()) last = field;
  }
  if (last != nullptr) *last = value;
}

// Reads to the TILT line; the rest of the text is numbers. Absent: there is none.
std::optional<std::string_view> TakeHeader(records::Lines& lines, PhotometricHeader& header,
                                           Edition& edition) {
  std::string* last = nullptr;
  edition = Edition::k1986;
  header.version = "LM-63-1986";
  while (const auto line = lines.Next()) {
    if (StartsWithTilt(*line)) return TrimBlanks(line->substr(kTilt.size()));
    if (lines.number() == 1 && line->starts_with("IES")) {
      const auto known = std::ranges::find_if(
          kEditions, [&](const EditionName& e) { return line->starts_with(e.begins); });
      edition = known->edition;
      header.version = known->name.empty() ? HeaderText(*line) : std::string(known->name);
      continue;
    }
    TakeKeyword(*line, header, last);
  }
  return std::nullopt;
}

// ---- TILT ----

LampTilt TakeTilt(Numbers& numbers) {
  LampTilt tilt;
  tilt.geometry = numbers.Whole("TILT's lamp geometry", 1, 3);
  const int count = numbers.Whole("TILT's count of angles", 1, kMostAngles);
  tilt.angle_deg = numbers.List(static_cast<std::size_t>(count), "a TILT angle");
  tilt.factor = numbers.List(static_cast<std::size_t>(count), "a TILT factor");
  return tilt;
}

// A plain name beside the file: nothing that leads elsewhere.
bool IsPlainName(std::string_view name) {
  return !name.empty() && name.size() <= 255 && name.front() != '.' &&
         name.find_first_of("/\\:") == std::string_view::npos &&
         std::ranges::none_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20U; });
}

Result<std::optional<LampTilt>> TiltFromFile(std::string_view name, std::string_view where,
                                             const TiltText& read, Warnings& warnings) {
  if (!IsPlainName(name)) {
    return Refused("unsafe_path", std::string(where),
                   "TILT names \"" + HeaderText(name) +
                       "\"; only a file in the same directory is read. Put it there and name it "
                       "without a path");
  }
  const auto text =
      read ? read(std::string(name))
           : Result<std::string>(tl::unexpected(Error{ErrorKind::kFailed, "", "", ""}));
  if (!text) {
    warnings.push_back({"tilt_missing", std::string(where),
                        "the TILT file " + HeaderText(name) +
                            " is not there; how the lamp dims when tilted is unknown"});
    return std::optional<LampTilt>();
  }
  Numbers numbers(*text, name);
  LampTilt tilt = TakeTilt(numbers);
  if (numbers.error()) return tl::unexpected(*numbers.error());
  return std::optional<LampTilt>(std::move(tilt));
}

// ---- the numbers of the luminaire ----

LuminousOpening OpeningFrom(double width, double length, double height, double metres) {
  LuminousOpening out;
  const auto size = [&](double v) { return Metres(std::abs(v) * metres); };
  out.along_c0 = size(length);
  out.along_c90 = size(width);
  out.height = size(height);
  if (width == 0.0 && length == 0.0 && height == 0.0) return out;
  out.shape = OpeningShape::kRect;
  if (width < 0.0 || length < 0.0) {
    out.shape = width < 0.0 && height < 0.0 ? OpeningShape::kSphere : OpeningShape::kRound;
    // Up to 1995 the diameter stands in the width alone.
    if (length == 0.0) out.along_c0 = out.along_c90;
    if (width == 0.0) out.along_c90 = out.along_c0;
  }
  return out;
}

std::string GenerationOf(double value) {
  const auto is = [&](double v) { return std::abs(value - v) < 1e-9; };
  if (is(1.00001)) return "undefined";
  if (is(1.0001)) return "simulation";
  const auto digits = static_cast<int>(std::lround((value - 1.0) * 1000.0));
  if (digits < 0 || digits > 111 || !is(1.0 + digits / 1000.0)) return {};
  std::string text = digits >= 100 ? "accredited laboratory" : "laboratory";
  if (digits / 10 % 10 == 1) text += ", interpolated";
  if (digits % 10 == 1) text += ", scaled";
  return text;
}

struct Body {
  IntensityGrid grid;
  PhotometricHeader header;
  Warnings warnings;
};

// The twelfth number: a factor, nothing, or how the data came to be.
double TwelfthFactor(double value, Edition edition, std::string_view where, Body& body) {
  if (edition == Edition::k2019) {
    body.header.generation = GenerationOf(value);
    return 1.0;
  }
  if (edition == Edition::k1986 || edition == Edition::k1991) return value;
  if (value != 1.0) {
    body.warnings.push_back({"reserved_field", std::string(where),
                             "the number after the ballast factor is " + ShortestText(value) +
                                 "; this edition reserves it, so it multiplies nothing"});
  }
  return 1.0;
}

void TakeBody(Numbers& numbers, Edition edition, std::string_view where, Body& body) {
  PhotometricHeader& header = body.header;
  LampSet& lamps = header.lamps.front();
  lamps.count = numbers.Whole("the number of lamps", 0, kMostAngles);
  const double lumens = numbers.Take("lumens per lamp");
  if (lumens > kMostLumens) numbers.Fail("lumens per lamp are more than any lamp has");
  double factor = numbers.Positive("the candela multiplier");
  const int vertical = numbers.Whole("the count of vertical angles", 2, kMostAngles);
  const int horizontal = numbers.Whole("the count of horizontal angles", 1, kMostAngles);
  const int type = numbers.Whole("the photometric type", 1, 3);
  const int units = numbers.Whole("the units type (1 feet, 2 metres)", 1, 2);
  const double width = numbers.Take("width");
  const double length = numbers.Take("length");
  const double height = numbers.Take("height");
  factor *= numbers.Positive("the ballast factor");
  factor *=
      TwelfthFactor(numbers.Positive("the number after the ballast factor"), edition, where, body);
  header.power = lamps.power = Watts(std::max(0.0, numbers.Take("input watts")));
  header.opening = OpeningFrom(width, length, height, units == 1 ? kMetresPerFoot : 1.0);
  lamps.count = std::max(1, lamps.count);
  header.absolute = !(lumens > kLeastLumens);
  if (!header.absolute) {
    lamps.flux = Lumens(lumens * lamps.count);
    header.lamp_flux = lamps.flux;
  }
  body.grid.type = static_cast<GoniometerType>(type - 1);
  body.grid.vertical_deg = numbers.Angles(static_cast<std::size_t>(vertical), "vertical");
  body.grid.horizontal_deg = numbers.Angles(static_cast<std::size_t>(horizontal), "horizontal");
  body.grid.candela = numbers.List(
      static_cast<std::size_t>(vertical) * static_cast<std::size_t>(horizontal), "an intensity");
  for (double& candela : body.grid.candela) candela *= factor;
}

// ---- the whole ----

// All that stands behind the TILT line.
struct TakenBody {
  Body body;
  bool at_end = false;
  bool number_follows = false;
};
Result<TakenBody> TakeNumbers(Body header, std::string_view text, std::string_view tilt_word,
                              Edition edition, std::string_view where, const TiltText& tilt,
                              Numbers::Commas commas, int first_line) {
  TakenBody taken{std::move(header)};
  Numbers numbers(text, where, commas, first_line);
  const std::string word = LowerAscii(tilt_word);
  if (word == "include") {
    taken.body.header.tilt = TakeTilt(numbers);
  } else if (word != "none") {
    auto from_file = TiltFromFile(tilt_word, where, tilt, taken.body.warnings);
    if (!from_file) return Propagate(std::move(from_file));
    taken.body.header.tilt = std::move(*from_file);
  }
  TakeBody(numbers, edition, where, taken.body);
  if (numbers.error()) return tl::unexpected(*numbers.error());
  taken.at_end = numbers.AtEnd();
  taken.number_follows = numbers.NumberFollows();
  return taken;
}

bool HasCommaInDigits(std::string_view text) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == ',' && digit(text[i - 1]) && digit(text[i + 1])) return true;
  }
  return false;
}

}  // namespace

bool IsIes(std::string_view text) {
  records::Lines lines(text);
  constexpr int kMostHeaderLines = 10000;
  while (const auto line = lines.Next()) {
    if (StartsWithTilt(*line)) return true;
    if (lines.number() == 1 && line->starts_with("IES")) return true;
    if (lines.number() > kMostHeaderLines) return false;
  }
  return false;
}

Result<ReadPhotometric> IesFromText(std::string_view text, std::string_view where,
                                    const TiltText& tilt) {
  Body body;
  body.header.format = PhotometricFormat::kIes;
  body.header.lamps.resize(1);
  Edition edition = Edition::k1986;
  records::Lines lines(text);
  const auto tilt_word = TakeHeader(lines, body.header, edition);
  if (!tilt_word) return BadPhotometric(where, "has no TILT= line, which every IES file has");
  const auto take = [&](Numbers::Commas commas) {
    return TakeNumbers(body, lines.rest(), *tilt_word, edition, where, tilt, commas,
                       lines.number() + 1);
  };
  auto taken = take(Numbers::Commas::kPart);
  // LM-63 parts numbers by blanks or commas. Some programs write decimal commas: what they give
  // are more numbers than their header announces, or none that fit it; read as decimals all fit.
  if ((!taken || taken->number_follows) && HasCommaInDigits(lines.rest())) {
    auto decimal = take(Numbers::Commas::kDecimal);
    if (decimal && decimal->at_end) {
      decimal->body.warnings.push_back(
          {"decimal_commas", std::string(where),
           "its numbers have decimal commas, which part numbers in LM-63; read as decimal points "
           "they are as many as its header says"});
      taken = std::move(decimal);
    } else if (taken) {
      return BadPhotometric(where,
                            "more numbers stand behind the last intensity, and commas between "
                            "digits: LM-63 parts numbers by commas. Write decimal points, or "
                            "remove what is too much");
    }
  }
  if (!taken) return Propagate(std::move(taken));
  body = std::move(taken->body);
  if (!taken->at_end) {
    body.warnings.push_back({"trailing_data", std::string(where),
                             "more stands behind the last intensity; it is not used"});
  }
  auto table = IntensityTable::Make(std::move(body.grid), where);
  if (!table) return Propagate(std::move(table));
  return ReadPhotometric{{std::move(body.header), std::move(*table)}, std::move(body.warnings)};
}

}  // namespace lightcal
