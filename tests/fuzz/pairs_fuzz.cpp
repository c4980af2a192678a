// SPDX-License-Identifier: MIT
// libFuzzer target: two blocks, cut out of boxes by any planes, anywhere near each other.
//
// The detector must agree with all axes in long double, give the same bits from memory and from
// plain numbers, and a contact whose points lie where it says.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <type_traits>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/pose.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/detection/placed_shapes.hpp>
#include <voussoir/rockmass/domain.hpp>

#include "fuzz/bytes.hpp"
#include "support/pairs.hpp"
#include "support/separating_axes.hpp"

using namespace voussoir;
using namespace voussoir_test;

namespace {

/// A vertex this near to a cut is taken to lie on it [m].
constexpr double snap = 1e-12;

template <int Dim>
Vec<Dim> lattice_vector(Bytes& bytes) {
  Vec<Dim> vector;
  for (int k = 0; k < Dim; ++k) vector[k] = bytes.coarse();
  if (bytes.below(4) == 0) vector[bytes.below(Dim)] += bytes.tiny();
  return vector;
}

/// A box of 2 m or a slab or needle down to 1:10^4, cut by up to five planes.
template <int Dim>
auto read_shape(Bytes& bytes) {
  Domain<Dim> box;
  for (int k = 0; k < Dim; ++k) {
    constexpr std::array<double, 6> halves{1, 1, 1, 0.5, 1e-2, 1e-4};
    box.high[k] = halves[static_cast<std::size_t>(bytes.below(6))];
    box.low[k] = -box.high[k];
  }
  auto shape = as_block(box);
  for (int cuts = bytes.below(6); cuts > 0; --cuts) {
    const Vec<Dim> normal = lattice_vector<Dim>(bytes), point = 0.25 * lattice_vector<Dim>(bytes);
    const bool lower = bytes.flag();
    if (!(normal.norm() > 1e-3)) continue;
    const auto plane =
        HalfSpace<Dim>::through(Vec<Dim>(point.cwiseProduct(box.high)), normal.normalized());
    if (auto parts = shape.split(plane, 6, snap)) shape = lower ? parts->first : parts->second;
  }
  return shape;
}

template <int Dim>
Pose<Dim> read_pose(Bytes& bytes) {
  Pose<Dim> pose;
  pose.position = 0.25 * lattice_vector<Dim>(bytes);
  Spin<Dim> spin = Spin<Dim>::Zero();
  for (Eigen::Index k = 0; k < spin.size(); ++k) switch (bytes.below(4)) {
      case 0:
        spin[k] = bytes.below(4) * 0.5 * std::numbers::pi;
        break;
      case 1:
        spin[k] = bytes.tiny();
        break;
      case 2:
        spin[k] = bytes.coarse();
        break;
      default:
        break;
    }
  pose.rotation = rotation_by(spin);
  return pose;
}

template <int Dim>
bool same(const Contact<Dim>& a, const Contact<Dim>& b) {
  return a.touch == b.touch && a.normal == b.normal && a.separation == b.separation &&
         a.measure == b.measure &&
         std::equal(a.polygon.begin(), a.polygon.end(), b.polygon.begin(), b.polygon.end());
}

template <int Dim>
void check_pair(Bytes& bytes) {
  using Pair = FaceContacts::Pair<Dim>;
  using PlainPair = FaceContacts::Pair<Dim, detail::PlainLanes>;
  const auto shape_a = read_shape<Dim>(bytes), shape_b = read_shape<Dim>(bytes);
  const Pose<Dim> pose_a = read_pose<Dim>(bytes), pose_b = read_pose<Dim>(bytes),
                  before = read_pose<Dim>(bytes);
  const double reach = bytes.flag() ? std::abs(bytes.tiny()) : 0.0;
  PlacedShapes<Dim> shapes;
  shapes.add(shape_a, Vec<Dim>::Zero());
  shapes.add(shape_b, Vec<Dim>::Zero());
  shapes.place(0, pose_a);
  shapes.place(1, before);
  Pair warm(shapes);
  typename Pair::Memory memory, of_overlap;
  (void)warm.contact(0, 1, memory, reach);
  (void)warm.overlap(0, 1, of_overlap);
  shapes.place(1, pose_b);

  const LongShape<Dim> a = reference_of(shape_a, pose_a), b = reference_of(shape_b, pose_b);
  const LongSeparation<Dim> exact = separating_axes(a, b);
  const double value = static_cast<double>(exact.value);
  Pair pair(shapes);
  typename Pair::Memory fresh;
  const double separation = pair.separation(0, 1, fresh);
  // Faces are flat, and planes known, to what cuts snap; needles multiply it.
  constexpr double tolerance = 1e-9;
  if (value <= 0) {
    must_be_below(std::abs(separation - value), tolerance, "depth");
  } else {
    must_be_below(separation, static_cast<double>(distance_apart(a, b)) + tolerance, "distance");
    // Cuts may leave a face 1e-10 m wide: its vertices do not say its normal over a gap of metres.
    constexpr long double sure = 1e-5L;
    must_be_below(static_cast<double>(separating_axes(a, b, sure).value), separation + tolerance,
                  "separation");
  }
  typename Pair::Memory cold;
  must(pair.overlap(0, 1, cold) == (separation < 0), "overlap as separation says", separation);
  must(warm.overlap(0, 1, of_overlap) == (separation < 0), "overlap from memory", separation);

  typename Pair::Memory none;
  const Contact<Dim> contact = pair.contact(0, 1, none, reach);
  PlainPair plain(shapes);
  typename PlainPair::Memory plain_memory;
  must(same(contact, plain.contact(0, 1, plain_memory, reach)), "plain numbers, same bits");
  must(same(contact, warm.contact(0, 1, memory, reach)), "from memory, same bits");
  must((contact.touch == Touch::none) == !(separation <= reach), "touching within reach",
       separation, reach);
  if (contact.touch == Touch::none) return;
  must_be_below(std::abs(contact.normal.norm() - 1), 1e-14, "unit normal");
  must_be_below(std::abs(static_cast<double>(
                             room_along<Dim>(a, b, contact.normal.template cast<long double>())) -
                         separation),
                tolerance, "the normal realises the depth");
  must(!contact.polygon.empty(), "a contact has points");
  must(contact.measure >= -tolerance, "its measure is not negative", contact.measure);
  // Points of a face are on their own block, and within the depth of the other; those of edges that
  // cross are midway.
  const double depth = std::max(std::abs(separation), reach) + tolerance;
  if (separation <= 0)
    for (const Vec<Dim>& point : contact.polygon) {
      const LongVec<Dim> x = point.template cast<long double>();
      const double of_a = static_cast<double>(outside(a, x)),
                   of_b = static_cast<double>(outside(b, x));
      must_be_below(std::min(of_a, of_b), contact.touch == Touch::edge_edge ? depth : tolerance,
                    "points on the surface");
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  if (bytes.flag())
    check_pair<2>(bytes);
  else
    check_pair<3>(bytes);
  return 0;
}
