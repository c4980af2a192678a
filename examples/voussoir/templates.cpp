// SPDX-License-Identifier: MIT
#include "templates.hpp"

#include <stdexcept>

namespace voussoir::program {

namespace {

// The parts of which the files are made; a part stands in several of them.

constexpr std::string_view head =
    R"(# Every quantity has its unit, in quotes. x is to the right, y up, from the tunnel centre; angles run
# anticlockwise from the right-hand springing, so 90 deg is the crown. All keys: docs/input.md.
)";

constexpr std::string_view section = R"(
[model]
width = "60 m"            # of the whole domain, the tunnel in its middle
below_invert = "20 m"     # ground under the invert
seed = 1                  # another number draws other joints of the same sets
)";

constexpr std::string_view circle = R"(
[tunnel]
shape = "circle"
diameter = "8 m"
cover = "25 m"            # crown to ground surface
)";

constexpr std::string_view horseshoe = R"(
[tunnel]
shape = "horseshoe"
width = "9 m"             # between the walls, = diameter of the half circle of its roof
wall_height = "4 m"       # floor to springing
cover = "25 m"            # crown to ground surface
)";

constexpr std::string_view d_shape = R"(
[tunnel]
shape = "polygon"         # a drift: walls, and a roof in seven pieces
vertices = [
  ["-2.5 m", "-2.5 m"], ["2.5 m", "-2.5 m"], ["2.5 m", "1 m"], ["2.1 m", "1.8 m"],
  ["1.4 m", "2.3 m"], ["0.5 m", "2.5 m"], ["-0.5 m", "2.5 m"], ["-1.4 m", "2.3 m"],
  ["-2.1 m", "1.8 m"], ["-2.5 m", "1 m"]]
cover = "25 m"            # crown to ground surface
)";

constexpr std::string_view cavern = R"(
[tunnel]
shape = "polygon"         # a cavern of 18 m by 20 m, its roof an arc in pieces
vertices = [
  ["-9 m", "-12 m"], ["9 m", "-12 m"], ["9 m", "3 m"], ["7.8 m", "4.8 m"], ["6 m", "6.4 m"],
  ["3.2 m", "7.6 m"], ["0 m", "8 m"], ["-3.2 m", "7.6 m"], ["-6 m", "6.4 m"],
  ["-7.8 m", "4.8 m"], ["-9 m", "3 m"]]
cover = "40 m"            # crown to ground surface
)";

constexpr std::string_view rock = R"(
[rock]
density = "2700 kg/m^3"

[stress]
K0 = 0.8                  # horizontal / vertical stress in situ
surcharge = "0 kPa"       # on the ground surface
)";

constexpr std::string_view section_joints = R"(
[[joint_set]]
name = "bedding"
dip = "20 deg"
dip_direction = "E"       # down to the right; with tunnel.trend an azimuth such as "135 deg"
sd = "2 deg"              # standard deviation of the dip
spacing = "1.6 m"

[[joint_set]]
name = "J1"
dip = "75 deg"
dip_direction = "W"       # down to the left
sd = "4 deg"
spacing = "2 m"
)";

constexpr std::string_view surveyed_joints = R"(
# Of a table of compass readings beside this file: the key below, and neither dip, dip_direction nor
# K in the sets whose names are in its set column.
#[joints]
#orientations = "joints.csv"

[[joint_set]]             # dip and dip direction as a compass reads them
name = "bedding"
dip = "20 deg"
dip_direction = "130 deg" # azimuth
K = 300                   # of Fisher's distribution: about 3 deg to either side
spacing = "2.5 m"

[[joint_set]]
name = "J1"
dip = "75 deg"
dip_direction = "310 deg"
K = 200
spacing = "3 m"

[[joint_set]]
name = "J2"
dip = "80 deg"
dip_direction = "40 deg"
K = 200
spacing = "3 m"
)";

constexpr std::string_view mechanics = R"(
[joint]                   # of all joints; a [[joint_set]] may have its own
law = "coulomb"           # or "mohr-coulomb", "barton-bandis"
kn = "5 GPa/m"            # normal stiffness per area
ks = "0.5 GPa/m"          # shear stiffness per area
friction = "38 deg"

[blocks]
min_inscribed_radius = "0.3 m"  # smaller blocks are not cut
)";

constexpr std::string_view bolts = R"(
[support.bolts]
length = "4 m"
spacing = "1.5 m"         # along the wall; an angle such as "15 deg" does as well
arc = ["0 deg", "180 deg"]
out_of_plane = "1.5 m"    # along the tunnel
stiffness = "0.2 GN/m"    # of one bolt across one joint
yield_force = "250 kN"
)";

