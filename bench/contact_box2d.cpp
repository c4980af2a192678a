// SPDX-License-Identifier: MIT
// Box2D 2.4 as queries. Its skin of 1 cm is set to 0, or every pair that is near would touch, and
// vertices are set directly, because `Set` welds those nearer than 2.5 mm.
#include <box2d/b2_collision.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_polygon_shape.h>

#include <algorithm>
#include <memory>

#include "contact_query.hpp"

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

struct Prepared {
  explicit Prepared(const Workload<2>& workload) {
    for (const auto& block : workload.blocks) {
      b2PolygonShape shape;
      shape.m_radius = 0;
      const std::size_t count = block.vertices.size();
      usable.push_back(count <= b2_maxPolygonVertices);
      if (usable.back()) {
        shape.m_count = static_cast<int32>(count);
        for (std::size_t k = 0; k < count; ++k) {
          const auto& start = block.vertices[k];
          const auto& end = block.vertices[(k + 1) % count];
          const double x = end[0] - start[0], y = end[1] - start[1], length = std::hypot(x, y);
          shape.m_vertices[k].Set(static_cast<float>(start[0]), static_cast<float>(start[1]));
          shape.m_normals[k].Set(static_cast<float>(y / length), static_cast<float>(-x / length));
        }
      }
      shapes.push_back(shape);
      for (std::size_t step = 0; step < 2; ++step) {
        const auto& place = block.places[step];
        places[step].emplace_back(
            b2Vec2(static_cast<float>(place.position[0]), static_cast<float>(place.position[1])),
            b2Rot(static_cast<float>(place.turn[0])));
      }
    }
  }
  std::vector<bool> usable;  ///< no more corners than the library takes
  std::vector<b2PolygonShape> shapes;
  std::array<std::vector<b2Transform>, 2> places;
};

double collide(const Prepared& blocks, const std::vector<b2Transform>& places,
               const CandidatePair& pair, Answer* answer) {
  const b2PolygonShape &a = blocks.shapes[pair.a], &b = blocks.shapes[pair.b];
  b2Manifold manifold;
  b2CollidePolygons(&manifold, &a, places[pair.a], &b, places[pair.b]);
  if (manifold.pointCount == 0) return 0;
  b2WorldManifold world;
  world.Initialize(&manifold, places[pair.a], 0, places[pair.b], 0);
  float separation = world.separations[0];
  if (manifold.pointCount > 1) separation = std::min(separation, world.separations[1]);
  if (answer != nullptr)
    *answer = {separation < 0,      false,      true,
               manifold.pointCount, separation, {world.normal.x, world.normal.y, 0}};
  return separation;
}

}  // namespace

std::vector<Query> queries(const Workload<2>& workload) {
  const auto blocks = std::make_shared<Prepared>(workload);
  const auto& pairs = workload.pairs;
  std::vector<Query> all;
  all.push_back(query_over(
      pairs, {"Box2D 2.4 b2CollidePolygons", "f32", "manifold", false}, [blocks](int step) {
        return [&blocks = *blocks, &places = blocks->places[static_cast<std::size_t>(step)]](
                   std::size_t, const CandidatePair& pair, Answer* answer) {
          if (blocks.usable[pair.a] && blocks.usable[pair.b])
            return collide(blocks, places, pair, answer);
          if (answer != nullptr) answer->failed = true;
          return 0.0;
        };
      }));
  for (const bool warm : {false, true}) {
    auto caches = std::make_shared<std::vector<b2SimplexCache>>(warm ? pairs.size() : 0);
    for (b2SimplexCache& cache : *caches) cache.count = 0;
    all.push_back(query_over(
        pairs, {"Box2D 2.4 b2Distance", "f32", "bool", warm}, [blocks, caches, warm](int step) {
          return [&blocks = *blocks, &caches = *caches, warm,
                  &places = blocks->places[static_cast<std::size_t>(step)]](
                     std::size_t k, const CandidatePair& pair, Answer* answer) {
            b2DistanceInput input;
            input.proxyA.Set(&blocks.shapes[pair.a], 0);
            input.proxyB.Set(&blocks.shapes[pair.b], 0);
            input.transformA = places[pair.a];
            input.transformB = places[pair.b];
            input.useRadii = false;
            b2SimplexCache cold;
            cold.count = 0;
            b2DistanceOutput output;
            b2Distance(&output, warm ? &caches[k] : &cold, &input);
            if (answer != nullptr) answer->touch = output.distance <= 10 * b2_epsilon;
            return static_cast<double>(output.distance);
          };
        }));
  }
  return all;
}

std::vector<Query> queries(const Workload<3>&) { return {}; }

}  // namespace voussoir_bench
