// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <vector>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/model/system.hpp>

#include "support/degree.hpp"

/// One block in a roof under horizontal stress, whose load at slip is a closed form.
namespace voussoir_test {

/// Faces of 1 m of a symmetric wedge in a roof.
struct RoofWedge {
  const char* row;               ///< of the reference values; empty: none
  double semi_apical, friction;  ///< [deg]
  double normal, shear, thrust;  ///< k_n A, k_s A [N/m], H0 [N]

  /// At which it falls under a load. Before it moves, H0 presses a face by H0 cos a and pulls it
  /// along by H0 sin a; a drop u takes k_n u sin a from one and adds k_s u cos a to the other, and
  /// the load is what these make along the vertical. Crawford and Bray (1983).
  [[nodiscard]] double tan_of_friction(double load) const {
    const double c = std::cos(semi_apical * degree), s = std::sin(semi_apical * degree),
                 drop = 0.5 * load / (shear * c * c + normal * s * s);
    return (thrust * s + shear * drop * c) / (thrust * c - normal * drop * s);
  }
};

/// Faces between two fixed abutments (0, 1) and the wedge (2), under a load [N].
[[nodiscard]] inline voussoir::System<voussoir::Planar> roof_wedge(const RoofWedge& c,
                                                                   double load) {
  using namespace voussoir;
  System<Planar> system(CoulombJoint({c.normal, c.shear, c.friction * degree}), 1,
                        CoulombJoint({1, 1, 0}, any_units));
  const double a = c.semi_apical * degree;
  const Vec2 apex(0, std::cos(a)), toe(std::sin(a), 0);
  system.add_body({Vec2(-1, 0.5), 1, 1, false});
  system.add_body({Vec2(1, 0.5), 1, 1, false});
  system.add_body({Vec2(0, 0.3), load, 0.3, true});
  const Segment left{Vec2(-toe.x(), 0), apex}, right{apex, toe};
  // Wedge on the right of its left face going up, and of its right face going down.
  const auto touch = [&](int abutment, const Segment& face) {
    system.joints.add(abutment, 2, face, system.body(abutment).centre, system.body(2).centre,
                      face.gauss_points());
  };
  touch(0, left);
  touch(1, right);
  Stress<2> horizontal = Stress<2>::Zero();
  horizontal(0, 0) = c.thrust / std::cos(a);  // on the height of the wedge, cos(a): H0
  system.joints.set_initial([&](const auto&, const Vec2&) { return horizontal; });
  system.load[3 * 2 + 1] = -load;
  system.wall_load[3 * 2 + 1] = load;  // the stage lets it come on
  return system;
}

/// A regular pyramid, point up, base in the roof, in rock that does not give way. The stage takes
/// away what holds its weight.
struct RoofPyramid {
  int faces;
  double semi_apical;                        ///< between a face and the vertical [rad]
  double turned;                             ///< about the vertical [rad]
  double height;                             ///< [m]
  double normal_stiffness, shear_stiffness;  ///< [Pa/m]
  double stress;                             ///< horizontal, the same all round [Pa]
  double left;                               ///< of the normal stress when it slips [-]

  [[nodiscard]] std::vector<voussoir::SpatialFacet> sides() const {
    using voussoir::Vec3;
    const Vec3 apex(0, 0, height);
    const double out = height * std::tan(semi_apical) / std::cos(std::numbers::pi / faces);
    const auto corner = [&](int k) {
      const double angle = turned + 2 * std::numbers::pi * k / faces;
      return Vec3(out * std::cos(angle), out * std::sin(angle), 0);
    };
    std::vector<voussoir::SpatialFacet> made;
    for (int k = 0; k < faces; ++k) made.push_back({{corner(k), corner(k + 1), apex}});
    return made;
  }

  // Rock that is rigid, springs on every face: all slip at once. Before it moves, horizontal stress
  // s presses a face of area A by N = s A cos^2 a and pulls it along by S = s A sin a cos a; a drop
  // u takes k_n u A sin a from N and adds k_s u A cos a to S, and the weight is what these make
  // along the vertical. Crawford and Bray (1983) for two faces.
  [[nodiscard]] double drop() const {
    const double c = std::cos(semi_apical), s = std::sin(semi_apical);
    return (1 - left) * stress * c * c / (normal_stiffness * s);
  }
  [[nodiscard]] double weight() const {
    const double c = std::cos(semi_apical), s = std::sin(semi_apical);
    return faces * sides().front().measure() * drop() *
           (shear_stiffness * c * c + normal_stiffness * s * s);
  }
  [[nodiscard]] double tan_of_friction() const {
    const double c = std::cos(semi_apical), s = std::sin(semi_apical);
    return (stress * s * c + shear_stiffness * drop() * c) / (left * stress * c * c);
  }

  [[nodiscard]] voussoir::System<voussoir::Spatial> system(double tan_friction) const {
    using namespace voussoir;
    System<Spatial> made(CoulombJoint({normal_stiffness, shear_stiffness, std::atan(tan_friction)}),
                         1, CoulombJoint({1, 1, 0}, any_units));
    const auto rock = sides();
    for (const SpatialFacet& side : rock) made.add_body({1.5 * side.centre(), 1, 1, false});
    const int block = made.add_body({Vec3(0, 0, 0.25 * height), weight(), 0.3 * height, true});
    for (int k = 0; k < faces; ++k) {
      // Its area points out of the pyramid, into the rock.
      const SpatialFacet& side = rock[static_cast<std::size_t>(k)];
      made.joints.add(block, k, side, made.body(block).centre, made.body(k).centre,
                      side.gauss_points());
    }
    Stress<3> horizontal = Stress<3>::Zero();
    horizontal(0, 0) = horizontal(1, 1) = stress;
    made.joints.set_initial([&](const auto&, const Vec3&) { return horizontal; });
    made.load[6 * block + 2] = -weight();
    made.wall_load[6 * block + 2] = weight();  // the rock below, until it is excavated
    return made;
  }
};

/// Drawn: three to six faces.
[[nodiscard]] inline std::vector<RoofPyramid> roof_pyramids() {
  voussoir::Random random(1, 1);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  std::vector<RoofPyramid> drawn;
  for (int k = 0; k < 24; ++k) {
    const double stiffness = std::pow(10.0, between(9, 10.5));
    drawn.push_back({3 + k % 4, between(10, 40) * degree, between(0, 360) * degree, between(0.5, 5),
                     stiffness, stiffness * between(0.1, 1), between(0.2e6, 5e6),
                     between(0.3, 0.95)});
  }
  return drawn;
}

}  // namespace voussoir_test
