// SPDX-License-Identifier: Apache-2.0
// <stem>.usda: UsdLux in metres, Z up. Luminance is nits at intensity 1 and exposure 0; colours are
// max-normalised (Unreal's importer clips above 1) and intensities divided by their luminance.
// normalize is 0 for area lights, whose area renderers measure differently, and 1 for distant
// lights, whose intensity then is lux. No light is said to be a point: Arnold then leaves its
// radius out. What renderers are documented to read otherwise stands in variants of the root
// prim (usd_readings.h): values all agree on are the light's own, the others are its variants'.
// Sources: OpenUSD pxr/usd/usdLux/schema.usda and overview.dox.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/photometric_files.h"
#include "lightcal/presets/preset_text.h"
#include "lightcal/presets/usd_over_layer.h"
#include "lightcal/presets/usd_readings.h"

namespace lightcal {
namespace {

using preset_text::Identifier;
using preset_text::Numbers;
using preset_text::Quoted;

constexpr double kPointRadius_m = 0.005;     // no light may have no size
constexpr double kSunsAngle_degrees = 0.53;  // the schema's own, where nits need one
constexpr EngineForms kUsdForms = {.sphere = true,
                                   .disk = true,
                                   .rect = true,
                                   .tube = true,
                                   .table = true,
                                   .dome = true,
                                   .cone = EngineConeLaw::kSmoothInAngle};

// ---- numbers ----

void PutSphere(const PresetLight& light, double radius_m, double candela, DerivedLight& out) {
  out.type = "SphereLight";
  out.Put("radius", radius_m);
  out.Put("intensity",
          candela / (std::numbers::pi * radius_m * radius_m) / light.color().luminance);
}

void PutUsdCone(const SpotCone& cone, DerivedLight& out) {
  out.Put("shaping:cone:angle", DegreesFromRadians(cone.outer));
  out.Put("shaping:cone:softness", 1.0 - cone.inner.value() / cone.outer.value());
}

// Of E = L pi sin^2(angle/2).
void PutDistant(const PresetLight& light, UsdReading reading, DerivedLight& out) {
  const double lux = light.lux / light.color().luminance;
  const double angle = light.angular_diameter_deg.value_or(0.0);
  out.type = "DistantLight";
  if (reading == UsdReading::kKarma) {
    const double degrees = angle > 0.0 ? angle : kSunsAngle_degrees;
    const double sine = std::sin(RadiansFromDegrees(degrees / 2.0).value());
    out.Put("angle", degrees);
    out.Put("intensity", lux / (std::numbers::pi * sine * sine));
    out.Put("normalize", 0.0);
    return;
  }
  out.Put("angle", angle);
  out.Put("intensity", reading == UsdReading::kRtx2024 ? lux / std::numbers::pi : lux);
  out.Put("normalize", 1.0);
}

void PutTube(const PresetLight& light, UsdReading reading, DerivedLight& out) {
  const double nits = light.nits / light.color().luminance;
  const bool normalised = reading == UsdReading::kArnold;
  out.type = "CylinderLight";
  out.Put("length", light.length_m);
  out.Put("radius", light.radius_m);
  out.Put("intensity",
          normalised ? nits * 2.0 * std::numbers::pi * light.radius_m * light.length_m : nits);
  out.Put("normalize", normalised ? 1.0 : 0.0);
}

DerivedLight DeriveUsd(const PresetLight& light, UsdReading reading) {
  DerivedLight out;
  out.substitution = light.substitution;
  const Rgb c = light.environment ? Rgb{1.0, 1.0, 1.0} : light.color().max_normalised;
  out.Put("color", {c.r, c.g, c.b});
  const double luminance = light.color().luminance;
  switch (light.form) {
    case LightForm::kPoint:
    case LightForm::kSpot:
      PutSphere(light, kPointRadius_m, light.candela, out);
      if (light.form == LightForm::kSpot) PutUsdCone(light.cone.cone, out);
      break;
    case LightForm::kTable:  // the file's candela multiply the luminance: 1 cd by itself
      PutSphere(light, kPointRadius_m, 1.0, out);
      out.Put("shaping:cone:angle", 180.0);  // the schema's fallback cuts at 90
      break;
    case LightForm::kSphere:
      PutSphere(light, light.radius_m, light.candela, out);
      break;
    case LightForm::kDisk:
      out.type = "DiskLight";
      out.Put("radius", light.radius_m);
      out.Put("intensity", light.nits / luminance);
      break;
    case LightForm::kRect:
      out.type = "RectLight";
      out.Put("width", light.width_m);
      out.Put("height", light.height_m);
      out.Put("intensity", light.nits / luminance);
      break;
    case LightForm::kTube:
      PutTube(light, reading, out);
      return out;
    case LightForm::kDirectional:
      PutDistant(light, reading, out);
      return out;
    case LightForm::kDome:
      out.type = "DomeLight";
      out.Put("intensity", light.environment ? 1.0 : light.nits / luminance);
      return out;
  }
  out.Put("normalize", 0.0);
  return out;
}

// ---- text ----

// Row vectors: each row is where an axis goes.
std::string Matrix(const ObjectFrame& f) {
  const auto row = [](const Vec3& v, const char* w) { return "(" + Numbers(v) + ", " + w + ")"; };
  return "    matrix4d xformOp:transform = ( " + row(f.x, "0") + ", " + row(f.y, "0") + ", " +
         row(f.z, "0") + ", " + row(f.origin, "1") +
         " )\n    uniform token[] xformOpOrder = [\"xformOp:transform\"]\n";
}

std::string UsdField(const DerivedField& field, const std::string& indent) {
  const bool color = field.name == "color";
  const char* type = color ? "color3f" : field.name == "normalize" ? "bool" : "float";
  return indent + type + " inputs:" + field.name + " = " +
         (color ? "(" + Numbers(field.values) + ")" : ShortestText(field.values[0])) + "\n";
}

// One light as every renderer is to be given it, in the order of UsdReadings().
using DerivedByReading = std::vector<DerivedLight>;

bool AllAgree(const DerivedByReading& readings, const std::string& name) {
  const DerivedField* first = readings.front().Find(name);
  return std::ranges::all_of(readings, [&](const DerivedLight& light) {
    return light.Find(name)->values == first->values;
  });
}

// The root prim's variants: what its lights have that not all renderers agree on.
std::string Variants(const std::vector<std::string>& prims,
                     const std::vector<DerivedByReading>& lights) {
  std::string text = "\n  variantSet \"renderer\" = {\n";
  for (std::size_t r = 0; r < UsdReadings().size(); ++r) {
    const UsdReadingRow& row = UsdReadings()[r];
    text += "    " + Quoted(row.word) + " (\n      doc = " + Quoted(row.note) + "\n    ) {\n";
    for (std::size_t i = 0; i < lights.size(); ++i) {
      std::string fields;
      for (const DerivedField& field : lights[i][r].fields) {
        if (!AllAgree(lights[i], field.name)) fields += UsdField(field, "        ");
      }
      if (fields.empty()) continue;
      text += "      over \"" + prims[i] + "\"\n      {\n" + fields + "      }\n";
    }
    text += "    }\n";
  }
  return text + "  }\n";
}

// Of a measured distribution; null = none.
std::string IesFigures(const PresetFile* ies) {
  if (ies == nullptr) return {};
  return "    asset inputs:shaping:ies:file = " + preset_text::UsdAssetPath("./" + ies->name) +
         "\n    bool inputs:shaping:ies:normalize = 0\n";
}

std::string LightPrim(const std::string& name, const FittedLight& lamp, const PresetLight& light,
                      const DerivedByReading& readings, const std::optional<PresetFile>& ies,
                      const std::string& picture) {
  const DerivedLight& derived = readings.front();
  const bool table = light.form == LightForm::kTable && ies;
  const bool shaped = table || light.form == LightForm::kSpot;
  std::string text = "\n  def " + derived.type + " \"" + name + "\" (\n";
  if (shaped) text += "    prepend apiSchemas = [\"ShapingAPI\"]\n";
  text += "    displayName = " + Quoted(light.name()) +
          "\n    customData = {\n      double candela = " + ShortestText(light.candela) +
          "\n      double lux = " + ShortestText(light.lux) +
          "\n      double nits = " + ShortestText(light.nits) +
          (lamp.distance_offset_m
               ? "\n      double distance_offset_m = " + ShortestText(lamp.distance_offset_m->value)
               : std::string()) +
          "\n    }\n  )\n  {\n";
  for (const DerivedField& field : derived.fields) {
    if (AllAgree(readings, field.name)) text += UsdField(field, "    ");
  }
  text += "    bool inputs:enableColorTemperature = 0\n    float inputs:exposure = 0\n";
  text += IesFigures(table ? &*ies : nullptr);
  if (!picture.empty()) {
    // The middle of a lat-long picture looks along the dome's +Z, its right side along -X, +Y up.
    const ObjectFrame frame = {{-1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {}};
    return text + "    asset inputs:texture:file = " + preset_text::UsdAssetPath("./" + picture) +
           "\n    token inputs:texture:format = \"latlong\"\n" + Matrix(frame) + "  }\n";
  }
  return text + Matrix(FrameOfLight(EngineAxes::kZUp, light)) + "  }\n";
}

// ---- lights that are there ----

// What a light that is there may shape its beam with and the lamp does not: left alone, a bulb set
// onto a spot stays a spot. Inert where the prim has no such schema. A light at infinity has no
// beam.
std::string UndoneShaping(const PresetLight& light, const DerivedLight& derived, bool table) {
  std::string text;
  if (light.form == LightForm::kRect) text += "    asset inputs:texture:file = None\n";
  if (light.form == LightForm::kDirectional || light.form == LightForm::kDome) return text;
  const auto rest = [&](const std::string& field, double value) {
    DerivedField one{"shaping:" + field, {value}};
    if (derived.Find(one.name) == nullptr) text += UsdField(one, "    ");
  };
  rest("cone:angle", 180.0);
  rest("cone:softness", 0.0);
  rest("focus", 0.0);
  if (table) {
    rest("ies:angleScale", 0.0);
  } else {
    text += "    asset inputs:shaping:ies:file = None\n";
  }
  return text;
}

std::string OpinionsText(const DerivedLight& derived) {
  std::string text;
  for (const DerivedField& field : derived.fields) text += UsdField(field, "    ");
  return text + "    bool inputs:enableColorTemperature = 0\n    float inputs:exposure = 0\n";
}

UsdOpinions OpinionsOf(const PresetLight& light, const DerivedLight& derived,
                       const std::optional<PresetFile>& ies) {
  const bool table = light.form == LightForm::kTable && ies;
  UsdOpinions over;
  if (table || light.form == LightForm::kSpot) {
    over.head = " (\n    prepend apiSchemas = [\"ShapingAPI\"]\n  )";
  }
  const bool sized = light.form != LightForm::kPoint && light.form != LightForm::kSpot && !table;
  over.body = "  # " + derived.type + " of lightcal's " + Quoted(light.name()) +
              (sized ? "" : "; no size was measured: 5 mm, and so many nits") + "\n" +
              OpinionsText(derived) + UndoneShaping(light, derived, table) +
              IesFigures(table ? &*ies : nullptr);
  // As deep as the layer indents the prim they stand in.
  for (std::size_t at = 0; (at = over.body.find("\n    ", at)) != std::string::npos; ++at) {
    over.body.erase(at + 1, 2);
  }
  return over;
}

// Of every prim of a person's stage that is to shine as one of the lights.
std::vector<UsdOpinions> OpinionsOnStage(const std::vector<PresetLight>& lights,
                                         const std::vector<DerivedLight>& derived,
                                         const std::vector<std::optional<PresetFile>>& ies,
                                         const std::vector<IntoRow>& into) {
  std::vector<UsdOpinions> out;
  for (const IntoRow& row : into) {
    const auto lamp = std::ranges::find(lights, row.lamp, &PresetLight::name);
    const auto i = static_cast<std::size_t>(lamp - lights.begin());
    out.push_back(OpinionsOf(*lamp, derived[i], ies[i]));
    out.back().path = row.object;
  }
  return out;
}

// ---- rig ----

std::string CardPrims(const Rig& rig) {
  std::string text;
  for (std::size_t i = 0; i < rig.cards.size(); ++i) {
    const std::string id = std::to_string(i);
    const double rho = rig.cards[i].reflectance;
    const std::string half = ShortestText(rig.side.value() / 2.0);
    text += "\n  def Material \"card_material_" + id +
            "\"\n  {\n    token outputs:surface.connect = </lightcal/card_material_" + id +
            "/matt.outputs:surface>\n    def Shader \"matt\"\n    {\n"
            "      uniform token info:id = \"UsdPreviewSurface\"\n"
            "      color3f inputs:diffuseColor = (" +
            Numbers(std::vector<double>{rho, rho, rho}) +
            ")\n      float inputs:roughness = 1\n      int inputs:useSpecularWorkflow = 1\n"
            "      color3f inputs:specularColor = (0, 0, 0)\n      token outputs:surface\n"
            "    }\n  }\n";
    text += "\n  def Mesh \"card_" + id +
            "\" (\n    prepend apiSchemas = [\"MaterialBindingAPI\"]\n    displayName = " +
            Quoted(rig.cards[i].name) +
            "\n  )\n  {\n    int[] faceVertexCounts = [4]\n"
            "    int[] faceVertexIndices = [0, 1, 2, 3]\n    point3f[] points = [(-" +
            half + ", -" + half + ", 0), (" + half + ", -" + half + ", 0), (" + half + ", " + half +
            ", 0), (-" + half + ", " + half +
            ", 0)]\n    uniform token subdivisionScheme = \"none\"\n"
            "    rel material:binding = </lightcal/card_material_" +
            id + ">\n" + Matrix(FrameOfCard(EngineAxes::kZUp, rig, rig.cards[i])) + "  }\n";
  }
  return text;
}

std::string CameraPrim(const Rig& rig) {
  constexpr double kAperture = 24.0;  // vertical, tenths of a unit as the focal length
  const double focal = kAperture / 2.0 / std::tan(rig.camera.vertical_fov.value() / 2.0);
  return "\n  def Camera \"rig_camera\"\n  {\n    float2 clippingRange = (0.01, 100000)\n"
         "    float focalLength = " +
         ShortestText(focal) +
         "\n    float horizontalAperture = " + ShortestText(kAperture * rig.camera.aspect_ratio) +
         "\n    float verticalAperture = " + ShortestText(kAperture) +
         "\n    float fStop = 0\n    float exposure = " +
         ShortestText(std::log2(rig.exposure.scale)) + "\n" +
         Matrix(FrameOfCamera(EngineAxes::kZUp, rig.camera)) + "  }\n";
}

std::string Head(const LightFile& file, const Rig& rig, const PresetOptions& options) {
  return "#usda 1.0\n(\n  defaultPrim = \"lightcal\"\n  doc = \"" + preset_text::GeneratorOf(file) +
         ": checked by tinyusdz, not executed in Karma, Arnold or Omniverse\"\n"
         "  metersPerUnit = 1\n  upAxis = \"Z\"\n  customLayerData = {\n    double ev100 = " +
         ShortestText(rig.exposure.ev100) +
         "\n    double exposure = " + ShortestText(rig.exposure.scale) +
         "\n    string colorSpace = " + Quoted(RgbSpaceWord(options.color.space)) +
         "\n  }\n)\n\ndef Xform \"lightcal\" (\n  variants = {\n    string renderer = \"" +
         std::string(UsdReadings()[static_cast<std::size_t>(options.usd_reading)].word) +
         "\"\n  }\n  prepend variantSets = \"renderer\"\n)\n{\n";
}

}  // namespace

Result<Preset> ExportUsd(const LightFile& lights, const std::string& stem,
                         const PresetOptions& options) {
  Preset preset;
  const auto forms = PresetLightsFrom(lights, kUsdForms, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  auto ies = IesFiles(lights, stem, TextsOfTables(*forms, options.written));
  if (!ies) return Propagate(std::move(ies));
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  std::string text = Head(lights, rig, options);
  std::set<std::string> taken = {"card_0", "card_1", "card_material_0", "card_material_1",
                                 "rig_camera"};
  std::vector<std::string> prims;
  std::vector<DerivedByReading> readings;
  for (std::size_t i = 0; i < forms->size(); ++i) {
    const PresetLight& light = (*forms)[i];
    readings.emplace_back();
    for (const UsdReadingRow& row : UsdReadings()) {
      readings.back().push_back(DeriveUsd(light, row.reading));
      auto finite = preset_text::CheckFinite(readings.back().back(), light.name());
      if (!finite) return Propagate(std::move(finite));
    }
    preset.derived.push_back(readings.back()[static_cast<std::size_t>(options.usd_reading)]);
    if (light.form == LightForm::kTable) preset.derived.back().elsewhere.push_back({"ies", {1.0}});
    prims.push_back(Identifier(light.name(), taken));
    std::string picture;
    if (light.environment) {
      preset.files.push_back(preset_text::PictureFileOf(
          light, stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
      picture = preset.files.back().name;
    }
    text += LightPrim(prims.back(), lights.lights[i], light, readings.back(), (*ies)[i], picture);
    if (light.form == LightForm::kTable) {
      preset.warnings.push_back({"ies_not_portable", light.name(),
                                 "renderers scale shaping:ies:file differently; the candela are "
                                 "absolute where it multiplies the luminance"});
      if ((*ies)[i]) preset.files.push_back(*(*ies)[i]);
    }
  }
  const std::string name = preset_text::SceneStem(stem, options);
  if (!options.into.empty()) {
    auto layer = UsdOverLayer(preset_text::GeneratorOf(lights),
                              OpinionsOnStage(*forms, preset.derived, *ies, options.into));
    if (!layer) return Propagate(std::move(layer));
    preset.files.insert(preset.files.begin(), PresetFile{stem + ".usda", *std::move(layer)});
    const std::string layer_path = std::string(kPasteDirectory) + "/" + stem + ".usda";
    preset.paste = "subLayers = [" + preset_text::UsdAssetPath(layer_path) +
                   ", ...] first in your stage, in metres";
    return preset;
  }
  if (options.rig) text += CardPrims(rig) + CameraPrim(rig);
  text += Variants(prims, readings);
  preset.files.insert(preset.files.begin(), PresetFile{name + ".usda", text + "}\n"});
  preset.paste = "usdview " + std::string(kPasteDirectory) + "/" + name + ".usda";
  return preset;
}

}  // namespace lightcal
