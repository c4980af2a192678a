// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/ordering.hpp>
#include <voussoir/core/progress.hpp>
#include <voussoir/model/contact_points.hpp>
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

/// The points of a contact in a facet, in place of what is in `points`.
template <class Facet, int Dim>
void place_points_on(const Facet& facet, ContactPoints kind, std::vector<FacetPoint<Dim>>& points) {
  if (kind == ContactPoints::gauss) {
    const auto gauss = facet.gauss_points();
    points.assign(gauss.begin(), gauss.end());
    return;
  }
  std::vector<WeightedPoint<Dim>> places;
  if constexpr (Dim == 2)
    place_points(kind, std::array{facet.start, facet.end}, facet.measure(), places);
  else
    place_points(kind, facet.vertices, facet.measure(), places);
  points.clear();
  for (const WeightedPoint<Dim>& p : places) points.push_back({p.place - facet.centre(), p.weight});
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
  using Facet = typename Geometry::Facet;
  static constexpr int dim = Geometry::dim;
  static constexpr int dof = Geometry::dof;

  /// All must outlive this.
  InitialModel(const RockMass<Geometry>& mass, const InSitu& in_situ, ContactPoints points,
               System& system, const Progress& progress)
      : mass_(mass),
        in_situ_(in_situ),
        kind_(points),
        system_(system),
        progress_(progress),
        stop_(progress) {}

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

  /// The contacts between bodies, sorted by them: forces are then read and written in order.
  template <class LawsOfSets>
  void add_contacts(const LawsOfSets& laws) {
    std::vector<int> law_of_cut = laws.of_cuts(mass_);
    const auto found = find_contacts<Detector>(mass_, progress_);
    const std::vector<int> order =
        order_by_bodies(found, [](const auto& c) { return std::pair<int, int>(c.a, c.b); });
    for (const int k : order) {
      stop_();
      const auto& c = found[static_cast<std::size_t>(k)];
      place_points_on(c.facet, kind_, points_);
      if (k == order.front()) system_.joints.reserve(found.size(), points_.size());
      const int law = c.cut >= 0 ? law_of_cut[static_cast<std::size_t>(c.cut)] : 0;
      system_.joints.add(c.a, c.b, c.facet, system_.body(c.a).centre, system_.body(c.b).centre,
                         points_, law);
    }
    system_.law_of_cut = std::make_shared<const std::vector<int>>(std::move(law_of_cut));
  }

  /// The surcharge on the top; contacts with the ground at the other edges, and the shear there.
  void add_edges() {
    for (const auto& f : boundary_facets(mass_)) {
      stop_();
      place_points_on(f.facet, kind_, points_);
      if (f.side == SideOf<dim>::top) {
        const Vec<dim> pressure = -in_situ_.surcharge * f.facet.area_vector();
        add_force_at<dim>(system_.load.data() + dof * f.body,
                          f.facet.centre_from(system_.body(f.body).centre), pressure);
        add_edge_shear(f.body, f.facet);
      } else {
        system_.boundary.add(f.body, ground(), f.facet, system_.body(f.body).centre,
                             system_.body(ground()).centre, points_);
        add_edge_shear(f.body, f.facet);
      }
    }
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
  void add_edge_shear(int body, const Facet& facet) {
    const Vec<dim> normal = facet.area_vector().normalized();
    const Vec<dim>& centre = system_.body(body).centre;
    const Vec<dim> middle = facet.centre_from(centre);
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
  const Progress& progress_;
  StopCheck stop_;
  std::vector<FacetPoint<dim>> points_;  ///< of the facet at hand
};

}  // namespace voussoir::detail
