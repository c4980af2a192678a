// expect: contact search: the detector needs `template <int Dim> class Pair`
// SPDX-License-Identifier: MIT
#include <voussoir/detection/contact_search.hpp>

struct NoPairs {
  using role = voussoir::roles::ContactDetector;
  static constexpr const char* name = "NoPairs";
  template <int Dim>
  struct Pair {
    struct Memory {};
  };
};

int main() {
  return voussoir::ContactSearch<NoPairs, 2>(0, 0).neighbours().pairs().empty() ? 0 : 1;
}
