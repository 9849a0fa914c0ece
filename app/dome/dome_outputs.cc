// SPDX-License-Identifier: Apache-2.0
#include "dome/dome_outputs.h"

#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::app {
namespace {

std::string PlateText(const CameraSettings& plate) {
  return "f/" + RoundedText(plate.f_number, 4) + ", " + RoundedText(plate.shutter.value(), 6) +
         " s, ISO " + RoundedText(plate.iso, 6);
}

}  // namespace

OutputWriter DomeExr(const std::string& path, const MadeDome& made, const DomeSettings& settings) {
  return {path, "exr", [&made, settings](const std::string& temporary) {
            const MeasuredDome& measured = made.measured;
            const Dome& dome = measured.input.dome;
            devices::ExrPicture exr;
            exr.samples =
                View2d<const float>(dome.samples.data(), dome.width, dome.height, dome.channels);
            exr.channel_names = {"Y"};
            if (dome.channels == 3) {
              exr.channel_names = {"R", "G", "B"};
              exr.chromaticities = PrimariesOfOutput(measured, settings);
            }
            // A unit that nobody stated is not stated by writing it out again.
            if (measured.unit_known) exr.white_luminance = made.white_luminance;
            exr.environment_latlong = true;
            std::string files;
            for (const std::string& file : measured.input.files) {
              files += (files.empty() ? "" : " ") + file;
            }
            exr.attributes = {{"generator", GeneratorName()},
                              {"quantity", "luminance of a lat-long dome"},
                              {"frames", files},
                              {"scale_source", measured.scale_source},
                              {"lights_taken_out", std::to_string(made.extracted)}};
            if (measured.scale_u95_relative) {
              exr.attributes.emplace_back("scale_u95_relative",
                                          RoundedText(*measured.scale_u95_relative, 3));
            }
            if (settings.plate) {
              exr.attributes.emplace_back("plate_exposure", PlateText(*settings.plate));
            }
            return devices::WriteExr(temporary, exr);
          }};
}

}  // namespace lightcal::app
