// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/pose.hpp>
#include <voussoir/core/vec.hpp>
#include <voussoir/model/moving_body.hpp>

namespace voussoir {

/// A force and a moment about the centre of a body, world axes.
template <int Dim>
struct Load {
  Vec<Dim> force = zeros<Vec<Dim>>();     ///< [N]
  Spin<Dim> moment = zeros<Spin<Dim>>();  ///< [N m]
};

/// Marks for some of the bodies, by their number.
using BodyMarks = std::vector<char>;
[[nodiscard]] inline bool is_marked(const BodyMarks& marks, int body) {
  return marks[static_cast<std::size_t>(body)] != 0;
}

/// What has become of a point of a body where rock has been excavated.
template <int Dim>
struct Heir {
  int body;           ///< its new number; -1: the point lay on rock that is gone
  bool is_excavated;  ///< by that; else what was left there was too small a piece
  Vec<Dim> arm;       ///< from the centre that it has now [m]
  Vec<Dim> place;     ///< of the point in the in-situ state [m]
};
/// heirs(body, arm): of a point at this lever from the centre of a body.
template <int Dim>
using Heirs = std::function<Heir<Dim>(int body, const Vec<Dim>& arm)>;

/// What holds bodies besides contacts, at rest and in motion: bolts, a lining, a spring of a test.
///
/// The search for equilibrium knows bodies by small displacements from the reference configuration,
/// the time stepper by their poses. A support answers both, from one state: a new kind of support
/// is one class, derived from `SupportModel`.
///
/// Few against the contacts: a virtual call for each evaluation costs nothing.
template <int Dim>
class Support {
 public:
  static constexpr int dof = Dim + spin_count<Dim>;
  using Bodies = std::vector<MovingBody<Dim>>;
  using Poses = std::vector<Pose<Dim>>;
  using Block = Fixed<dof, dof>;
  /// Takes the stiffness between two bodies, by its four parts: minus the force on one for a
  /// displacement of the other.
  using StiffnessSink = std::function<void(int a, int b, const Block& aa, const Block& ab,
                                           const Block& ba, const Block& bb)>;

  virtual ~Support() = default;
  [[nodiscard]] virtual std::shared_ptr<Support> copy() const = 0;
  /// Takes the state of a copy that was made before.
  virtual void restore(const Support& copy) = 0;
  /// The bodies that it acts on, each once.
  [[nodiscard]] virtual std::vector<int> bodies() const = 0;
  /// The pairs of bodies that cannot part or turn against each other without straining it. A bolt
  /// alone does not hold: a block could still turn about it.
  [[nodiscard]] virtual std::vector<std::pair<int, int>> links() const { return {}; }
  /// Forgets what it was to these bodies.
  virtual void remove(const BodyMarks& gone) = 0;
  /// Takes the numbers and centres that bodies have after rock has been excavated.
  /// @throws InvalidInput  it holds excavated rock; the support is then of no use
  virtual void take_over(const Heirs<Dim>& heirs) = 0;
  /// Forgets what joins two bodies where that has been cut through.
  virtual void sever(const std::function<bool(int a, int b)>& /*is_parted*/) {}
  /// For every element that can break, whether it has.
  virtual void list_broken(std::vector<bool>& /*broken*/) const {}

  // ---- at rest: `u`, dof values a body, are small displacements from the reference --------------

  /// Adds its forces; of what acts on no chosen body it need not.
  /// @param chosen  null: all bodies
  virtual void add_forces(const double* u, double* f, const BodyMarks* chosen) const = 0;
  /// Brings its history up to date; of what acts on no chosen body it must not.
  /// @return  elements that broke: equilibrium must then be sought again
  virtual int commit(const double* /*u*/, const BodyMarks* /*chosen*/) { return 0; }
  /// Its elastic stiffness; none of what is broken.
  virtual void add_stiffness(const StiffnessSink& sink) const = 0;
  /// Its stiffness at a displacement, history held: the negative derivative of the forces.
  virtual void add_tangent(const double* u, const BodyMarks* chosen,
                           const StiffnessSink& sink) const = 0;
  /// From the axes of the reference configuration to the frames of the bodies, in which a run
  /// knows it. A contact update goes to the frames and back.
  /// @param frames  of all bodies: where they are in the reference configuration
  /// @param u       displacement there; null: zero
  virtual void to_frames(const Poses& frames, const double* u) = 0;
  /// And back: where bodies are now becomes the reference configuration.
  /// @param frames  of all bodies now
  /// @param u       their displacement, from wherever it is counted
  virtual void from_frames(const Poses& frames, const double* u) = 0;

  // ---- in motion --------------------------------------------------------------------------------

