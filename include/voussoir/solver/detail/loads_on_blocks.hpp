// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <utility>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/long_vectors.hpp>
#include <voussoir/core/message.hpp>
#include <voussoir/core/vec.hpp>
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
void ComposedSolver<Models>::fix(int block) {
  check_block(block, "fixed block");
  system_.fix(block);
  started_ = is_loaded_ = true;
}

}  // namespace voussoir
