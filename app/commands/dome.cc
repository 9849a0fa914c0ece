// SPDX-License-Identifier: Apache-2.0
// lightcal dome: a panorama as a calibrated environment, its lights as lights.
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clock.h"
#include "color_words.h"
#include "commands.h"
#include "directory_name.h"
#include "dome/dome_options.h"
#include "dome/dome_outputs.h"
#include "dome/dome_words.h"
#include "input_files.h"
#include "lamp_words.h"
#include "lightcal/calibrate/dome/make_dome.h"
#include "lightcal/colorimetry/cct.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/core/units_text.h"
#include "lightcal/imaging/panorama/turn_north.h"
#include "lightcal/records/light_codec.h"
#include "lightcal_devices/disk_sources.h"
#include "one_of.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

struct DomeCommandOptions {
  DomeOptions dome;
  std::string extract = "0", plate, output, space, white;
  bool force = false;
};

struct Plan {
  DomeRequest request;
  DomeSettings settings;
  std::optional<GreyPlate> grey;
};

Result<std::size_t> ParseExtract(const std::string& text) {
  if (text == "all") return kEveryLight;
  const auto number = ParseNumber(text);
  if (!number || *number < 0.0 || *number != static_cast<double>(static_cast<int>(*number))) {
    return WrongUsage("--extract", "\"" + text + "\" is neither a count of lights nor all");
  }
  return static_cast<std::size_t>(*number);
}

Result<Plan> PlanOf(const DomeCommandOptions& options) {
  Plan plan;
  auto request = DomeRequestOf(options.dome);
  if (!request) return Propagate(std::move(request));
  plan.request = std::move(*request);
  const auto extract = ParseExtract(options.extract);
  if (!extract) return tl::unexpected(extract.error());
  plan.settings.extract = *extract;
  if (!options.plate.empty()) {
    const auto plate = ParsePlateExposure("--plate-exposure", options.plate);
    if (!plate) return tl::unexpected(plate.error());
    plan.settings.plate = *plate;
  }
  auto grey = GreyPlateOf(options.dome, plan.request, plan.settings.plate);
  if (!grey) return Propagate(std::move(grey));
  plan.grey = *std::move(grey);
  const auto colors = ParseColorWords(options.space, options.white);
  if (!colors) return tl::unexpected(colors.error());
  plan.settings.space = colors->space;
  plan.settings.white = colors->white;
  plan.settings.time = SourceDateIso8601().value_or("");
  return plan;
}

const char* SourceOf(const DomeLight& light) {
  if (light.inferred) return "inferred";
  return light.body.clipped ? "lower_bound" : "pixels";
}

Node ColorNode(Xy xy) {
  const CctResult cct = CctFromXy(xy);
  return {{"xy", {xy.x, xy.y}},
          {"cct_K", cct.valid() ? Node(cct.temperature) : Node()},
          {"duv", cct.valid() ? Node(cct.duv) : Node()}};
}

Node DomeLightNode(const MeasuredDome& measured, std::size_t i, const std::string& name,
                   bool taken) {
  const DomeLight& light = measured.lights[i];
  const Vec3 direction = TurnedNorth(light.direction, measured.north);
  const AzimuthElevation at = AnglesOf(direction);
  return {{"name", name},
          {"illuminance_lx", DocumentOf(LuxOfLight(measured, i))},
          {"source", SourceOf(light)},
          {"direction", direction},
          {"azimuth_deg", at.azimuth_deg},
          {"elevation_deg", at.elevation_deg},
          {"angular_diameter_deg", DegreesFromRadians(light.angular_diameter)},
          {"luminance_nits", light.luminance},
          {"color", light.xy ? ColorNode(*light.xy) : Node()},
          {"extracted", taken}};
}

std::string ScaleText(const MeasuredDome& measured) {
  if (!measured.scale_u95_relative) return "";
  const double u95 = *measured.scale_u95_relative;
  if (!(measured.scale.range_ln > 0.0)) return " ± " + RoundedText(100.0 * u95, 2) + " %";
  return ", anything from " + RoundedText(std::exp(-u95), 2) + " to " +
         RoundedText(std::exp(u95), 2) + " times that";
}

Node ScaleNode(const MeasuredDome& measured) {
  const double factor = measured.scale.factor;
  Node node = {{"factor", factor}, {"source", measured.scale_source}};
  if (!(measured.scale.range_ln > 0.0) || !measured.scale_u95_relative) {
    node.Put({{"u95_relative", measured.scale_u95_relative}});
    return node;
  }
  const double ln = *measured.scale_u95_relative;
  node.Put({{"u95_relative", std::sinh(ln)},
            {"low95", factor * std::exp(-ln)},
            {"high95", factor * std::exp(ln)}});
  return node;
}

