// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>
#include <voussoir/contact/contact_law.hpp>
#include <voussoir/core/errors.hpp>
#include <voussoir/core/roles.hpp>
#include <voussoir/core/vec.hpp>

namespace voussoir {

// Contacts know their laws at run time only: all that works on a model is compiled once for all
// laws. A law is compiled into its kernels of forces and into what it remembers of a point, alone.

namespace detail {

/// Makes and copies what a law remembers. There is one for every type, which outlives all of them.
class StateModel {
 public:
  static constexpr std::size_t most_bytes = 128, alignment = 16;

  explicit StateModel(std::size_t size) : size_(size) {}
  StateModel(const StateModel&) = delete;
  StateModel& operator=(const StateModel&) = delete;
  virtual ~StateModel() = default;

  [[nodiscard]] std::size_t size() const { return size_; }  ///< of one [bytes]
  /// What is remembered of a point to which nothing has happened.
  [[nodiscard]] virtual const void* fresh() const = 0;
  /// Makes `count` of them, copies of others that lie one behind the other. @pre no overlap
  virtual void copy(void* to, const void* from, std::size_t count) const = 0;
  /// Overwrites `count` of them, from the first on. @pre to is not after from
  virtual void move_down(void* to, const void* from, std::size_t count) const = 0;

 private:
  std::size_t size_;
};

}  // namespace detail

/// What a contact law remembers of a point, as a value. A new one is that of a point to which
/// nothing has happened.
class AnyState {
 public:
  AnyState() = default;
  AnyState(const detail::StateModel& model, const void* state) : model_(&model) {
    model.copy(bytes_, state, 1);
  }
  AnyState(const AnyState& other) : model_(other.model_) {
    if (model_ != nullptr) model_->copy(bytes_, other.bytes_, 1);
  }
  AnyState& operator=(const AnyState& other) {
    if (this == &other) return *this;
    model_ = other.model_;
    if (model_ != nullptr) model_->copy(bytes_, other.bytes_, 1);
    return *this;
  }
  ~AnyState() = default;

  /// As the law's own type.
  /// @throws InvalidInput  another law remembers this
  template <class State>
  [[nodiscard]] const State& as() const;

  /// @param model  of the law that asks
  [[nodiscard]] const void* of(const detail::StateModel& model) const {
    return model_ != nullptr ? bytes_ : model.fresh();
  }
  [[nodiscard]] void* of(const detail::StateModel& model) {
    if (model_ == nullptr) *this = AnyState(model, model.fresh());
    return bytes_;
  }

 private:
  const detail::StateModel* model_ = nullptr;
  alignas(detail::StateModel::alignment) std::byte bytes_[detail::StateModel::most_bytes];
};

template <int Dim>
class AnyLaw;
template <class Law>
inline constexpr bool is_any_law = false;
template <int Dim>
inline constexpr bool is_any_law<AnyLaw<Dim>> = true;
template <int Dim>
struct ReferenceContact;
template <int Dim>
struct PointRecord;
template <int Dim>
struct PointShift;
template <int Dim>
struct MovingBody;
template <int Dim>
struct MovingContact;
template <int Dim, class State>
struct MovingContactPoint;
template <int Dim>
struct Reaction;
template <int Dim>
struct StepCrossings;
struct Dissipation;

namespace detail {

template <class Law>
concept IsLawOfAType = Fills<Law, roles::ContactLaw> && !is_any_law<Law>;

/// The point of other contacts whose memory a point inherits.
struct FormerPoint {
  std::int32_t number = -1;  ///< -1: none
};

/// Contacts at rest whose forces are wanted, see `ContactGroup::add_forces`.
template <int Dim>
struct ForceTask {
  bool commits = false;
  const AnyLaw<Dim>* laws = nullptr;
  const ReferenceContact<Dim>* contacts = nullptr;
  const int* which = nullptr;  ///< numbers of contacts; null: the first `count`
  std::size_t count = 0;
  const PointRecord<Dim>* records = nullptr;
  const PointShift<Dim>* shifts = nullptr;  ///< null: there are none
  void* states = nullptr;
  const double* u = nullptr;
  double* f = nullptr;
};

/// Contacts in motion whose forces are wanted, see `MovingContacts::react`.
template <int Dim>
struct ReactionTask {
  const AnyLaw<Dim>* laws = nullptr;
  const MovingContact<Dim>* contacts = nullptr;
  std::size_t first = 0, last = 0;
  MovingContactPoint<Dim, FormerPoint>* points = nullptr;
  void* states = nullptr;
  const MovingBody<Dim>* bodies = nullptr;
  Reaction<Dim>* reactions = nullptr;  ///< of contact `first` and those behind it
  Dissipation* lost = nullptr;
  StepCrossings<Dim>* crossings = nullptr;  ///< null: nobody asks for them
};

/// A contact law behind functions that are called at run time: those of many contacts at once where
/// time counts, of a point elsewhere.
template <int Dim>
class LawModel {
 public:
  explicit LawModel(const StateModel& states) : states_(states) {}
  LawModel(const LawModel&) = delete;
  LawModel& operator=(const LawModel&) = delete;
  virtual ~LawModel() = default;

