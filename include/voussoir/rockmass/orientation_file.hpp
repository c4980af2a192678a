// SPDX-License-Identifier: MIT
#pragma once

#include <istream>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/rockmass/detail/orientation_reader.hpp>

namespace voussoir {

/// Reads joints that were measured with a compass from a table of text: a row for each plane, with
/// its dip and dip direction, or its strike, or trend and plunge of its pole, and optionally a set
/// and a weight. As Dips, Stereonet, FieldMove and spreadsheets export it.
///
/// A header in any case and order chooses the columns; columns that it does not know, and what
/// stands before it, are skipped and told in the notes. A strike by azimuth needs its rule, RHR, or
/// letters of the side in the dip, 60SE, as half of the trade has the dip to its left. Without a
/// header there are two columns, and the one with values above 90 is the dip direction. Angles are
/// in degrees, or in the unit that the header says (deg, rad, gon); "grad" is refused, which is a
/// degree in German and a gon in English. Azimuths are taken as they stand: no declination is
/// added.
///
/// Quadrant notation, N45E, N 45 E or N45°E of an azimuth and 60SE or 60 SE of a dip, is read row
/// by row beside numbers, in degrees. A strike in it is a line, also N, E, NS or EW: the letters of
/// the dip choose the side, and the dip direction is across the strike. Refused are a dip without
/// letters, unless it is 0 or 90, and letters within 22.5 degrees of the strike. Strike and dip may
/// stand in one column, named Orientation or the like, as N45E/60SE, or with a comma or a blank
/// between; two numbers in one column need its name to say which is the dip, "Dip direction/Dip".
/// Of a pole, in the
/// lower hemisphere, the plane has dip = 90 - plunge and dip direction = trend + 180; a trend and a
/// plunge that are not told to be of a pole may be of a lineation and are refused.
///
/// Fields are separated by tabs, semicolons, commas, | or blanks, may be quoted, and numbers may
/// have a decimal comma where fields are not separated by commas. Empty lines and those that start
/// with #, //, %, !, * or -- are skipped. UTF-8 or UTF-16; lines end in LF, CR LF or CR. A set is a
/// name or a number; an empty field, "-", "none" or -1 is none.
///
/// @param name      of the source, for messages
/// @param progress  asked now and then whether to go on
/// @throws InvalidInput  the first five faults at once, each with line, value and what is accepted:
///                       wrong number of fields, no finite number, a dip outside 0 to 90 degrees, a
///                       direction outside 0 to 360, a weight that is not > 0; a header that does
///                       not name a plane or names a thing twice; no plane at all, more than
///                       `limits`; a format that is not read, by its name
/// @throws Stopped
[[nodiscard]] VOUSSOIR_INLINE OrientationFile
read_orientations(std::istream& in, const std::string& name,
                  const OrientationFileLimits& limits = {}, const Progress& progress = {});

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE OrientationFile read_orientations(std::istream& in, const std::string& name,
                                                  const OrientationFileLimits& limits,
                                                  const Progress& progress) {
  StopCheck stop(progress);
  return detail::OrientationReader(in, name, limits, stop).read();
}

#endif

}  // namespace voussoir
