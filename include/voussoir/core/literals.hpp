// SPDX-License-Identifier: MIT
#pragma once

/// Quantities with their unit, for C++ programs: `using namespace voussoir::literals;` then
/// `JointSet{.dip = 75_deg, .spacing = 50_cm}`, `CoulombJoint({5_GPa_per_m, 0.5_GPa_per_m,
/// 35_deg})`.
///
/// Each is a double in SI units (angles in radians), the very one that the text "75 deg" gives in
/// an input file. There is no checking of dimensions: `75_deg` where a length is due compiles.
namespace voussoir::literals {

// One unit: for 5_GPa and 0.5_GPa. Multiplied first, then divided, so that 90_deg is pi / 2.
#define VOUSSOIR_UNIT(suffix, factor, divisor)                               \
  [[nodiscard]] constexpr double operator""_##suffix(long double v) {        \
    return static_cast<double>(v) * (factor) / (divisor);                    \
  }                                                                          \
  [[nodiscard]] constexpr double operator""_##suffix(unsigned long long v) { \
    return static_cast<double>(v) * (factor) / (divisor);                    \
  }

VOUSSOIR_UNIT(deg, 3.141592653589793, 180.0)
VOUSSOIR_UNIT(rad, 1.0, 1.0)
VOUSSOIR_UNIT(percent, 1.0, 100.0)

VOUSSOIR_UNIT(mm, 1.0, 1000.0)
VOUSSOIR_UNIT(cm, 1.0, 100.0)
VOUSSOIR_UNIT(m, 1.0, 1.0)
VOUSSOIR_UNIT(km, 1000.0, 1.0)
VOUSSOIR_UNIT(m2, 1.0, 1.0)
VOUSSOIR_UNIT(per_m, 1.0, 1.0)
VOUSSOIR_UNIT(per_m2, 1.0, 1.0)
VOUSSOIR_UNIT(per_m3, 1.0, 1.0)

VOUSSOIR_UNIT(ms, 1.0, 1000.0)
VOUSSOIR_UNIT(s, 1.0, 1.0)
VOUSSOIR_UNIT(m_per_s2, 1.0, 1.0)

VOUSSOIR_UNIT(kg_per_m3, 1.0, 1.0)
VOUSSOIR_UNIT(t_per_m3, 1000.0, 1.0)

VOUSSOIR_UNIT(N, 1.0, 1.0)
VOUSSOIR_UNIT(kN, 1e3, 1.0)
VOUSSOIR_UNIT(MN, 1e6, 1.0)
VOUSSOIR_UNIT(N_per_m, 1.0, 1.0)
VOUSSOIR_UNIT(kN_per_m, 1e3, 1.0)
VOUSSOIR_UNIT(MN_per_m, 1e6, 1.0)
VOUSSOIR_UNIT(GN_per_m, 1e9, 1.0)

VOUSSOIR_UNIT(Pa, 1.0, 1.0)
VOUSSOIR_UNIT(kPa, 1e3, 1.0)
VOUSSOIR_UNIT(MPa, 1e6, 1.0)
VOUSSOIR_UNIT(GPa, 1e9, 1.0)
VOUSSOIR_UNIT(Pa_per_m, 1.0, 1.0)
VOUSSOIR_UNIT(kPa_per_m, 1e3, 1.0)
VOUSSOIR_UNIT(MPa_per_m, 1e6, 1.0)
VOUSSOIR_UNIT(GPa_per_m, 1e9, 1.0)

#undef VOUSSOIR_UNIT

}  // namespace voussoir::literals