std::string Table(const MadeDome& made) {
  const MeasuredDome& measured = made.measured;
  const DomePlane& up = made.planes.front();
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < made.names.size(); ++i) {
    const DomeLight& light = measured.lights[i];
    const AzimuthElevation at = AnglesOf(TurnedNorth(light.direction, measured.north));
    const CctResult cct = light.xy ? CctFromXy(*light.xy) : CctResult{};
    const double lux = light.illuminance.value();
    rows.push_back({made.names[i],
                    measured.unit_known ? ValueAndInterval(LuxOfLight(measured, i), "lx")
                                        : RoundedText(lux, 4),
                    RoundedText(at.azimuth_deg, 4) + "°", RoundedText(at.elevation_deg, 4) + "°",
                    RoundedText(DegreesFromRadians(light.angular_diameter), 2) + "°",
                    cct.valid() ? RoundedText(cct.temperature.value(), 3) + " K" : "-",
                    SourceOf(light), i < made.extracted ? "taken out" : "stays"});
  }
  std::string text = TextTable(
      {"light", measured.unit_known ? "lux at normal incidence" : "lux, were 1.0 one cd/m²",
       "azimuth", "elevation", "diameter", "CCT", "from", "dome"},
      rows);
  const auto lux = [&](double v) { return RoundedText(v, 4) + (measured.unit_known ? " lx" : ""); };
  return text + "\nupward plane: " + lux(up.lights) + " from the lights + " + lux(up.remaining) +
         " from the dome = " + lux(up.total) +
         (up.most ? ", up to " + lux(up.lights + *up.most) : "") +
         "; scale: " + measured.scale_source + ScaleText(measured) +
         (measured.unit_known ? ""
                              : ", a unit that nobody states: true to each other, not in lux") +
         "\n";
}

Node ViewNode(const DomeViewScale& view) {
  return {{"file", view.file},
          {"factor", view.factor},
          {"u95_relative", view.u95_relative},
          {"yaw_deg", DegreesFromRadians(view.aim.yaw)},
          {"pitch_deg", DegreesFromRadians(view.aim.pitch)},
          {"roll_deg", DegreesFromRadians(view.aim.roll)},
          {"u95_deg", view.aim_u95_deg}};
}

Node BlindCapNode(const BlindCap& cap, Radians north) {
  const AzimuthElevation at = AnglesOf(TurnedNorth(cap.direction, north));
  return {{"azimuth_deg", at.azimuth_deg},
          {"elevation_deg", at.elevation_deg},
          {"half_angle_deg", DegreesFromRadians(cap.half_angle)}};
}

Node GreyNode(const DomeInput::Grey& grey) {
  return {{"factor", grey.factor},
          {"u95_relative", grey.u95_relative},
          {"misfit_sd_relative", grey.misfit_sd},
          {"ball_reflectance", grey.ball_reflectance}};
}

std::string ViewsTable(const DomeInput& input) {
  if (input.views.size() < 2) return "";
  std::vector<std::vector<std::string>> rows;
  for (const DomeViewScale& view : input.views) {
    rows.push_back({view.file, ValueWithPercent(view.factor, view.u95_relative * view.factor, ""),
                    RoundedText(DegreesFromRadians(view.aim.yaw), 5) + "°",
                    RoundedText(DegreesFromRadians(view.aim.pitch), 4) + "°",
                    RoundedText(DegreesFromRadians(view.aim.roll), 4) + "°",
                    view.aim_u95_deg ? RoundedText(*view.aim_u95_deg, 2) + "°" : "as given"});
  }
  std::string lens;
  if (input.field_of_view) {
    lens = "the lens sees " + RoundedText(DegreesFromRadians(*input.field_of_view), 4) +
           "°; features lie within " + RoundedText(input.aims_rms_px, 2) + " pixels\n";
  }
  return TextTable({"view", "scale", "yaw", "pitch", "roll", "aim ±"}, rows) + "\n" + lens +
         "views agree within " + RoundedText(100.0 * input.agreement_sd, 2) +
         " % (1 sigma), but for " + RoundedText(100.0 * input.apart_share, 2) +
         " % of what they share, more than 10 % apart; the lens passes " +
         RoundedText(100.0 * input.rim_transmission, 3) + " % at its rim\n\n";
}

