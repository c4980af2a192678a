// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/model/any_law.hpp>
#include <voussoir/model/detail/contact_reaction.hpp>
#include <voussoir/model/detail/crossing.hpp>
#include <voussoir/model/detail/law_steps.hpp>
#include <voussoir/model/moving_body.hpp>
#include <voussoir/model/moving_contact.hpp>
#include <voussoir/model/reference_contact.hpp>

namespace voussoir::detail {

/// A law of one type behind the functions of `LawModel`.
template <int Dim, class Law>
class LawModelOf final : public LawModel<Dim> {
 public:
  using State = typename Law::template State<Dim>;

  explicit LawModelOf(const Law& law) : LawModel<Dim>(StateModelOf<State>::one()), law_(law) {}

  [[nodiscard]] const Law& law() const { return law_; }

  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load,
                                      const void* state) const override {
    return law_.force(load, as_state(state));
  }
  double commit(const PointLoad<Dim>& load, void* state) const override {
    return law_.commit(load, *static_cast<State*>(state));
  }
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load,
                                       const void* state) const override {
    return report_of(law_, load, as_state(state));
  }
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const void* state) const override {
    return law_.stored_energy(load, as_state(state));
  }
  [[nodiscard]] BondRelease<Dim> release_opening(const PointLoad<Dim>& load,
                                                 const void* state) const override {
    if constexpr (HasBond<Law, Dim>)
      return law_.release_opening(load, as_state(state));
    else
      return {voussoir::release_opening<Dim>(law_, load, as_state(state)), 0, 0, {}};
  }
  [[nodiscard]] bool dilates() const override {
    if constexpr (HasLift<Law, Dim>)
      return law_.dilates();
    else
      return false;
  }
  [[nodiscard]] PointLift lift([[maybe_unused]] const PointLoad<Dim>& load,
                               [[maybe_unused]] const void* state) const override {
    if constexpr (HasLift<Law, Dim>)
      return law_.lift(load, as_state(state));
    else
      return {};
  }
  bool commit_point(const PointLoad<Dim>& load, void* state) const override {
    return detail::commit_point<Dim>(law_, load, *static_cast<State*>(state));
  }
  [[nodiscard]] Stress<Dim> tangent_at(const PointLoad<Dim>& load,
                                       const void* state) const override {
    return detail::tangent_at<Dim>(law_, load, as_state(state));
  }
  void creep([[maybe_unused]] const PointLoad<Dim>& load, [[maybe_unused]] void* state,
             [[maybe_unused]] double time) const override {
    if constexpr (CreepingLaw<Law, Dim>) law_.creep(load, *static_cast<State*>(state), time);
  }
  void add_forces(const ForceTask<Dim>& task) const override {
    detail::add_forces<Dim, Law>(
        task, [&](std::size_t law) -> const Law& { return of_type(task.laws[law]); });
  }
  void react(const ReactionTask<Dim>& task) const override {
    auto* const states = static_cast<State*>(task.states);
    Reaction<Dim>* reactions = task.reactions;
    for (std::size_t k = task.first; k < task.last; ++k) {
      const MovingContact<Dim>& c = task.contacts[k];
      const Law& law = of_type(task.laws[c.law]);
      const auto &a = task.bodies[c.a], &b = task.bodies[c.b];
      *reactions++ = reaction(law, c, task.points, states, a, b, *task.lost);
      if (task.crossings != nullptr)
        add_crossing(law, c, task.points, states, a, b, *task.crossings);
    }
  }

  /// @pre it is of this type
  [[nodiscard]] static const Law& of_type(const AnyLaw<Dim>& law) {
    return static_cast<const LawModelOf&>(law.model()).law_;
  }

 private:
  [[nodiscard]] static const State& as_state(const void* state) {
    return *static_cast<const State*>(state);
  }

  Law law_;
};

/// Laws known at run time. Those of an `AnyJoint` are as their own type where that is one for all.
template <int Dim, class Law>
[[nodiscard]] std::vector<AnyLaw<Dim>> any_laws(const std::vector<Law>& laws) {
  if constexpr (requires(const Law& law) { law.type(); }) {
    const auto is_as_first = [&](const Law& law) { return law.type() == laws.front().type(); };
    if (std::all_of(laws.begin(), laws.end(), is_as_first)) {
      std::vector<AnyLaw<Dim>> own;
      for (const Law& law : laws) law.visit([&](const auto& typed) { own.emplace_back(typed); });
      return own;
    }
  }
  return {laws.begin(), laws.end()};
}

}  // namespace voussoir::detail

namespace voussoir {

template <int Dim>
template <class Law>
requires detail::IsLawOfAType<Law> AnyLaw<Dim>::AnyLaw(const Law& law)
    : model_(std::make_shared<const detail::LawModelOf<Dim, Law>>(law)),
      normal_stiffness_(law.joint_normal_stiffness()),
      shear_stiffness_(law.joint_shear_stiffness()) {
  using History = typename Law::template State<Dim>;
  static_assert(explain_contact_law<Law, Dim>());
  static_assert(sizeof(History) <= detail::StateModel::most_bytes,
                "contact law: `State` may have 128 bytes");
  static_assert(alignof(History) <= detail::StateModel::alignment,
                "contact law: `State` may be aligned to 16 bytes");
  static_assert(std::is_trivially_destructible_v<History>,
                "contact law: `State` must own nothing: it is kept in arrays of bytes");
}

template <int Dim>
template <class Law>
const Law* AnyLaw<Dim>::as() const {
  const auto* model = dynamic_cast<const detail::LawModelOf<Dim, Law>*>(model_.get());
  return model != nullptr ? &model->law() : nullptr;
}

}  // namespace voussoir
