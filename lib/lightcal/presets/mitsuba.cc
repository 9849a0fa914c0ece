// SPDX-License-Identifier: Apache-2.0
// <stem>.mitsuba.xml for Mitsuba 3 in its RGB variants. The renderer has no photometric unit: what
// it is given is candela, lux and nits as R, G, B whose luminance is that number. The exposed rig
// multiplies them by the exposure, so that the picture shows the cards as they are; the bare one
// does not.   Sources: Mitsuba 3 plugin reference; src/emitters/{point,spot}.cpp.
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/xml_text.h"
#include "lightcal/presets/exporters.h"
#include "lightcal/presets/frames.h"
#include "lightcal/presets/preset_text.h"

namespace lightcal {
namespace {

using preset_text::Numbers;

constexpr EngineForms kMitsubaForms = {.sphere = true,
                                       .disk = true,
                                       .rect = true,
                                       .tube = true,
                                       .dome = true,
                                       .cone = EngineConeLaw::kLinearInAngle};

// R, G, B of that luminance.
std::vector<double> Scaled(const PresetLight& light, double photometric) {
  const Rgb& m = light.color().max_normalised;
  const double k = photometric / light.color().luminance;
  return {m.r * k, m.g * k, m.b * k};
}

DerivedLight DeriveMitsuba(const PresetLight& light, double exposure) {
  DerivedLight out;
  out.substitution = light.substitution;
  out.Put("pre_exposure", exposure);
  switch (light.form) {
    case LightForm::kPoint:
      out.type = "point";
      out.Put("intensity", Scaled(light, light.candela * exposure));
      break;
    case LightForm::kSpot:
      out.type = "spot";
      out.Put("intensity", Scaled(light, light.candela * exposure));
      out.Put("cutoff_angle", DegreesFromRadians(light.cone.cone.outer));
      out.Put("beam_width", DegreesFromRadians(light.cone.cone.inner));
      break;
    case LightForm::kDirectional:
      out.type = "directional";
      out.Put("irradiance", Scaled(light, light.lux * exposure));
      break;
    case LightForm::kDome:
      out.type = light.environment ? "envmap" : "constant";
      if (light.environment) {
        out.Put("scale", exposure);
        out.elsewhere.push_back({"upward_lx", {light.lux}});
        break;
      }
      out.Put("radiance", Scaled(light, light.nits * exposure));
      break;
    default:
      out.type = "area";
      out.Put("radiance", Scaled(light, light.nits * exposure));
      preset_text::PutSize(light, out);
      break;
  }
  return out;
}

// ---- text ----

std::string RgbElement(const char* name, const DerivedLight& derived) {
  return "<rgb name=\"" + std::string(name) + "\" value=\"" +
         Numbers(derived.Find(name)->values, " ") + "\"/>";
}

std::string Float(const char* name, double value) {
  return "<float name=\"" + std::string(name) + "\" value=\"" + ShortestText(value) + "\"/>";
}

std::string Point(const char* name, const Vec3& p) {
  return "<point name=\"" + std::string(name) + "\" x=\"" + ShortestText(p[0]) + "\" y=\"" +
         ShortestText(p[1]) + "\" z=\"" + ShortestText(p[2]) + "\"/>";
}

// Rows of a matrix whose columns are the axes, scaled, and the origin. The local +z shines.
std::string ToWorld(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  std::vector<double> n;
  for (int row = 0; row < 3; ++row) {
    for (const Vec3* column : {&x, &y, &z, &origin}) n.push_back((*column)[row]);
  }
  n.insert(n.end(), {0.0, 0.0, 0.0, 1.0});
  return "<transform name=\"to_world\"><matrix value=\"" + Numbers(n, " ") + "\"/></transform>";
}

// The frame of a light whose +z is its aim, right-handed.
std::string ToWorld(const PresetLight& light, double sx, double sy) {
  return ToWorld(light.axes.c0 * -sx, light.axes.c90 * sy, light.aim(), light.position_m());
}

std::string MitsubaShape(const PresetLight& light, const DerivedLight& derived) {
  const std::string emitter =
      "<emitter type=\"area\">" + RgbElement("radiance", derived) + "</emitter>";
  switch (light.form) {
    case LightForm::kSphere:
      return "<shape type=\"sphere\">" + Point("center", light.position_m()) +
             Float("radius", light.radius_m) + emitter + "</shape>";
    case LightForm::kDisk:
      return "<shape type=\"disk\">" + ToWorld(light, light.radius_m, light.radius_m) + emitter +
             "</shape>";
    case LightForm::kRect:
      return "<shape type=\"rectangle\">" +
             ToWorld(light, light.width_m / 2.0, light.height_m / 2.0) + emitter + "</shape>";
    default: {
      const Vec3 half = light.axes.c0 * (light.length_m / 2.0);
      return "<shape type=\"cylinder\">" + Point("p0", light.position_m() - half) +
             Point("p1", light.position_m() + half) + Float("radius", light.radius_m) + emitter +
             "</shape>";
    }
  }
}

std::string MitsubaLight(const PresetLight& light, const DerivedLight& derived,
                         const std::string& picture) {
  if (derived.type == "area") return MitsubaShape(light, derived);
  std::string text = "<emitter type=\"" + derived.type + "\">";
  switch (light.form) {
    case LightForm::kDirectional: {
      const Vec3& aim = light.aim();
      return text + "<vector name=\"direction\" x=\"" + ShortestText(aim[0]) + "\" y=\"" +
             ShortestText(aim[1]) + "\" z=\"" + ShortestText(aim[2]) + "\"/>" +
             RgbElement("irradiance", derived) + "</emitter>";
    }
    case LightForm::kDome:
      // Its middle looks along the emitter's +z, its right side along -x, its upper edge +y.
      if (light.environment) {
        return text + "<string name=\"filename\" value=\"" + XmlEscaped(picture) + "\"/>" +
               Float("scale", derived.Find("scale")->values[0]) +
               ToWorld(Vec3{-1.0, 0.0, 0.0}, Vec3{0.0, 0.0, 1.0}, Vec3{0.0, 1.0, 0.0}, Vec3{}) +
               "</emitter>";
      }
      return text + RgbElement("radiance", derived) + "</emitter>";
    case LightForm::kSpot:
      return text + ToWorld(light, 1.0, 1.0) + RgbElement("intensity", derived) +
             Float("cutoff_angle", derived.Find("cutoff_angle")->values[0]) +
             Float("beam_width", derived.Find("beam_width")->values[0]) + "</emitter>";
    default:
      return text + Point("position", light.position_m()) + RgbElement("intensity", derived) +
             "</emitter>";
  }
}

std::string Vec(const Vec3& v) { return Numbers(v, ", "); }

std::string RigText(const Rig& rig) {
  constexpr int kHeight = 400;
  std::string text;
  for (const RigCard& card : rig.cards) {
    const double half = rig.side.value() / 2.0;
    const std::string rho = ShortestText(card.reflectance);
    text += "  <shape type=\"rectangle\">" +
            ToWorld(rig.row * half, Cross(rig.normal, rig.row) * half, rig.normal, card.centre_m) +
            "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + rho + " " + rho + " " +
            rho + "\"/></bsdf></shape>\n";
  }
  const RigCamera& camera = rig.camera;
  return text + "  <sensor type=\"perspective\"><string name=\"fov_axis\" value=\"y\"/>" +
         Float("fov", DegreesFromRadians(camera.vertical_fov)) + Float("near_clip", 0.01) +
         "<transform name=\"to_world\"><lookat origin=\"" + Vec(camera.position_m) +
         "\" target=\"" + Vec(camera.target_m) + "\" up=\"" + Vec(camera.up) +
         "\"/></transform>\n    <film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
         std::to_string(static_cast<int>(kHeight * camera.aspect_ratio)) +
         "\"/><integer name=\"height\" value=\"" + std::to_string(kHeight) +
         "\"/><string name=\"pixel_format\" value=\"rgb\"/></film>\n"
         "    <sampler type=\"independent\"><integer name=\"sample_count\" value=\"64\"/>"
         "</sampler></sensor>\n";
}

}  // namespace

Result<Preset> ExportMitsuba(const LightFile& lights, const std::string& stem,
                             const PresetOptions& asked) {
  Preset preset;
  const PresetOptions options = preset_text::InRec709(asked, "mitsuba", preset.warnings);
  const auto forms = PresetLightsFrom(lights, kMitsubaForms, options, preset.warnings);
  if (!forms) return tl::unexpected(forms.error());
  const Rig rig = BuildRig(lights, *forms, options.rig_place);
  const double exposure = options.rig ? rig.exposure.scale : 1.0;
  const std::string name = preset_text::SceneStem(stem, options);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- " +
      XmlEscaped(preset_text::GeneratorOf(lights)) +
      ", not executed in Mitsuba: schema-checked. Values are cd, lx and nits times " +
      ShortestText(exposure) + "; ev100 " + ShortestText(rig.exposure.ev100) +
      " -->\n<scene version=\"3.0.0\">\n";
  if (options.rig) {
    text += "  <integrator type=\"path\"><integer name=\"max_depth\" value=\"2\"/></integrator>\n";
  }
  for (const PresetLight& light : *forms) {
    preset.derived.push_back(DeriveMitsuba(light, exposure));
    auto finite = preset_text::CheckFinite(preset.derived.back(), light.name());
    if (!finite) return Propagate(std::move(finite));
    std::string comment = XmlEscaped(light.name());
    const std::string note = preset_text::SubstitutionNote(preset.derived.back());
    if (!note.empty()) comment += "; " + note;
    // "--" ends no comment well.
    for (std::size_t at = 0; (at = comment.find("--", at)) != std::string::npos;) comment[at] = '_';
    std::string picture;
    if (light.environment) {
      preset.files.push_back(preset_text::PictureFileOf(
          light, stem, options, preset_text::PictureEncoding::kRadiance, preset.warnings));
      picture = preset.files.back().name;
    }
    text += "  <!-- " + comment + " -->\n  " + MitsubaLight(light, preset.derived.back(), picture) +
            "\n";
  }
  if (options.rig) text += RigText(rig);
  preset.files.insert(preset.files.begin(), {name + ".mitsuba.xml", text + "</scene>\n"});
  const std::string path = std::string(kPasteDirectory) + "/" + name + ".mitsuba.xml";
  preset.paste = options.rig ? "mitsuba -m scalar_rgb " + path
                             : "<include filename=\"" + path + "\"/> in your scene";
  return preset;
}

Emission EmittedInMitsuba(const DerivedLight& light, LightKind kind, double /*axial_part*/) {
  if (light.type == "envmap") return {.lux = NumberIn(light, "upward_lx")};
  double emitted = 0.0;
  for (const char* name : {"intensity", "irradiance", "radiance"}) {
    if (light.Find(name) != nullptr) {
      emitted = LuminanceIn(light, name) / NumberIn(light, "pre_exposure");
    }
  }
  Emission out = EmittedByPathTracer(
      light, kind, emitted, {.directional = "directional", .dome = "constant", .area = "area"});
  if (light.type == "spot") {
    out.cone = ConeOfLaw{.law = ConeLaw::kLinearInAngle,
                         .inner_rad = RadiansFromDegrees(NumberIn(light, "beam_width")).value(),
                         .outer_rad = RadiansFromDegrees(NumberIn(light, "cutoff_angle")).value()};
  }
  return out;
}

}  // namespace lightcal
