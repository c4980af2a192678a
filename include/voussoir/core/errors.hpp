// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/message.hpp>

/// On in tests and debug builds: a broken invariant of the toolkit itself, never a user's mistake.
#if defined(VOUSSOIR_ASSERTIONS) || !defined(NDEBUG)
#define VOUSSOIR_ASSERT(condition, text)                                            \
  ((condition) ? static_cast<void>(0)                                               \
               : throw std::logic_error(std::string("voussoir: broken invariant: ") \
                                            .append(text)                           \
                                            .append(" [" #condition "]")))
#else
#define VOUSSOIR_ASSERT(condition, text) static_cast<void>(0)
#endif

namespace voussoir {

/// Data given by the user cannot be used: the message names what, its value and the rule.
class InvalidInput : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A calculation went bad at run time: the message names where and the probable cause.
class NumericalFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Work was refused because it needs more memory than there is: the message has both figures.
class NotEnoughMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Refuses a parameter outside its range; `range` reads like "> 0". Written so that NaN is refused:
/// pass the condition that must hold.
VOUSSOIR_INLINE void require(bool holds, const char* name, double value, const char* range);

/// Tells a law that its values are without units, or in others than SI: `CoulombJoint({1, 1, 0},
/// any_units)`. Values too small to be meant in SI units are then taken too.
struct AnyUnits {};
inline constexpr AnyUnits any_units{};

/// Refuses a quantity so small that it was surely meant in a larger unit: 5 for 5 GPa/m. For
/// quantities that are > 0 already; who has no units says `any_units` to the law.
/// @param unit    of the value, "Pa/m"
/// @param least   the smallest that is plausible
/// @param meant   the larger unit, "GPa/m", and how many of `unit` it is
VOUSSOIR_INLINE void require_plausible(double value, const char* name, const char* unit,
                                       double least, const char* meant, double factor);

/// Refuses an angle outside its range, and says what it is in degrees: radians are wanted.
VOUSSOIR_INLINE void require_angle(bool holds, const char* name, double value, const char* range);

/// The same for an angle that may be low to high [rad].
/// @param name  with what it belongs to: "joint set J1: dip"
VOUSSOIR_INLINE void require_angle(const std::string& name, double angle, double low, double high);

/// Runs `make`; if it refuses its data, the refusal says of what: "block 17: convex polygon: ...".
/// A shape does not know its number, whoever builds it from a list does.
///
///   blocks.push_back(naming("block " + std::to_string(k), [&] { return ConvexPolygon(...); }));
template <class Make>
auto naming(const std::string& what, Make&& make) {
  try {
    return make();
  } catch (const InvalidInput& error) {
    throw InvalidInput(message({what, ": ", error.what()}));
  }
}

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE void require(bool holds, const char* name, double value, const char* range) {
  if (holds) return;
  throw InvalidInput(message({name, " = ", value, ": must be ", range}));
}

VOUSSOIR_INLINE void require_plausible(double value, const char* name, const char* unit,
                                       double least, const char* meant, double factor) {
  if (value >= least) return;
  throw InvalidInput(
      message({name, " = ", value, " ", unit, ": must be >= ", least, " ", unit, "; did you mean ",
               value, " ", meant, " = ", factor * value, " ", unit, "?"}));
}

VOUSSOIR_INLINE void require_angle(bool holds, const char* name, double value, const char* range) {
  if (holds) return;
  constexpr double degree = 3.14159265358979323846 / 180;
  std::string text =
      message({name, " = ", value, " rad (", value / degree, " deg): must be ", range});
  if (value >= 2 && value <= 360)
    text += message({"; did you mean ", value, " deg = ", value * degree, " rad?"});
  throw InvalidInput(text);
}

VOUSSOIR_INLINE void require_angle(const std::string& name, double angle, double low, double high) {
  if (angle >= low && angle <= high) return;
  constexpr double degree = 3.14159265358979323846 / 180;
  const std::string range =
      message({low, " to ", high, " rad (", low / degree, " to ", high / degree, " deg)"});
  require_angle(false, name.c_str(), angle, range.c_str());
}

#endif

}  // namespace voussoir
