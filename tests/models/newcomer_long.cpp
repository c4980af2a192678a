// SPDX-License-Identifier: MIT
// The laws of docs/write-your-own.md, word for word: one that describes itself and one that does
// not.
#include <write_your_own.hpp>

#include "models/every_model.hpp"

namespace every_model {

template <>
inline PattonJoint law() {
  return PattonJoint({5e9, 5e8, 35 * degree, 10 * degree, 1e5});
}
template <>
inline FrictionBolt law() {
  return FrictionBolt({2e8, 1e4});
}

}  // namespace every_model

namespace newcomer_long {

using namespace every_model;

TEST_SUITE("models/newcomer_long") {
  TEST_CASE("PattonJoint and FrictionBolt") {
    const Row row = in_all_settings<PattonJoint, FrictionBolt>();
    check_yielded(row);  // slid at their grip
    row.print();
    in_all_settings<FrictionBolt, PattonJoint>().print();
  }
}

}  // namespace newcomer_long
