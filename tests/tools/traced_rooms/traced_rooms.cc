// SPDX-License-Identifier: Apache-2.0
// Illuminance in random rooms, traced: truth for the intervals of `lightcal fit` that comes from
// outside. Nothing here includes a header of lightcal. See README.md here.
//   traced_rooms ORDINARY UNSEEN THREE  a table of so many rooms of each family, to standard output
//   traced_rooms --by_walls N           a table of N rooms whose lamps stand by their walls
//   traced_rooms --places ORDINARY UNSEEN  bulbs and panels read at seven places about them
//   traced_rooms --colours ORDINARY UNSEEN  what painted walls give at eight wavelengths
//   traced_rooms --lit_walls ORDINARY UNSEEN  what the room gives a wall that a lamp is turned to
//   traced_rooms --lit_wall_colours ORDINARY UNSEEN  the same of painted rooms, by wavelength
//   traced_rooms --describe N          ordinary room N as JSON: what stands where, how bright
//   traced_rooms --check               the tracer against closed forms; ends with 1 where one fails
//   traced_rooms --compare TABLE N     traces every Nth room of a table again, with other rays
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "closed_forms.h"
#include "lit_walls.h"
#include "paint.h"
#include "random_rooms.h"
#include "trace.h"

namespace traced_rooms {
namespace {

constexpr const char* kHead =
    "family,room,kind,width_m,height_m,power,size_x_m,size_y_m,size_z_m,reflectance,"
    "flux_over_intensity,error";

TraceAnswer TraceRoom(const LitRoom& lit, std::uint64_t seed, const TraceEffort& effort) {
  std::vector<double> distances;
  for (const double d : kDistances) {
    if (d <= lit.reach) distances.push_back(d);
  }
  Random random(seed);
  return TraceLight(lit.room, lit.lamp, MetersAlong(lit.lamp, distances), effort, random);
}

void PrintRoom(Family family, int number) {
  const LitRoom lit = RandomRoom(family, number);
  const Lamp& lamp = lit.lamp;
  const TraceAnswer answer = TraceRoom(lit, 5000000ULL + number, {});
  double error = 0.0;
  for (const WallLight& light : answer.meters) error = std::fmax(error, light.error);
  const bool panel = lamp.kind == LampKind::kPanel;
  std::printf("%s,%d,%s,", std::string(NameOf(family)).c_str(), number,
              std::string(NameOf(lamp.kind)).c_str());
  if (panel) {
    std::printf("%.4g,%.4g,,", lamp.width, lamp.height);
  } else if (lamp.kind == LampKind::kBeam) {
    std::printf(",,%.4g,", lamp.power);
  } else {
    std::printf(",,,");
  }
  std::printf("%.3f,%.3f,%.3f,%.3f,%.4g,%.1g", lit.room.size[0], lit.room.size[1], lit.room.size[2],
              lit.room.MeanAlbedo(), lamp.FluxOverIntensity(), error);
  for (std::size_t k = 0; k < kDistances.size(); ++k) {
    if (k >= answer.meters.size()) {
      std::printf(",,,");
      continue;
    }
    const WallLight& light = answer.meters[k];
    std::printf(",%.5g,%.4g,%.4g", lamp.Direct(kDistances[k]), light.wall, light.behind_card);
  }
  std::printf("\n");
  std::fflush(stdout);
}

int PrintTable(int ordinary, int unseen, int three_lamps, int by_walls) {
  std::printf("%s", kHead);
  for (const double d : kDistances) std::printf(",direct_%g,wall_%g,card_%g", d, d, d);
  std::printf("\n");
  for (int i = 0; i < ordinary; ++i) PrintRoom(Family::kOrdinary, i);
  for (int i = 0; i < unseen; ++i) PrintRoom(Family::kUnseen, i);
  for (int i = 0; i < 3 * three_lamps; ++i) PrintRoom(Family::kThreeLamps, i);
  for (int i = 0; i < by_walls; ++i) PrintRoom(Family::kByWalls, i);
  return 0;
}

// The room as JSON, for whoever builds it elsewhere: metres, the lamp's `towards` a unit vector.
int DescribeRoom(int number) {
  const LitRoom lit = RandomRoom(Family::kOrdinary, number);
  const auto triple = [](const Vec3& v) {
    char text[96];
    std::snprintf(text, sizeof text, "[%.4f, %.4f, %.4f]", v[0], v[1], v[2]);
    return std::string(text);
  };
  std::printf("{\"room\": %d, \"size\": %s, \"albedo\": [", number, triple(lit.room.size).c_str());
  for (std::size_t i = 0; i < lit.room.albedo.size(); ++i) {
    std::printf("%s%.3f", i == 0 ? "" : ", ", lit.room.albedo[i]);
  }
  std::printf("],\n \"lamp\": {\"place\": %s, \"towards\": %s},\n \"boxes\": [",
              triple(lit.lamp.place).c_str(), triple(lit.lamp.towards).c_str());
  for (std::size_t i = 0; i < lit.room.boxes.size(); ++i) {
    const Box& box = lit.room.boxes[i];
    std::printf("%s{\"low\": %s, \"high\": %s, \"albedo\": %.3f}", i == 0 ? "" : ",\n  ",
                triple(box.low).c_str(), triple(box.high).c_str(), box.albedo);
  }
  std::printf("]}\n");
  return 0;
}

// Seven rows a room and layout: a lamp of 1 cd towards its first meter.
int PrintPlaces(int ordinary, int unseen) {
  std::printf(
      "family,room,kind,layout,width_m,height_m,size_x_m,size_y_m,size_z_m,reflectance,lamp_x_m,"
      "lamp_y_m,lamp_z_m,aim_x,aim_y,aim_z,x_m,y_m,z_m,normal_x,normal_y,normal_z,direct,wall,"
      "card\n");
  const auto print = [](Family family, int number, Layout layout) {
    const LitRoom lit = RandomRoom(family, number);
    const Lamp& lamp = lit.lamp;
    if (lamp.kind == LampKind::kBeam) return;
    const std::vector<Meter> meters = PlacesAround(lit, layout, number);
    Random random(7000000ULL + 2 * number + (layout == Layout::kTable ? 1 : 0));
    if (meters.empty()) return;
    const TraceAnswer answer = TraceLight(lit.room, lamp, meters, {}, random);
    const bool panel = lamp.kind == LampKind::kPanel;
    const Vec3& size = lit.room.size;
    for (std::size_t k = 0; k < meters.size(); ++k) {
      const Meter& meter = meters[k];
      std::printf("%s,%d,%s,%s,", std::string(NameOf(family)).c_str(), number,
                  std::string(NameOf(lamp.kind)).c_str(), std::string(NameOf(layout)).c_str());
      panel ? std::printf("%.4g,%.4g", lamp.width, lamp.height) : std::printf(",");
      std::printf(",%.3f,%.3f,%.3f,%.3f", size[0], size[1], size[2], lit.room.MeanAlbedo());
      for (const Vec3& v : {lamp.place, lamp.towards, meter.place, meter.normal}) {
        std::printf(",%.4f,%.4f,%.4f", v[0], v[1], v[2]);
      }
      std::printf(",%.5g,%.4g,%.4g\n", lamp.DirectAt(meter.place, meter.normal),
                  answer.meters[k].wall, answer.meters[k].behind_card);
    }
  };
  for (int i = 0; i < ordinary + unseen; ++i) {
    const bool of_unseen = i >= ordinary;
    for (const Layout layout : {Layout::kFacing, Layout::kTable}) {
      print(of_unseen ? Family::kUnseen : Family::kOrdinary, of_unseen ? i - ordinary : i, layout);
    }
  }
  return 0;
}

// A row a reading: what the walls give a meter, and what they give it behind its card, at each
// wavelength; lamp and meter as in the table of rooms. The same rays at all wavelengths.
int PrintColours(int ordinary, int unseen) {
  std::printf(
      "family,room,kind,width_m,height_m,size_x_m,size_y_m,size_z_m,reflectance,distance_m,direct");
  for (const char* what : {"wall", "card"}) {
    for (const int nm : kBands_nm) std::printf(",%s_%d", what, nm);
  }
  std::printf("\n");
  const auto print = [](Family family, int number) {
    const LitRoom lit = RandomRoom(family, number);
    const RoomPaint paint = PaintOf(lit, family, number);
    std::vector<TraceAnswer> bands;
    for (const int nm : kBands_nm) {
      const LitRoom there{RoomAt(lit.room, paint, nm), lit.lamp, lit.reach};
      bands.push_back(TraceRoom(there, 11000000ULL + number, {0.02, 1 << 14, 1 << 16}));
    }
    const bool panel = lit.lamp.kind == LampKind::kPanel;
    const Vec3& size = lit.room.size;
    for (std::size_t k = 0; k < bands[0].meters.size(); ++k) {
      if (kDistances[k] == 0.7 || kDistances[k] == 1.5) continue;
      std::printf("%s,%d,%s,", std::string(NameOf(family)).c_str(), number,
                  std::string(NameOf(lit.lamp.kind)).c_str());
      panel ? std::printf("%.4g,%.4g", lit.lamp.width, lit.lamp.height) : std::printf(",");
      std::printf(",%.3f,%.3f,%.3f,%.3f,%g,%.5g", size[0], size[1], size[2], lit.room.MeanAlbedo(),
                  kDistances[k], lit.lamp.Direct(kDistances[k]));
      for (const TraceAnswer& band : bands) std::printf(",%.4g", band.meters[k].wall);
      for (const TraceAnswer& band : bands) std::printf(",%.4g", band.meters[k].behind_card);
      std::printf("\n");
    }
  };
  for (int i = 0; i < ordinary; ++i) print(Family::kOrdinary, i);
  for (int i = 0; i < unseen; ++i) print(Family::kUnseen, i);
  return 0;
}

// A row a place on the wall: what the lamp gives it, and all else.
int PrintLitWalls(int ordinary, int unseen) {
  std::printf(
      "family,room,kind,width_m,height_m,power,base_deg,base_right,base_ahead,base_up,slope,size_x_"
      "m,size_y_m,size_z_m,"
      "reflectance,wall_reflectance,flux_over_intensity,distance_m,gamma_deg,azimuth_deg,direct,"
      "room_lx\n");
  const auto print = [](Family family, int number) {
    const LitWall wall = LitWallOf(family, number);
    if (wall.places.empty()) return;
    const Lamp& lamp = wall.lit.lamp;
    const Vec3& size = wall.lit.room.size;
    std::vector<Meter> meters;
    for (const WallPlace& place : wall.places) meters.push_back(place.meter);
    Random random(13000000ULL + 2 * number + (family == Family::kUnseen ? 1 : 0));
    const TraceAnswer answer =
        TraceLight(wall.lit.room, lamp, meters, {0.015, 1 << 14, 1 << 17}, random);
    for (std::size_t k = 0; k < meters.size(); ++k) {
      std::printf("%s,%d,%s,", std::string(NameOf(family)).c_str(), number,
                  std::string(NameOf(lamp.kind)).c_str());
      const bool panel = lamp.kind == LampKind::kPanel, bulb = lamp.kind == LampKind::kBulb;
      panel ? std::printf("%.4g,%.4g,", lamp.width, lamp.height) : std::printf(",,");
      lamp.kind == LampKind::kBeam ? std::printf("%.4g,", lamp.power) : std::printf(",");
      const Vec3 right = Cross(lamp.towards, Vec3{0, 0, 1});
      bulb ? std::printf("%.4g,%.4f,%.4f,%.4f,%.4g", lamp.base_angle * 180.0 / kPi,
                         Dot(lamp.base, right), Dot(lamp.base, lamp.towards), lamp.base[2],
                         lamp.slope)
           : std::printf(",,,,");
      std::printf(",%.3f,%.3f,%.3f,%.3f,%.3f,%.4g,%.4f,%g,%g,%.5g,%.4g\n", size[0], size[1],
                  size[2], wall.lit.room.MeanAlbedo(), wall.lit.room.albedo[wall.wall],
                  lamp.FluxOverIntensity(), wall.distance, wall.places[k].gamma_deg,
                  wall.places[k].azimuth_deg, lamp.DirectAt(meters[k].place, meters[k].normal),
                  answer.meters[k].wall);
    }
  };
  for (int i = 0; i < ordinary; ++i) print(Family::kOrdinary, i);
  for (int i = 0; i < unseen; ++i) print(Family::kUnseen, i);
  return 0;
}

// A row a lit wall: its paint's reflectance, and what room and lamp give it in the mean of its
// places, at each wavelength (the lamp: the same at all). The same rays at all wavelengths.
int PrintLitWallColours(int ordinary, int unseen) {
  std::printf("family,room,kind,direct");
  for (const char* what : {"paint", "room"}) {
    for (const int nm : kBands_nm) std::printf(",%s_%d", what, nm);
  }
  std::printf("\n");
  const auto print = [](Family family, int number) {
    const LitWall wall = LitWallOf(family, number);
    if (wall.places.empty()) return;
    const LitRoom& lit = wall.lit;
    const RoomPaint paint = PaintOf(lit, family, number);
    const auto places = static_cast<double>(wall.places.size());
    std::vector<Meter> meters;
    double direct = 0.0;
    for (const WallPlace& place : wall.places) {
      meters.push_back(place.meter);
      direct += lit.lamp.DirectAt(place.meter.place, place.meter.normal) / places;
    }
    std::printf("%s,%d,%s,%.5g", std::string(NameOf(family)).c_str(), number,
                std::string(NameOf(lit.lamp.kind)).c_str(), direct);
    std::vector<Room> rooms;
    for (const int nm : kBands_nm) rooms.push_back(RoomAt(lit.room, paint, nm));
    const auto of_wall = static_cast<std::size_t>(wall.wall);
    for (const Room& room : rooms) std::printf(",%.4g", room.albedo[of_wall]);
    for (const Room& room : rooms) {
      Random random(17000000ULL + 2 * number + (family == Family::kUnseen ? 1 : 0));
      const TraceAnswer answer =
          TraceLight(room, lit.lamp, meters, {0.02, 1 << 14, 1 << 16}, random);
      double mean = 0.0;
      for (const WallLight& light : answer.meters) mean += light.wall / places;
      std::printf(",%.4g", mean);
    }
    std::printf("\n");
  };
  for (int i = 0; i < ordinary; ++i) print(Family::kOrdinary, i);
  for (int i = 0; i < unseen; ++i) print(Family::kUnseen, i);
  return 0;
}

int Compare(const char* path, int every) {
  std::ifstream table(path);
  std::string line;
  std::getline(table, line);
  int row = 0, compared = 0, off = 0;
  while (std::getline(table, line)) {
    if (row++ % every != 0) continue;
    std::vector<std::string> cells;
    std::stringstream cut(line);
    for (std::string cell; std::getline(cut, cell, ',');) cells.push_back(cell);
    const Family family = cells[0] == "ordinary"   ? Family::kOrdinary
                          : cells[0] == "unseen"   ? Family::kUnseen
                          : cells[0] == "by_walls" ? Family::kByWalls
                                                   : Family::kThreeLamps;
    const int number = std::atoi(cells[1].c_str());
    const TraceAnswer answer =
        TraceRoom(RandomRoom(family, number), 9000000ULL + number, {0.02, 1 << 14, 1 << 17});
    for (std::size_t k = 0; k < answer.meters.size(); ++k) {
      const double expected = std::atof(cells[13 + 3 * k].c_str());
      const WallLight& light = answer.meters[k];
      const double allowed = 4.5 * std::hypot(light.error, 0.01) * expected + 1e-7;
      ++compared;
      if (std::abs(light.wall - expected) > allowed) {
        ++off;
        std::printf("%s %d at %g m: %g, in the table %g\n", cells[0].c_str(), number, kDistances[k],
                    light.wall, expected);
      }
    }
  }
  std::printf("%d figures traced again, %d differ\n", compared, off);
  return compared > 0 && off == 0 ? 0 : 1;
}

}  // namespace
}  // namespace traced_rooms

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--describe") == 0) {
    return traced_rooms::DescribeRoom(std::atoi(argv[2]));
  }
  if (argc == 2 && std::strcmp(argv[1], "--check") == 0) {
    return traced_rooms::ClosedFormsHold() ? 0 : 1;
  }
  if (argc == 3 && std::strcmp(argv[1], "--by_walls") == 0) {
    return traced_rooms::PrintTable(0, 0, 0, std::atoi(argv[2]));
  }
  if (argc == 4 && std::strcmp(argv[1], "--places") == 0) {
    return traced_rooms::PrintPlaces(std::atoi(argv[2]), std::atoi(argv[3]));
  }
  if (argc == 4 && std::strcmp(argv[1], "--colours") == 0) {
    return traced_rooms::PrintColours(std::atoi(argv[2]), std::atoi(argv[3]));
  }
  if (argc == 4 && std::strcmp(argv[1], "--lit_walls") == 0) {
    return traced_rooms::PrintLitWalls(std::atoi(argv[2]), std::atoi(argv[3]));
  }
  if (argc == 4 && std::strcmp(argv[1], "--lit_wall_colours") == 0) {
    return traced_rooms::PrintLitWallColours(std::atoi(argv[2]), std::atoi(argv[3]));
  }
  if (argc == 4 && std::strcmp(argv[1], "--compare") == 0 && std::atoi(argv[3]) > 0) {
    return traced_rooms::Compare(argv[2], std::atoi(argv[3]));
  }
  if (argc == 4 && argv[1][0] != '-') {
    return traced_rooms::PrintTable(std::atoi(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]), 0);
  }
  std::fprintf(
      stderr,
      "traced_rooms ORDINARY UNSEEN THREE | --by_walls N | --places ORDINARY UNSEEN | --colours "
      "ORDINARY "
      "UNSEEN | --lit_walls ORDINARY UNSEEN | --lit_wall_colours ORDINARY UNSEEN | --describe N | "
      "--check | --compare TABLE EVERY\n");
  return 2;
}
