// SPDX-License-Identifier: MIT
#pragma once

#include <vector>
#include <voussoir/core/vec.hpp>

/// What Boost.Geometry says of an outline given by its corners, anticlockwise; compiled once for
/// all tests, for its headers alone take seconds.
namespace voussoir_test::boost_polygon {

using Outline = std::vector<voussoir::Vec2>;

[[nodiscard]] bool is_valid(const Outline& outline);
/// The same, whichever way round it goes.
[[nodiscard]] bool is_valid_either_way(const Outline& outline);
/// Negative if it goes clockwise.
[[nodiscard]] double area(const Outline& outline);
[[nodiscard]] double area_of_convex_hull(const Outline& outline);
/// Whether a point lies inside, not on the outline.
[[nodiscard]] bool contains(const Outline& outline, const voussoir::Vec2& point);

}  // namespace voussoir_test::boost_polygon
