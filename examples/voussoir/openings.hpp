// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>
#include <voussoir/geometry/prismatic_opening.hpp>
#include <voussoir/geometry/simple_polygon.hpp>
#include <voussoir/rockmass/domain.hpp>

#include "input.hpp"

/// The openings of an input, by number: 0 is the tunnel, then come those of [[opening]]. Where each
/// lies, what of it a round takes out, and in which stretches it is driven.
namespace voussoir::program {

[[nodiscard]] const OutlineInput& outline_input(const Input& input, std::size_t opening);
/// "tunnel", "opening[0]", ...
[[nodiscard]] std::string opening_key(std::size_t opening);
/// "tunnel", or the name of another.
[[nodiscard]] std::string opening_name(const Input& input, std::size_t opening);
/// False for one that a section does not show.
[[nodiscard]] bool is_modelled(const Input& input, std::size_t opening);

/// The same of bolts: forepoles are in 3-D alone.
[[nodiscard]] bool is_modelled(const Input& input, const BoltsInput& bolts);

/// The ground of a section; the same of 3-D, in which the tunnel begins at the face of the domain.
[[nodiscard]] Domain<2> section_domain(const Input& input);
[[nodiscard]] Domain<3> spatial_domain(const Input& input);

/// Centre of its outline in the section [m].
[[nodiscard]] Vec2 centre_in_section(const Input& input, std::size_t opening);
/// An outline about the centre of an opening, where it lies in the section.
[[nodiscard]] SimplePolygon in_section(const Input& input, std::size_t opening,
                                       const SimplePolygon& outline);
/// The outline of an opening where it lies in the section.
[[nodiscard]] SimplePolygon opening_in_section(const Input& input, std::size_t opening);

/// What a round excavates of its opening, about the centre of that; none: nothing of it.
/// @pre  the round excavates
/// @throws InvalidInput  it takes several pieces, or leaves some out of which it is made up
[[nodiscard]] std::optional<SimplePolygon> outline_of_round(const Input& input,
                                                            const StageInput& round);

/// How an opening is driven along its axis, in 3-D.
struct Drive {
  double from, to;      ///< places along the axis [m]
  double stretch;       ///< what is excavated at a time [m]; the last may be shorter
  int count;            ///< of stretches
  bool has_open_start;  ///< it begins where the domain does
  bool has_open_end;    ///< no rock is left ahead of it

  [[nodiscard]] double length() const { return to - from; }
  [[nodiscard]] double begin_of(int k) const { return from + k * stretch; }
  [[nodiscard]] double end_of(int k) const {
    return k + 1 == count ? to : from + (k + 1) * stretch;
  }
};
/// @pre  the opening ends somewhere, see `OpeningInput::to`
[[nodiscard]] Drive drive_of(const Input& input, std::size_t opening);
/// Advances of the tunnel's face until all of its rounds, and those of other openings, are done.
/// @pre  it is driven in rounds
[[nodiscard]] int advance_count(const Input& input);
/// What lies within an outline, all along an opening as far as it is driven, or one stretch of it.
[[nodiscard]] PrismaticOpening opening_in_space(const Input& input, std::size_t opening,
                                                const SimplePolygon& outline);
[[nodiscard]] PrismaticOpening stretch_in_space(const Input& input, std::size_t opening,
                                                const SimplePolygon& outline, int stretch);

/// Strips of a lining on one stretch of an opening, 3-D.
struct StripsOfStretch {
  int count;
  double width;  ///< of each along the opening [m]
};
/// @pre  the file has a lining
[[nodiscard]] StripsOfStretch strips_of(const Input& input, std::size_t opening);
/// Of all linings, which have strips of one width [m]. @pre  the file has a lining
[[nodiscard]] double strip_width(const Input& input);

/// What is wrong with where openings lie: beside the domain, or two in one place.
struct OpeningFault {
  std::size_t opening;
  std::string text;
};
/// @pre  every opening is read without fault
[[nodiscard]] std::optional<OpeningFault> fault_of_openings(const Input& input);

}  // namespace voussoir::program
