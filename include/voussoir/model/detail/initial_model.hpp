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
#include <voussoir/model/contact_points.hpp>
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

/// The shapes of the bodies and, last, of the ground around the domain. They keep the rock alive.
template <class System>
[[nodiscard]] std::shared_ptr<const typename System::Shapes> shapes_of(
    std::shared_ptr<const RockMass<typename System::GeometryType>> mass) {
  struct Shapes {
    std::shared_ptr<const RockMass<typename System::GeometryType>> mass;
    decltype(edge_slabs(mass->domain)) slabs;
    typename System::Shapes of_body;
  };
  auto slabs = edge_slabs(mass->domain);
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

  /// Rock and model must outlive this.
  InitialModel(const RockMass<Geometry>& mass, const InSitu& in_situ, ContactPoints points,
               System& system, Progress progress = {})
      : mass_(mass),
        in_situ_(in_situ),
        kind_(points),
        system_(system),
        progress_(std::move(progress)),
        stop_(progress_) {}

  /// All of it.
  /// @param mass      the same as above, to be kept alive for its shapes
  /// @param measures  of bodies, in place of what is there [m^2 or m^3]
  template <class LawsOfSets>
  void run(std::shared_ptr<const RockMass<Geometry>> mass, const LawsOfSets& laws,
           std::vector<double>& measures) {
    add_bodies(measures);
    add_contacts(laws);
    add_edges();
    system_.shapes = shapes_of<System>(std::move(mass));
    set_initial_stress();
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
    bodies.push_back({zeros<Vec<dim>>(), 0.0, 1.0, false, false});
    measures.push_back(0.0);
    system_.add_bodies(bodies);
    for (int b = 0; b < ground(); ++b) system_.load[dof * b + dim - 1] = -system_.body(b).weight;
  }

  /// The contacts between bodies, one for every plane in which two touch, sorted by them: forces
  /// are then read and written in order.
  template <class LawsOfSets>
  void add_contacts(const LawsOfSets& laws) {
    std::vector<int> law_of_cut = laws.of_cuts(mass_);
    const auto found = find_contacts<Detector>(mass_, progress_);
    const auto law_of = [&](int cut) {
      return cut >= 0 ? law_of_cut[static_cast<std::size_t>(cut)] : 0;
    };
    visit_joined(found, mass_.domain.tolerance(), law_of,
                 [&](int a, int b, const auto& area, int law) {
                   stop_();
                   place_points_on(area, kind_, points_);
                   if (system_.joints.contacts().empty())
                     system_.joints.reserve(found.size(), points_.size());
                   system_.joints.add(a, b, area, system_.body(a).centre, system_.body(b).centre,
                                      points_, law);
                 });
    system_.law_of_cut = std::make_shared<const std::vector<int>>(std::move(law_of_cut));
  }

  /// The surcharge on the top; contacts with the ground at the other edges, and the shear there.
  void add_edges() {
    visit_joined(boundary_facets(mass_), [&](int body, SideOf<dim> side, const auto& area) {
      stop_();
      place_points_on(area, kind_, points_);
      const Vec<dim>& centre = system_.body(body).centre;
      if (side == SideOf<dim>::top) {
        const Vec<dim> pressure = -in_situ_.surcharge * area.area_vector();
        add_force_at<dim>(system_.load.data() + dof * body, area.centre_from(centre), pressure);
        add_edge_shear(body, area);
      } else {
        system_.boundary.add(body, ground(), area, centre, system_.body(ground()).centre, points_);
        add_edge_shear(body, area);
      }
    });
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

  /// The edge of the domain is smooth: where the in-situ stress has shear on it, that goes on
  /// acting as a load.
  template <class Area>
  void add_edge_shear(int body, const Area& area) {
    const Vec<dim> normal = area.area_vector().normalized();
    const Vec<dim>& centre = system_.body(body).centre;
    const Vec<dim> middle = area.centre_from(centre);
    for (const FacetPoint<dim>& p : points_) {
      const Vec<dim> arm = middle + p.offset;
      const Vec<dim> traction =
          in_situ_.template stress<dim>(mass_.domain.depth(Vec<dim>(centre + arm))) * normal;
      const Vec<dim> shear = traction - normal.dot(traction) * normal;
      if (!is_zero(shear))
        add_force_at<dim>(system_.load.data() + dof * body, arm, Vec<dim>(-p.weight * shear));
    }
  }

  const RockMass<Geometry>& mass_;
  const InSitu& in_situ_;
  ContactPoints kind_;
  System& system_;
  Progress progress_;
  StopCheck stop_;                       ///< asks the one above
  std::vector<FacetPoint<dim>> points_;  ///< of the contact at hand
};

}  // namespace voussoir::detail
