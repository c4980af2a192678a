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

/// Templates of which the library holds the common instances: a header that includes this one ends
/// with a list of them under `#ifdef VOUSSOIR_COMPILED`. The library's own sources (cmake/compiled)
/// define these words as plain `template`.
#ifndef VOUSSOIR_PLANAR_TEMPLATE
#define VOUSSOIR_PLANAR_TEMPLATE extern template
#endif
#ifndef VOUSSOIR_SPATIAL_TEMPLATE
#define VOUSSOIR_SPATIAL_TEMPLATE extern template
#endif
