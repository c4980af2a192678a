// SPDX-License-Identifier: MIT
// A lining whose elements are known at run time only, and the hinge of an element that ends on a
// pin.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>
#include <voussoir/geometry/planar.hpp>
#include <voussoir/geometry/spatial.hpp>
#include <voussoir/lining/any_lining.hpp>
#include <voussoir/lining/frame_element.hpp>
#include <voussoir/model/lining_surface.hpp>

#include "support/near.hpp"

namespace any_lining_test {

using namespace voussoir;
using voussoir_test::near;

namespace {

LiningSection section(LiningElement element) {
  LiningSection made = LiningSection::strip(0.3, 0.8, 25e9);
  made.element = element;
  return made;
}
constexpr LiningElement every_element[] = {LiningElement::euler_bernoulli,
                                           LiningElement::timoshenko, LiningElement::pinned,
                                           LiningElement::bonded_chain};

template <int Dof>
ElementMatrix<Dof> plain(LiningElement element, double length) {
  const LiningSection s = section(element);
  switch (element) {
    case LiningElement::euler_bernoulli:
      return EulerBernoulliBeam::stiffness<Dof>(s, length);
    case LiningElement::timoshenko:
      return TimoshenkoBeam::stiffness<Dof>(s, length);
    case LiningElement::pinned:
      return PinnedBar::stiffness<Dof>(s, length);
    case LiningElement::bonded_chain:
      break;
  }
  return BondedChain::stiffness<Dof>(s, length);
}
/// Of any kind, which it does not say.
struct Silent {
  using role = roles::Lining;
  static constexpr const char* name = "Silent";
  template <int Dof>
  static ElementMatrix<Dof> stiffness(const LiningSection& s, double length) {
    return EulerBernoulliBeam::stiffness<Dof>(s, length);
  }
};
/// A function that nobody can call without an object: not passed over.
struct WithMemberFunction : Silent {
  [[nodiscard]] bool is_pinned(const LiningSection&) const { return true; }
};
static_assert(!LiningModel<WithMemberFunction, 3>);
static_assert(ChoosesPins<AnyLining> && !HasPins<AnyLining>);
static_assert(HasPins<PinnedBar> && !ChoosesPins<PinnedBar>);

/// The members of a frame of three nodes in a row of which some are pins.
std::vector<FrameElement<Planar>> row_of(const std::vector<LiningSection>& sections,
                                         const std::vector<int>& pins) {
  LiningFrame<Planar> frame;
  frame.nodes = {{0, 0}, {2, 0}, {4, 0}};
  frame.members = {{0, 1, {0, 1}, 0}, {1, 2, {0, 1}, 1}};
  return lining_elements<AnyLining>(frame, sections, frame.nodes, {0, 1, 2},
                                    [&](int k) { return pins[static_cast<std::size_t>(k)] != 0; });
}

}  // namespace

TEST_SUITE("lining/any_lining") {
  TEST_CASE("an element is that of its model, bit for bit; models differ") {
    for (const LiningElement element : every_element) {
      CHECK(AnyLining::stiffness<3>(section(element), 0.7) == plain<3>(element, 0.7));
      CHECK(AnyLining::stiffness<6>(section(element), 0.7) == plain<6>(element, 0.7));
      for (const LiningElement other : every_element)
        if (other != element)
          CHECK(AnyLining::stiffness<3>(section(element), 0.7) !=
                AnyLining::stiffness<3>(section(other), 0.7));
    }
    CHECK(section({}).element == LiningElement::euler_bernoulli);
    CHECK(LiningSection::rectangular(0.1, 25e9).element == LiningElement::euler_bernoulli);
    CHECK_THROWS_AS((void)AnyLining::stiffness<3>(section(static_cast<LiningElement>(9)), 1),
                    InvalidInput);
  }
  TEST_CASE("it names its model and knows which is pinned") {
    CHECK(AnyLining::type_name(LiningElement::euler_bernoulli) ==
          std::string("EulerBernoulliBeam"));
    CHECK(AnyLining::type_name(LiningElement::timoshenko) == std::string("TimoshenkoBeam"));
    CHECK(AnyLining::type_name(LiningElement::pinned) == std::string("PinnedBar"));
    CHECK(AnyLining::type_name(LiningElement::bonded_chain) == std::string("BondedChain"));
    for (const LiningElement element : every_element)
      CHECK(is_pinned_lining<AnyLining>(section(element)) == (element == LiningElement::pinned));
    CHECK(is_pinned_lining<PinnedBar>(section(LiningElement::timoshenko)));
    CHECK(!is_pinned_lining<EulerBernoulliBeam>(section(LiningElement::pinned)));
    CHECK(!is_pinned_lining<Silent>(section(LiningElement::pinned)));
  }
  TEST_CASE("sections of one lining are all pinned or none is") {
    const LiningSection beam = section(LiningElement::timoshenko),
                        pinned = section(LiningElement::pinned),
                        chain = section(LiningElement::bonded_chain);
    using Sections = std::vector<LiningSection>;
    CHECK(!is_pinned_lining<AnyLining>(Sections{}));
    CHECK(!is_pinned_lining<AnyLining>(Sections{beam, chain}));
    CHECK(is_pinned_lining<AnyLining>(Sections{pinned, pinned}));
    CHECK_THROWS_WITH_AS((void)is_pinned_lining<AnyLining>(Sections{beam, chain, pinned}),
                         "lining: section 0 is not pinned and section 2 is; accepted: sections of "
                         "one lining that are all pinned, or none of them",
                         InvalidInput);
    CHECK_THROWS_AS((void)is_pinned_lining<AnyLining>(Sections{pinned, beam}), InvalidInput);
  }

  TEST_CASE("a beam that is hinged at one end is a propped cantilever") {
    // Displaced across at the hinge it resists with 3 E I / l^3, and the clamp turns it by
    // 3 E I / l^2: both a quarter, half of those of a beam that is clamped twice (12, 6).
    const LiningSection s = section(LiningElement::euler_bernoulli);
    const double l = 1.7, ei = s.bending_stiffness;
    for (const int end : {0, 1}) {
      auto k = EulerBernoulliBeam::stiffness<3>(s, l);
      hinge<3>(k, end);
      const int across = 3 * end + 1, turn = 3 * end + 2, clamp = 3 * (1 - end) + 2;
      CHECK(k(across, across) == near(3 * ei / (l * l * l)).epsilon(1e-12));  // some roundings
      CHECK(k(clamp, clamp) == near(3 * ei / l).epsilon(1e-12));
      CHECK(std::abs(k(across, clamp)) == near(3 * ei / (l * l)).epsilon(1e-12));
      CHECK(k(3 * end, 3 * end) == s.axial_stiffness / l);
      CHECK(k.row(turn).norm() == 0);
      CHECK(k.col(turn).norm() == 0);
      CHECK(k == ElementMatrix<3>(transposed(k)));
    }
  }
  TEST_CASE("a hinged element has no moments there and resists no rigid motion, in 2-D and 3-D") {
    const double l = 0.9;
    for (const LiningElement element : every_element)
      for (const int end : {0, 1}) {
        auto k = plain<6>(element, l);
        const double size = k.norm();
        hinge<6>(k, end);
        for (int r = 6 * end + 3; r < 6 * (end + 1); ++r) {
          CHECK(k.row(r).norm() == 0);
          CHECK(k.col(r).norm() == 0);
        }
        if (element == LiningElement::pinned) continue;  // its other turns are fixed to nowhere
        for (int axis = 0; axis < 3; ++axis) {
          Fixed<12, 1> turned = zeros<Fixed<12, 1>>();
          turned[3 + axis] = turned[9 + axis] = 1;
          if (axis == 1) turned[8] = -l;  // about y the far end goes down
          if (axis == 2) turned[7] = l;
          CHECK((k * turned).norm() <= 1e-14 * size);  // some roundings of the largest entry
        }
      }
    // Hinged at both ends a beam is a bar on pins without their springs to nowhere.
    auto beam = plain<6>(LiningElement::timoshenko, l), bar = plain<6>(LiningElement::pinned, l);
    for (const int end : {0, 1}) {
      hinge<6>(beam, end);
      hinge<6>(bar, end);
    }
    CHECK((beam - bar).norm() <= 1e-14 * bar.norm());
  }
  TEST_CASE("members are hinged where a pin meets a node that turns, and nowhere else") {
    const LiningSection beam = section(LiningElement::timoshenko),
                        pinned = section(LiningElement::pinned);
    // What the turn of an end has to do with any other motion.
    const auto turns = [](const FrameElement<Planar>& e, int end) {
      auto row = Fixed<1, 6>(e.local.row(3 * end + 2));
      row[3 * end + 2] = 0;
      return row.norm() > 0;
    };
    using Hinged = std::array<bool, 2>;
    const auto all_beams = row_of({beam, beam}, {0, 0, 0}),
               all_bars = row_of({pinned, pinned}, {1, 1, 1}),
               beam_to_pin = row_of({beam, beam}, {0, 0, 1}),
               bar_to_beam = row_of({pinned, pinned}, {0, 1, 1});
    for (const std::size_t m : {0U, 1U}) {
      CHECK(all_beams[m].local == TimoshenkoBeam::stiffness<3>(beam, 2));
      CHECK(all_bars[m].local == PinnedBar::stiffness<3>(pinned, 2));
      CHECK(all_beams[m].is_hinged == Hinged{false, false});
      CHECK(all_bars[m].is_hinged == Hinged{true, true});
    }
    CHECK(beam_to_pin[0].local == TimoshenkoBeam::stiffness<3>(beam, 2));
    CHECK(beam_to_pin[1].is_hinged == Hinged{false, true});
    CHECK(turns(beam_to_pin[1], 0));
    CHECK(!turns(beam_to_pin[1], 1));
    // The pin stays fixed where the bars that meet it are taken out, with the spring of a bar.
    CHECK(beam_to_pin[1].local(5, 5) == all_bars[1].local(5, 5));
    CHECK(bar_to_beam[1].local == PinnedBar::stiffness<3>(pinned, 2));
    CHECK(bar_to_beam[0].is_hinged == Hinged{true, true});
    CHECK(bar_to_beam[0].local(2, 2) == 0);  // the node of the beam turns
    CHECK(bar_to_beam[0].local(5, 5) == all_bars[0].local(5, 5));
  }

  TEST_CASE("a hinged member in motion: its chord and the end that is clamped strain it alone") {
    const LiningSection beam = section(LiningElement::euler_bernoulli);
    const auto members = row_of({beam, beam}, {0, 0, 1});
    const FrameElement<Planar>& e = members[1];  // from (2, 0) to the pin at (4, 0)
    Pose<2> clamped, pin;
    clamped.position = {2, 0};
    const double across = 1e-6;
    pin.position = {4, across};
    // A propped cantilever, at its free end P = 3 E I w / l^3, at the clamp M = P l.
    const double force = 3 * beam.bending_stiffness * across / 8;
    const auto push = e.push(clamped, pin);  // on the nodes
    // Turns of 1e-6 are small: their squares are not in it.
    CHECK(push[4] == near(-force).epsilon(1e-6));
    CHECK(push[1] == near(force).epsilon(1e-6));
    CHECK(push[2] == near(2 * force).epsilon(1e-6));
    CHECK(push[5] == 0);
    CHECK(e.energy(clamped, pin) == near(0.5 * force * across).epsilon(1e-6));
    pin.rotation = by_rows<2, 2>({0.8, -0.6, 0.6, 0.8});
    CHECK(e.push(clamped, pin) == push);
  }
}

}  // namespace any_lining_test
