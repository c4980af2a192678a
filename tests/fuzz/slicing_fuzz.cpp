// SPDX-License-Identifier: MIT
// libFuzzer target: any ground, joints and limits, sliced in 2-D and 3-D.
//
// Either the input is refused (InvalidInput), or the blocks fill the ground, are convex, keep the
// limits, and touch each other and the sides all over their faces.
//
// Joints on a coarse lattice meet exactly or clearly do not, and volumes must sum to 1e-12; joints
// a hair off it are what the tolerance of the domain is for, and it bounds the errors.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/slicing.hpp>

#include "fuzz/bytes.hpp"

using namespace voussoir;
using namespace voussoir_test;

namespace {

template <int Dim>
struct Input {
  Domain<Dim> domain;
  std::vector<JointOf<Dim>> joints;
  BlockLimits limits;
  bool exact = true;  ///< nothing a hair off the lattice
};

template <int Dim>
Vec<Dim> lattice_point(Bytes& bytes, Input<Dim>& input) {
  Vec<Dim> point;
  for (int k = 0; k < Dim; ++k) point[k] = bytes.coarse();
  if (bytes.below(4) == 0) {
    const double step = bytes.tiny();
    point[bytes.below(Dim)] += step;
    input.exact = input.exact && step == 0;
  }
  return point;
}

template <int Dim>
Input<Dim> read(Bytes& bytes) {
  Input<Dim> input;
  constexpr std::array<double, 4> sizes{1, 3, 10, 0.01};
  constexpr std::array<double, 4> shifts{0, 0, 100, 1e6};
  const double shift = shifts[static_cast<std::size_t>(bytes.below(4))];
  input.exact = shift == 0;
  for (int k = 0; k < Dim; ++k) {
    const double size = sizes[static_cast<std::size_t>(bytes.below(4))];
    input.domain.low[k] = bytes.maybe_wrong(shift - size);
    input.domain.high[k] = bytes.maybe_wrong(shift + size);
  }
  if (bytes.flag()) input.limits.min_inscribed_radius = bytes.maybe_wrong(std::abs(bytes.tiny()));
  if (bytes.flag()) input.limits.max_elongation = bytes.maybe_wrong(2 + bytes.byte());
  const int joint_count = bytes.below(Dim == 2 ? 24 : 12);
  const Vec<Dim> centre = Vec<Dim>::Constant(shift);
  for (int k = 0; k < joint_count; ++k) {
    Vec<Dim> point = centre + lattice_point(bytes, input);
    point[0] = bytes.maybe_wrong(point[0]);
    if constexpr (Dim == 2) {
      const Vec2 end = centre + lattice_point(bytes, input);
      input.joints.push_back({{point, end}, bytes.below(3)});
    } else {
      const Vec3 normal = lattice_point(bytes, input);
      std::optional<JointPlane> joint;
      switch (bytes.below(3)) {
        case 0:
          joint = unbounded_joint(point, normal);
          break;
        case 1:
          joint = joint_disc(point, normal, bytes.maybe_wrong(1 + bytes.coarse()));
          break;
        default:
          joint = joint_rectangle(point, normal, cross(normal, Vec3::Unit(bytes.below(3))));
      }
      // A disc and a rectangle end where no lattice has a point.
      input.exact = input.exact && joint->is_unbounded();
      input.joints.push_back({std::move(*joint), bytes.below(3)});
    }
  }
  return input;
}

/// How far a polygon is from convex: the depth of its dents [m].
double dent(const ConvexPolygon& block) {
  double deepest = 0;
  for (std::size_t k = 0; k < block.size(); ++k) {
    const Vec2& before = block.vertex(k);
    const Vec2& here = block.vertex((k + 1) % block.size());
    const Vec2& after = block.vertex((k + 2) % block.size());
    const double sine = cross(after - before, here - before);  // < 0 where the corner turns left
    if (sine > 0) deepest = std::max(deepest, sine / (after - before).norm());
  }
  return deepest;
}
/// How far vertices stand above faces, or those of a face off its plane [m].
double dent(const ConvexPolyhedron& block) {
  double deepest = 0;
  for (std::size_t face = 0; face < block.size(); ++face) {
    const HalfSpace<3>& side = block.half_space(face);
    must(std::abs(side.normal.norm() - 1) < 1e-12, "unit normal", side.normal.norm());
    for (const Vec3& vertex : block.vertices()) deepest = std::max(deepest, side.distance(vertex));
    for (const int v : block.loop(face))
      deepest =
          std::max(deepest, std::abs(side.distance(block.vertex(static_cast<std::size_t>(v)))));
  }
  must(block.vertices().size() + block.size() == block.edge_count() + 2, "Euler's formula");
  return deepest;
}

/// How much of each pair of bodies touches.
template <class Contacts>
std::map<std::pair<int, int>, double> by_pair(const Contacts& contacts) {
  std::map<std::pair<int, int>, double> measures;
  for (const auto& contact : contacts)
    measures[std::minmax(contact.a, contact.b)] += contact.facet.measure();
  return measures;
}

template <class Geometry>
void slice_and_check(Bytes& bytes) {
  constexpr int dim = Geometry::dim;
  RockMass<Geometry> mass;
  bool exact = false;
  BlockLimits limits;
  try {
    const Input<dim> input = read<dim>(bytes);
    exact = input.exact;
    limits = input.limits;
    mass = slice<Geometry>(input.domain, input.joints, limits);
  } catch (const InvalidInput&) {
    return;
  }
  const double tolerance = mass.domain.tolerance(), whole = mass.domain.measure();
  // Ground that is longer than the limit may leave blocks that are, but none longer than itself.
  const auto ground = as_block(mass.domain);
  const double own = ground.diameter() / (2 * inscribed_ball(ground).radius);
  const bool long_ground = own > limits.max_elongation;
  std::size_t too_long = 0;
  double sum = 0, boundary = 0;
  std::size_t faces = 0;
  std::vector<Vec<dim>> closing(mass.bodies.size(), Vec<dim>::Zero());
  std::vector<double> covered(mass.bodies.size(), 0.0), outline(mass.bodies.size(), 0.0);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    const auto& body = mass.bodies[b];
    must(body.parts.size() == 1, "one part a body");
    const auto& block = body.parts.front();
    must(body.properties.measure > 0, "volume of a block", body.properties.measure);
    must_be_below(dent(block), 16 * tolerance, "convex block");
    sum += body.properties.measure;
    for (std::size_t face = 0; face < block.size(); ++face)
      outline[b] += block.face(face).measure();
    boundary += outline[b];
    faces += block.size();
    const double radius = inscribed_ball(block).radius;
    if (mass.bodies.size() > 1) {  // the ground itself may break them
      must_be_below(limits.min_inscribed_radius - 4 * tolerance, radius, "smallest block");
      const double length = block.diameter() - 4 * tolerance, width = 2 * (radius + 4 * tolerance);
      must_be_below(length, std::max(own, limits.max_elongation) * width * (1 + 1e-8),
                    "longest block");
      too_long += length > limits.max_elongation * width;
    }
  }
  must(long_ground || too_long == 0, "a block is too long only if the ground is");
  must(too_long <= mass.slicing.blocks_too_long, "blocks that are too long are counted");
  const double bound = 1e-12 * whole + (exact ? 0.0 : 4 * tolerance * boundary);
  must_be_below(std::abs(sum - whole), bound, "volumes sum to the ground's");

