// SPDX-License-Identifier: MIT
#pragma once

/// The toolkit: everything an analysis in two or three dimensions needs, at rest and in motion.
/// Pictures and files (io/) are apart, and so are statistics/, which need Boost.Math.

#include <voussoir/bolt/axial_bolt.hpp>
#include <voussoir/bolt/axial_shear_bolt.hpp>
#include <voussoir/bolt/bolt_anchors.hpp>
#include <voussoir/contact/barton_bandis_joint.hpp>
#include <voussoir/contact/burgers_joint.hpp>
#include <voussoir/contact/coulomb_joint.hpp>
#include <voussoir/contact/mohr_coulomb_joint.hpp>
#include <voussoir/contact/rock_on_lining.hpp>
#include <voussoir/contact/smooth_wall.hpp>
#include <voussoir/core/literals.hpp>
#include <voussoir/core/random.hpp>
#include <voussoir/core/version.hpp>
#include <voussoir/detection/analytic_centre.hpp>
#include <voussoir/detection/contact_search.hpp>
#include <voussoir/detection/face_contacts.hpp>
#include <voussoir/dynamics/dynamics.hpp>
#include <voussoir/dynamics/moving_rock.hpp>
#include <voussoir/equilibrium/explicit.hpp>
#include <voussoir/equilibrium/relaxation.hpp>
#include <voussoir/equilibrium/two_level.hpp>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/laboratory/generation_stage.hpp>
#include <voussoir/laboratory/oedometer.hpp>
#include <voussoir/lining/beams.hpp>
#include <voussoir/rockmass/carving.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/joint_set.hpp>
#include <voussoir/rockmass/slicing.hpp>
#include <voussoir/rockmass/spatial_joint_set.hpp>
#include <voussoir/rockmass/statistics.hpp>
#include <voussoir/rockmass/trace_coverage.hpp>
#include <voussoir/rockmass/trace_file.hpp>
#include <voussoir/solver/solver.hpp>
#include <voussoir/theory/bolts_and_lining.hpp>
#include <voussoir/theory/circular_opening.hpp>
#include <voussoir/theory/equivalent_moduli.hpp>
#include <voussoir/theory/ground_reaction.hpp>
#include <voussoir/theory/grouted_bolt.hpp>
#include <voussoir/theory/initial_friction.hpp>
#include <voussoir/theory/lining_in_ground.hpp>
#include <voussoir/theory/longitudinal_profile.hpp>
#include <voussoir/theory/polygon_ring.hpp>
#include <voussoir/theory/smeared_bolts.hpp>
#include <voussoir/theory/thin_lining.hpp>
#include <voussoir/tunnel/bolt_pattern.hpp>
#include <voussoir/tunnel/interaction_diagram.hpp>
#include <voussoir/tunnel/lining_ring.hpp>
#include <voussoir/tunnel/measurements.hpp>
#include <voussoir/tunnel/opening.hpp>
