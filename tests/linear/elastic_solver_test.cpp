// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/linear/elastic_solver.hpp>

#include "linear/dense_matrix.hpp"
#include "linear/rigid_network.hpp"
#include "support/dense_algebra.hpp"

namespace elastic_solver_test {

using namespace voussoir;
using namespace voussoir_test;

namespace {

constexpr LinearSettings iterative{.method = LinearMethod::iterative};
constexpr LinearSettings direct{.method = LinearMethod::direct};

template <int Dof>
ElasticSolver<Dof> solver(const RigidNetwork<Dof>& network, const LinearSettings& settings) {
  return {network.matrix, network.centres, settings};
}

template <int Dof>
Eigen::VectorXd exact(const RigidNetwork<Dof>& network, const Eigen::VectorXd& f) {
  Eigen::VectorXd u = f;
  (void)solver(network, direct).solve_in_place(u, {});
  return u;
}

/// The same network, with a chain of bodies beside it that hold each other and nothing else.
template <int Dof>
RigidNetwork<Dof> with_floating_chain(Random& random, int side, int chain) {
  constexpr int dim = dimension_of<Dof>;
  const auto held = rigid_network<Dof>(random, {.side = side});
  const int bodies = held.matrix.size();
  RigidNetwork<Dof> all(bodies + chain);
  all.centres = held.centres;
  for (int i = 0; i < bodies; ++i) {
    all.matrix.add(i, held.matrix.diagonal(i));
    for (int k = held.matrix.row_begin(i); k < held.matrix.row_begin(i + 1); ++k)
      all.matrix.add(i, held.matrix.column(k), held.matrix.below(k));
  }
  for (int k = 0; k < chain; ++k)
    all.centres.push_back(-5 * axis_vector<dim>(0) - k * axis_vector<dim>(1));
  for (int k = 0; k + 1 < chain; ++k)
    all.join(bodies + k, bodies + k + 1,
             all.centres[static_cast<std::size_t>(bodies + k)] - 0.5 * axis_vector<dim>(1),
             all_entries<dim>(5e9), 1e9);
  all.matrix.compress();
  return all;
}

}  // namespace

TEST_SUITE("linear/elastic_solver") {
  TEST_CASE_TEMPLATE("iteration, a factor and dense algebra give the same", D, Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(31, dof);
    const auto network = rigid_network<dof>(random, {.side = dof == 3 ? 10 : 4, .contrast = 100});
    const Eigen::VectorXd f = random_forces(random, dof * network.matrix.size());
    const Eigen::VectorXd expected = voussoir_test::solve(dense(network.matrix), f);
    // Multigrid of three levels, on so few bodies.
    Multigrid<dof> levels(network.matrix, network.centres,
                          {.largest_aggregate = 4, .direct_below = 8});
    CHECK(levels.level_count() >= 3);
    Eigen::VectorXd u = zeros(f.size()), residual;
    const IterationReport done = conjugate_gradients<dof>(
        network.matrix, [&](const Eigen::VectorXd& r, Eigen::VectorXd& z) { levels.apply(r, z); },
        f, u, residual, {.relative = 1e-10}, 200);
    CHECK(done.converged);
    CHECK(detail::largest_change<dof>(u, expected) <= 1e-10 * largest_translation<dof>(expected));
    Eigen::VectorXd product;
    network.matrix.multiply(u, product);
    CHECK((f - product - residual).norm() <= 1e-10 * f.norm());
    const Eigen::VectorXd factored = exact(network, f);
    CHECK(detail::largest_change<dof>(factored, expected) <=
          1e-10 * largest_translation<dof>(expected));
  }

  TEST_CASE_TEMPLATE("the error of an inexact solve is no larger than it says: 50 networks", D,
                     Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(32, dof);
    int solves = 0, beyond = 0;
    double closest = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 50; ++trial) {
      NetworkKind kind;
      const int sides = dof == 3 ? 30 : 3;
      kind.side = (dof == 3 ? 10 : 6) + static_cast<int>(random.below(sides));
      kind.contrast = std::pow(10, 6 * random.uniform());
      kind.disorder = 0.45 * random.uniform();
      const auto network = rigid_network<dof>(random, kind);
      auto iteration = solver(network, iterative);
      REQUIRE(iteration.report().method == LinearMethod::iterative);
      Eigen::VectorXd f = random_forces(random, dof * network.matrix.size());
      for (int again = 0; again < 2; ++again) {  // the second starts from the first
        const double tolerance = std::pow(10, -1 - 4 * random.uniform());
        const Eigen::VectorXd expected = exact(network, f);
        Eigen::VectorXd u = f;
        const double error = iteration.solve_in_place(u, {.relative = tolerance});
        const double change = detail::largest_change<dof>(u, expected);
        CAPTURE(trial);
        CAPTURE(kind.side);
        CAPTURE(kind.contrast);
        CAPTURE(tolerance);
        // An estimate, not a bound, fitted to other networks: beyond it by a quarter at most.
        CHECK(change <= 1.25 * error);
        beyond += change > error;
        CHECK(error <= tolerance * largest_translation<dof>(u));
        closest = std::min(closest, error / change);
        ++solves;
        f += 0.1 * random_forces(random, f.size());
      }
    }
    CHECK(solves == 100);
    CHECK(beyond <= 2);
    CHECK(closest < 100);  // it is an estimate of the error, not of the work
  }

