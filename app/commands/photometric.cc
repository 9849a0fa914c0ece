// SPDX-License-Identifier: Apache-2.0
// lightcal photometric: what an IES or EULUMDAT file says, converted, drawn.
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_type_c.h"
#include "lightcal/report/polar_plot.h"
#include "lightcal_devices/files/read_photometric.h"
#include "output_files.h"
#include "picture_file.h"

namespace lightcal::app {
namespace {

constexpr int kPhotometricDigits = 5;

struct PhotometricOptions {
  std::string file, to, output, plot;
  std::optional<int> set;
  bool force = false;
};

Result<PhotometricFormat> FormatWanted(const PhotometricOptions& options) {
  for (std::size_t i = 0; i < kPhotometricFormatWords.size(); ++i) {
    if (options.to == kPhotometricFormatWords[i]) return static_cast<PhotometricFormat>(i);
  }
  return WrongUsage("--to " + options.to, "is no photometric format; use ies or ldt");
}

Result<void> CheckPhotometric(const PhotometricOptions& options) {
  if (options.to.empty() != options.output.empty()) {
    return WrongUsage("--to", "goes with -o: --to ldt -o lamp.ldt");
  }
  if (!options.to.empty()) {
    if (auto format = FormatWanted(options); !format) return Propagate(std::move(format));
  }
  if (!options.plot.empty()) return CheckPictureName("--plot", options.plot);
  return {};
}

Result<OutputFile> Converted(const PhotometricOptions& options, PhotometricFile file,
                             Console& console) {
  const auto format = FormatWanted(options);
  if (!format) return tl::unexpected(format.error());
  if (file.header.tilt) {
    console.Warn({"tilt_dropped", options.file,
                  "how the lamp dims when tilted is not written; the intensities are those of the "
                  "tested position"});
  }
  if (*format == PhotometricFormat::kIes) return OutputFile{options.output, IesText(file)};
  const double before = file.table.Flux().value();
  const bool sampled = file.table.grid().type != GoniometerType::kC;
  auto as_c = AsTypeC(std::move(file));
  if (!as_c) return Propagate(std::move(as_c));
  if (sampled) {
    const double change = 100.0 * (as_c->table.Flux().value() / before - 1.0);
    console.Warn({"resampled", options.file,
                  "EULUMDAT holds type C only: the table was sampled anew, its flux changed by " +
                      RoundedText(change, 2) + " %"});
  }
  auto text = EulumdatText(*as_c);
  if (!text) return Propagate(std::move(text));
  return OutputFile{options.output, std::move(*text)};
}

// The C planes of both widths of a lobe about the axis, within 0 to 180 degrees.
std::pair<double, double> PlanesOf(const LobeWidths& lobe) {
  const double turn = DegreesFromRadians(lobe.turn);
  return {turn < 0.0 ? turn + 180.0 : turn, turn + 90.0};
}

Node ToJson(const PhotometricFile& file) {
  const PhotometricHeader& header = file.header;
  const IntensityTable& table = file.table;
  const auto word = [](const auto& words, auto value) {
    return words[static_cast<std::size_t>(value)];
  };
  const LobeWidths beam = LobeWidthsAt(table, 0.5);
  const LobeWidths field = LobeWidthsAt(table, 0.1);
  const auto by_plane = [](const LobeWidths& lobe) -> Node {
    return {DegreesFromRadians(lobe.along), DegreesFromRadians(lobe.across)};
  };
  const auto planes = [](const LobeWidths& lobe) -> Node {
    if (lobe.beside_axis) return {};
    const auto [first, second] = PlanesOf(lobe);
    return {first, second};
  };
  Node node = {
      {"format", word(kPhotometricFormatWords, header.format)},
      {"version", header.version},
      {"type", word(kGoniometerTypeWords, table.grid().type)},
      {"flux_lm", table.Flux()},
      {"flux_cubic_lm", table.Flux(TableInterpolation::kCubic)},
      {"peak_cd", table.peak().intensity},
      {"peak_at",
       {{"c_deg", DegreesFromRadians(table.peak().c)},
        {"gamma_deg", DegreesFromRadians(table.peak().gamma)}}},
      {"lamp_lumens", header.lamp_flux},
      {"light_output_ratio", header.lamp_flux ? Node(table.Flux() / *header.lamp_flux) : Node()},
      {"absolute", header.absolute},
      {"planes", table.grid().horizontal_deg.size()},
      {"vertical_angles", table.grid().vertical_deg.size()},
      {"symmetry", word(kTableSymmetryWords, table.symmetry())},
      {"beam_deg", DegreesFromRadians(beam.mean)},
      {"field_deg", DegreesFromRadians(field.mean)},
      {"lobe_about", beam.beside_axis ? "peak" : "axis"},
      {"beam_by_plane_deg", by_plane(beam)},
      {"field_by_plane_deg", by_plane(field)},
      {"beam_planes_c_deg", planes(beam)},
      {"field_planes_c_deg", planes(field)},
      {"power_W", header.power},
      {"opening",
       {{"shape", word(kOpeningShapeWords, header.opening.shape)},
        {"along_c0_m", header.opening.along_c0},
        {"along_c90_m", header.opening.along_c90},
        {"height_m", header.opening.height}}},
      {"manufacturer", Node::UnlessEmpty(header.manufacturer)},
      {"luminaire", Node::UnlessEmpty(header.luminaire)},
      {"catalogue", Node::UnlessEmpty(header.catalogue)},
      {"report", Node::UnlessEmpty(header.report)},
      {"laboratory", Node::UnlessEmpty(header.laboratory)},
      {"date", Node::UnlessEmpty(header.date)},
      {"generation", Node::UnlessEmpty(header.generation)}};
  if (header.tilt) {
    node.Put("tilt", {{"geometry", header.tilt->geometry},
                      {"angle_deg", header.tilt->angle_deg},
                      {"factor", header.tilt->factor}});
  }
  return node;
}

std::string DistributionTitle(const PhotometricOptions& options, const PhotometricHeader& header) {
  const std::string file = std::filesystem::path(options.file).filename().string();
  return header.luminaire.empty() ? file : header.luminaire + " (" + file + ")";
}

double Tenth(Radians angle) { return std::round(10.0 * DegreesFromRadians(angle)) / 10.0; }

std::string Table(const PhotometricOptions& options, const PhotometricFile& file) {
  const PhotometricHeader& header = file.header;
  const IntensityTable& table = file.table;
  const auto text = [](double value) { return RoundedText(value, kPhotometricDigits); };
  const auto widths = [&](double level) {
    const LobeWidths lobe = LobeWidthsAt(table, level);
    std::string out = text(DegreesFromRadians(lobe.mean));
    if (table.symmetry() != TableSymmetry::kAxial) {
      out += " (" + text(DegreesFromRadians(lobe.along)) + " by " +
             text(DegreesFromRadians(lobe.across));
      const auto [first, second] = PlanesOf(lobe);
      if (lobe.turn.value() != 0.0) {
        out += " in C " + ShortestText(std::round(first)) + ", " + ShortestText(std::round(second));
      }
      out += ")";
    }
    return out;
  };
  std::vector<std::vector<std::string>> rows = {
      {"luminous flux", text(table.Flux().value()), "lm"}};
  if (header.lamp_flux) {
    rows.push_back({"of lamp lumens", text(header.lamp_flux->value()), "lm"});
    rows.push_back({"light output ratio", text(100.0 * (table.Flux() / *header.lamp_flux)), "%"});
  }
  rows.push_back({"peak intensity", text(table.peak().intensity.value()), "cd"});
  rows.push_back({"peak at gamma", text(DegreesFromRadians(table.peak().gamma)), "deg"});
  rows.push_back({"beam angle (50 %)", widths(0.5), "deg"});
  rows.push_back({"field angle (10 %)", widths(0.1), "deg"});
  const std::string peak_gamma = ShortestText(Tenth(table.peak().gamma));
  const std::string peak_c = ShortestText(Tenth(table.peak().c));
  const std::string where = LobeWidthsAt(table, 0.5).beside_axis
                                ? "the lobe lies beside the axis, its peak at gamma " + peak_gamma +
                                      ", C " + peak_c +
                                      ": its angles are about that direction, in the plane of C " +
                                      peak_c + " and across it\n"
                                : "";
  const std::string planes = std::to_string(table.grid().horizontal_deg.size());
  return DistributionTitle(options, header) + "\n" + header.version + ", type " +
         std::string(kGoniometerTypeWords[static_cast<std::size_t>(table.grid().type)]) +
         ", symmetry " +
         std::string(kTableSymmetryWords[static_cast<std::size_t>(table.symmetry())]) + ", " +
         planes + " planes of " + std::to_string(table.grid().vertical_deg.size()) + " angles\n" +
         TextTable({"quantity", "value", "unit"}, rows) + where;
}

Result<void> RunPhotometric(const PhotometricOptions& options, Console& console) {
  if (auto ok = CheckPhotometric(options); !ok) return ok;
  NoteInput(options.file);
  const auto read = devices::ReadPhotometricFile(options.file, options.set);
  if (!read) return tl::unexpected(read.error());
  console.Warn(read->warnings);
  std::vector<OutputFile> files;
  if (!options.to.empty()) {
    auto converted = Converted(options, read->file, console);
    if (!converted) return Propagate(std::move(converted));
    files.push_back(std::move(*converted));
  }
  if (!options.plot.empty()) {
    auto picture = PictureFile(
        options.plot,
        report::PolarPlot(read->file.table, DistributionTitle(options, read->file.header)));
    if (!picture) return Propagate(std::move(picture));
    files.push_back(std::move(*picture));
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  console.Print(Table(options, read->file));
  for (const OutputFile& file : files) console.Print("wrote " + file.path + "\n");
  console.PrintDocument(ToJson(read->file));
  return {};
}

}  // namespace

Run BuildPhotometric(CLI::App& parser) {
  auto options = std::make_shared<PhotometricOptions>();
  parser.add_option("file", options->file, "IES LM-63 (.ies) or EULUMDAT (.ldt); told by content")
      ->required();
  parser.add_option("--to", options->to, "Convert: LM-63-2002 or EULUMDAT")
      ->check(CLI::IsMember({"ies", "ldt"}));
  parser.add_option("-o,--output", options->output, "Where the converted file goes");
  parser.add_option("--set", options->set, "Which of a EULUMDAT file's sets of lamps is in it")
      ->check(CLI::PositiveNumber);
  parser.add_option("--plot", options->plot, "Write a polar diagram, .svg or .png");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunPhotometric(*options, console); };
}

}  // namespace lightcal::app
