// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <voussoir/core/bodies.hpp>

namespace voussoir {

/// Exponents of a physical dimension. The angle counts as a dimension of its own, so that "35 deg"
/// cannot pass for the plain number 0.61; percent is dimensionless.
struct Dimension {
  int mass = 0;    ///< exponent of kg
  int length = 0;  ///< exponent of m
  int time = 0;    ///< exponent of s
  int angle = 0;   ///< exponent of rad
  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

/// The dimensions that ground and support are described in.
namespace dimension {
inline constexpr Dimension number{};
inline constexpr Dimension mass{1, 0, 0, 0};                  ///< kg
inline constexpr Dimension length{0, 1, 0, 0};                ///< m
inline constexpr Dimension time{0, 0, 1, 0};                  ///< s
inline constexpr Dimension angle{0, 0, 0, 1};                 ///< rad
inline constexpr Dimension area{0, 2, 0, 0};                  ///< m^2
inline constexpr Dimension section_modulus{0, 3, 0, 0};       ///< of a steel section, m^3
inline constexpr Dimension second_moment{0, 4, 0, 0};         ///< of a steel section, m^4
inline constexpr Dimension intensity{0, -2, 0, 0};            ///< joint centres per area, 1/m^2
inline constexpr Dimension area_per_volume{0, -1, 0, 0};      ///< P32 of joints, m^2/m^3
inline constexpr Dimension number_per_volume{0, -3, 0, 0};    ///< P30 of joints, 1/m^3
inline constexpr Dimension velocity{0, 1, -1, 0};             ///< m/s
inline constexpr Dimension acceleration{0, 1, -2, 0};         ///< m/s^2
inline constexpr Dimension density{1, -3, 0, 0};              ///< kg/m^3
inline constexpr Dimension force{1, 1, -2, 0};                ///< N
inline constexpr Dimension moment{1, 2, -2, 0};               ///< N m
inline constexpr Dimension stiffness{1, 0, -2, 0};            ///< N/m
inline constexpr Dimension pressure{1, -1, -2, 0};            ///< Pa
inline constexpr Dimension stiffness_per_area{1, -2, -2, 0};  ///< Pa/m
inline constexpr Dimension viscosity_per_area{1, -2, -1, 0};  ///< of joints, Pa s/m
}  // namespace dimension

namespace detail {

/// How a dimension is called, shown in examples and echoed; `echo` rises by size.
struct DimensionWords {
  Dimension dimension;
  std::string_view name;
  std::string_view examples;
  std::array<std::string_view, 4> echo;
};

inline constexpr std::array<DimensionWords, 20> dimension_words{{
    {dimension::number, "a fraction", R"("40 %" or "2.5 %")", {"%"}},
    {dimension::mass, "a mass", R"("250 kg" or "1.2 t")", {"kg", "t"}},
    {dimension::length, "a length", R"("4 m", "10 cm" or "28 mm")", {"mm", "m"}},
    {dimension::time, "a time", R"("0.5 s", "30 d" or "2 a")", {"ms", "s", "h", "d"}},
    {dimension::angle, "an angle", R"("35 deg" or "0.6 rad")", {"deg"}},
    {dimension::area, "an area", R"("0.074 m^2" or "740 cm^2")", {"m^2"}},
    {dimension::section_modulus, "a section modulus", R"("144 cm^3" or "1.44e-4 m^3")", {"cm^3"}},
    {dimension::second_moment, "a second moment", R"("864 cm^4" or "8.64e-6 m^4")", {"cm^4"}},
    {dimension::intensity, "a number per area", R"("1 /m^2" or "0.5 1/m^2")", {"/m^2"}},
    {dimension::number_per_volume, "a number per volume", R"("0.1 /m^3")", {"/m^3"}},
    {dimension::velocity, "a velocity", R"("0.1 m/s" or "5 mm/s")", {"mm/s", "m/s"}},
    {dimension::acceleration, "an acceleration", R"("9.81 m/s^2")", {"m/s^2"}},
    {dimension::area_per_volume, "an area per volume", R"("1.5 m^2/m^3" or "1.5 /m")", {"m^2/m^3"}},
    {dimension::density, "a density", R"("2700 kg/m^3" or "2.7 t/m^3")", {"kg/m^3"}},
    {dimension::force, "a force", R"("500 kN" or "0.5 MN")", {"N", "kN", "MN", "GN"}},
    {dimension::moment, "a moment", R"("120 kN*m" or "0.12 MN*m")", {"N*m", "kN*m", "MN*m"}},
    {dimension::stiffness,
     "a stiffness",
     R"("0.2 GN/m", "200 MN/m" or "2e8 N/m")",
     {"N/m", "kN/m", "MN/m", "GN/m"}},
    {dimension::pressure,
     "a stress",
     R"("662 kPa", "1.2 MPa" or "25 GPa")",
     {"Pa", "kPa", "MPa", "GPa"}},
    {dimension::stiffness_per_area,
     "a stiffness per area",
     R"("5 GPa/m", "5000 MPa/m" or "5e9 Pa/m")",
     {"Pa/m", "kPa/m", "MPa/m", "GPa/m"}},
    {dimension::viscosity_per_area,
     "a viscosity per area",
     R"("20 GPa d/m" or "5 GPa a/m")",
     {"Pa*s/m", "MPa*d/m", "GPa*d/m"}},
}};

inline const DimensionWords* find_words(const Dimension& dimension) {
  for (const DimensionWords& words : dimension_words)
    if (words.dimension == dimension) return &words;
  return nullptr;
}

VOUSSOIR_INLINE std::string base_units(const Dimension& dimension);

}  // namespace detail

/// "a length, such as "4 m", "10 cm" or "28 mm"": what to write for a quantity of this dimension.
[[nodiscard]] inline std::string accepted_examples(const Dimension& dimension) {
  const detail::DimensionWords* words = detail::find_words(dimension);
  if (words == nullptr) return "a quantity in " + detail::base_units(dimension);
  return std::string(words->name) + ", such as " + std::string(words->examples);
}

#if VOUSSOIR_BODIES

namespace detail {

VOUSSOIR_INLINE std::string base_units(const Dimension& dimension) {
  std::string text;
  const auto add = [&](std::string_view symbol, int exponent) {
    if (exponent == 0) return;
    if (!text.empty()) text += '*';
    text += symbol;
    if (exponent != 1) text += "^" + std::to_string(exponent);
  };
  add("kg", dimension.mass);
  add("m", dimension.length);
  add("s", dimension.time);
  add("rad", dimension.angle);
  return text.empty() ? "1" : text;
}

}  // namespace detail

#endif

}  // namespace voussoir
