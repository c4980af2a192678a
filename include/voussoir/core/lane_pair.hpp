// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

namespace voussoir {

/// Two numbers side by side, on which every operation acts as on each alone, bit for bit: what a
/// register of any 64-bit processor holds.
///
/// Compilers find such pairs by themselves in loops over many points; over the two of a contact
/// they lose more in front of the loop and behind it than they win. (`detail::VectorLanes` has
/// four, and two registers where these hold two.)
class LanePair {
 public:
#if defined(__GNUC__)
  using Register = double __attribute__((vector_size(16)));
#else
  struct Register {
    double entries[2];
    [[nodiscard]] double operator[](int k) const { return entries[k]; }
  };
#endif

  LanePair() = default;
  LanePair(double first, double second) : both_{first, second} {}
  explicit LanePair(double same) : both_{same, same} {}
  [[nodiscard]] static LanePair load(const double* from) { return {from[0], from[1]}; }
  void store(double* to) const { std::memcpy(to, &both_, sizeof both_); }

  [[nodiscard]] double operator[](int lane) const { return both_[lane]; }
  [[nodiscard]] double sum() const { return both_[0] + both_[1]; }

#if defined(__GNUC__)
  friend LanePair operator+(LanePair a, LanePair b) { return LanePair(a.both_ + b.both_); }
  friend LanePair operator-(LanePair a, LanePair b) { return LanePair(a.both_ - b.both_); }
  friend LanePair operator*(LanePair a, LanePair b) { return LanePair(a.both_ * b.both_); }
  friend LanePair operator-(LanePair a) { return LanePair(-a.both_); }
  /// std::max(a, b) and std::min(a, b): a where neither is larger, and where one is not a number.
  friend LanePair larger(LanePair a, LanePair b) {
    return LanePair(a.both_ < b.both_ ? b.both_ : a.both_);
  }
  friend LanePair smaller(LanePair a, LanePair b) {
    return LanePair(b.both_ < a.both_ ? b.both_ : a.both_);
  }
#else
  friend LanePair operator+(LanePair a, LanePair b) { return {a[0] + b[0], a[1] + b[1]}; }
  friend LanePair operator-(LanePair a, LanePair b) { return {a[0] - b[0], a[1] - b[1]}; }
  friend LanePair operator*(LanePair a, LanePair b) { return {a[0] * b[0], a[1] * b[1]}; }
  friend LanePair operator-(LanePair a) { return {-a[0], -a[1]}; }
  friend LanePair larger(LanePair a, LanePair b) {
    return {a[0] < b[0] ? b[0] : a[0], a[1] < b[1] ? b[1] : a[1]};
  }
  friend LanePair smaller(LanePair a, LanePair b) {
    return {b[0] < a[0] ? b[0] : a[0], b[1] < a[1] ? b[1] : a[1]};
  }
#endif
  friend LanePair operator*(double a, LanePair b) { return LanePair(a) * b; }
  friend LanePair operator*(LanePair a, double b) { return a * LanePair(b); }
  LanePair& operator+=(LanePair other) { return *this = *this + other; }

 private:
#if defined(__GNUC__)
  explicit LanePair(Register both) : both_(both) {}
#endif
  Register both_;
};

}  // namespace voussoir
