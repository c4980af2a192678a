// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <vector>
#include <voussoir/tunnel/interaction_diagram.hpp>

namespace interaction_diagram_test {

using namespace voussoir;

namespace {

/// A tunnel that knows its place in the diagram.
DiagramPoint labelled(std::size_t spacing, std::size_t thickness) {
  DiagramPoint point{};
  point.crown_convergence = static_cast<double>(100 * spacing + thickness);
  point.report.verdict = Verdict::stable;
  return point;
}

}  // namespace

TEST_SUITE("tunnel/interaction_diagram") {
  TEST_CASE("points come row by row, whatever the number of threads") {
    for (const unsigned threads : {0U, 1U, 2U, 7U, 64U}) {
      CAPTURE(threads);
      const auto points = interaction_diagram(4, 6, threads, labelled);
      REQUIRE(points.size() == 24);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
          const DiagramPoint& point = points[6 * i + j];
          CHECK(point.spacing == i);
          CHECK(point.thickness == j);
          CHECK(point.crown_convergence == static_cast<double>(100 * i + j));
        }
    }
  }

  TEST_CASE("every tunnel is run once, and the count of those done reaches every number once") {
    std::vector<std::atomic<int>> runs(12);
    std::mutex guard;
    std::vector<std::size_t> counts;
    (void)interaction_diagram(
        3, 4, 5,
        [&](std::size_t i, std::size_t j) {
          ++runs[4 * i + j];
          return labelled(i, j);
        },
        [&](std::size_t done) {
          const std::scoped_lock lock(guard);
          counts.push_back(done);
        });
    for (const auto& run : runs) CHECK(run == 1);
    std::sort(counts.begin(), counts.end());
    REQUIRE(counts.size() == 12);
    for (std::size_t k = 0; k < 12; ++k) CHECK(counts[k] == k + 1);
  }

  TEST_CASE("a tunnel that throws stops the diagram with its own words") {
    const auto run = [](std::size_t i, std::size_t j) {
      if (i == 1 && j == 2) throw std::runtime_error("no rock left");
      return labelled(i, j);
    };
    CHECK_THROWS_WITH_AS((void)interaction_diagram(2, 3, 2, run), "no rock left",
                         std::runtime_error);
  }

  TEST_CASE("a diagram without tunnels is empty") {
    CHECK(interaction_diagram(0, 6, 2, labelled).empty());
  }

  TEST_CASE("a point is no design if rock detached or no equilibrium was found") {
    DiagramPoint point = labelled(0, 0);
    CHECK(!point.failed());
    point.report.fallen_measure = 0.1;
    CHECK(point.failed());
    for (const Verdict verdict : {Verdict::collapse, Verdict::undecided}) {
      DiagramPoint other = labelled(0, 0);
      other.report.verdict = verdict;
      CHECK(other.failed());
    }
  }
}

}  // namespace interaction_diagram_test
