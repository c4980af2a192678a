// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/linear/free_body.hpp>
#include <voussoir/model/prescribed_displacement.hpp>
#include <voussoir/solver/composed_solver.hpp>

// Loads on blocks of `ComposedSolver`, and blocks that it holds.
namespace voussoir {

template <class Models>
void ComposedSolver<Models>::check_block(int block, const char* what) const {
  const std::string blocks = "0 to " + std::to_string(ground() - 1);
  require(block >= 0 && block < ground(), what, block, blocks.c_str());
  if (system_.body(block).is_gone)
    throw InvalidInput(
        message({what, " ", std::to_string(block), " at ", text_of<dim>(system_.body(block).centre),
                 " m: it has fallen and is taken out of the model"}));
}

template <class Models>
void ComposedSolver<Models>::add_load(int block, const Load<dim>& load) {
  check_block(block, "load on block");
  require(std::isfinite(load.force.squaredNorm() + load.moment.squaredNorm()), "load on a block",
          load.force.norm(), "a finite force and moment");
  if (!system_.body(block).movable)
    throw InvalidInput(message({"load on block ", std::to_string(block), " at ",
                                text_of<dim>(system_.body(block).centre),
                                " m: the block is fixed, and bears any load"}));
  const Fixed<dof, 1> on_body = stacked(load.force, load.moment);
  add_at<dof>(system_.load.data() + dof * block, on_body);
  Eigen::VectorXd held = zeros(system_.load.size());
  add_at<dof>(held.data() + dof * block, -on_body);
  hold(std::move(held));
  started_ = is_loaded_ = true;
}

template <class Models>
void ComposedSolver<Models>::add_body_force(const Vec<dim>& over_weight) {
  require(std::isfinite(over_weight.squaredNorm()), "body force over weight", over_weight.norm(),
          "finite");
  Eigen::VectorXd held = zeros(system_.load.size());
  for (int b = 0; b < ground(); ++b) {
    if (!system_.body(b).movable) continue;
    const Vec<dim> force = system_.body(b).weight * over_weight;
    add_at<dim>(system_.load.data() + dof * b, force);
    add_at<dim>(held.data() + dof * b, Vec<dim>(-force));
  }
  hold(std::move(held));
  started_ = is_loaded_ = true;
}

template <class Models>
void ComposedSolver<Models>::fix(int block) {
  check_block(block, "fixed block");
  system_.fix(block);
  started_ = is_loaded_ = true;
}

template <class Models>
void ComposedSolver<Models>::displace(const std::vector<PrescribedDisplacement<dim>>& motions) {
  Eigen::VectorXd moved = zeros(system_.displacement.size());
  for (const auto& [block, by, rotation] : motions) {
    check_block(block, "displaced block");
    require(std::isfinite(by.squaredNorm() + rotation.squaredNorm()), "displacement of a block",
            by.norm(), "finite");
    if (system_.body(block).movable)
      throw InvalidInput(message({"displacement of block ", std::to_string(block), " at ",
                                  text_of<dim>(system_.body(block).centre),
                                  " m: the block is free; fix it first, or load it"}));
    const Fixed<dof, 1> motion = stacked(by, rotation);
    add_at<dof>(moved.data() + dof * block, motion);
  }
  started_ = is_loaded_ = true;
  // Moved alone, a block would be driven into those that it carries, by forces that have nothing
  // to do with those of any equilibrium.
  try {
    Eigen::VectorXd carried = system_.forces_of_displaced(moved);
    (void)system_.elastic_solver({}).solve_in_place(carried, {});
    carried_ += system_.largest_translation(carried);
    moved += carried;
  } catch (const FreeBody&) {
    // Nothing holds that one: the next stage takes it out, and begins where the others are.
  }
  system_.displacement += moved;
}

}  // namespace voussoir
