// expect: a sentence from the compiler
// SPDX-License-Identifier: MIT
// Proves that a refusal is recognised by its sentence.
#include <voussoir/core/version.hpp>

static_assert(voussoir::version.empty(), "a sentence from the compiler");
