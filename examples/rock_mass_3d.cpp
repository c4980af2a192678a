// SPDX-License-Identifier: MIT
// A 12 m cube of rock with three joint sets, sliced into blocks. What is known beforehand:
// persistent joints s apart have P32 = 1 / s, and the blocks fill the cube. With an argument, the
// picture of the rock, a corner left out, is written to that file.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <voussoir/io/atomic_file.hpp>
#include <voussoir/io/mass_picture.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/statistics.hpp>
using namespace voussoir;

int main(int argc, char** argv) {
  constexpr double deg = std::numbers::pi / 180;

  // The rock: fully persistent bedding, a steep set of 6 m discs, a third of 8 m x 4 m rectangles.
  SpatialJointSet bedding{"bedding", 25 * deg, 130 * deg};
  bedding.fisher_concentration = 800;  // about 2 degrees
  bedding.spacing = 1.2;
  SpatialJointSet steep{"J2", 75 * deg, 10 * deg};
  steep.dip_deviation = steep.dip_direction_deviation = 4 * deg;
  steep.area_per_volume = 0.6;
  steep.shape = DiscJoints{6};
  SpatialJointSet cross{"J3", 60 * deg, 250 * deg};
  cross.fisher_concentration = 300;
  cross.area_per_volume = 0.5;
  cross.shape = RectangularJoints{8, 4};
  const Domain<3> ground{{-6, -6, -6}, {6, 6, 6}};
  const auto joints = joint_network({bedding, steep, cross}, ground, 1);
  const auto rock = slice<Spatial>(ground, joints, {.min_inscribed_radius = 0.12});

  double volume = 0;
  for (const auto& body : rock.bodies) volume += body.properties.measure;
  const BlockSizeCurve sizes(rock);
  const Vec3 across = upward_normal({bedding.dip, bedding.dip_direction});
  const double spacing = scanline_spacing(rock, SpatialLine{-5 * across, 5 * across});
  std::printf(
      "%zu blocks, %zu contacts, P32 %.2f m2/m3 (bedding %.2f), volumes V10 %.2f, V50 %.2f, "
      "V90 %.2f m3, spacing across the bedding %.2f m\n",
      rock.bodies.size(), CutContacts::find(rock).size(), joint_intensity(rock),
      joint_intensity(rock, 0), sizes.size_at(0.1), sizes.size_at(0.5), sizes.size_at(0.9),
      spacing);

  if (argc > 1) {
    MassPicture picture;
    picture.header.title = "Rock mass of three joint sets, 12 m cube";
    picture.header.key_numbers = {
        {"blocks", std::to_string(rock.bodies.size())},
        {"joint area per volume P32", readable_text(joint_intensity(rock)) + " m\u00b2/m\u00b3"},
        {"block size V50", readable_text(sizes.size_at(0.5)) + " m\u00b3"},
        {"largest block", readable_text(sizes.size_at(1)) + " m\u00b3"}};
    picture.set_names = {bedding.name, steep.name, cross.name};
    picture.corner_left_out = 0.5;
    write_atomically(argv[1], draw_mass_picture(rock, picture));
  }
  const bool is_full = std::abs(volume / ground.measure() - 1) < 1e-12;
  const bool is_dense = std::abs(joint_intensity(rock, 0) * bedding.spacing - 1) < 0.15;
  return is_full && is_dense ? 0 : 1;
}