  /// Of what it remembers.
  [[nodiscard]] const StateModel& states() const { return states_; }

  [[nodiscard]] virtual PointForce<Dim> force(const PointLoad<Dim>& load,
                                              const void* state) const = 0;
  virtual double commit(const PointLoad<Dim>& load, void* state) const = 0;
  /// See `report_of`.
  [[nodiscard]] virtual ContactReport describe(const PointLoad<Dim>& load,
                                               const void* state) const = 0;
  [[nodiscard]] virtual double stored_energy(const PointLoad<Dim>& load,
                                             const void* state) const = 0;
  [[nodiscard]] virtual BondRelease<Dim> release_opening(const PointLoad<Dim>& load,
                                                         const void* state) const = 0;
  [[nodiscard]] virtual bool dilates() const = 0;
  /// Nothing for a law that does not dilate.
  [[nodiscard]] virtual PointLift lift(const PointLoad<Dim>& load, const void* state) const = 0;
  /// See `detail::commit_point` and `detail::tangent_at`.
  virtual bool commit_point(const PointLoad<Dim>& load, void* state) const = 0;
  [[nodiscard]] virtual Stress<Dim> tangent_at(const PointLoad<Dim>& load,
                                               const void* state) const = 0;
  /// Nothing for a law whose joints do not creep. @param time  [s]
  virtual void creep(const PointLoad<Dim>& load, void* state, double time) const = 0;
  /// @pre all laws of the task are of the same type as this one
  virtual void add_forces(const ForceTask<Dim>& task) const = 0;
  virtual void react(const ReactionTask<Dim>& task) const = 0;

 private:
  const StateModel& states_;
};

/// What a law known at run time says of the points of one contact, as `PointsOf` does.
/// @tparam StateOf  state_of(k) points to what it remembers of point k
template <int Dim, class StateOf>
class PointsOfAny {
 public:
  PointsOfAny(const LawModel<Dim>& law, StateOf state_of)
      : law_(law), state_of_(std::move(state_of)) {}

  [[nodiscard]] BondRelease<Dim> release(std::size_t k, const PointLoad<Dim>& load) const {
    return law_.release_opening(load, state_of_(k));
  }
  [[nodiscard]] bool dilates() const { return law_.dilates(); }
  [[nodiscard]] PointLift lift(std::size_t k, const PointLoad<Dim>& load) const {
    return law_.lift(load, state_of_(k));
  }

 private:
  const LawModel<Dim>& law_;
  StateOf state_of_;
};

template <class State>
class StateModelOf final : public StateModel {
 public:
  [[nodiscard]] static const StateModel& one() {
    static const StateModelOf model;
    return model;
  }

  [[nodiscard]] const void* fresh() const override { return &fresh_; }
  void copy(void* to, const void* from, std::size_t count) const override {
    std::uninitialized_copy_n(static_cast<const State*>(from), count, static_cast<State*>(to));
  }
  void move_down(void* to, const void* from, std::size_t count) const override {
    std::copy_n(static_cast<const State*>(from), count, static_cast<State*>(to));
  }

 private:
  StateModelOf() : StateModel(sizeof(State)) {}

  State fresh_{};
};

}  // namespace detail

/// A contact law of any type, known at run time. Copies share it: laws do not change.
///
/// What the law remembers of a point lies in the arrays of its contacts, moved and copied with
/// them: it owns nothing and has 128 bytes at most.
template <int Dim>
class AnyLaw {
 public:
  using role = roles::ContactLaw;
  static constexpr const char* name = "AnyLaw";
  template <int>
  using State = AnyState;

  template <class Law>
  requires detail::IsLawOfAType<Law> AnyLaw(  // NOLINT(google-explicit-constructor): any law is one
      const Law& law);

  /// The law as its type; null if it is of another.
  template <class Law>
  [[nodiscard]] const Law* as() const;

