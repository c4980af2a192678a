// SPDX-License-Identifier: MIT
// Bullet 3.24 as queries: GJK with EPA, and the convex-convex algorithm with its kept manifold.
// Compiled against the float or the double library. The margin of 4 cm is set to 0.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <btBulletCollisionCommon.h>

#include <limits>
#include <memory>

#include "contact_query.hpp"

namespace voussoir_bench {

const char* const build_description = VOUSSOIR_BENCH_BUILD;

namespace {

constexpr const char* precision = sizeof(btScalar) == 8 ? "f64" : "f32";

std::array<double, 3> numbers_of(const btVector3& v, double factor) {
  return {factor * static_cast<double>(v.x()), factor * static_cast<double>(v.y()),
          factor * static_cast<double>(v.z())};
}

struct Prepared {
  explicit Prepared(const Workload<3>& workload) {
    const auto vector = [](double x, double y, double z) {
      return btVector3(static_cast<btScalar>(x), static_cast<btScalar>(y),
                       static_cast<btScalar>(z));
    };
    for (const auto& block : workload.blocks) {
      auto shape = std::make_unique<btConvexHullShape>();
      for (const auto& p : block.vertices) shape->addPoint(vector(p[0], p[1], p[2]), false);
      shape->setMargin(0);
      shape->recalcLocalAabb();
      shape->initializePolyhedralFeatures();
      for (std::size_t step = 0; step < 2; ++step) {
        const auto& [p, q] = block.places[step];
        places[step].push_back(
            btTransform(btQuaternion(static_cast<btScalar>(q[1]), static_cast<btScalar>(q[2]),
                                     static_cast<btScalar>(q[3]), static_cast<btScalar>(q[0])),
                        vector(p[0], p[1], p[2])));
      }
      auto object = std::make_unique<btCollisionObject>();
      object->setCollisionShape(shape.get());
      shapes.push_back(std::move(shape));
      objects.push_back(std::move(object));
    }
  }
  std::vector<std::unique_ptr<btConvexHullShape>> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> objects;
  std::array<btAlignedObjectArray<btTransform>, 2> places;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
};

Query depth_query(const std::shared_ptr<Prepared>& blocks, const Workload<3>& workload) {
  return query_over(
      workload.pairs, {"Bullet 3.24 btGjkPairDetector+EPA", precision, "depth", false},
      [blocks](int step) {
        return [&blocks = *blocks, &places = blocks->places[static_cast<std::size_t>(step)]](
                   std::size_t, const CandidatePair& pair, Answer* answer) {
          btVoronoiSimplexSolver simplex;
          btGjkEpaPenetrationDepthSolver penetration;
          btGjkPairDetector detector(blocks.shapes[pair.a].get(), blocks.shapes[pair.b].get(),
                                     &simplex, &penetration);
          btGjkPairDetector::ClosestPointInput input;
          input.m_transformA = places[static_cast<int>(pair.a)];
          input.m_transformB = places[static_cast<int>(pair.b)];
          btPointCollector found;
          detector.getClosestPoints(input, found, nullptr);
          if (!found.m_hasResult) return 0.0;
          const auto separation = static_cast<double>(found.m_distance);
          if (answer != nullptr)
            *answer = {separation < 0, false,
                       true,           1,
                       separation,     numbers_of(found.m_normalOnBInWorld, -1)};
          return separation;
        };
      });
}

/// The algorithm objects of a query; kept for every pair if warm, as a simulation keeps them.
struct Algorithms {
  std::shared_ptr<Prepared> blocks;
  std::vector<btCollisionAlgorithm*> of_pair;
  btDispatcherInfo info;

  void release(btCollisionAlgorithm* algorithm) const {
    if (algorithm == nullptr) return;
    algorithm->~btCollisionAlgorithm();
    blocks->dispatcher.freeCollisionAlgorithm(algorithm);
  }
  ~Algorithms() {
    for (btCollisionAlgorithm* algorithm : of_pair) release(algorithm);
  }
};

double collide(Algorithms& algorithms, std::size_t k, const CandidatePair& pair, Answer* answer) {
  Prepared& blocks = *algorithms.blocks;
  btCollisionObject &object_a = *blocks.objects[pair.a], &object_b = *blocks.objects[pair.b];
  const btCollisionObjectWrapper a(nullptr, blocks.shapes[pair.a].get(), &object_a,
                                   object_a.getWorldTransform(), -1, -1);
  const btCollisionObjectWrapper b(nullptr, blocks.shapes[pair.b].get(), &object_b,
                                   object_b.getWorldTransform(), -1, -1);
  const bool warm = !algorithms.of_pair.empty();
  btCollisionAlgorithm* algorithm = warm ? algorithms.of_pair[k] : nullptr;
  if (algorithm == nullptr) {
    algorithm = blocks.dispatcher.findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    if (warm) algorithms.of_pair[k] = algorithm;
  }
  btManifoldResult result(&a, &b);
  algorithm->processCollision(&a, &b, algorithms.info, &result);
  btManifoldArray manifolds;
  algorithm->getAllContactManifolds(manifolds);
  int points = 0;
  double separation = std::numeric_limits<double>::infinity();
  std::array<double, 3> normal{};
  for (int m = 0; m < manifolds.size(); ++m) {
    const double sign = manifolds[m]->getBody0() == &object_a ? -1 : 1;
    for (int p = 0; p < manifolds[m]->getNumContacts(); ++p, ++points) {
      const btManifoldPoint& point = manifolds[m]->getContactPoint(p);
      if (static_cast<double>(point.getDistance()) >= separation) continue;
      separation = static_cast<double>(point.getDistance());
      normal = numbers_of(point.m_normalWorldOnB, sign);
    }
  }
  if (answer != nullptr && points > 0)
    *answer = {separation < 0, false, true, points, separation, normal};
  if (!warm) algorithms.release(algorithm);
  return points > 0 ? separation : 0;
}

Query manifold_query(const std::shared_ptr<Prepared>& blocks, const Workload<3>& workload,
                     const char* peer, bool separating_axes, bool warm) {
  auto algorithms = std::make_shared<Algorithms>();
  algorithms->blocks = blocks;
  algorithms->of_pair.resize(warm ? workload.pairs.size() : 0);
  algorithms->info.m_enableSatConvex = separating_axes;
  return query_over(workload.pairs, {peer, precision, "manifold", warm}, [=](int step) {
    Prepared& prepared = *blocks;
    const auto& places = prepared.places[static_cast<std::size_t>(step)];
    for (std::size_t k = 0; k < prepared.objects.size(); ++k)
      prepared.objects[k]->setWorldTransform(places[static_cast<int>(k)]);
    return [&algorithms = *algorithms](std::size_t k, const CandidatePair& pair, Answer* answer) {
      return collide(algorithms, k, pair, answer);
    };
  });
}

}  // namespace

std::vector<Query> queries(const Workload<2>&) { return {}; }

std::vector<Query> queries(const Workload<3>& workload) {
  const auto blocks = std::make_shared<Prepared>(workload);
  const char* const gjk = "Bullet 3.24 btConvexConvex (GJK axis + clipping)";
  const char* const sat = "Bullet 3.24 btConvexConvex (SAT axis + clipping)";
  return {depth_query(blocks, workload), manifold_query(blocks, workload, gjk, false, false),
          manifold_query(blocks, workload, gjk, false, true),
          manifold_query(blocks, workload, sat, true, true)};
}

}  // namespace voussoir_bench
