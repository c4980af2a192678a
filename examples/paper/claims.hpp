// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace voussoir::paper {

/// What the paper does with a statement.
enum class ClaimKind {
  input,         ///< a value or set-up
  procedure,     ///< how it is done
  quantitative,  ///< a number or formula
  qualitative,   ///< a trend or an ordering
  derived        ///< follows from the print by arithmetic
};
[[nodiscard]] const char* to_string(ClaimKind kind);

/// A statement of Boon, Houlsby & Utili (2015), in our words, and how it is to be tested: written
/// down before the toolkit was, with tolerances that are not the paper's.
struct Claim {
  const char* id;  ///< "PF-042"
  const char* where;
  ClaimKind kind;
  const char* statement;
  const char* test;
};
[[nodiscard]] const std::vector<Claim>& claims();

/// Whether a claim states what the paper has put in or how it was carried out: a program that does
/// the same agrees with it by its make, and can differ only by a fault.
[[nodiscard]] inline bool restates_the_input(const Claim& claim) {
  return claim.kind == ClaimKind::input || claim.kind == ClaimKind::procedure ||
         claim.kind == ClaimKind::derived;
}

/// Claims first, ..., last of the list, counted from 1.
struct ClaimChapter {
  const char* title;
  int first, last;
};
[[nodiscard]] const std::vector<ClaimChapter>& claim_chapters();

}  // namespace voussoir::paper