  const auto add = [&](int body, const auto& facet, double sign) {
    const auto b = static_cast<std::size_t>(body);
    closing[b] += sign * facet.area_vector();
    covered[b] += facet.measure();
  };
  const auto contacts = CutContacts::find(mass);
  for (const auto& contact : contacts) {
    must(contact.a != contact.b, "a contact joins two bodies");
    must(contact.facet.measure() > 0, "a contact has an area", contact.facet.measure());
    add(contact.a, contact.facet, 1);
    add(contact.b, contact.facet, -1);
  }
  for (const auto& side : boundary_facets(mass)) add(side.body, side.facet, 1);
  // What is narrower than the tolerance is no contact: at most that much along every edge.
  const double size = mass.domain.diameter();
  const double lost = 16 * tolerance * static_cast<double>(faces) * (dim == 2 ? 1.0 : size);
  for (std::size_t b = 0; b < mass.bodies.size(); ++b) {
    must_be_below(closing[b].norm(), lost, "area vectors close around a block");
    must_be_below(std::abs(covered[b] - outline[b]), lost, "faces are covered by contacts");
  }

  // What a search finds is what the cuts know, but for contacts about as narrow as the tolerance.
  if (!exact) return;
  const auto known = by_pair(contacts), found = by_pair(FaceContacts::find(mass));
  for (const auto& [pair, measure] : known) {
    const auto same = found.find(pair);
    must_be_below(std::abs(measure - (same == found.end() ? 0 : same->second)), lost,
                  "contacts of the cuts are found by search");
  }
  for (const auto& [pair, measure] : found)
    if (!known.contains(pair)) must_be_below(measure, lost, "contacts found are those of the cuts");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  if (bytes.flag())
    slice_and_check<Planar>(bytes);
  else
    slice_and_check<Spatial>(bytes);
  return 0;
}
