// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/farfield/far_field.hpp>
#include <voussoir/farfield/ground_around.hpp>
#include <voussoir/model/elastic_edge.hpp>
#include <voussoir/model/joined_contacts.hpp>
#include <voussoir/model/system.hpp>
#include <voussoir/rockmass/cut_contacts.hpp>
#include <voussoir/rockmass/edge_slabs.hpp>
#include <voussoir/rockmass/in_situ.hpp>
#include <voussoir/rockmass/rock_mass.hpp>

namespace voussoir::detail {

/// The initial contacts; a detector may be asked to stop, but need not know how.
template <class Detector, class Geometry>
[[nodiscard]] auto find_contacts(const RockMass<Geometry>& mass, const Progress& progress) {
  if constexpr (requires { Detector::find(mass, progress); }) {
    return Detector::find(mass, progress);
  } else {
    return Detector::find(mass);
  }
}

/// The shapes of the bodies and, last, of the ground around the domain, where that is rollers. They
/// keep the rock alive.
template <class System>
[[nodiscard]] std::shared_ptr<const typename System::Shapes> shapes_of(
    std::shared_ptr<const RockMass<typename System::GeometryType>> mass,
    const FarField<System::dim>& far_field) {
  struct Shapes {
    std::shared_ptr<const RockMass<typename System::GeometryType>> mass;
    decltype(edge_slabs(mass->domain)) slabs;
    typename System::Shapes of_body;
  };
  auto slabs = edge_slabs(mass->domain, [&](int axis, bool upper) {
    return far_field.at(axis, upper) == Boundary::rollers;
  });
  const auto shapes = std::make_shared<Shapes>(Shapes{std::move(mass), std::move(slabs), {}});
  shapes->of_body.reserve(shapes->mass->bodies.size() + 1);
  for (const auto& body : shapes->mass->bodies) shapes->of_body.emplace_back(body.parts);
  shapes->of_body.emplace_back(shapes->slabs);
  return {shapes, &shapes->of_body};
}

/// Makes the model of rock that is in its in-situ stress, in the order of its members: bodies,
/// weights, contacts with each other and with the edges of the domain, and what acts there.
template <class Detector, class System>
class InitialModel {
 public:
  using Geometry = typename System::GeometryType;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  /// Rock and model must outlive this, and the far field.
  InitialModel(const RockMass<Geometry>& mass, const InSitu& in_situ,
               const FarField<dim>& far_field, System& system, Progress progress = {})
      : mass_(mass),
        in_situ_(in_situ),
        far_field_(far_field),
        system_(system),
        progress_(std::move(progress)),
        stop_(progress_) {}

  /// All of it.
  /// @param mass      the same as above, to be kept alive for its shapes
  /// @param around    the elastic ground beyond; null: there is none
  /// @param measures  of bodies, in place of what is there [m^2 or m^3]
  /// @param law_of_cut  of every cut of the rock the number of its joint law
  void run(std::shared_ptr<const RockMass<Geometry>> mass, std::vector<int> law_of_cut,
           std::shared_ptr<const GroundAround<dim>> around, std::vector<double>& measures) {
    add_bodies(measures);
    add_contacts(std::move(law_of_cut));
    add_edges();
    system_.shapes = shapes_of<System>(std::move(mass), far_field_);
    set_initial_stress();
    if (around != nullptr) glue_to(std::move(around));
    measures.resize(static_cast<std::size_t>(system_.body_count()), 0.0);
  }

  /// The bodies, and as the last the ground, which is fixed.
  /// @param measures  of them, in place of what is there [m^2 or m^3]
  void add_bodies(std::vector<double>& measures) {
    measures.clear();
    measures.reserve(mass_.bodies.size() + 1);
    std::vector<SystemBody<dim>> bodies;
    bodies.reserve(mass_.bodies.size() + 1);
    for (const Body<Geometry>& body : mass_.bodies) {
      stop_();
      const auto& p = body.properties;
      const double weight = in_situ_.density * in_situ_.gravity * p.measure;
      const double gyration = std::sqrt(p.second_moment.trace() / spin_count<dim> / p.measure);
      bodies.push_back({p.centroid, weight, gyration, true});
      measures.push_back(p.measure);
    }
    // In the model, wherever that lies: seen from a body kilometres away a block in motion has its
    // place to no more than 1e-12 m, and forces by that never come to rest.
    bodies.push_back({smaller_of(larger_of(zeros<Vec<dim>>(), mass_.domain.low), mass_.domain.high),
                      0.0, 1.0, false, false});
    measures.push_back(0.0);
    system_.add_bodies(bodies);
    for (int b = 0; b < ground(); ++b) system_.load[dof * b + dim - 1] = -system_.body(b).weight;
  }

  /// The contacts between bodies, one for every plane in which two touch, sorted by them: forces
  /// are then read and written in order.
  void add_contacts(std::vector<int> law_of_cut) {
    const auto found = find_contacts<Detector>(mass_, progress_);
    const auto law_of = [&](int cut) {
      return cut >= 0 ? law_of_cut[static_cast<std::size_t>(cut)] : 0;
    };
    visit_joined(found, mass_.domain.tolerance(), law_of,
                 [&](int a, int b, const auto& area, int law) {
                   stop_();
                   place_points(area);
                   if (system_.joints.contacts().empty())
                     system_.joints.reserve(found.size(), points_.size());
                   system_.joints.add(a, b, area, system_.body(a).centre, system_.body(b).centre,
                                      points_, law);
                 });
    system_.law_of_cut = std::make_shared<const std::vector<int>>(std::move(law_of_cut));
  }

