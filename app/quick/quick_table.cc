// SPDX-License-Identifier: Apache-2.0
#include "quick/quick_table.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "input_files.h"
#include "lamp_answer.h"
#include "lamp_words.h"
#include "lightcal/calibrate/export_presets.h"
#include "lightcal/core/did_you_mean.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/stops.h"
#include "lightcal/core/units_text.h"
#include "lightcal/fit/fit_light.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/files/csv_columns.h"
#include "lightcal_devices/files/delimited_text.h"
#include "output_files.h"
#include "typed_reading.h"

namespace lightcal::app {
namespace {

using devices::files::ColumnFromName;
using devices::files::CsvQuantity;
using devices::files::Row;

enum class TableWord { kName, kReading, kDistance, kLux, kCard, kOff, kAngle, kCct, kOption };

struct TableColumn {
  TableWord word = TableWord::kName;
  double scale = 1.0;
  std::string option;  // kOption: fixture, kind, room, meter
};

constexpr const char* kColumnNames =
    "name, reading, distance_m, illuminance_lx, card_lx, off_lx, angle_deg, cct_K, fixture, kind, "
    "room, meter (other units: distance_ft, illuminance_fc)";

std::optional<TableColumn> ColumnOf(const std::string& written) {
  const std::string name = LowerAscii(TrimBlanks(written));
  if (name == "name" || name == "lamp" || name == "light") return TableColumn{};
  if (name == "reading") return TableColumn{TableWord::kReading, 1.0, {}};
  if (name == "angle_deg") return TableColumn{TableWord::kAngle, 1.0, {}};
  for (const char* option : {"fixture", "kind", "room", "meter"}) {
    if (name == option) return TableColumn{TableWord::kOption, 1.0, name};
  }
  for (const auto& [prefix, word] :
       {std::pair("card_", TableWord::kCard), std::pair("off_", TableWord::kOff)}) {
    if (!name.starts_with(prefix)) continue;
    const auto unit = ColumnFromName(name.substr(std::string_view(prefix).size()));
    if (unit.quantity == CsvQuantity::kIlluminance) return TableColumn{word, unit.scale, {}};
  }
  const auto column = ColumnFromName(written);
  switch (column.quantity) {
    case CsvQuantity::kDistance:
      return TableColumn{TableWord::kDistance, column.scale, {}};
    case CsvQuantity::kIlluminance:
      return TableColumn{TableWord::kLux, column.scale, {}};
    case CsvQuantity::kCct:
      return TableColumn{TableWord::kCct, 1.0, {}};
    default:
      return std::nullopt;
  }
}

Result<std::vector<TableColumn>> ColumnsOf(const std::vector<std::string>& names,
                                           const std::string& where) {
  std::vector<TableColumn> columns;
  for (const std::string& name : names) {
    const auto column = ColumnOf(name);
    if (!column && ColumnFromName(name).quantity == CsvQuantity::kNeedsUnit) {
      return Refused(
          "bad_table", where,
          "the column \"" + name + "\" has no unit; put it into its name: " + kColumnNames);
    }
    if (!column) {
      return Refused("bad_table", where,
                     "no column is called \"" + name + "\"; there are " + kColumnNames);
    }
    columns.push_back(*column);
  }
  const auto has = [&](TableWord word) {
    return std::ranges::find(columns, word, &TableColumn::word) != columns.end();
  };
  if (!has(TableWord::kReading) && !(has(TableWord::kDistance) && has(TableWord::kLux))) {
    return Refused("bad_table", where,
                   "a lamp needs a column reading, or distance_m and illuminance_lx");
  }
  return columns;
}

// The pieces of a reading that several columns hold, until the next distance begins another.
struct PendingReading {
  std::string distance, lux, rest;
  [[nodiscard]] bool Empty() const { return distance.empty() && lux.empty() && rest.empty(); }
};

// A bare number is in the column's unit; one with a unit of its own in that.
Result<std::string> InSi(const std::string& cell, const TableColumn& column,
                         const std::string& where) {
  if (const auto number = ParseNumber(cell)) return ShortestText(*number * column.scale);
  if (column.word == TableWord::kDistance) {
    if (const auto length = ParseLength(cell)) return ShortestText(length->value());
  } else if (column.word != TableWord::kAngle) {
    if (const auto lux = ParseIlluminance(cell)) return ShortestText(lux->value());
  }
  return Refused("bad_table", where, "\"" + cell + "\" is not a number");
}

// A row as if it had been typed.
class RowReader {
 public:
  RowReader(const QuickOptions& asked, std::string where, bool decimal_comma)
      : out_(asked), where_(std::move(where)), decimal_comma_(decimal_comma) {}