  [[nodiscard]] PointForce<Dim> force(const PointLoad<Dim>& load, const AnyState& state) const {
    return model_->force(load, state.of(model_->states()));
  }
  double commit(const PointLoad<Dim>& load, AnyState& state) const {
    return model_->commit(load, state.of(model_->states()));
  }
  [[nodiscard]] double stored_energy(const PointLoad<Dim>& load, const AnyState& state) const {
    return model_->stored_energy(load, state.of(model_->states()));
  }
  [[nodiscard]] ContactReport describe(const PointLoad<Dim>& load, const AnyState& state) const {
    return model_->describe(load, state.of(model_->states()));
  }
  [[nodiscard]] BondRelease<Dim> release_opening(const PointLoad<Dim>& load,
                                                 const AnyState& state) const {
    return model_->release_opening(load, state.of(model_->states()));
  }
  [[nodiscard]] bool dilates() const { return model_->dilates(); }
  [[nodiscard]] PointLift lift(const PointLoad<Dim>& load, const AnyState& state) const {
    return model_->lift(load, state.of(model_->states()));
  }
  [[nodiscard]] double joint_normal_stiffness() const { return normal_stiffness_; }
  [[nodiscard]] double joint_shear_stiffness() const { return shear_stiffness_; }

  [[nodiscard]] const detail::LawModel<Dim>& model() const { return *model_; }

 private:
  std::shared_ptr<const detail::LawModel<Dim>> model_;
  double normal_stiffness_, shear_stiffness_;
};

namespace detail {

/// What the laws of a group remember. Kernels of forces are called once for all contacts.
/// @throws InvalidInput  they are not of one type
/// @pre there is one
template <int Dim>
[[nodiscard]] const StateModel& states_of(const std::vector<AnyLaw<Dim>>& laws) {
  const LawModel<Dim>& first = laws.front().model();
  for (const AnyLaw<Dim>& law : laws) {
    const LawModel<Dim>& other = law.model();
    if (typeid(other) != typeid(first))
      throw InvalidInput("contact laws of one group: they must be of one type");
  }
  return first.states();
}

/// What points remember, one behind the other, as tight as the law's own type.
class StateColumn {
 public:
  StateColumn() = default;
  StateColumn(const StateColumn& other) : model_(other.model_), count_(other.count_) {
    if (count_ == 0) return;
    bytes_.resize(count_ * model_->size());
    model_->copy(bytes_.data(), other.bytes_.data(), count_);
  }
  StateColumn(StateColumn&& other) noexcept { swap(other); }
  StateColumn& operator=(StateColumn other) noexcept {
    swap(other);
    return *this;
  }
  ~StateColumn() = default;
  void swap(StateColumn& other) noexcept {
    std::swap(model_, other.model_);
    std::swap(count_, other.count_);
    bytes_.swap(other.bytes_);
  }

  /// Of the laws that these are of, before the first is there.
  void set_model(const StateModel& model) {
    VOUSSOIR_ASSERT(count_ == 0 || model_ == &model, "laws of one type");
    model_ = &model;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] AnyState value(std::size_t k) const { return {*model_, at(k)}; }
  [[nodiscard]] const void* at(std::size_t k) const { return bytes_.data() + k * model_->size(); }
  [[nodiscard]] void* at(std::size_t k) { return bytes_.data() + k * model_->size(); }
  void set(std::size_t k, const void* state) { model_->copy(at(k), state, 1); }
  void set(std::size_t k, const AnyState& state) { set(k, state.of(*model_)); }
  void push_back(const void* state) { append(state, 1); }
  void push_back(const AnyState& state) { append(state.of(*model_), 1); }
  /// @pre they are not of this column
  void append(const void* states, std::size_t count) {
    if ((count_ + count) * model_->size() > bytes_.size())
      reserve(std::max(count_ + count, 2 * count_));
    model_->copy(at(count_), states, count);
    count_ += count;
  }
  void reserve(std::size_t count) {
    if (model_ == nullptr || count * model_->size() <= bytes_.size()) return;
    std::vector<std::byte> next(count * model_->size());
    if (count_ > 0) model_->copy(next.data(), bytes_.data(), count_);
    bytes_.swap(next);
  }
  void truncate(std::size_t count) { count_ = count; }
  void move_down(std::size_t from, std::size_t to, std::size_t count) {
    if (count > 0) model_->move_down(at(to), at(from), count);
  }
  [[nodiscard]] const void* data() const { return bytes_.data(); }
  [[nodiscard]] void* data() { return bytes_.data(); }

 private:
  const StateModel* model_ = nullptr;
  std::size_t count_ = 0;
  std::vector<std::byte> bytes_;  ///< may be longer
};

}  // namespace detail

template <class State>
const State& AnyState::as() const {
  const detail::StateModel& model = detail::StateModelOf<State>::one();
  if (model_ != nullptr && model_ != &model)
    throw InvalidInput("what a contact point remembers: it is that of another law");
  return *static_cast<const State*>(of(model));
}

}  // namespace voussoir
