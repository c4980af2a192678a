// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/lining/lining_model.hpp>
#include <voussoir/lining/node_spacing.hpp>
#include <voussoir/tunnel/lining_ring.hpp>

namespace voussoir {

/// The ring with its number of nodes: as given; where it is left out, `default_lining_nodes`, and
/// more where the interface holds tension, so that nodes are no farther apart than
/// `chosen_bonded_spacing`.
///
/// @param opening    that is lined: its section
/// @param interface  law of rock on lining
/// @param width      of the wall that bears on one member: the spacing of ribs; 1 in 2-D [m]
/// @throws InvalidInput  that would be more than 2000 nodes
template <int Dim, class Law>
[[nodiscard]] LiningRing with_chosen_nodes(LiningRing ring, const SimplePolygon& opening,
                                           const LiningSection& section, const Law& interface,
                                           double width = 1) {
  if (ring.nodes) return ring;
  ring.nodes = default_lining_nodes;
  if (!holds_tension<Dim>(interface)) return ring;
  const double length =
      bending_length(section.bending_stiffness, width * interface.joint_normal_stiffness());
  const double needed = node_count_for(opening.perimeter(), length, chosen_bonded_spacing);
  if (!(needed <= most_lining_nodes))
    throw InvalidInput(message(
        {"lining: its bond to the rock acts over L = (4 E I / k_n)^(1/4) = ", length, " m, and ",
         needed, " nodes would have to be on its outline of ", opening.perimeter(),
         " m; accepted: at most ", most_lining_nodes,
         ", of a thicker lining or a softer interface, or a number of nodes that you give, at "
         "least ",
         node_count_for(opening.perimeter(), length, coarsest_bonded_spacing)}));
  ring.nodes = std::max(default_lining_nodes, static_cast<int>(needed));
  return ring;
}

}  // namespace voussoir
