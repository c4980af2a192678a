// SPDX-License-Identifier: MIT
#pragma once

#include "analyses.hpp"

namespace voussoir::paper {

/// The program of one analysis: computes it, prints what it found beside what the paper says, and
/// writes its plots.  paper_<name> [--samples N] [--threads N] [--out FOLDER]
/// @return  exit status
int run_program(int argc, char** argv, const char* name, Analysis analysis);

}  // namespace voussoir::paper
