// SPDX-License-Identifier: Apache-2.0
// A lamp of any kind where it stands, and the light it casts straight onto a surface.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lightcal/core/vec3.h"
#include "lightcal/light/intensity_table.h"
#include "lightcal/light/models/source_model.h"
#include "lightcal/light/pattern_doubt.h"

namespace lightcal {

// Light from one direction, -frame.z: a sun of that angular radius, 0 = none [rad].
struct SunSource {
  double angular_radius = 0.0;
};
// A sky that nobody saw: of one luminance over a ground of reflectance .25 (Liu and Jordan 1963),
//   E = E_up ((1 + n_z) + .25 (1 - n_z))/2;  its doubt holds how far real skies and halls are from
//   it.
struct EvenSky {};
// A sky and the ground under it, as a picture shows them: what each part sends, L w dOmega, over
// the whole's illuminance of an upward plane, E = E_up sum of max(0, n . flux).
struct SeenSky {
  std::shared_ptr<const std::vector<Vec3>> flux;
};
// The shape of a measured distribution; its frame is that of AxesOfAim (frame.x, frame.y,
// -frame.z).
struct TableSource {
  std::shared_ptr<const IntensityTable> table;
};
using LampSource = std::variant<PointSource, SphereSource, DiskSource, RectSource, TubeSource,
                                SpotSource, TableSource, SunSource, EvenSky, SeenSky>;

// frame.z is the aim. offset_m is d0, how far behind position_m the effective source lies: against
// the aim for flat lamps and spots, away from the axis for a tube, away from the surface for
// others.
struct LampPose {
  Vec3 position_m{};
  SourceFrame frame;
  double offset_m = 0.0;
};

// Of a lamp whose place was found, together with its strength or by itself. It may shine more to
// one side: ln strength towards the unit vector u is ln strength + g.(u - middle).
struct PlaceDoubt {
  static constexpr int kCount = 7;
  Vec3 gradient{}, middle{};
  std::array<double, kCount * kCount> covariance{};  // of (ln strength, x, y, z [m], g)
};

// One of the things that a lamp may be: its strength, where its light starts, and the rectangle it
// shines as towards whoever looks (0 = its own source).
struct LampPart {
  double weight = 1.0;
  double ln_strength = 0.0, offset_m = 0.0;
  double width_m = 0.0, height_m = 0.0;
  double variance_ln = 0.0, variance_offset = 0.0, covariance = 0.0;  // as LampDoubt's
};

// Standard deviations; what is not known to be unsure is 0.
struct LampDoubt {
  double variance_ln = 0.0;         // of ln strength
  double variance_offset = 0.0;     // of d0 [m^2]
  double covariance = 0.0;          // of both [m]
  std::vector<LampPart> parts{};    // in the stead of these three, where one normal does not say it
  std::optional<PlaceDoubt> place;  // variance_ln is in it, but not beside parts
  double aim_rad = 0.0;             // of each of its two directions
  double inner_rad = 0.0, outer_rad = 0.0;
  std::shared_ptr<const PatternDoubt> pattern{};  // of a point, a table: off its aim
  double exponent = 0.0;  // of the cosine by which a flat lamp shines off its aim, of a tube's sine
  double variance_ln_flux = 0.0;  // of ln of all its light, beside that of its strength
};

struct PlacedLamp {
  std::string name;
  LampSource source;
  double strength = 0.0;  // cd on the axis (table: at its peak); lx: sun facing it, sky upward
  LampPose pose;
  LampDoubt doubt;
};

// How closely a source's size is followed.
struct SourceDetail {
  bool point_only = false;  // sizes are ignored
  double tolerance = 0.0;   // relative, of the ladder; 0 = exact
};

struct SurfacePoint {
  Vec3 position_m{};
  Vec3 normal{0.0, 0.0, 1.0};  // unit
};

// Illuminance over strength, straight from the lamp: nothing stands between, no walls.
//   [lx/cd], sun and sky [1]
[[nodiscard]] double LuxPerUnit(const LampSource& source, const LampPose& pose,
                                const SurfacePoint& at, const SourceDetail& detail = {});
[[nodiscard]] inline double LuxOf(const PlacedLamp& lamp, const SurfacePoint& at,
                                  const SourceDetail& detail = {}) {
  return lamp.strength * LuxPerUnit(lamp.source, lamp.pose, at, detail);
}

// The integral over all directions of the intensity far away, relative to its peak [sr].
[[nodiscard]] double SolidAngleOf(const LampSource& source);

// A dome's: it has no direction.
[[nodiscard]] bool IsSky(const LampSource& source);
// Sun and sky: the same everywhere, no distance law, no walls.
[[nodiscard]] bool IsEverywhere(const LampSource& source);

// Unit, from a place towards the lamp or the sun; absent for a sky, and where the lamp stands.
[[nodiscard]] std::optional<Vec3> DirectionToLamp(const PlacedLamp& lamp, const Vec3& position_m);

// Standard deviation of LuxOf from the lamp's own doubt: each parameter moved by its standard
// deviation both ways, strength and d0 together by their covariance; of a mixture of parts half its
// 95 % over kZ95.                                                                         [lx]
[[nodiscard]] double DoubtOfLux(const PlacedLamp& lamp, const SurfacePoint& at,
                                const SourceDetail& detail = {});

// Of it, what its pattern leaves open there (LampDoubt::pattern).                            [lx]
[[nodiscard]] double DoubtOfPattern(const PlacedLamp& lamp, const SurfacePoint& at);

// The same of the logarithm of all the light that it sends, which the walls throw back: its
// strength, its pattern and, of a lamp that may shine more to one side, that side:
// ln flux = ln strength - g . middle.
[[nodiscard]] double DoubtOfLnFlux(const PlacedLamp& lamp);

}  // namespace lightcal