  Result<QuickOptions> Read(const std::vector<TableColumn>& columns, const Row& row) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string cell(TrimBlanks(devices::files::CellAt(row, i)));
      if (cell.empty()) continue;
      if (auto taken = Take(columns[i], cell); !taken) return Propagate(std::move(taken));
    }
    if (auto ended = EndReading(); !ended) return Propagate(std::move(ended));
    if (out_.readings.empty()) return Refused("bad_table", where_, "the row holds no reading");
    return out_;
  }

 private:
  Result<void> Take(const TableColumn& column, const std::string& cell) {
    switch (column.word) {
      case TableWord::kName:
        out_.name = cell;
        return {};
      case TableWord::kReading:
        out_.readings.push_back(cell);
        return {};
      case TableWord::kCct:
        out_.cct = WithPoint(cell);
        return {};
      case TableWord::kOption:
        SetOption(column.option, cell);
        return {};
      default:
        break;
    }
    const auto number = InSi(WithPoint(cell), column, where_);
    if (!number) return tl::unexpected(number.error());
    if (column.word == TableWord::kDistance) {
      if (!pending_.distance.empty()) {
        if (auto ended = EndReading(); !ended) return ended;
      }
      pending_.distance = *number;
    } else if (column.word == TableWord::kLux) {
      if (!pending_.lux.empty()) {
        if (auto ended = EndReading(); !ended) return ended;
      }
      pending_.lux = *number;
    } else if (column.word == TableWord::kAngle) {
      pending_.rest += "," + *number + "deg";
    } else {
      pending_.rest += (column.word == TableWord::kCard ? ",card=" : ",off=") + *number + "lx";
    }
    return {};
  }

  [[nodiscard]] std::string WithPoint(std::string cell) const {
    if (decimal_comma_) std::ranges::replace(cell, ',', '.');
    return cell;
  }

  void SetOption(const std::string& name, const std::string& cell) {
    if (name == "fixture") out_.fixture = cell;
    if (name == "kind") out_.kind = cell;
    if (name == "room") out_.room = cell;
    if (name == "meter") out_.meter = cell;
  }

  Result<void> EndReading() {
    if (pending_.Empty()) return {};
    if (pending_.distance.empty() || pending_.lux.empty()) {
      return Refused("bad_table", where_,
                     pending_.lux.empty() ? "a distance without its illuminance"
                                          : "an illuminance without its distance");
    }
    out_.readings.push_back(pending_.lux + "lx@" + pending_.distance + "m" + pending_.rest);
    pending_ = {};
    return {};
  }

  QuickOptions out_;
  std::string where_;
  bool decimal_comma_;  // in cells that hold one number
  PendingReading pending_;
};

// What a row came to. The session and the fit stay where they are: answers point at them.
struct TableLamp {
  std::string name, where;
  Session session;
  FittedSession fitted;
  std::optional<LampAnswer> answer;
  std::optional<Error> error;
};

