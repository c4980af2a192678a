// SPDX-License-Identifier: MIT
#pragma once

/// As core/bodies.hpp, for design/: its functions need Boost, and have a library of their own,
/// voussoir::design, beside voussoir::compiled.
#ifndef VOUSSOIR_COMPILED
#define VOUSSOIR_DESIGN_INLINE inline
#define VOUSSOIR_DESIGN_BODIES 1
#else
#define VOUSSOIR_DESIGN_INLINE
#ifdef VOUSSOIR_DESIGN_SOURCE
#define VOUSSOIR_DESIGN_BODIES 1
#else
#define VOUSSOIR_DESIGN_BODIES 0
#endif
#endif
