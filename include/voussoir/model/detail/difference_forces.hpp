// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/reference_contact.hpp>

namespace voussoir::detail {

/// The tangent of a contact that is open from one edge on, where the part that is pressed changes
/// with the motion: by differences of all its forces.
/// @param add_forces       add_forces(task) adds the forces of a task whose contacts and motion are
///                         told
/// @param aa, ab, ba, bb   are overwritten: the negative derivative of the forces
template <int Dim, class AddForces, class Block>
void difference_forces(const ReferenceContact<Dim>& c, const double* u, const AddForces& add_forces,
                       Block& aa, Block& ab, Block& ba, Block& bb) {
  constexpr int dof = ReferenceContact<Dim>::dof;
  using Values = std::array<double, 2 * dof>;  // of both bodies
  ReferenceContact<Dim> alone = c;
  alone.a = 0;
  alone.b = 1;
  Values at;
  std::copy_n(u + dof * c.a, dof, at.begin());
  std::copy_n(u + dof * c.b, dof, at.begin() + dof);
  ForceTask<Dim> task;
  task.contacts = &alone;
  task.count = 1;
  task.u = at.data();
  const auto forces = [&]() -> Values {
    Values f{};
    task.f = f.data();
    add_forces(task);
    return f;
  };
  const double arm = std::max(c.arm_a.norm(), c.arm_b.norm());
  for (int col = 0; col < 2 * dof; ++col) {
    double& entry = at[static_cast<std::size_t>(col)];
    const double step = col % dof < Dim ? 1e-12 : 1e-12 / arm, before = entry;
    entry = before + step;
    const Values up = forces();
    entry = before - step;
    const Values down = forces();
    entry = before;
    for (int row = 0; row < 2 * dof; ++row) {
      Block& block = row < dof ? (col < dof ? aa : ab) : (col < dof ? ba : bb);
      const auto r = static_cast<std::size_t>(row);
      block(row % dof, col % dof) = (down[r] - up[r]) / (2 * step);
    }
  }
}

}  // namespace voussoir::detail