Result<void> AnswerRow(const QuickOptions& options, TableLamp& lamp) {
  if (!options.fixture.empty() && !FixtureFromName(options.fixture)) {
    return Refused("bad_table", lamp.where,
                   "no fixture is called \"" + options.fixture +
                       "\"; there are bulb, cob_bare, "
                       "reflector, fresnel, panel, softbox, luminaire");
  }
  auto session = SessionFromOptions(options);
  if (!session) return Propagate(std::move(session));
  lamp.session = *std::move(session);
  auto fitted = FitSession(lamp.session, FitSettings{});
  if (!fitted) return Propagate(std::move(fitted));
  lamp.fitted = *std::move(fitted);
  LampQuestion question;
  question.lights = &lamp.fitted.lights;
  question.session = &lamp.session;
  question.targets = options.targets;
  question.typed_color = true;
  std::vector<LampAnswer> answers = LampAnswersOf(question).lamps;
  lamp.answer = std::move(answers.front());
  return {};
}

std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

// "Unreal Engine (cd)" of every engine that any lamp has a number for.
std::vector<std::string> EngineColumns(const std::deque<TableLamp>& lamps) {
  std::vector<std::string> names;
  for (const TableLamp& lamp : lamps) {
    if (!lamp.answer) continue;
    for (const EngineFigure& figure : lamp.answer->figures) {
      const std::string name =
          figure.engine + (figure.unit.empty() ? "" : " (" + figure.unit + ")");
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::string CsvOf(const std::deque<TableLamp>& lamps) {
  const std::vector<std::string> engines = EngineColumns(lamps);
  std::string text = "name,value,unit,low95,high95,stops,cct_K";
  for (const std::string& engine : engines) text += "," + CsvCell(engine);
  text += ",enough_for,next,problem\r\n";
  for (const TableLamp& lamp : lamps) {
    text += CsvCell(lamp.name);
    if (!lamp.answer) {
      text += ",,,,,," + std::string(engines.size(), ',') + ",,," + CsvCell(lamp.error->message) +
              "\r\n";
      continue;
    }
    const FittedLight& light = *lamp.answer->light;
    const Strength strength = StrengthOf(light);
    const Uncertain& u = *strength.value;
    const auto stops = HalfWidthStops(u);
    const auto number = [](double value) { return RoundedText(value, 6); };
    text += "," + number(u.value) + "," + std::string(strength.unit) + "," + number(LowEnd(u)) +
            "," + number(HighEnd(u)) + "," + (stops ? RoundedText(*stops, 3) : "") + "," +
            (light.color.cct_K ? number(light.color.cct_K->value) : "");
    for (const std::string& engine : engines) {
      const auto figure = std::ranges::find_if(lamp.answer->figures, [&](const EngineFigure& f) {
        return engine == f.engine + (f.unit.empty() ? "" : " (" + f.unit + ")");
      });
      text += "," + (figure == lamp.answer->figures.end() ? "" : CsvCell(figure->value));
    }
    text += "," + (stops ? EnoughFor(*stops) : "") + "," + CsvCell(lamp.answer->next.say) + ",\r\n";
  }
  return text;
}

// Readings of one lamp in two rows would be two lamps.
Result<QuickOptions> UnderANameOfItsOwn(QuickOptions typed, const std::deque<TableLamp>& lamps,
                                        const std::string& where) {
  const auto other = std::ranges::find(lamps, typed.name, &TableLamp::name);
  if (other == lamps.end()) return typed;
  return Refused("bad_table", where,
                 "\"" + typed.name + "\" stands in " + other->where +
                     ", too: a row is a lamp, whose further readings stand in the same row "
                     "(distance_m,illuminance_lx again); another lamp needs another name");
}

Result<std::deque<TableLamp>> ReadTable(const QuickOptions& options) {
  const auto bytes = ReadInputFile(options.table);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto text = devices::files::TextFromBytes(*bytes, options.table);
  if (!text) return tl::unexpected(text.error());
  const std::string first_line = text->substr(0, text->find('\n'));
  const char delimiter = devices::files::DelimiterOf(first_line);
  auto rows = devices::files::ReadRows(*text, delimiter);
  if (!rows) return Propagate(std::move(rows));
  std::erase_if(*rows, [](const Row& row) { return row.cells.empty(); });
  std::vector<std::string> names = SplitAt(options.columns, ',');
  for (std::string& name : names) name = TrimBlanks(name);
  if (options.columns.empty()) {
    if (rows->empty()) return Refused("bad_table", options.table, "holds no line");
    names = rows->front().cells;
    rows->erase(rows->begin());
  }
  const auto columns = ColumnsOf(names, options.table);
  if (!columns) return tl::unexpected(columns.error());
  if (rows->empty()) return Refused("bad_table", options.table, "holds no lamp");
  std::deque<TableLamp> lamps;
  for (const Row& row : *rows) {
    const std::string where = devices::files::AtLine(options.table, row.line);
    QuickOptions of_row = options;
    of_row.name = "line " + std::to_string(row.line);
    auto typed = RowReader(of_row, where, delimiter != ',').Read(*columns, row);
    if (typed) typed = UnderANameOfItsOwn(*std::move(typed), lamps, where);
    TableLamp& lamp = lamps.emplace_back();  // after its name was looked for among the others
    lamp.name = typed ? typed->name : of_row.name;
    lamp.where = where;
    const auto answered =
        typed ? AnswerRow(*typed, lamp) : Result<void>(tl::unexpected(typed.error()));
    if (!answered) lamp.error = answered.error();
  }
  return lamps;
}

}  // namespace

Result<void> RunQuickTable(const QuickOptions& options, Console& console) {
  auto lamps = ReadTable(options);
  if (!lamps) return Propagate(std::move(lamps));
  std::vector<LampAnswer> answers;
  LightFile all;
  Warnings warnings;
  const Error* refused = nullptr;
  for (const TableLamp& lamp : *lamps) {
    warnings.insert(warnings.end(), lamp.fitted.warnings.begin(), lamp.fitted.warnings.end());
    if (lamp.answer) {
      answers.push_back(*lamp.answer);
      all.lights.push_back(*lamp.answer->light);
    } else {
      if (refused == nullptr) refused = &*lamp.error;
      warnings.push_back({lamp.error->code, lamp.where, lamp.error->message});
    }
  }
  if (answers.empty()) return tl::unexpected(*refused);
  all.provenance.generator = GeneratorName();
  const bool as_csv = options.output.ends_with(".csv");
  std::vector<OutputFile> files;
  if (as_csv) {
    files.push_back({options.output, CsvOf(*lamps)});
  } else if (!options.targets.empty()) {
    auto presets = ExportPresets(all, options.targets, "lamps", {.rig = options.rig});
    if (!presets) return Propagate(std::move(presets));
    warnings.insert(warnings.end(), presets->warnings.begin(), presets->warnings.end());
    for (PresetFile& file : presets->files) {
      files.push_back({std::move(file.name), std::move(file.contents)});
    }
    PlaceUnder(options.output, files);
  }
  console.Warn(warnings);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  console.Print(LampAnswersTable(answers));
  Node document = DocumentOf(all);
  Node next = Node::Table();
  for (const LampAnswer& answer : answers) next.Put(answer.light->name, answer.next.say);
  document.Put("next_steps", std::move(next));
  document.Put("files", Node::UnlessEmpty(PathsOf(files)));
  console.Note(files.empty() ? "add -o FILE.csv for low, high, stops and each engine's number"
                             : WroteLine(files, options.output));
  if (refused != nullptr) {
    const auto count = lamps->size() - answers.size();
    return EndWithError(console, std::move(document),
                        {ErrorKind::kRefused, refused->code, options.table,
                         std::to_string(count) + (count == 1 ? " lamp was" : " lamps were") +
                             " refused; the others are answered"});
  }
  console.PrintDocument(std::move(document));
  return {};
}

}  // namespace lightcal::app
