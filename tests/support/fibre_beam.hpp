// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

/// A row of equal rigid blocks between two walls, every joint of it many springs that carry no
/// tension: the second method beside the library's joints, with which it shares no code.
namespace voussoir_test {

/// Blocks 1 m long and 1 m high, per metre. Positions and angles are finite.
struct FibreBeam {
  int span;              ///< blocks
  double normal, shear;  ///< k_n, k_s [Pa/m]
  double weight;         ///< of a block [N]
  int fibres = 64;       ///< of a joint
  Eigen::VectorXd q{};   ///< x, y, angle of every block

  using Six = Eigen::Matrix<double, 6, 1>;  ///< x, y, angle left and right of a joint

  /// Force and moment on both sides of a joint.
  /// @param pressed  which fibres count, decided by `at`; null: those that are pressed there
  [[nodiscard]] Six joint_force(const Six& at, std::vector<char>* decide,
                                const std::vector<char>* pressed) const {
    using Eigen::Vector2d;
    Six force = Six::Zero();
    const double middle = 0.5 * (at[2] + at[5]);
    const Vector2d n(std::cos(middle), std::sin(middle)), t(-n.y(), n.x());
    const Vector2d left_x(std::cos(at[2]), std::sin(at[2])), left_y(-left_x.y(), left_x.x()),
        right_x(std::cos(at[5]), std::sin(at[5])), right_y(-right_x.y(), right_x.x());
    for (int i = 0; i < fibres; ++i) {
      const double h = (i + 0.5) / fibres - 0.5, width = 1.0 / fibres;
      const Vector2d to_left = 0.5 * left_x + h * left_y, to_right = -0.5 * right_x + h * right_y;
      const Vector2d apart = at.segment<2>(3) + to_right - at.segment<2>(0) - to_left;
      const double opening = apart.dot(n);
      const auto k = static_cast<std::size_t>(i);
      if (decide != nullptr) (*decide)[k] = opening <= 1e-15;
      if (pressed != nullptr ? !(*pressed)[k] : !(opening <= 1e-15)) continue;
      const Vector2d on_right = -width * (normal * opening * n + shear * apart.dot(t) * t);
      // At the middle between the two faces, so that no couple is left.
      const Vector2d arm_left = to_left + 0.5 * apart, arm_right = to_right - 0.5 * apart;
      force.segment<2>(3) += on_right;
      force.segment<2>(0) -= on_right;
      force[5] += arm_right.x() * on_right.y() - arm_right.y() * on_right.x();
      force[2] -= arm_left.x() * on_right.y() - arm_left.y() * on_right.x();
    }
    return force;
  }
  [[nodiscard]] Six sides_of(int joint, const Eigen::VectorXd& x) const {
    Six at;
    at << joint - 0.5, 0, 0, joint + 0.5, 0, 0;
    if (joint > 0) at.head<3>() = x.segment<3>(3 * (joint - 1));
    if (joint < span) at.tail<3>() = x.segment<3>(3 * joint);
    return at;
  }
  /// What is out of balance under this part of the weight, and its derivative if it is asked for.
  [[nodiscard]] Eigen::VectorXd residual(const Eigen::VectorXd& x, double part,
                                         Eigen::MatrixXd* tangent) const {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(x.size());
    if (tangent != nullptr) tangent->setZero(x.size(), x.size());
    for (int b = 0; b < span; ++b) r[3 * b + 1] = -part * weight;
    std::vector<char> pressed(static_cast<std::size_t>(fibres));
    for (int joint = 0; joint <= span; ++joint) {
      const Six at = sides_of(joint, x), f = joint_force(at, &pressed, nullptr);
      const auto place = [&](int i) { return 3 * (joint - 1) + i; };  // of an unknown in x
      const auto is_free = [&](int i) { return i < 3 ? joint > 0 : joint < span; };
      for (int i = 0; i < 6; ++i)
        if (is_free(i)) r[place(i)] += f[i];
      if (tangent == nullptr) continue;
      for (int k = 0; k < 6; ++k) {
        if (!is_free(k)) continue;
        Six more = at, less = at;
        constexpr double step = 1e-7;
        more[k] += step;
        less[k] -= step;
        const Six column =
            (joint_force(more, nullptr, &pressed) - joint_force(less, nullptr, &pressed)) /
            (2 * step);
        for (int i = 0; i < 6; ++i)
          if (is_free(i)) (*tangent)(place(i), place(k)) += column[i];
      }
    }
    return r;
  }

  /// Lets the weight come on, by Newton's method in steps of it.
  /// @return  how far the middle has sunk [m]; nothing if it snaps through before all is on
  [[nodiscard]] std::optional<double> sag() {
    q.resize(3 * span);
    for (int b = 0; b < span; ++b) q.segment<3>(3 * b) << b + 0.5, 0, 0;
    double part = 0, step = 0.02;
    while (part < 1) {
      const double next = std::min(1.0, part + step);
      Eigen::VectorXd x = q;
      if (settle(x, next)) {
        q = x;
        part = next;
        step = std::min(0.02, 1.5 * step);
      } else if ((step *= 0.5) < 1e-5) {
        return std::nullopt;
      }
    }
    double lowest = 0;
    for (int b = 0; b < span; ++b) lowest = std::min(lowest, q[3 * b + 1]);
    return -lowest;
  }

 private:
  /// @return  whether it has found where every block is in balance to 1e-8 of its weight
  [[nodiscard]] bool settle(Eigen::VectorXd& x, double part) const {
    Eigen::MatrixXd tangent;
    for (int iteration = 0; iteration < 60; ++iteration) {
      const Eigen::VectorXd r = residual(x, part, &tangent);
      const double size = r.lpNorm<Eigen::Infinity>();
      if (size < 1e-8 * weight) return true;
      const Eigen::VectorXd move = -tangent.partialPivLu().solve(r);
      if (!move.allFinite() || move.lpNorm<Eigen::Infinity>() > 1) return false;
      double share = 1;
      while (share > 0.01 &&
             !(residual(x + share * move, part, nullptr).lpNorm<Eigen::Infinity>() < size))
        share *= 0.5;
      x += share * move;
    }
    return false;
  }
};

}  // namespace voussoir_test