  /// Contacts with the ground where the edge is rollers, which are smooth: there the shear of the
  /// in-situ stress acts as a load, and all of it on other sides.
  void add_edges() {
    visit_joined(boundary_facets(mass_), [&](int body, SideOf<dim> side, const auto& area) {
      stop_();
      place_points(area);
      const Vec<dim>& centre = system_.body(body).centre;
      const bool is_smooth = far_field_.at(side) == Boundary::rollers;
      if (is_smooth)
        system_.boundary.add(body, ground(), area, centre, system_.body(ground()).centre, points_);
      add_edge_load(body, area, is_smooth);
    });
  }

  /// The elastic ground beyond, its nodes as bodies behind those that there are: rock at the edge
  /// is glued to it by springs as stiff as walls are.
  void glue_to(std::shared_ptr<const GroundAround<dim>> around) {
    const EdgeMesh<dim>& mesh = around->mesh();
    const int first = system_.body_count();
    const double stiffness = system_.boundary.laws().front().joint_normal_stiffness();
    std::vector<EdgeSpring<dim>> springs;
    visit_joined(boundary_facets(mass_), [&](int body, SideOf<dim> side, const auto& area) {
      if (far_field_.at(side) != Boundary::elastic) return;
      stop_();
      place_points(area);
      const Vec<dim>& centre = system_.body(body).centre;
      const Vec<dim> middle = area.centre_from(centre);
      for (const FacetPoint<dim>& p : points_) {
        EdgeSpring<dim> spring;
        spring.rock = body;
        spring.arm = middle + p.offset;
        const auto place = mesh.place_of_point(side, Vec<dim>(centre + spring.arm));
        for (std::size_t k = 0; k < spring.nodes.size(); ++k)
          spring.nodes[k] = first + place.nodes[k];
        spring.shares = place.shares;
        spring.stiffness = stiffness * p.weight;
        springs.push_back(spring);
      }
    });
    const auto edge =
        std::make_shared<ElasticEdge<dim>>(around, std::move(springs), ground(), first);
    std::vector<SystemBody<dim>> nodes;
    for (const Vec<dim>& place : mesh.nodes())
      nodes.push_back({place, 0.0, edge->cell_length(), true, false});
    system_.add_bodies(nodes);
    system_.supports.add(edge);
  }

  /// What the in-situ stress exerts in every contact.
  void set_initial_stress() {
    const auto stress_at = [this](const auto& contact, const Vec<dim>& offset) {
      stop_();
      const Vec<dim> point = system_.body(contact.a).centre + contact.arm_a + offset;
      return in_situ_.template stress<dim>(mass_.domain.depth(point));
    };
    system_.joints.set_initial(stress_at);
    system_.boundary.set_initial(stress_at);
  }

 private:
  /// Its number: that of the last body.
  [[nodiscard]] int ground() const { return static_cast<int>(mass_.bodies.size()); }

  template <class Area>
  void place_points(const Area& area) {
    const auto points = area.gauss_points();
    points_.assign(points.begin(), points.end());
  }

  /// What the in-situ stress exerts on a piece of the edge.
  /// @param shear_alone  without what is at right angles to it
  template <class Area>
  void add_edge_load(int body, const Area& area, bool shear_alone) {
    const Vec<dim> normal = area.area_vector().normalized();
    const Vec<dim>& centre = system_.body(body).centre;
    const Vec<dim> middle = area.centre_from(centre);
    for (const FacetPoint<dim>& p : points_) {
      const Vec<dim> arm = middle + p.offset;
      Vec<dim> traction =
          in_situ_.template stress<dim>(mass_.domain.depth(Vec<dim>(centre + arm))) * normal;
      if (shear_alone) traction -= normal.dot(traction) * normal;
      if (!is_zero(traction))
        add_force_at<dim>(system_.load.data() + dof * body, arm, Vec<dim>(-p.weight * traction));
    }
  }

  const RockMass<Geometry>& mass_;
  const InSitu& in_situ_;
  const FarField<dim>& far_field_;
  System& system_;
  Progress progress_;
  StopCheck stop_;                       ///< asks the one above
  std::vector<FacetPoint<dim>> points_;  ///< of the contact at hand
};

/// Makes the model of rock in its in-situ stress: see `InitialModel::run`. Compiled once for all
/// laws, as the one below.
template <class Detector, class System>
void make_model(System& system, std::shared_ptr<const RockMass<typename System::GeometryType>> mass,
                const InSitu& in_situ, const FarField<System::dim>& far_field,
                std::vector<int> law_of_cut,
                std::shared_ptr<const GroundAround<System::dim>> around,
                std::vector<double>& measures, const Progress& progress) {
  const auto& rock = *mass;
  InitialModel<Detector, System>(rock, in_situ, far_field, system, progress)
      .run(std::move(mass), std::move(law_of_cut), std::move(around), measures);
}

}  // namespace voussoir::detail