  /// Adds its forces to `loads`, one for every body of the run, and brings its history up to date.
  virtual void act(const Bodies& bodies, std::vector<Load<Dim>>& loads) = 0;
  /// Energy that it holds, and has lost to yield [J].
  [[nodiscard]] virtual double energy(const Bodies& bodies) const = 0;
  /// Adds to every body's number a bound on the largest eigenvalue of M^-1 K [1/s^2], K its own
  /// stiffness with all other bodies fixed.
  virtual void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const = 0;
};

/// What every support is derived from: it copies itself.
template <class Derived, int Dim>
class SupportModel : public Support<Dim> {
 public:
  [[nodiscard]] std::shared_ptr<Support<Dim>> copy() const final {
    return std::make_shared<Derived>(static_cast<const Derived&>(*this));
  }
  void restore(const Support<Dim>& copy) final {
    static_cast<Derived&>(*this) = static_cast<const Derived&>(copy);
  }
};

/// All supports of a model. A copy of the set has copies of them.
template <int Dim>
class SupportSet {
 public:
  using Kind = Support<Dim>;
  using Bodies = typename Kind::Bodies;

  SupportSet() = default;
  SupportSet(const SupportSet& other) { *this = other; }
  SupportSet(SupportSet&&) noexcept = default;
  SupportSet& operator=(const SupportSet& other) {
    if (this == &other) return *this;
    supports_.clear();
    for (const auto& support : other.supports_) supports_.push_back(support->copy());
    loads_ = other.loads_;
    at_start_ = other.at_start_;
    return *this;
  }
  SupportSet& operator=(SupportSet&&) noexcept = default;
  ~SupportSet() = default;

  void add(std::shared_ptr<Kind> support) { supports_.push_back(std::move(support)); }
  /// The same in a run: what it holds already is no work of the run.
  void add(std::shared_ptr<Kind> support, const Bodies& bodies) {
    at_start_ += support->energy(bodies);
    add(std::move(support));
  }
  /// The first of a kind; null if there is none.
  template <class Wanted>
  [[nodiscard]] Wanted* first() const {
    for (const auto& support : supports_)
      if (auto* found = dynamic_cast<Wanted*>(support.get())) return found;
    return nullptr;
  }
  /// All of a kind, in the order in which they came.
  template <class Wanted>
  [[nodiscard]] std::vector<const Wanted*> all() const {
    std::vector<const Wanted*> found;
    for (const auto& support : supports_)
      if (const auto* it = dynamic_cast<const Wanted*>(support.get())) found.push_back(it);
    return found;
  }
  [[nodiscard]] auto begin() const { return supports_.begin(); }
  [[nodiscard]] auto end() const { return supports_.end(); }

  /// Every support takes back the state that it had in a copy of this set. The supports stay the
  /// same objects: others may hold them too.
  void restore(const SupportSet& copy) {
    for (std::size_t k = 0; k < supports_.size(); ++k) supports_[k]->restore(*copy.supports_[k]);
    at_start_ = copy.at_start_;
  }

  /// For every element that can break, whether it has.
  [[nodiscard]] std::vector<bool> broken() const {
    std::vector<bool> broken;
    for (const auto& support : supports_) support->list_broken(broken);
    return broken;
  }
  [[nodiscard]] int broken_count() const {
    const std::vector<bool> all = broken();
    return static_cast<int>(std::count(all.begin(), all.end(), true));
  }

  // ---- in motion --------------------------------------------------------------------------------

  /// Computes the loads on all bodies, histories brought up to date.
  void act(const Bodies& bodies) {
    if (supports_.empty()) return;
    loads_.resize(bodies.size());
    for (const auto& support : supports_)
      for (const int b : support->bodies()) loads_[static_cast<std::size_t>(b)] = {};
    for (const auto& support : supports_) support->act(bodies, loads_);
  }
  /// Adds the load on body b, as last computed.
  void add_load_on(std::size_t b, Vec<Dim>& force, Spin<Dim>& moment) const {
    if (b >= loads_.size()) return;
    force += loads_[b].force;
    moment += loads_[b].moment;
  }
  /// Forgets what supports were to bodies that are taken out; the energy of that goes with them.
  void remove(const BodyMarks& gone, const Bodies& bodies) {
    at_start_ -= sum(bodies);
    for (const auto& support : supports_) support->remove(gone);
    at_start_ += sum(bodies);
    std::fill(loads_.begin(), loads_.end(), Load<Dim>{});  // nobody writes what nobody holds now
  }
  /// Stored, and lost to yield, since each of them was added or `start` was called [J].
  [[nodiscard]] double energy(const Bodies& bodies) const { return sum(bodies) - at_start_; }
  void start(const Bodies& bodies) { at_start_ = sum(bodies); }
  void add_stiffness_over_mass(const Bodies& bodies, std::vector<double>& sums) const {
    for (const auto& support : supports_) support->add_stiffness_over_mass(bodies, sums);
  }

 private:
  [[nodiscard]] double sum(const Bodies& bodies) const {
    double energy = 0;
    for (const auto& support : supports_) energy += support->energy(bodies);
    return energy;
  }

  std::vector<std::shared_ptr<Kind>> supports_;
  std::vector<Load<Dim>> loads_;
  double at_start_ = 0;
};

}  // namespace voussoir
