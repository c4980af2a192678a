// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>
#include <voussoir/core/roles.hpp>
#include <voussoir/detection/contact.hpp>
#include <voussoir/geometry/contact_facet.hpp>

namespace voussoir {

template <int Dim>
class PlacedShapes;

template <class Detector, class Mass, class Geometry>
concept HasInitialContacts = requires(const Mass& mass) {
  { Detector::find(mass) } -> std::same_as<std::vector<ContactFacet<Geometry>>>;
};

/// Finds the contacts between the bodies of a rock mass.
///
/// What the compiler cannot check: contacts between parts of one body are left out, the result does
/// not depend on anything but the mass, and the facets of a body cover its faces exactly where it
/// has neighbours.
///
/// Models: CutContacts (rockmass/cut_contacts.hpp), FaceContacts.
template <class Detector, class Mass, class Geometry>
concept ContactDetector = Fills<Detector, roles::ContactDetector> && HasName<Detector> &&
    HasInitialContacts<Detector, Mass, Geometry>;

/// The narrow phase by which a model updates its contacts: the detector itself, or the one that it
/// names as `NarrowPhase` because it knows but how rock lies that has not moved.
template <class Detector>
struct NarrowPhaseOf {
  using type = Detector;
};
template <class Detector>
requires requires { typename Detector::NarrowPhase; }
struct NarrowPhaseOf<Detector> {
  using type = typename Detector::NarrowPhase;
};

template <class Detector, class Mass, class Geometry>
consteval bool explain_contact_detector() {
  static_assert(Fills<Detector, roles::ContactDetector>,
                "contact detector: add `using role = voussoir::roles::ContactDetector`");
  static_assert(HasName<Detector>,
                "contact detector: add `static constexpr const char* name` for the log");
  static_assert(HasInitialContacts<Detector, Mass, Geometry>,
                "contact detector: add `static std::vector<ContactFacet<Geometry>> find(const "
                "RockMass<Geometry>&)`");
  return true;
}

template <class Detector, int Dim>
concept HasPairQueries = requires(const PlacedShapes<Dim>& shapes,
                                  typename Detector::template Pair<Dim>& pair,
                                  typename Detector::template Pair<Dim>::Memory& memory,
                                  std::size_t shape, double reach) {
  typename Detector::template Pair<Dim>;
  {typename Detector::template Pair<Dim>(shapes)};
  requires DefaultConstructible<typename Detector::template Pair<Dim>::Memory>;
  { pair.overlap(shape, shape, memory) } -> std::same_as<bool>;
  { pair.separation(shape, shape, memory) } -> std::same_as<double>;
  { pair.contact(shape, shape, memory, reach) } -> std::same_as<Contact<Dim>>;
};

template <class Detector, int Dim>
concept HasFacingContact = requires(typename Detector::template Pair<Dim>& pair,
                                    typename Detector::template Pair<Dim>::Memory& memory,
                                    std::size_t shape, double reach) {
  { pair.facing_contact(shape, shape, memory, reach) } -> std::same_as<Contact<Dim>>;
};

/// Tells how two shapes touch, wherever they are: the narrow phase of ContactSearch and of a model,
/// which updates its contacts by it.
///
/// What the compiler cannot check: `Memory` changes the cost of an answer, never the answer; the
/// normal points from the first shape to the second; the polygon stays valid until the next query.
/// (b, a) is the answer to (a, b) seen from the other side.
///
/// A model asks `facing_contact` alone, of every pair that has moved; it measures the opening of
/// each contact point over the face that is named.
///  - Touch::none if the shapes are further apart than `reach` [m], >= 0. Most pairs are, and were
///    when they were last asked: that answer should cost one axis.
///  - `touch` names whose face it is, face_a or face_b; in 3-D crossing edges may touch, edge_edge.
///    Never `interior`.
///  - `normal` is that of the face, to 0.1 rad, or the common one of the edges; `separation` is
///  that
///    of the shapes along it, the lowest vertex of the other shape over the face [m].
///  - `polygon` is the *whole* part of the other shape's face that lies over the face, the prism
///    upright on it, no matter how high: springs then do not change with the depth of the overlap,
///    which would make or lose energy. Its points are counted from the grid point of a. `measure`
///    is its length or area seen along the normal [m], [m^2]; 0 where nothing lies over the face:
///    then the polygon is the deepest point of the other (2-D: twice).
///
/// Models: FaceContacts, AnalyticCentre.
template <class Detector, int Dim>
concept PairDetector = Fills<Detector, roles::ContactDetector> && HasPairQueries<Detector, Dim> &&
    HasFacingContact<Detector, Dim>;

template <class Detector, int Dim>
consteval bool explain_pair_detector() {
  static_assert(
      HasPairQueries<Detector, Dim>,
      "contact search: the detector needs `template <int Dim> class Pair`, made from "
      "`const PlacedShapes<Dim>&`, with `struct Memory`, `bool overlap(a, b, Memory&)`, "
      "`double separation(a, b, Memory&)` and `Contact<Dim> contact(a, b, Memory&, double "
      "reach)`, or the name of one that has it, `using NarrowPhase = voussoir::FaceContacts`");
  if constexpr (HasPairQueries<Detector, Dim>)
    static_assert(HasFacingContact<Detector, Dim>,
                  "contact detector: its `Pair` needs `Contact<Dim> facing_contact(a, b, Memory&, "
                  "double reach)`, by which a model updates its contacts");
  return true;
}

}  // namespace voussoir
