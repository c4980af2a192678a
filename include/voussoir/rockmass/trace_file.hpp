// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/rockmass/detail/trace_reader.hpp>

namespace voussoir {

/// Reads mapped joints from a table of text: a row for each trace, `x1,y1,x2,y2` and optionally a
/// set; or a row for each point of a polyline, `id,x,y`, those of an id one after the other; or WKT
/// lines. In metres on the site grid, x to the right and y up, or in the unit that the header says.
///
/// Fields are separated by tabs, semicolons, commas or blanks, may be quoted, and numbers may have
/// a decimal comma where fields are not separated by commas. A header in any case and order chooses
/// the columns; without one the order is that above. Empty lines, those that start with #, //, %, !
/// or --, and what stands before the header are skipped. UTF-8 or UTF-16; lines end in LF, CR LF or
/// CR. Numbers are taken relative to the site origin to the digits that they are written with: the
/// same map on another site grid gives the same traces, bit for bit.
///
/// @param name      of the source, for messages
/// @param progress  asked now and then whether to go on
/// @throws InvalidInput  the first five faults at once, each with line, value and what is accepted:
///                       wrong number of fields, no finite number, zero length, a set that is not
///                       there, an id that comes again, units that are mixed; no trace at all, more
///                       than `limits`; a format that is not read, by its name
/// @throws Stopped
[[nodiscard]] VOUSSOIR_INLINE TraceFile read_traces(std::istream& in, const std::string& name,
                                                    const Vec2& site_origin = zeros<Vec2>(),
                                                    const TraceFileLimits& limits = {},
                                                    const Progress& progress = {});

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE TraceFile read_traces(std::istream& in, const std::string& name,
                                      const Vec2& site_origin, const TraceFileLimits& limits,
                                      const Progress& progress) {
  StopCheck stop(progress);
  return detail::TraceReader(in, name, site_origin, limits, stop).read();
}

#endif

}  // namespace voussoir