  TEST_CASE("iterations do not grow with the number of bodies") {
    Random random(33);
    std::vector<int> iterations;
    for (const int side : {20, 40, 80, 160}) {
      const auto network = rigid_network<3>(random, {.side = side});
      auto iteration = solver(network, iterative);
      // The weight of the bodies: it moves all of them, not each for itself.
      Eigen::VectorXd u = zeros(3 * network.matrix.size());
      for (Eigen::Index k = 1; k < u.size(); k += 3) u[k] = -1e6;
      (void)iteration.solve_in_place(u, {.relative = 1e-6});
      iterations.push_back(iteration.report().iterations);
    }
    INFO(iterations[0], " ", iterations[1], " ", iterations[2], " ", iterations[3]);
    CHECK(iterations[3] <= 40);
    CHECK(iterations[3] <= 2 * iterations[0]);  // one level: 8 times, as the side
  }

  TEST_CASE("the last answer starts the next solve") {
    Random random(34);
    const auto network = rigid_network<6>(random, {.side = 8});
    auto iteration = solver(network, iterative);
    const Eigen::VectorXd f = random_forces(random, 6 * network.matrix.size());
    Eigen::VectorXd u = f, v = -2 * f;
    (void)iteration.solve_in_place(u, {.relative = 1e-9});
    const int first = iteration.report().iterations;
    (void)iteration.solve_in_place(v, {.relative = 1e-6});
    CHECK(iteration.report().iterations - first <= 6);  // the fewest that give an estimate
    CHECK((v + 2 * u).norm() <= 1e-8 * v.norm());
  }

  TEST_CASE("forces of zero move nothing") {
    Random random(35);
    const auto network = rigid_network<3>(random, {.side = 20});
    for (const auto& settings : {direct, iterative}) {
      Eigen::VectorXd u = zeros(3 * network.matrix.size());
      CHECK(solver(network, settings).solve_in_place(u, {}) == 0);
      CHECK(u == zeros(u.size()));
    }
  }

  TEST_CASE("forces that are not numbers are not solved for, and give no numbers") {
    Random random(37);
    const auto network = rigid_network<3>(random, {.side = 20});
    for (const auto& settings : {direct, iterative}) {
      auto solving = solver(network, settings);
      Eigen::VectorXd u = random_forces(random, 3 * network.matrix.size());
      u[4] = std::numeric_limits<double>::quiet_NaN();
      (void)solving.solve_in_place(u, {});
      CHECK(u.array().isNaN().all());
      CHECK(solving.report().method == settings.method);
      CHECK(std::isnan(largest_translation<3>(u)));
    }
    Eigen::VectorXd u = zeros(6), before = u;
    u[0] = std::numeric_limits<double>::quiet_NaN();
    u[3] = 1;
    CHECK(std::isnan(largest_translation<3>(u)));
    CHECK(std::isnan(detail::largest_change<3>(u, before)));
  }

  TEST_CASE("more exact than numbers can be: a factor, or an error as small as was asked") {
    Random random(38);
    for (const int side : {10, 20}) {
      const auto network = rigid_network<3>(random, {.side = side});
      const Eigen::VectorXd f = random_forces(random, 3 * network.matrix.size());
      const Eigen::VectorXd expected = exact(network, f);
      const double largest = largest_translation<3>(expected);
      for (const double tolerance : {1e-6, 1e-9, 1e-12, 1e-16}) {
        CAPTURE(side);
        CAPTURE(tolerance);
        auto solving = solver(network, iterative);
        Eigen::VectorXd u = f;
        CHECK(solving.solve_in_place(u, {.relative = tolerance}) <= tolerance * 1.001 * largest);
        // Rounding: the condition of these networks is below 1e5.
        CHECK(detail::largest_change<3>(u, expected) <= std::max(tolerance, 1e-11) * largest);
      }
    }
  }

