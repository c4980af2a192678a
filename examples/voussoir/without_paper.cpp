// SPDX-License-Identifier: MIT
// Takes the place of the verbs `paper` and `verify` in a program that was built without them.
#include "verbs.hpp"

namespace voussoir::program {

const bool has_paper = false;

namespace {
int say_how_to_get(const std::string& verb) {
  std::cerr << "error: this program was built without `" << verb
            << "`\n   = accepted: a program with it, by `cmake --workflow --preset release` in the "
               "project's folder: build/release/voussoir "
            << verb << "\n";
  return bad_input;
}
}  // namespace

int paper_verb(const Options&, int, const std::string&) { return say_how_to_get("paper"); }
int verify_verb(const Options&) { return say_how_to_get("verify"); }

}  // namespace voussoir::program
