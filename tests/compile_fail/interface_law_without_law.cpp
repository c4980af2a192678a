// expect: interface law: add `using Law = ...`, the contact law between rock and lining
// SPDX-License-Identifier: MIT
// The role alone does not say by which law rock touches the lining.
#include <voussoir/solver/composition.hpp>

namespace {

struct Nothing {
  using role = voussoir::roles::InterfaceLaw;
  static constexpr const char* name = "Nothing";
};

}  // namespace

template struct voussoir::Composition<Nothing>;
