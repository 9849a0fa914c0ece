// SPDX-License-Identifier: Apache-2.0
// <stem>.pbrt for pbrt-v4. Lights take photometric scales beside an RGB of luminance 1: candela,
// lux ("illuminance") and nits. The cie1931 sensor gives XYZ times iso/100 at one second, so that
// the film's iso locks the exposure.   Sources: mmp/pbrt-v4 src/pbrt/{lights,film,shapes}.cpp.
#include <optional>
#include <span>

#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/preset_text.h"

namespace lightcal {
namespace {

using preset_text::Numbers;
using preset_text::Quoted;

constexpr EngineForms kPbrtForms = {.sphere = true,
                                    .disk = true,
                                    .rect = true,
                                    .tube = true,
                                    .dome = true,
                                    .cone = EngineConeLaw::kSmooth};

DerivedLight DerivePbrt(const PresetLight& light) {
  DerivedLight out;
  out.substitution = light.substitution;
  const Rgb& m = light.color().max_normalised;
  const double y = light.color().luminance;
  out.Put("rgb", {m.r / y, m.g / y, m.b / y});
  switch (light.form) {
    case LightForm::kPoint:
      out.type = "point";
      out.Put("scale", light.candela);
      break;
    case LightForm::kSpot:
      out.type = "spot";
      out.Put("scale", light.candela);
      out.Put("coneangle", DegreesFromRadians(light.cone.cone.outer));
      out.Put("conedeltaangle", DegreesFromRadians(light.cone.cone.outer - light.cone.cone.inner));
      break;
    case LightForm::kDirectional:
      out.type = "distant";
      out.Put("illuminance", light.lux);
      break;
    case LightForm::kDome:
      out.type = "infinite";
      out.Put("scale", light.environment ? 1.0 : light.nits);
      if (light.environment) out.elsewhere.push_back({"upward_lx", {light.lux}});
      break;
    default:
      out.type = "diffuse";
      out.Put("scale", light.nits);
      preset_text::PutSize(light, out);
      break;
  }
  return out;
}

// ---- text ----

std::string Parameter(const char* type, const char* name, std::span<const double> values) {
  return " \"" + std::string(type) + " " + name + "\" [ " + Numbers(values, " ") + " ]";
}

std::string Value(const DerivedLight& derived, const char* name) {
  return Parameter("float", name, derived.Find(name)->values);
}

// Columns first, as the file has it; into whatever frame a scene includes the file in (Transform
// would replace it).   Source: pbrt-v4 file format, transformations.
std::string TransformText(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  return "  ConcatTransform [ " + Numbers(x, " ") + " 0 " + Numbers(y, " ") + " 0 " +
         Numbers(z, " ") + " 0 " + Numbers(origin, " ") + " 1 ]\n";
}

// A quadrilateral whose (p10 - p00) x (p01 - p00) is the way it faces.
std::string Quad(const Vec3& p00, const Vec3& p10, const Vec3& p01, const Vec3& p11) {
  std::vector<double> p;
  for (const Vec3* corner : {&p00, &p10, &p01, &p11})
    p.insert(p.end(), corner->begin(), corner->end());
  return "  Shape \"bilinearmesh\"" + Parameter("point3", "P", p) + "\n";
}

std::string PbrtShape(const PresetLight& light) {
  const Vec3& at = light.position_m();
  const double radius[] = {light.radius_m};
  switch (light.form) {
    case LightForm::kSphere:
      return TransformText({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, at) + "  Shape \"sphere\"" +
             Parameter("float", "radius", radius) + "\n";
    case LightForm::kDisk:
      return TransformText(light.axes.c0 * -1.0, light.axes.c90, light.aim(), at) +
             "  Shape \"disk\"" + Parameter("float", "radius", radius) + "\n";
    case LightForm::kRect: {
      const Vec3 u = light.axes.c0 * (-light.width_m / 2.0);
      const Vec3 v = light.axes.c90 * (light.height_m / 2.0);
      return Quad(at - u - v, at + u - v, at - u + v, at + u + v);
    }
    default: {
      const double zmin[] = {-light.length_m / 2.0};
      const double zmax[] = {light.length_m / 2.0};
      return TransformText(light.aim(), light.axes.c90, light.axes.c0, at) +
             "  Shape \"cylinder\"" + Parameter("float", "radius", radius) +
             Parameter("float", "zmin", zmin) + Parameter("float", "zmax", zmax) + "\n";
    }
  }
}

std::string PbrtLight(const PresetLight& light, const DerivedLight& derived,
                      const std::string& picture) {
  const auto& rgb = derived.Find("rgb")->values;
  if (derived.type == "diffuse") {
    return "AttributeBegin\n  AreaLightSource \"diffuse\"" + Parameter("rgb", "L", rgb) +
           Value(derived, "scale") + "\n" + PbrtShape(light) + "AttributeEnd\n";
  }
  std::string text = "LightSource \"" + derived.type + "\"";
  const Vec3& at = light.position_m();
  switch (light.form) {
    case LightForm::kDirectional:
      return text + Parameter("rgb", "L", rgb) + Value(derived, "illuminance") +
             Parameter("point3", "from", Vec3{}) + Parameter("point3", "to", light.aim()) + "\n";
    case LightForm::kDome:
      if (light.environment) {
        return text + " \"string filename\" " + Quoted(picture) + Value(derived, "scale") + "\n";
      }
      return text + Parameter("rgb", "L", rgb) + Value(derived, "scale") + "\n";
    case LightForm::kSpot:
      return text + Parameter("rgb", "I", rgb) + Value(derived, "scale") +
             Value(derived, "coneangle") + Value(derived, "conedeltaangle") +
             Parameter("point3", "from", at) + Parameter("point3", "to", at + light.aim()) + "\n";
    default:
      return text + Parameter("rgb", "I", rgb) + Value(derived, "scale") +
             Parameter("point3", "from", at) + "\n";
  }
}

// pbrt's camera space is left-handed: without the mirror the picture would be one.
std::string CameraText(const Rig& rig, const std::string& stem) {
  constexpr int kHeight = 400;
  const RigCamera& camera = rig.camera;
  const double fov[] = {DegreesFromRadians(camera.vertical_fov)};  // of the shorter side
  const double iso[] = {100.0 * rig.exposure.scale};
  return "Scale -1 1 1\nLookAt " + Numbers(camera.position_m, " ") + "  " +
         Numbers(camera.target_m, " ") + "  " + Numbers(camera.up, " ") +
         "\nCamera \"perspective\"" + Parameter("float", "fov", fov) +
         " \"float shutteropen\" [ 0 ] \"float shutterclose\" [ 1 ]\n"
         "Film \"rgb\" \"string sensor\" \"cie1931\"" +
         Parameter("float", "iso", iso) + " \"integer xresolution\" [ " +
         std::to_string(static_cast<int>(kHeight * camera.aspect_ratio)) +
         " ] \"integer yresolution\" [ " + std::to_string(kHeight) + " ] \"string filename\" " +
         Quoted(stem + ".exr") +
         "\nSampler \"zsobol\" \"integer pixelsamples\" [ 64 ]\n"
         "Integrator \"path\" \"integer maxdepth\" [ 1 ]\n";
}

std::string CardText(const Rig& rig) {
  std::string text;
  for (const RigCard& card : rig.cards) {
    const auto corner = CornersOf(rig, card);
    const double rho[] = {card.reflectance, card.reflectance, card.reflectance};
    text += "AttributeBegin\n  Material \"diffuse\"" + Parameter("rgb", "reflectance", rho) + "\n" +
            Quad(corner[0], corner[1], corner[3], corner[2]) + "AttributeEnd\n";
  }
  return text;
}

std::optional<std::string_view> ColorSpaceWord(RgbSpace space) {
  switch (space) {
    case RgbSpace::kSrgb:
      return "srgb";
    case RgbSpace::kRec2020:
      return "rec2020";
    case RgbSpace::kDisplayP3:
      return "dci-p3";
    case RgbSpace::kAcescg:
      break;
  }
  return std::nullopt;
}

}  // namespace

Result<Preset> ExportPbrt(const LightFile& lights, const std::string& stem,
                          const PresetOptions& asked) {
  Preset preset;
  const bool known = ColorSpaceWord(asked.color.space).has_value();
  const PresetOptions options =
      known ? asked : preset_text::InRec709(asked, "pbrt", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kPbrtForms, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  const std::string name = preset_text::SceneStem(stem, options);
  std::string text = "# " + preset_text::GeneratorOf(lights) +
                     ", not executed in pbrt: schema-checked. cd, lx and nits; ev100 " +
                     ShortestText(rig.exposure.ev100) + ", exposure " +
                     ShortestText(rig.exposure.scale) + "\n";
  const std::string space =
      "ColorSpace \"" + std::string(*ColorSpaceWord(options.color.space)) + "\"\n";
  // Lights alone stand in a block of their own, so that a scene that includes them keeps its state.
  text += options.rig ? space + CameraText(rig, name) + "WorldBegin\n" : "AttributeBegin\n" + space;
  for (const PresetLight& light : *forms) {
    preset.derived.push_back(DerivePbrt(light));
    auto finite = preset_text::CheckFinite(preset.derived.back(), light.name());
    if (!finite) return Propagate(std::move(finite));
    std::string picture;
    if (light.environment) {
      // A .pfm is taken as Rec. 709 whatever the scene's ColorSpace.
      PresetOptions plain = options;
      plain.color.space = RgbSpace::kSrgb;
      preset.files.push_back(preset_text::PictureFileOf(
          light, stem, plain, preset_text::PictureEncoding::kEqualAreaSquare, preset.warnings));
      picture = preset.files.back().name;
    }
    const std::string note = preset_text::SubstitutionNote(preset.derived.back());
    text += "# " + Quoted(light.name()) + (note.empty() ? "" : " " + note) + "\n" +
            PbrtLight(light, preset.derived.back(), picture);
  }
  text += options.rig ? CardText(rig) : "AttributeEnd\n";
  preset.files.insert(preset.files.begin(), {name + ".pbrt", std::move(text)});
  const std::string path = std::string(kPasteDirectory) + "/" + name + ".pbrt";
  preset.paste = options.rig ? "pbrt " + path : "Include \"" + path + "\" after WorldBegin";
  return preset;
}

Emission EmittedInPbrt(const DerivedLight& light, LightKind kind, double /*axial_part*/) {
  if (light.Find("upward_lx") != nullptr) return {.lux = NumberIn(light, "upward_lx")};
  const double scale = NumberIn(light, light.Find("scale") != nullptr ? "scale" : "illuminance");
  Emission out =
      EmittedByPathTracer(light, kind, scale * LuminanceIn(light, "rgb"),
                          {.directional = "distant", .dome = "infinite", .area = "diffuse"});
  if (light.type == "spot") {
    const double outer = RadiansFromDegrees(NumberIn(light, "coneangle")).value();
    out.cone = ConeOfLaw{
        .law = ConeLaw::kSmooth,
        .inner_rad = outer - RadiansFromDegrees(NumberIn(light, "conedeltaangle")).value(),
        .outer_rad = outer};
  }
  return out;
}

}  // namespace lightcal
