// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/tunnel/construction.hpp>

#include "input.hpp"
#include "models.hpp"
#include "openings.hpp"

/// From an input to the construction of its tunnel, in 2-D and 3-D: what is excavated and what is
/// installed, in which order.
namespace voussoir::program {

/// The supports of one tunnel among many in the same rock.
struct SupportChoice {
  std::optional<BoltSpacing> spacing;  ///< none: no bolts
  double thickness = 0;                ///< of the lining [m]; 0: no lining
};

[[nodiscard]] Acceptance acceptance_of(const Input& input, const SimplePolygon& opening);
/// The bars of a pattern in the section.
[[nodiscard]] std::vector<Segment> bars_of_pattern(const Input& input, const BoltsInput& bolts,
                                                   const BoltSpacing& spacing);
/// In 3-D, in rows along what is driven of its opening.
[[nodiscard]] std::vector<SpatialLine> rows_of_pattern(const Input& input, const BoltsInput& bolts,
                                                       const BoltSpacing& spacing);
/// Of every bar the pattern that it is of. @pre the bars are those of the patterns of the file
[[nodiscard]] std::vector<const BoltsInput*> patterns_of_bars(const Input& input,
                                                              const std::vector<Segment>& bars);
[[nodiscard]] std::vector<const BoltsInput*> patterns_of_bars(const Input& input,
                                                              const std::vector<SpatialLine>& bars);

[[nodiscard]] BoltPattern pattern_of(const BoltsInput& bolts, const BoltSpacing& spacing);
/// Nodes on the full ring of a section: as many as facets, or as many as it takes to be no farther
/// apart than joints, for a block that falls between two nodes loads none, or than a bond needs.
/// @param thickness  of the lining [m], > 0
[[nodiscard]] int lining_nodes(const Input& input, const LiningInput& lining,
                               const RockMass<Planar>& mass, double thickness);
/// In 3-D: as many as facets; none where they are chosen for a bond.
[[nodiscard]] std::optional<int> rib_nodes(const Input& input, const LiningInput& lining);
/// Linings in the order in which stages install them: the number of a lining in tables.
[[nodiscard]] std::vector<const LiningInput*> linings_as_installed(const Input& input,
                                                                   const SupportChoice& supports);
/// That of the file, or for the first lining what is chosen; 0: it is left out [m].
[[nodiscard]] double thickness_of(const Input& input, const LiningInput& lining,
                                  const SupportChoice& supports);
/// The part of a lining around the section, and the feet that it stands on.
[[nodiscard]] LiningRing ring_of(const LiningInput& lining, std::optional<int> nodes);
[[nodiscard]] std::optional<FootBearing> feet_of(const LiningInput& lining);

/// The tunnel of an input along its axis, 3-D: as far as it is driven, through the beginning of the
/// domain and, where no rock is left ahead, its end.
[[nodiscard]] PrismaticOpening driven_tunnel(const Input& input);

/// All stages. 2-D: those of the file. 3-D: the same over the whole length, or round by round.
/// @param is_excavated  what the first stage takes out is out
[[nodiscard]] Construction<Tunnel> construction_of(const Input& input, const Tunnel& tunnel,
                                                   bool is_excavated, const SupportChoice& supports,
                                                   const LinearSettings& linear, RangeSought range);
[[nodiscard]] Construction<SpatialTunnel> construction_of(const Input& input,
                                                          const SupportChoice& supports,
                                                          const LinearSettings& linear,
                                                          RangeSought range);

}  // namespace voussoir::program
