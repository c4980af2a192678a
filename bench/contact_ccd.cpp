// SPDX-License-Identifier: MIT
// libccd 2.1 as queries: GJK with EPA, and MPR. It keeps nothing and gives one contact point.
#include <ccd/ccd.h>
#include <ccd/quat.h>

#include <limits>
#include <memory>

#include "contact_query.hpp"

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

struct Body {
  const std::vector<std::array<double, 3>>* vertices;
  ccd_vec3_t position;
  ccd_quat_t turn, turn_back;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const Body& body = *static_cast<const Body*>(object);
  ccd_vec3_t local = *direction;
  ccdQuatRotVec(&local, &body.turn_back);
  const std::array<double, 3>* best = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& vertex : *body.vertices) {
    const double along = local.v[0] * vertex[0] + local.v[1] * vertex[1] + local.v[2] * vertex[2];
    if (along > most) {
      most = along;
      best = &vertex;
    }
  }
  ccdVec3Set(farthest, (*best)[0], (*best)[1], (*best)[2]);
  ccdQuatRotVec(farthest, &body.turn);
  ccdVec3Add(farthest, &body.position);
}

void centre(const void* object, ccd_vec3_t* inside) {
  *inside = static_cast<const Body*>(object)->position;
}

struct Prepared {
  explicit Prepared(const Workload<3>& workload) {
    for (std::size_t step = 0; step < 2; ++step)
      for (const auto& block : workload.blocks) {
        const auto& [p, q] = block.places[step];
        Body body{&block.vertices, {}, {}, {}};
        ccdVec3Set(&body.position, p[0], p[1], p[2]);
        ccdQuatSet(&body.turn, q[1], q[2], q[3], q[0]);
        ccdQuatInvert2(&body.turn_back, &body.turn);
        bodies[step].push_back(body);
      }
    CCD_INIT(&settings);
    settings.support1 = settings.support2 = support;
    settings.center1 = settings.center2 = centre;
    settings.max_iterations = 200;
    settings.epa_tolerance = settings.mpr_tolerance = 1e-6;
  }
  std::array<std::vector<Body>, 2> bodies;
  ccd_t settings{};
};

using Intersect = int (*)(const void*, const void*, const ccd_t*);
using Penetration = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*,
                            ccd_vec3_t*);

Query query(const std::shared_ptr<Prepared>& prepared, const Workload<3>& workload,
            const char* peer, Intersect intersect) {
  return query_over(workload.pairs, {peer, "f64", "bool", false}, [=](int step) {
    return [&settings = prepared->settings, intersect,
            &bodies = prepared->bodies[static_cast<std::size_t>(step)]](
               std::size_t, const CandidatePair& pair, Answer* answer) {
      const bool touch = intersect(&bodies[pair.a], &bodies[pair.b], &settings) != 0;
      if (answer != nullptr) answer->touch = touch;
      return touch ? 1.0 : 0.0;
    };
  });
}

Query query(const std::shared_ptr<Prepared>& prepared, const Workload<3>& workload,
            const char* peer, Penetration penetration) {
  return query_over(workload.pairs, {peer, "f64", "depth", false}, [=](int step) {
    return [&settings = prepared->settings, penetration,
            &bodies = prepared->bodies[static_cast<std::size_t>(step)]](
               std::size_t, const CandidatePair& pair, Answer* answer) {
      ccd_real_t depth = 0;
      ccd_vec3_t direction{}, point{};
      const int result =
          penetration(&bodies[pair.a], &bodies[pair.b], &settings, &depth, &direction, &point);
      if (answer != nullptr && result == 0)
        *answer = {true, false, true, 1, -depth, {direction.v[0], direction.v[1], direction.v[2]}};
      if (answer != nullptr && result < -1) answer->failed = true;  // -1: they do not touch
      return result == 0 ? depth : 1.0;
    };
  });
}

}  // namespace

std::vector<Query> queries(const Workload<2>&) { return {}; }

std::vector<Query> queries(const Workload<3>& workload) {
  const auto prepared = std::make_shared<Prepared>(workload);
  return {query(prepared, workload, "libccd 2.1 GJK intersect", ccdGJKIntersect),
          query(prepared, workload, "libccd 2.1 GJK+EPA penetration", ccdGJKPenetration),
          query(prepared, workload, "libccd 2.1 MPR intersect", ccdMPRIntersect),
          query(prepared, workload, "libccd 2.1 MPR penetration", ccdMPRPenetration)};
}

}  // namespace voussoir_bench
