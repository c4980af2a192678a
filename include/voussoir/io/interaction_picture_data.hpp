// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/drawing/picture_parts.hpp>

namespace voussoir {

/// What is drawn over thickness and spacing, and how its numbers read.
struct InteractionQuantity {
  std::string name;          ///< "crown convergence"
  double contour_scale;      ///< value times this is the number on a contour
  std::string contour_unit;  ///< "% of a"
  std::string contour_mark;  ///< behind that number: " %"
  double point_scale;        ///< value times this is the number at a point
  std::string point_unit;    ///< "mm"

  /// In % of the radius and in mm; values in m.
  [[nodiscard]] static InteractionQuantity crown_convergence(double diameter) {
    return {"crown convergence", 200 / diameter, "% of a", " %", 1e3, "mm"};
  }
  /// One unit for contours and points.
  [[nodiscard]] static InteractionQuantity in(std::string name, double scale, std::string unit) {
    return {std::move(name), scale, unit, "", scale, std::move(unit)};
  }
  /// Then one scale beside the colours says all.
  [[nodiscard]] bool has_one_unit() const {
    return contour_unit == point_unit && contour_scale == point_scale;
  }
};

/// What an interaction diagram shows: crown convergence, or another quantity, over lining thickness
/// and bolt spacing.
struct InteractionPicture {
  struct Spacing {
    std::string label;                 ///< as written on the axis: "15°", "no bolts"
    std::optional<double> value = {};  ///< in any one unit; none: no bolts
  };
  PictureHeader header;
  double diameter = 0;              ///< D of the opening [m], > 0
  std::vector<double> thicknesses;  ///< t of the lining [m], ascending, 2 or more
  std::vector<Spacing> spacings;    ///< ascending, 2 or more; only the last may be without value
  std::string spacing_axis = "bolt spacing";  ///< title of the axis
  /// (thickness, spacing), SI: crown convergence, into the opening positive, unless `quantity` says
  /// what else; NaN: none.
  Eigen::MatrixXd values;
  /// (thickness, spacing): blocks detach. Empty: nowhere. A failed point counts in the contours
  /// only if it has a value.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> failed = {};
  /// (thickness, spacing), of the failed ones: collapsed; of the others some rock came off and the
  /// rest stands. Empty: not told apart.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> collapsed = {};
  /// (thickness, spacing): sought and not found, neither an equilibrium nor detached blocks. Such a
  /// point has no value and is not failed. Empty: nowhere.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> undecided = {};
  /// (thickness, spacing): what came off depends on limits and rates that nobody knows. Empty:
  /// nowhere.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> marginal = {};
  /// (thickness, spacing): the value is known, the tunnel was not computed. Empty: nowhere.
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> assumed = {};
  std::string computed_name = "computed";     ///< in the legend
  std::string failed_name = "blocks detach";  ///< in the legend, where `collapsed` is empty
  /// The one that is recommended: indices of its thickness and spacing.
  std::optional<std::pair<std::size_t, std::size_t>> chosen = {};
  std::optional<PictureBanner> banner = {};          ///< between header and diagram
  std::optional<InteractionQuantity> quantity = {};  ///< none: crown convergence
  /// A result from elsewhere, drawn into the diagram where it belongs; contours know nothing of it.
  struct Other {
    double thickness, spacing;  ///< as on the axes; drawn if within them
    double value;               ///< SI, beside the label; NaN: "blocks detach"
    std::string label;
  };
  std::vector<Other> others = {};
  std::string others_name = "other";  ///< in the legend

  [[nodiscard]] InteractionQuantity shown() const {
    return quantity.value_or(InteractionQuantity::crown_convergence(diameter));
  }
  [[nodiscard]] bool is_failed(std::size_t i, std::size_t j) const {
    return failed.size() > 0 && failed(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  /// Failed, and known to stand but for what came off.
  [[nodiscard]] bool is_shedding(std::size_t i, std::size_t j) const {
    return is_failed(i, j) && collapsed.size() > 0 &&
           !collapsed(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] bool is_undecided(std::size_t i, std::size_t j) const {
    return undecided.size() > 0 &&
           undecided(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] bool is_marginal(std::size_t i, std::size_t j) const {
    return marginal.size() > 0 &&
           marginal(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] bool is_assumed(std::size_t i, std::size_t j) const {
    return assumed.size() > 0 &&
           assumed(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  [[nodiscard]] double at(std::size_t i, std::size_t j) const {
    return values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
};

/// @throws InvalidInput  fewer than 2 x 2 points, axes that do not ascend, tables of another size,
///                       diameter not > 0
VOUSSOIR_INLINE void check_interaction(const InteractionPicture& picture);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void check_interaction(const InteractionPicture& picture) {
  const auto columns = static_cast<Eigen::Index>(picture.thicknesses.size());
  const auto rows = static_cast<Eigen::Index>(picture.spacings.size());
  if (columns < 2 || rows < 2) {
    throw InvalidInput("interaction picture: needs 2 or more thicknesses and spacings");
  }
  const auto has_another_size = [&](const auto& marks) {
    return marks.size() > 0 && (marks.rows() != columns || marks.cols() != rows);
  };
  if (picture.values.rows() != columns || picture.values.cols() != rows ||
      has_another_size(picture.failed) || has_another_size(picture.collapsed) ||
      has_another_size(picture.undecided) || has_another_size(picture.marginal) ||
      has_another_size(picture.assumed)) {
    throw InvalidInput("interaction picture: tables must be thicknesses x spacings");
  }
  for (std::size_t i = 0; i + 1 < picture.thicknesses.size(); ++i) {
    if (!(picture.thicknesses[i] < picture.thicknesses[i + 1])) {
      throw InvalidInput("interaction picture: thicknesses must ascend");
    }
  }
  for (std::size_t j = 0; j + 1 < picture.spacings.size(); ++j) {
    const std::optional<double> here = picture.spacings[j].value;
    const std::optional<double> next = picture.spacings[j + 1].value;
    if (!here || (next && !(*here < *next))) {
      throw InvalidInput("interaction picture: spacings must ascend, `no bolts` last");
    }
  }
  require(picture.diameter > 0, "interaction picture: diameter", picture.diameter, "> 0");
}

#endif

}  // namespace voussoir