  TEST_CASE_TEMPLATE("bodies that hold nothing but each other are named, whatever the method", D,
                     Dofs<3>, Dofs<6>) {
    constexpr int dof = D::value;
    Random random(36, dof);
    for (const int chain : {1, 2, 5, 40, 700})
      for (const auto& settings : {direct, iterative}) {
        CAPTURE(chain);
        CAPTURE(to_string(settings.method));
        const auto network = with_floating_chain<dof>(random, dof == 3 ? 20 : 7, chain);
        const int first = network.matrix.size() - chain;
        try {
          (void)solver(network, settings);
          FAIL("was taken");
        } catch (const FreeBody& free) {
          CHECK(free.body() >= first);
          CHECK(std::string(free.what()) == "elastic stiffness: body " +
                                                std::to_string(free.body()) +
                                                " can move without resistance");
        }
      }
  }

  TEST_CASE("hard matrices are solved as exactly as said, by a factor if need be") {
    Random random(41);
    struct Hard {
      const char* what;
      RigidNetwork<3> network;
    };
    std::vector<Hard> all;
    // Two sets of joints, one a million times softer: columns that hardly know of each other.
    {
      RigidNetwork<3> columns(40 * 40);
      for (int k = 0; k < 1600; ++k)
        columns.centres.push_back(
            {k % 40 + 0.3 * random.uniform(), k / 40 + 0.3 * random.uniform()});
      for (int k = 0; k < 1600; ++k) {
        const auto& here = columns.centres[static_cast<std::size_t>(k)];
        if (k / 40 == 0) columns.join(k, -1, here - 0.5 * axis_vector<2>(1), {5e9, 5e9}, 1e8);
        if (k / 40 < 39)
          columns.join(k, k + 40, 0.5 * (here + columns.centres[static_cast<std::size_t>(k + 40)]),
                       {5e8, 5e9}, 1e8);
        if (k % 40 < 39)
          columns.join(k, k + 1, 0.5 * (here + columns.centres[static_cast<std::size_t>(k + 1)]),
                       {5e3, 5e2}, 1e2);
      }
      columns.matrix.compress();
      all.push_back({"joint sets", std::move(columns)});
    }
    // A ring of beams a thousand times stiffer than the rock that it is in.
    {
      RigidNetwork<3> ring = rigid_network<3>(random, {.side = 40});
      RigidNetwork<3> both(1600);
      both.centres = ring.centres;
      for (int i = 0; i < 1600; ++i) {
        both.matrix.add(i, ring.matrix.diagonal(i));
        for (int k = ring.matrix.row_begin(i); k < ring.matrix.row_begin(i + 1); ++k)
          both.matrix.add(i, ring.matrix.column(k), ring.matrix.below(k));
      }
      int before = -1, first = -1;
      for (int k = 0; k < 60; ++k) {
        const double angle = 2 * 3.141592653589793 * k / 60;
        const int at = static_cast<int>(20 + 10 * std::cos(angle)) +
                       40 * static_cast<int>(20 + 10 * std::sin(angle));
        if (at == before) continue;
        if (before >= 0)
          both.join(before, at,
                    0.5 * (both.centres[static_cast<std::size_t>(before)] +
                           both.centres[static_cast<std::size_t>(at)]),
                    {5e12, 5e12}, 5e12);
        if (first < 0) first = at;
        before = at;
      }
      both.matrix.compress();
      all.push_back({"stiff ring", std::move(both)});
    }
    // A corner body, and a quarter of the network, held by next to nothing.
    for (const bool one : {true, false}) {
      RigidNetwork<3> loose(1600);
      for (int k = 0; k < 1600; ++k) loose.centres.push_back({k % 40, k / 40});
      const auto is_loose = [one](int k) { return one ? k == 1599 : k % 40 >= 20 && k / 40 >= 20; };
      for (int k = 0; k < 1600; ++k)
        for (const int next : {k % 40 < 39 ? k + 1 : -1, k / 40 < 39 ? k + 40 : -1}) {
          const auto& here = loose.centres[static_cast<std::size_t>(k)];
          if (next < 0) continue;
          const double soft = is_loose(k) != is_loose(next) ? 1e-9 : 1;
          loose.join(k, next, 0.5 * (here + loose.centres[static_cast<std::size_t>(next)]),
                     soft * Vec2(5e9, 5e9), soft * 1e8);
        }
      for (int k = 0; k < 40; ++k)
        loose.join(k, -1, loose.centres[static_cast<std::size_t>(k)], {5e9, 5e9}, 1e8);
      loose.matrix.compress();
      all.push_back({one ? "loose body" : "loose quarter", std::move(loose)});
    }
    for (const Hard& hard : all) {
      const auto& network = hard.network;
      Eigen::VectorXd f = random_forces(random, 3 * network.matrix.size());
      const Eigen::VectorXd expected = exact(network, f);
      // Of the factor: the loose ones cost it nine digits of sixteen.
      const double rounding = 1e-5 * largest_translation<3>(expected);
      for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
        CAPTURE(std::string(hard.what));
        CAPTURE(tolerance);
        auto iteration = solver(network, iterative);
        Eigen::VectorXd u = f;
        const double error = iteration.solve_in_place(u, {.relative = tolerance});
        CAPTURE(iteration.report().reason);
        CHECK(error <= tolerance * largest_translation<3>(u));
        CHECK(detail::largest_change<3>(u, expected) <= 1.25 * error + rounding);
      }
    }
  }

  TEST_CASE("iteration that does not converge is followed by a factor, and says so") {
    Random random(37);
    const auto network = rigid_network<3>(random, {.side = 30});
    const Eigen::VectorXd f = random_forces(random, 3 * network.matrix.size());
    LinearSettings few = iterative;
    few.max_iterations = 4;
    auto iteration = solver(network, few);
    Eigen::VectorXd u = f;
    CHECK(iteration.solve_in_place(u, {.relative = 1e-9}) == 0);
    CHECK(u == exact(network, f));
    CHECK(iteration.report().method == LinearMethod::direct);
    CHECK(iteration.report().reason.starts_with(
        "conjugate gradients did not converge in 4 iterations"));
    CHECK(iteration.residual() == zeros(f.size()));
  }

  TEST_CASE("what does not fit into memory is refused with both figures") {
    Random random(38);
    const auto network = rigid_network<6>(random, {.side = 9});
    const auto refusal = [&](LinearSettings settings) -> std::string {
      try {
        auto made = solver(network, settings);
        Eigen::VectorXd u = random_forces(random, 6 * network.matrix.size());
        (void)made.solve_in_place(u, {.relative = 1e-9});
      } catch (const NotEnoughMemory& error) {
        return error.what();
      } catch (const NumericalFault& error) {
        return std::string("fault: ") + error.what();
      }
      return "";
    };
    CHECK(refusal({}).empty());
    CHECK(refusal({.memory_limit = 1e6}).find("GB of memory, of 0.001 GB that it may take") !=
          std::string::npos);
    const std::string factor = refusal({.method = LinearMethod::direct, .memory_limit = 5e6});
    CHECK(factor.starts_with("elastic solver: a factor for 729 bodies needs 0.0"));
    // Iteration fits, the factor that would have to replace it does not.
    const std::string both =
        refusal({.method = LinearMethod::iterative, .memory_limit = 5e6, .max_iterations = 4});
    CHECK(both.starts_with("fault: elastic solver: conjugate gradients did not converge in 4"));
    CHECK(both.find("most at body ") != std::string::npos);
    CHECK(both.find("of 0.005 GB that it may take") != std::string::npos);
  }

  TEST_CASE("without a wish the faster one is taken, or the one that fits") {
    Random random(39);
    const auto small = rigid_network<3>(random, {.side = 40});
    CHECK(solver(small, {}).report().method == LinearMethod::direct);
    const auto wide = rigid_network<6>(random, {.side = 16});
    CHECK(solver(wide, {}).report().method == LinearMethod::iterative);
    const auto tight = solver(small, {.memory_limit = 2e6});
    CHECK(tight.report().method == LinearMethod::iterative);
    CHECK(tight.report().reason.find("GB that it may take") != std::string::npos);
  }

  TEST_CASE("stopped at any question, it can be made and asked again") {
    Random random(40);
    const auto network = rigid_network<3>(random, {.side = 60});
    const Eigen::VectorXd f = random_forces(random, 3 * network.matrix.size());
    ElasticSolver<3> kept(network.matrix, network.centres, iterative);
    for (int left = 0; left < 3; ++left) {
      int questions = left;
      const Progress progress = [&](double) { return questions-- > 0; };
      Eigen::VectorXd u = f;
      try {
        (void)kept.solve_in_place(u, {.relative = 1e-10}, progress);
      } catch (const Stopped&) {
        CHECK(u == f);
      }
    }
    Eigen::VectorXd u = f;
    const double error = kept.solve_in_place(u, {.relative = 1e-9});
    CHECK(detail::largest_change<3>(u, exact(network, f)) <= error);
    const Progress never = [](double) { return false; };
    const auto wide = rigid_network<3>(random, {.side = 200});  // tens of milliseconds
    CHECK_THROWS_AS(ElasticSolver<3>(wide.matrix, wide.centres, iterative, never), Stopped);
  }
}

}  // namespace elastic_solver_test
