// SPDX-License-Identifier: MIT
#pragma once
// What the fuzz targets read their input with, and how they say what is wrong.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace voussoir_test {

/// Numbers from the bytes that the fuzzer makes up; zeros when they run out.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  std::uint8_t byte() { return next_ == end_ ? std::uint8_t{0} : *next_++; }
  int below(int count) { return byte() % count; }
  bool flag() { return byte() % 2 != 0; }

  /// A multiple of 1/16 from -8 to 7.94: few bits, so that coincidences are common.
  double coarse() { return (byte() - 128) / 16.0; }
  /// 0, or 1e-1 to 1e-14 of either sign.
  double tiny() {
    const int b = byte();
    return b % 2 == 0 ? 0.0 : (b % 4 == 1 ? 1 : -1) * std::pow(10.0, -1 - b / 4 % 14);
  }
  /// What no calculation can use, once in many times.
  double maybe_wrong(double value) {
    switch (byte()) {
      case 251:
        return std::numeric_limits<double>::quiet_NaN();
      case 252:
        return std::numeric_limits<double>::infinity();
      case 253:
        return -1e300;
      default:
        return value;
    }
  }

 private:
  const std::uint8_t *next_, *end_;
};

/// Stops the fuzzer with a sentence where something that must hold does not.
inline void must(bool holds, const char* what, double value = 0, double bound = 0) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s (%.17g, bound %.17g)\n", what, value, bound);
  std::abort();
}
inline void must_be_below(double value, double bound, const char* what) {
  must(value <= bound, what, value, bound);  // NaN is not
}

}  // namespace voussoir_test
