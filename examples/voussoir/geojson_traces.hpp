// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <string>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/trace_file.hpp>

namespace voussoir::program {

/// Reads mapped joints from GeoJSON: its line strings, in metres on the site grid. The joint set of
/// a trace is its property `set` (or `joint_set`, `layer`, `name`): a name or a number, counted as
/// in a file of traces.
/// @param site_origin  taken off all points [m]
/// @throws InvalidInput  no GeoJSON; degrees, by its reference system or its coordinates; a line
///                       without length or points that are no numbers; a set that is not there; no
///                       line at all
[[nodiscard]] TraceFile geojson_traces(std::istream& in, const std::string& name,
                                       const Vec2& site_origin, const TraceFileLimits& limits);

}  // namespace voussoir::program