constexpr std::string_view lining = R"(
[support.lining]
thickness = "15 cm"
E = "20 GPa"
interface = { kn = "5 GPa/m", friction = "35 deg" }  # between rock and lining
)";

constexpr std::string_view stages = R"(
[[round]]
name = "heading"
above = "-0.5 m"          # of the springing
wall_traction = "40 %"    # of the in-situ traction left on the wall: the face is near

[[round]]
name = "bolts in the heading"
excavate = "nothing"
wall_traction = "20 %"
install = ["bolts"]

[[round]]
name = "bench"
below = "-0.5 m"
wall_traction = "20 %"

[[round]]
name = "shotcrete"
excavate = "nothing"
install = ["lining"]
)";

constexpr std::string_view spatial = R"(
[model]
dimension = 3             # 2: the section at right angles to the tunnel, by the same file
length = "14 m"           # along the tunnel
width = "24 m"            # of the whole domain, the tunnel in its middle
below_invert = "8 m"
seed = 1

[tunnel]
cover = "10 m"            # of the model; what is above it is stress.surcharge
shape = "horseshoe"
width = "7 m"
wall_height = "3 m"
#shape = "polygon"        # from a drawing, in place of the three lines above; with model.origin,
#file = "section.dxf"     # the site coordinates of the tunnel's centre, ["512300 m", "148 m"]
#layer = "PROFILE"
trend = "40 deg"          # looking along the tunnel, clockwise from North
round_length = "2 m"      # driven in rounds
rounds = 5                # rock is left ahead of the last face
facets = 36

[rock]
density = "2700 kg/m^3"

[stress]
K0 = 0.8
surcharge = "400 kPa"     # 15 m of ground above
)";

constexpr std::string_view spatial_rounds = R"(
[[round]]
name = "full face"

[[round]]
name = "bolts"
excavate = "nothing"
install = ["bolts"]
behind = 1                # rounds behind the face

# A lining that follows the bolts:
#[support.lining]
#thickness = "10 cm"
#E = "15 GPa"
#interface = { kn = "5 GPa/m", friction = "35 deg" }  # between rock and lining
#[[round]]
#name = "shotcrete"
#excavate = "nothing"
#install = ["lining"]
#behind = 2
)";

std::string joined(std::string_view title, std::initializer_list<std::string_view> parts) {
  std::string text("# ");
  text.append(title).append("\n").append(head);
  for (const std::string_view part : parts) text += part;
  return text;
}

}  // namespace

const std::vector<Template>& templates() {
  static const std::vector<Template> all{
      {"circle", "a circular tunnel with bolts and shotcrete, in a section"},
      {"horseshoe", "a horseshoe tunnel with bolts and shotcrete, in a section"},
      {"d-shape", "a mine drift, its outline by points, with bolts"},
      {"cavern", "a cavern of 18 m by 20 m, its outline by points, with bolts and shotcrete"},
      {"staged", "a horseshoe in heading and bench, supported in steps"},
      {"3d", "a tunnel in 3-D, driven in rounds; with the lines for a survey and a drawing"},
  };
  return all;
}

std::string template_text(std::string_view name) {
  if (name == "circle")
    return joined("A circular tunnel in jointed rock.",
                  {section, circle, rock, section_joints, mechanics, bolts, lining});
  if (name == "horseshoe")
    return joined("A horseshoe tunnel in jointed rock.",
                  {section, horseshoe, rock, section_joints, mechanics, bolts, lining});
  if (name == "d-shape")
    return joined("A mine drift in jointed rock.",
                  {section, d_shape, rock, section_joints, mechanics, bolts});
  if (name == "cavern")
    return joined("A cavern in jointed rock.",
                  {"\n[model]\nwidth = \"110 m\"\nbelow_invert = \"30 m\"\nseed = 1\n", cavern,
                   rock, section_joints, mechanics, bolts, lining});
  if (name == "staged")
    return joined("A horseshoe tunnel in heading and bench.",
                  {section, horseshoe, rock, section_joints, mechanics, bolts, lining, stages});
  if (name == "3d")
    return joined("A tunnel in 3-D, driven in rounds.",
                  {spatial, surveyed_joints, mechanics, bolts, spatial_rounds});
  throw std::logic_error("no template " + std::string(name));
}

}  // namespace voussoir::program
