// SPDX-License-Identifier: Apache-2.0
// What a picture of a lit wall shows beside the lamp's own light: what the room throws back onto
// the wall, light of others, and the lens's glare.
#pragma once

#include <optional>
#include <vector>

#include "lightcal/core/units.h"
#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_sample.h"
#include "lightcal/light/other_wall_light.h"
#include "lightcal/records/session.h"

namespace lightcal {

// The lamp by the light that was seen, all of it taken for its own: means over rings of one degree
// about its aim, as far out as five octants of eight were seen. Of E lux everywhere on the wall it
// would have had E flux_lm_per_lx, and towards the rim of that cone E edge_cd_per_lx.
struct LampAsSeen {
  double flux_lm = 0.0, flux_lm_per_lx = 0.0;
  double edge_cd = 0.0, edge_cd_per_lx = 0.0;
  double half_angle_rad = 0.0;
};
// `distance`: of the lamp from the wall, whose normal is +Y.
[[nodiscard]] LampAsSeen LampOf(const std::vector<IntensitySample>& samples, const Vec3& aim,
                                Metres distance);

// What is known before the picture is looked at.
struct OtherLightPrior {
  // Of E_room = k (rho Phi_seen + Phi_beyond): ln k, k in 1/m^2. Absent: no room, or a dark one.
  struct Room {
    double ln_k = 0.0, sd = 0.0;
  };
  std::optional<Room> room;
  // ln of what leaves beyond the cone over a Lambertian lamp's pi I(rim) cos(half angle).
  double ln_beyond = 0.0, sd_beyond = 0.0;
  double most_ambient_lx = 0.0;                      // any part of it is as likely as another
  double least_glare_lx = 0.0, most_glare_lx = 0.0;  // likewise
};

// The prior of a capture: an ordinary room's k, or that of the session's [room]; what its fixture
// sends elsewhere; ambient light up to 5 % of `mean_lx`, which the whole wall shows, unless it was
// subtracted; glare of as much as the lens's, or .5 to 3 %, of `mean_lx`.
[[nodiscard]] OtherLightPrior PriorOfOtherLight(const Session& session,
                                                const LightDescription& light,
                                                const CaptureDescription& capture, double mean_lx);

struct OtherLightFound {
  OtherWallLight mean;
  std::vector<OtherWallLight> shifts;  // one standard deviation off, each independent of the others
  double sd_lx = 0.0;                  // of mean.lux
  double of_room = 0.0;                // part of mean.lux that the room throws back,
  double of_ambient = 0.0;             // and that others shine; the rest is the lens's glare
  double most_lx = 0.0;                // 97.5 % of it are below
};

// Other light cannot be brighter than what any of `lit` shows, and is what `shadows` show: places
// behind a card that keeps the lamp's own light from them. Mean and covariance of 4,000 draws, of a
// fixed seed, of the prior cut off there; shadows by least squares in ln lux, those draws their
// prior. A card's shadow holds other light to 9 % (1 sigma: what the card hides of it, and what its
// shape does not follow).
[[nodiscard]] OtherLightFound FindOtherLight(const OtherLightPrior& prior, const LampAsSeen& seen,
                                             double reflectance, const OtherWallLight& about,
                                             const std::vector<SeenPlace>& lit,
                                             const std::vector<SeenPlace>& shadows);

}  // namespace lightcal
