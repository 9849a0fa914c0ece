// SPDX-License-Identifier: Apache-2.0
#include "option_words.h"

#include <algorithm>
#include <array>

namespace lightcal::app {
namespace {

struct FieldRow {
  std::string_view field;
  std::string_view words;
};

// The whole list.
constexpr auto kFields = std::to_array<FieldRow>({
    {"CalibrateCamera", "lightcal camera"},
    {"FindMeters", "lightcal devices"},
    {"ImportFile", "lightcal import FILE"},
    {"MakeDome", "lightcal dome"},
    {"MakeStudy", "lightcal tradeoff SESSION -o DIR"},
    {"MergeBracket", "lightcal merge"},
    {"ReadDistribution", "lightcal photometric FILE"},
    {"ReadMeter", "lightcal read"},
    {"ShootBracket", "lightcal shoot"},
    {"camera.flat", "--no-flat"},
    {"color.space", "--space"},
    {"dome.aims", "--aim"},
    {"dome.clip", "--clip"},
    {"dome.illuminance", "--lux"},
    {"dome.normal", "--lux-direction"},
    {"dome.plate_aim", "--plate-aim"},
    {"dome.plate_exposure", "--plate-exposure"},
    {"dome.shaded", "--lux-shaded"},
    {"exposure.f_number", "--f-number"},
    {"exposure.t_stop", "--t-stop"},
    {"glare.vertical", "--glare-ev"},
    {"import.column", "--column"},
    {"import.columns", "--columns distance_m,illuminance_lx"},
    {"import.decimals", "--decimals"},
    {"light.aim", "aim"},
    {"light.axis", "axis"},
    {"light.beam", "beam_deg"},
    {"light.fixture", "fixture"},
    {"light.off_axis_sigma", "off_axis_sigma_deg"},
    {"match.reach", "--reach"},
    {"merge.align", "--align"},
    {"merge.anchor", "--anchor"},
    {"merge.cosine_fourth", "--cos4"},
    {"merge.exposures", "--exposures"},
    {"merge.iso", "--iso"},
    {"merge.noise", "--noise"},
    {"merge.response", "--response"},
    {"merge.space", "--space"},
    {"meter.count", "-n"},
    {"meter.device", "--device"},
    {"meter.option", "--set"},
    {"meter.settle", "--settle"},
    {"meter.tape", "--record"},
    {"photometric.set", "--set"},
    {"place.aim", "--aim"},
    {"place.position", "--position"},
    {"preset.into", "--into"},
    {"preset.json", "--to json"},
    {"preset.range", "--range"},
    {"preset.rig_at", "--rig-at"},
    {"preset.spots", "--spots"},
    {"preset.target", "--to"},
    {"render.engine", "--engine"},
    {"render.pixels", "--pixels"},
    {"shoot.aperture", "--aperture"},
    {"shoot.bracket", "--bracket"},
    {"shoot.center", "--center"},
    {"shoot.iso", "--iso"},
    {"shoot.resume", "--resume"},
    {"shutter.mains", "--mains"},
    {"study.knobs", "--knobs"},
    {"study.synthetic", "--synthetic"},
    {"study.tolerance", "--tol"},
    {"view.aims", "--aim YAW,PITCH"},
    {"view.bracket", "--bracket"},
    {"view.field_of_view", "--fov"},
    {"view.level", "--up"},
    {"view.projection", "--projection"},
});

}  // namespace

std::string InOptionWords(std::string_view text) {
  std::string out;
  while (true) {
    const auto brace = text.find('{');
    out += text.substr(0, brace);
    if (brace == std::string_view::npos) return out;
    text.remove_prefix(brace + 1);
    const auto end = std::min(text.find('}'), text.size());
    const auto row = std::ranges::find(kFields, text.substr(0, end), &FieldRow::field);
    out += row == kFields.end() ? "{" : row->words;
    if (row != kFields.end()) text.remove_prefix(end + 1);
  }
}

}  // namespace lightcal::app
