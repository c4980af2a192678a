// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>

namespace voussoir {

/// Two numbers side by side, on which every operation acts as on each alone, bit for bit: what a
/// register of any 64-bit processor holds.
///
/// Compilers find such pairs by themselves in loops over many points; over the two or four of a
/// contact they lose more in front of the loop and behind it than they win.
class Lanes {
 public:
#if defined(__GNUC__)
  using Register = double __attribute__((vector_size(16)));
#else
  struct Register {
    double entries[2];
    [[nodiscard]] double operator[](int k) const { return entries[k]; }
  };
#endif

  Lanes() = default;
  Lanes(double first, double second) : both_{first, second} {}
  explicit Lanes(double same) : both_{same, same} {}
  [[nodiscard]] static Lanes load(const double* from) { return {from[0], from[1]}; }
  void store(double* to) const { std::memcpy(to, &both_, sizeof both_); }

  [[nodiscard]] double operator[](int lane) const { return both_[lane]; }
  [[nodiscard]] double sum() const { return both_[0] + both_[1]; }

#if defined(__GNUC__)
  friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.both_ + b.both_); }
  friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.both_ - b.both_); }
  friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.both_ * b.both_); }
  friend Lanes operator-(Lanes a) { return Lanes(-a.both_); }
  /// std::max(a, b) and std::min(a, b): a where neither is larger, and where one is not a number.
  friend Lanes larger(Lanes a, Lanes b) { return Lanes(a.both_ < b.both_ ? b.both_ : a.both_); }
  friend Lanes smaller(Lanes a, Lanes b) { return Lanes(b.both_ < a.both_ ? b.both_ : a.both_); }
#else
  friend Lanes operator+(Lanes a, Lanes b) { return {a[0] + b[0], a[1] + b[1]}; }
  friend Lanes operator-(Lanes a, Lanes b) { return {a[0] - b[0], a[1] - b[1]}; }
  friend Lanes operator*(Lanes a, Lanes b) { return {a[0] * b[0], a[1] * b[1]}; }
  friend Lanes operator-(Lanes a) { return {-a[0], -a[1]}; }
  friend Lanes larger(Lanes a, Lanes b) {
    return {a[0] < b[0] ? b[0] : a[0], a[1] < b[1] ? b[1] : a[1]};
  }
  friend Lanes smaller(Lanes a, Lanes b) {
    return {b[0] < a[0] ? b[0] : a[0], b[1] < a[1] ? b[1] : a[1]};
  }
#endif
  friend Lanes operator*(double a, Lanes b) { return Lanes(a) * b; }
  friend Lanes operator*(Lanes a, double b) { return a * Lanes(b); }
  friend Lanes root_of(Lanes a) { return {std::sqrt(a[0]), std::sqrt(a[1])}; }
  Lanes& operator+=(Lanes other) { return *this = *this + other; }

 private:
#if defined(__GNUC__)
  explicit Lanes(Register both) : both_(both) {}
#endif
  Register both_;
};

}  // namespace voussoir
