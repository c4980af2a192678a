// expect: contact detector: its `Pair` needs `Contact<Dim> facing_contact(a, b, Memory&, double reach)`
// SPDX-License-Identifier: MIT
// Enough for pairs of shapes, not for a model that updates its contacts.
#include <voussoir/detection/contact_search.hpp>

namespace {

using namespace voussoir;

struct PairsOnly {
  using role = roles::ContactDetector;
  static constexpr const char* name = "PairsOnly";
  template <int Dim>
  struct Pair {
    struct Memory {};
    explicit Pair(const PlacedShapes<Dim>&) {}
    static bool overlap(std::size_t, std::size_t, Memory&) { return false; }
    static double separation(std::size_t, std::size_t, Memory&) { return 0; }
    static Contact<Dim> contact(std::size_t, std::size_t, Memory&, double) { return {}; }
  };
};

}  // namespace

template class voussoir::ContactSearch<PairsOnly, 2>;
