// SPDX-License-Identifier: MIT
#pragma once

/// Where the longer functions that are no templates have their bodies. Header-only, the default: in
/// the header, inline. With the library voussoir::compiled (VOUSSOIR_COMPILED): in the one source
/// of it that defines VOUSSOIR_COMPILED_BODIES, and whoever includes the header reads declarations
/// only. A header writes
///
///   VOUSSOIR_INLINE double area(const Outline& outline);
///   #if VOUSSOIR_BODIES
///   VOUSSOIR_INLINE double area(const Outline& outline) { ... }
///   #endif
#ifndef VOUSSOIR_COMPILED
#define VOUSSOIR_INLINE inline
#define VOUSSOIR_BODIES 1
#else
#define VOUSSOIR_INLINE
#ifdef VOUSSOIR_COMPILED_BODIES
#define VOUSSOIR_BODIES 1
#else
#define VOUSSOIR_BODIES 0
#endif
#endif
