// SPDX-License-Identifier: MIT
#include "bolts_strength.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "mapped_rock.hpp"
#include "output_parts.hpp"

namespace voussoir::program {

namespace {

bool is_of_bar(const BoltUtilisation& at) {
  return at.limit.mode == BoltMode::yield || at.limit.mode == BoltMode::rupture;
}

std::string share_text(const BoltUtilisation& at) {
  const double value = at.value();
  return (std::isinf(value) ? std::string("more than any") : text("%.0f %%", 100 * value)) +
         " of the strength of " + governed_by(at);
}

}  // namespace

std::vector<CrossingStrength> crossing_strengths(const std::vector<BoltUtilisation>& joints) {
  std::vector<CrossingStrength> strengths;
  for (const BoltUtilisation& at : joints)
    strengths.push_back(std::isfinite(at.limit.strength)
                            ? CrossingStrength{at.limit.strength, to_string(at.limit.mode)}
                            : CrossingStrength{});
  return strengths;
}

void add_bolt_strength(const std::vector<BoltUtilisation>& joints, nlohmann::json& bolts) {
  const BoltUtilisation* const most = governing(joints);
  if (most == nullptr) return;
  bolts["governing"] = {{"bolt", most->bolt + 1},
                        {"joint", most->joint},
                        {"distance_from_head_m", most->position},
                        {"mode", to_string(most->limit.mode)},
                        {"axial_force_kN", 1e-3 * most->force},
                        {"strength_kN", 1e-3 * most->limit.strength}};
}

std::string bolt_strength_line(const std::vector<BoltUtilisation>& joints) {
  const BoltUtilisation* const most = governing(joints);
  return most == nullptr ? "" : "         " + share_text(*most) + "\n";
}

std::string bolt_strength_warning(const std::vector<BoltUtilisation>& joints) {
  std::vector<BoltUtilisation> over;
  std::copy_if(joints.begin(), joints.end(), std::back_inserter(over),
               [](const BoltUtilisation& at) { return at.value() > 1 && !is_of_bar(at); });
  if (over.empty()) return "";
  return "bolts carry more than their bond bears at " + counted(over.size(), "joint") + " of " +
         std::to_string(joints.size()) + ", most with " + share_text(*governing(over)) +
         "; the model holds them there, where the grout would let go";
}

}  // namespace voussoir::program