Node ToJson(const Plan& plan, const MadeDome& made, const std::vector<std::string>& written) {
  const MeasuredDome& measured = made.measured;
  Node lights = Node::Array();
  for (std::size_t i = 0; i < made.names.size(); ++i) {
    lights.items.push_back(DomeLightNode(measured, i, made.names[i], i < made.extracted));
  }
  Node illuminance = Node::Table();
  for (const DomePlane& plane : made.planes) {
    illuminance.Put(plane.name, {{"total", plane.total},
                                 {"lights", plane.lights},
                                 {"remaining", plane.remaining},
                                 {"most", plane.most ? Node(plane.lights + *plane.most) : Node()}});
  }
  Node plate;
  const auto& asked = plan.settings.plate;
  if (asked) {
    plate = {{"ev100", Ev100(*asked)}, {"exposure", ExposureScale(*asked)}};
  }
  const DomeInput& input = measured.input;
  const bool several = input.views.size() > 1;
  return {{"lights", lights},
          {"illuminance_lx", illuminance},
          {"scale", ScaleNode(measured)},
          {"width", input.dome.width},
          {"height", input.dome.height},
          {"white_luminance_nits", asked ? MaximumLuminance(*asked) : Nits(1.0)},
          {"plate", plate},
          {"views", Node::UnlessEmpty(Node::List(input.views, ViewNode))},
          {"field_of_view_deg",
           input.field_of_view ? Node(DegreesFromRadians(*input.field_of_view)) : Node()},
          {"aims_rms_px", input.field_of_view ? Node(input.aims_rms_px) : Node()},
          {"rim_transmission", several ? Node(input.rim_transmission) : Node()},
          {"agreement_sd_relative", several ? Node(input.agreement_sd) : Node()},
          {"apart_fraction", several ? Node(input.apart_share) : Node()},
          {"grey", input.grey ? GreyNode(*input.grey) : Node()},
          {"blind_cap", input.blind_cap ? BlindCapNode(*input.blind_cap, measured.north) : Node()},
          {"seen_fraction", input.views.empty() ? Node() : Node(input.seen_share)},
          {"files", written}};
}

Result<void> RunDome(const DomeCommandOptions& options, Console& console) {
  auto plan = PlanOf(options);
  if (!plan) return tl::unexpected(plan.error());
  plan->request.input.progress = [&console](const std::string& text) { console.Note(text); };
  const Sources sources = InputSources();
  auto measured = MeasureDome(plan->request, sources, plan->grey);
  if (!measured) return Propagate(std::move(measured));
  console.Warn(measured->warnings);
  const auto made = MakeDome(*std::move(measured), plan->request, sources, plan->settings);
  if (!made) return tl::unexpected(made.error());
  console.Warn(made->warnings);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;

  std::vector<OutputFile> texts;
  auto json = LightFileToJson(made->light_file);
  if (!json) return Propagate(std::move(json));
  texts.push_back({"light.json", std::move(*json)});
  auto preview = DomePreview("dome.png", *made);
  if (!preview) return Propagate(std::move(preview));
  texts.push_back(std::move(*preview));
  PlaceUnder(options.output, texts);
  std::vector<OutputWriter> writers = {DomeExr(
      (std::filesystem::path(options.output) / kDomePicture).string(), *made, plan->settings)};
  for (const OutputFile& file : texts) writers.push_back(WriterOf(file));
  if (auto written = WriteOutputsWith(writers, options.force); !written) return written;
  std::vector<std::string> paths;
  for (const OutputWriter& writer : writers) paths.push_back(writer.path);
  console.Print(ViewsTable(made->measured.input) + Table(*made));
  console.PrintDocument(ToJson(*plan, *made, paths));
  for (const std::string& path : paths) console.Note("wrote " + path);
  return {};
}

}  // namespace

Run BuildDome(CLI::App& parser) {
  auto options = std::make_shared<DomeCommandOptions>();
  DomeCommandOptions& o = *options;
  AddDomeOptions(parser, o.dome);
  parser
      .add_option("--extract", o.extract,
                  "Take out the N brightest lights (or all): they leave the dome and go to "
                  "light.json")
      ->capture_default_str();
  parser.add_option("--plate-exposure", o.plate,
                    "f/8,1/60,100: write the dome as this exposure sees it, saturating at 1 "
                    "[cd/m2]");
  parser.add_option("--space", o.space, "RGB of the dome [the picture's own]")
      ->check(OneOf(kSpaceWords));
  parser.add_option("--white", o.white,
                    "What becomes white, in the dome and its lights: 3200K, D65 or x,y [as it is]");
  parser.add_option("-o,--output", o.output, "Directory of dome.exr, light.json and dome.png")
      ->required()
      ->check(DirectoryName());
  parser.add_flag("--force", o.force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunDome(*options, console); };
}

}  // namespace lightcal::app
