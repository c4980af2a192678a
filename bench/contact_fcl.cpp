// SPDX-License-Identifier: MIT
// FCL 0.7 as queries: `collide` with libccd inside, and with its own GJK and EPA.
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include <memory>

#include "contact_query.hpp"

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

struct Prepared {
  explicit Prepared(const Workload<3>& workload) {
    for (const auto& block : workload.blocks) {
      auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
      for (const auto& p : block.vertices) vertices->emplace_back(p[0], p[1], p[2]);
      auto faces = std::make_shared<std::vector<int>>();
      for (const auto& face : block.faces) {
        faces->push_back(static_cast<int>(face.size()));
        faces->insert(faces->end(), face.begin(), face.end());
      }
      shapes.push_back(std::make_shared<fcl::Convexd>(
          vertices, static_cast<int>(block.faces.size()), faces, false));
      shapes.back()->computeLocalAABB();
      for (std::size_t step = 0; step < 2; ++step) {
        const auto& [p, q] = block.places[step];
        fcl::Transform3d place = fcl::Transform3d::Identity();
        place.linear() = fcl::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
        place.translation() = fcl::Vector3d(p[0], p[1], p[2]);
        places[step].push_back(place);
      }
    }
  }
  std::vector<std::shared_ptr<fcl::Convexd>> shapes;
  std::array<std::vector<fcl::Transform3d>, 2> places;
};

struct Way {
  const char* peer;
  fcl::GJKSolverType solver;
  bool contact, warm;
};

Query query(const std::shared_ptr<Prepared>& blocks, const Workload<3>& workload, const Way& way) {
  auto guesses = std::make_shared<std::vector<fcl::Vector3d>>(way.warm ? workload.pairs.size() : 0,
                                                              fcl::Vector3d(1, 0, 0));
  return query_over(workload.pairs, {way.peer, "f64", way.contact ? "depth" : "bool", way.warm, 4},
                    [=](int step) {
                      return [&blocks = *blocks, &guesses = *guesses, way,
                              &places = blocks->places[static_cast<std::size_t>(step)]](
                                 std::size_t k, const CandidatePair& pair, Answer* answer) {
                        fcl::CollisionRequestd request;
                        request.num_max_contacts = way.contact ? 8 : 1;
                        request.enable_contact = way.contact;
                        request.gjk_solver_type = way.solver;
                        request.gjk_tolerance = 1e-6;
                        request.enable_cached_gjk_guess = way.warm;
                        if (way.warm) request.cached_gjk_guess = guesses[k];
                        fcl::CollisionResultd result;
                        fcl::collide(blocks.shapes[pair.a].get(), places[pair.a],
                                     blocks.shapes[pair.b].get(), places[pair.b], request, result);
                        if (way.warm) guesses[k] = result.cached_gjk_guess;
                        if (answer != nullptr) {
                          answer->touch = result.isCollision();
                          answer->points = static_cast<int>(result.numContacts());
                        }
                        if (!way.contact || !result.isCollision())
                          return result.isCollision() ? 1.0 : 0.0;
                        const fcl::Contactd& contact = result.getContact(0);
                        if (answer != nullptr) {
                          answer->has_separation = true;
                          answer->separation = -contact.penetration_depth;
                          for (std::size_t axis = 0; axis < 3; ++axis)
                            answer->normal[axis] = contact.normal[static_cast<Eigen::Index>(axis)];
                        }
                        return contact.penetration_depth;
                      };
                    });
}

}  // namespace

std::vector<Query> queries(const Workload<2>&) { return {}; }

std::vector<Query> queries(const Workload<3>& workload) {
  const auto blocks = std::make_shared<Prepared>(workload);
  std::vector<Query> all;
  for (const Way& way : {Way{"FCL 0.7 collide (libccd)", fcl::GST_LIBCCD, false, false},
                         Way{"FCL 0.7 collide (own GJK)", fcl::GST_INDEP, false, false},
                         Way{"FCL 0.7 collide (own GJK)", fcl::GST_INDEP, false, true},
                         Way{"FCL 0.7 collide+contact (libccd)", fcl::GST_LIBCCD, true, false},
                         Way{"FCL 0.7 collide+contact (own GJK+EPA)", fcl::GST_INDEP, true, false}})
    all.push_back(query(blocks, workload, way));
  return all;
}

}  // namespace voussoir_bench
