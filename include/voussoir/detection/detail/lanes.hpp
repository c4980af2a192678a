// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace voussoir {

/// Coordinates are handled in groups of so many numbers: one vector register of AVX, two of SSE2.
inline constexpr std::size_t lane_count = 4;

namespace detail {

/// Four numbers that are worked on at once, by loops over plain numbers: on any machine, and what
/// `VectorLanes` is checked against.
class PlainLanes {
 public:
  static PlainLanes load(const double* from) {
    return each([from](std::size_t k) { return from[k]; });
  }
  static PlainLanes all(double value) {
    return each([value](std::size_t) { return value; });
  }
  friend PlainLanes operator+(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return a.v_[k] + b.v_[k]; });
  }
  friend PlainLanes operator-(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return a.v_[k] - b.v_[k]; });
  }
  friend PlainLanes operator*(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return a.v_[k] * b.v_[k]; });
  }
  friend PlainLanes min(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return std::min(a.v_[k], b.v_[k]); });
  }
  friend PlainLanes max(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return std::max(a.v_[k], b.v_[k]); });
  }
  friend PlainLanes operator/(const PlainLanes& a, const PlainLanes& b) {
    return each([&](std::size_t k) { return a.v_[k] / b.v_[k]; });
  }
  /// Where `sign` is positive `a`, elsewhere `b`.
  friend PlainLanes where_positive(const PlainLanes& sign, const PlainLanes& a,
                                   const PlainLanes& b) {
    return each([&](std::size_t k) { return sign.v_[k] > 0 ? a.v_[k] : b.v_[k]; });
  }
  [[nodiscard]] double sum() const { return (v_[0] + v_[2]) + (v_[1] + v_[3]); }
  [[nodiscard]] double smallest() const { return *std::min_element(v_.begin(), v_.end()); }
  [[nodiscard]] double largest() const { return *std::max_element(v_.begin(), v_.end()); }
  void store(double* to) const { std::copy(v_.begin(), v_.end(), to); }

 private:
  template <class F>
  static PlainLanes each(F&& f) {
    PlainLanes lanes;
    for (std::size_t k = 0; k < 4; ++k) lanes.v_[k] = f(k);
    return lanes;
  }
  std::array<double, 4> v_;
};

#if defined(__GNUC__)
/// The same in vector registers, by the vector types of g++ and clang++: one register where the
/// compiler may use AVX, else two. Nothing is fused or reordered, so the bits are those of
/// `PlainLanes`. (Eigen's arrays would do, but g++ 12 copies them through integer registers: four
/// times slower here.)
template <class Register>
class RegisterLanes {
  static constexpr std::size_t width = sizeof(Register) / sizeof(double);
  static constexpr bool two = width < lane_count;

 public:
  static RegisterLanes load(const double* from) {
    RegisterLanes lanes;
    std::memcpy(&lanes.first_, from, sizeof(Register));
    if constexpr (two) std::memcpy(&lanes.second_, from + width, sizeof(Register));
    return lanes;
  }
  static RegisterLanes all(double value) {
    RegisterLanes lanes;
    if constexpr (two) {
      lanes.first_ = lanes.second_ = Register{value, value};
    } else {
      lanes.first_ = Register{value, value, value, value};
    }
    return lanes;
  }
  friend RegisterLanes operator+(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return x + y; });
  }
  friend RegisterLanes operator-(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return x - y; });
  }
  friend RegisterLanes operator*(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return x * y; });
  }
  friend RegisterLanes min(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return y < x ? y : x; });
  }
  friend RegisterLanes max(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return x < y ? y : x; });
  }
  friend RegisterLanes operator/(const RegisterLanes& a, const RegisterLanes& b) {
    return each(a, b, [](Register x, Register y) { return x / y; });
  }
  friend RegisterLanes where_positive(const RegisterLanes& sign, const RegisterLanes& a,
                                      const RegisterLanes& b) {
    RegisterLanes lanes;
    lanes.first_ = sign.first_ > 0 ? a.first_ : b.first_;
    if constexpr (two) lanes.second_ = sign.second_ > 0 ? a.second_ : b.second_;
    return lanes;
  }
  /// Even and odd lanes first, as two registers are added.
  [[nodiscard]] double sum() const {
    if constexpr (two) {
      const Register both = first_ + second_;
      return both[0] + both[1];
    } else {
      return (first_[0] + first_[2]) + (first_[1] + first_[3]);
    }
  }
  [[nodiscard]] double smallest() const {
    if constexpr (two) {
      const Register both = second_ < first_ ? second_ : first_;
      return std::min(both[0], both[1]);
    } else {
      const Register swapped = __builtin_shufflevector(first_, first_, 2, 3, 0, 1);
      const Register both = swapped < first_ ? swapped : first_;
      return std::min(both[0], both[1]);
    }
  }
  [[nodiscard]] double largest() const {
    if constexpr (two) {
      const Register both = first_ < second_ ? second_ : first_;
      return std::max(both[0], both[1]);
    } else {
      const Register swapped = __builtin_shufflevector(first_, first_, 2, 3, 0, 1);
      const Register both = first_ < swapped ? swapped : first_;
      return std::max(both[0], both[1]);
    }
  }
  void store(double* to) const {
    std::memcpy(to, &first_, sizeof(Register));
    if constexpr (two) std::memcpy(to + width, &second_, sizeof(Register));
  }

 private:
  struct Nothing {};
  template <class F>
  static RegisterLanes each(const RegisterLanes& a, const RegisterLanes& b, F f) {
    RegisterLanes lanes;
    lanes.first_ = f(a.first_, b.first_);
    if constexpr (two) lanes.second_ = f(a.second_, b.second_);
    return lanes;
  }
  Register first_;
  [[no_unique_address]] std::conditional_t<two, Register, Nothing> second_;
};
#if defined(__AVX__)
using VectorLanes = RegisterLanes<double __attribute__((vector_size(32)))>;
#else
using VectorLanes = RegisterLanes<double __attribute__((vector_size(16)))>;
#endif
#else
using VectorLanes = PlainLanes;
#endif

}  // namespace detail
}  // namespace voussoir
