// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/farfield/elastic_matrix.hpp>
#include <voussoir/rockmass/domain.hpp>

namespace voussoir {

/// What a side of the domain meets. The in-situ stress acts on all of them.
enum class Boundary {
  rollers,  ///< stays where it is, and is smooth
  stress,   ///< the in-situ stress goes on acting, however the side moves
  elastic   ///< ground that goes on, elastic, and pushes back where the side moves
};
[[nodiscard]] constexpr const char* to_string(Boundary boundary) {
  switch (boundary) {
    case Boundary::rollers:
      return "rollers";
    case Boundary::stress:
      return "stress";
    case Boundary::elastic:
      return "elastic";
  }
  return "?";
}

/// The axis that a side is at right angles to, and whether it is the upper one.
template <int Dim>
struct SidePlace {
  int axis;
  bool upper;
};
template <int Dim>
[[nodiscard]] constexpr SidePlace<Dim> place_of(SideOf<Dim> side) {
  switch (static_cast<int>(side)) {
    case 0:
      return {0, false};
    case 1:
      return {Dim - 1, false};
    case 2:
      return {0, true};
    case 3:
      return {Dim - 1, true};
    case 4:
      return {1, false};
    default:
      return {1, true};
  }
}
template <int Dim>
[[nodiscard]] constexpr SideOf<Dim> side_at(int axis, bool upper) {
  if (axis == 0) return upper ? static_cast<SideOf<Dim>>(2) : static_cast<SideOf<Dim>>(0);
  if (axis == Dim - 1) return upper ? SideOf<Dim>::top : SideOf<Dim>::bottom;
  return upper ? static_cast<SideOf<Dim>>(5) : static_cast<SideOf<Dim>>(4);
}

/// The ground beyond the domain.
///
/// By default the sides and the base are rollers, and the top is the ground surface. Rollers hold
/// the rock back where an opening would let it move, a stress boundary lets it move too far; the
/// elastic one lies between, and the answer does then not depend on where the domain ends.
template <int Dim>
class FarField {
 public:
  /// Rollers at the sides and the base; the surface, or a surcharge, on top.
  FarField() {
    boundaries_.fill(Boundary::rollers);
    at(SideOf<Dim>::top) = Boundary::stress;
  }
  /// Elastic ground beyond the sides and the base.
  /// @param moduli  of it, e.g. those of the rock in the domain (`elastic_moduli`)
  [[nodiscard]] static FarField elastic(const ElasticMatrix<Dim>& moduli) {
    FarField field;
    field.boundaries_.fill(Boundary::elastic);
    field.at(SideOf<Dim>::top) = Boundary::stress;
    field.moduli_ = moduli;
    return field;
  }
  /// The same with another boundary at one side.
  [[nodiscard]] FarField with(SideOf<Dim> side, Boundary boundary) const {
    FarField other = *this;
    other.at(side) = boundary;
    return other;
  }

  [[nodiscard]] Boundary at(SideOf<Dim> side) const {
    return boundaries_[static_cast<std::size_t>(side)];
  }
  [[nodiscard]] Boundary at(int axis, bool upper) const { return at(side_at<Dim>(axis, upper)); }
  [[nodiscard]] bool has(Boundary boundary) const {
    for (const Boundary b : boundaries_)
      if (b == boundary) return true;
    return false;
  }
  /// Of the elastic ground [Pa].
  [[nodiscard]] const ElasticMatrix<Dim>& moduli() const { return moduli_; }

  /// @throws InvalidInput  rock that nothing holds, or moduli that are no stable material's
  void check() const {
    if (at(SideOf<Dim>::top) == Boundary::rollers)
      throw InvalidInput(
          "far field: rollers on top contradict the ground surface; accepted there: stress (the "
          "surface, or a surcharge), elastic (ground that goes on above)");
    if (at(SideOf<Dim>::bottom) == Boundary::stress)
      throw InvalidInput(
          "far field: a stress boundary at the base contradicts gravity: the weight of what is "
          "excavated would have nothing to rise against; accepted there: rollers, elastic");
    for (int axis = 0; axis < Dim - 1; ++axis)
      if (at(axis, false) == Boundary::stress && at(axis, true) == Boundary::stress &&
          at(SideOf<Dim>::bottom) == Boundary::rollers)
        throw InvalidInput(
            "far field: stress at both sides leaves the rock free to slide on a base of rollers; "
            "accepted with it: an elastic base, or rollers or elastic ground at one side");
    if (has(Boundary::elastic)) check_moduli();
  }

 private:
  [[nodiscard]] Boundary& at(SideOf<Dim> side) {
    return boundaries_[static_cast<std::size_t>(side)];
  }
  /// Positive definite: every pivot of an elimination is positive.
  void check_moduli() const {
    constexpr int size = tensor_size<Dim>;
    ElasticMatrix<Dim> left = moduli_;
    for (int k = 0; k < size; ++k) {
      const double pivot = left(k, k);
      if (!(pivot > 1e-9 * moduli_(k, k)) || !std::isfinite(pivot))
        throw InvalidInput(
            "far field: the moduli of elastic ground must be finite and positive definite; those "
            "of one joint set alone are not, nor those of ground that was not given");
      for (int i = k + 1; i < size; ++i)
        for (int j = k + 1; j < size; ++j) left(i, j) -= left(i, k) * left(k, j) / pivot;
    }
  }

  std::array<Boundary, 2 * Dim> boundaries_{};
  ElasticMatrix<Dim> moduli_ = zeros<ElasticMatrix<Dim>>();
};

}  // namespace voussoir
