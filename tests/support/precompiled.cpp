// SPDX-License-Identifier: MIT
// Empty: the source for which the tests' common headers are precompiled (main.cpp must not use
// them).
