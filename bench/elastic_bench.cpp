// SPDX-License-Identifier: MIT
// Equations of the elastic stiffness by size: the factor, multigrid, the whole search for
// equilibrium that they serve, and peers on the same matrices. One product with the matrix is the
// floor. At the end: exponents n^k fitted to the sizes of each row from 10 000 bodies.
//   elastic_bench [--large] [Google Benchmark's flags]      --large: 860 000 blocks in 2-D
//   too, and the peers on larger models (a quarter of an hour)
#include <benchmark/benchmark.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#ifdef VOUSSOIR_BENCH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>
#include <voussoir/linear/elastic_solver.hpp>

#include "cavern_case.hpp"
#include "design_case.hpp"

namespace {

using namespace voussoir;
using namespace voussoir_bench;

/// A model of one size: the supported tunnel, its stiffness, and the forces of its unloading.
template <class Model>
struct Case {
  static constexpr int dof = Model::dof;
  Model model;
  BlockMatrix<dof> matrix;
  BodyCentres<dof> centres;
  Eigen::VectorXd load;

  explicit Case(Model made)
      : model(std::move(made)),
        matrix(model.system().elastic_stiffness()),
        centres(model.system().centres()) {
    auto system = model.system();
    system.wall_fraction = 0;
    system.forces(system.displacement, load);
  }
};

using Planar2 = Case<Tunnel>;
using Spatial3 = Case<Cavern>;

/// The last that was asked for: the large ones do not fit into memory together.
const Planar2& planar(int width) {
  static std::pair<int, std::unique_ptr<Planar2>> last;
  if (last.first != width) {
    last = {};
    Tunnel tunnel = excavated_square(width);
    support(tunnel, 15 * degree, 0.1);
    last = {width, std::make_unique<Planar2>(std::move(tunnel))};
  }
  return *last.second;
}
const Spatial3& spatial(int spacing) {
  static std::pair<int, std::unique_ptr<Spatial3>> last;
  if (last.first != spacing) {
    last = {};
    last = {spacing, std::make_unique<Spatial3>(cavern(0.01 * spacing))};
  }
  return *last.second;
}

template <class Of>
void count(benchmark::State& state, const Of& of) {
  state.counters["bodies"] = of.matrix.size();
}

template <class Of>
void product(benchmark::State& state, const Of& of) {
  Eigen::VectorXd y;
  for (auto _ : state) {
    of.matrix.multiply(of.load, y);
    benchmark::DoNotOptimize(y.data());
  }
  count(state, of);
}

template <class Of>
void order(benchmark::State& state, const Of& of) {
  for (auto _ : state) {
    const CholeskyPattern pattern(Of::dof, of.matrix.size(), of.matrix.pairs());
    state.counters["operations"] = pattern.operations();
    state.counters["numbers"] = pattern.stored_numbers();
  }
  count(state, of);
}

template <class Of>
void factor(benchmark::State& state, const Of& of, unsigned threads) {
  const auto pattern =
      std::make_shared<const CholeskyPattern>(Of::dof, of.matrix.size(), of.matrix.pairs());
  for (auto _ : state) {
    const BlockCholesky<Of::dof> made(of.matrix, pattern, {}, threads);
    benchmark::DoNotOptimize(&made);
  }
  count(state, of);
}

template <class Of>
void factor_solve(benchmark::State& state, const Of& of) {
  const BlockCholesky<Of::dof> made(of.matrix);
  Eigen::VectorXd u;
  for (auto _ : state) {
    u = of.load;
    made.solve_in_place(u);
    benchmark::DoNotOptimize(u.data());
  }
  count(state, of);
}

template <class Of>
void multigrid(benchmark::State& state, const Of& of) {
  for (auto _ : state) {
    Multigrid<Of::dof> made(of.matrix, of.centres);
    state.counters["levels"] = made.level_count();
    state.counters["complexity"] = made.complexity();
  }
  count(state, of);
}

template <class Of>
void iterate(benchmark::State& state, const Of& of, double tolerance) {
  Multigrid<Of::dof> levels(of.matrix, of.centres);
  Eigen::VectorXd residual;
  for (auto _ : state) {
    Eigen::VectorXd u = zeros(of.load.size());
    const IterationReport done = conjugate_gradients<Of::dof>(
        of.matrix, [&](const Eigen::VectorXd& r, Eigen::VectorXd& z) { levels.apply(r, z); },
        of.load, u, residual, {.relative = tolerance}, 200);
    if (!done.converged) state.SkipWithError("did not converge");
    state.counters["iterations"] = done.iterations;
  }
  count(state, of);
}

template <class Of>
void equilibrium_search(benchmark::State& state, const Of& of) {
  for (auto _ : state) {
    state.PauseTiming();
    auto model = of.model;
    state.ResumeTiming();
    const EquilibriumReport report = model.equilibrium();
    state.PauseTiming();
    if (report.verdict != Verdict::stable) state.SkipWithError("not stable");
    state.counters["error_estimate"] = report.error_estimate;
    state.counters["iterations"] = report.linear.iterations;
    state.counters["is_direct"] = report.linear.method == LinearMethod::direct;
    state.ResumeTiming();
  }
  count(state, of);
}

// ---- peers
// -----------------------------------------------------------------------------------------

using Sparse = Eigen::SparseMatrix<double>;

/// Lower triangle, number by number.
template <int Dof>
Sparse as_sparse(const BlockMatrix<Dof>& blocks) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int i, int j, const Fixed<Dof, Dof>& block) {
    for (int r = 0; r < Dof; ++r)
      for (int c = 0; c < Dof; ++c)
        if (i != j || r >= c) entries.emplace_back(Dof * i + r, Dof * j + c, block(r, c));
  };
  for (int i = 0; i < blocks.size(); ++i) {
    add(i, i, blocks.diagonal(i));
    for (int k = blocks.row_begin(i); k < blocks.row_begin(i + 1); ++k)
      add(i, blocks.column(k), blocks.below(k));
  }
  Sparse matrix(Dof * blocks.size(), Dof * blocks.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class Solver, class Of>
void peer_factor(benchmark::State& state, const Of& of) {
  const Sparse matrix = as_sparse(of.matrix);
  Solver solver;
  for (auto _ : state) {
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) state.SkipWithError("not factored");
  }
  const Eigen::VectorXd expected = solver.solve(of.load);
  Eigen::VectorXd u = of.load;
  BlockCholesky<Of::dof>(of.matrix).solve_in_place(u);
  state.counters["difference"] = (u - expected).norm() / expected.norm();
  count(state, of);
}

/// Conjugate gradients with an incomplete factor by numbers; set-up included, to a residual of
/// 1e-6 of the load.
template <class Of>
void peer_iterate(benchmark::State& state, const Of& of) {
  const Sparse matrix = as_sparse(of.matrix);
  for (auto _ : state) {
    Eigen::ConjugateGradient<Sparse, Eigen::Lower, Eigen::IncompleteCholesky<double>> solver;
    solver.setTolerance(1e-6);
    solver.compute(matrix);
    const Eigen::VectorXd u = solver.solve(of.load);
    if (solver.info() != Eigen::Success) state.SkipWithError("did not converge");
    state.counters["iterations"] = static_cast<double>(solver.iterations());
  }
  count(state, of);
}

using EigenFactor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>>;

// ---- what is run
// -----------------------------------------------------------------------------------

/// One row of benchmarks for each way, over the sizes given.
template <class Get>
void add_family(const std::string& space, const std::vector<int>& sizes, Get get, int factor_up_to,
                int peers_up_to) {
  const auto add = [&](const char* name, int size, auto run) {
    return benchmark::RegisterBenchmark(
               (space + "/" + name + "/" + std::to_string(size)).c_str(),
               [run, get, size](benchmark::State& s) { run(s, get(size)); })
        ->Unit(benchmark::kMillisecond);
  };
  for (const int size : sizes) {  // the larger the number, the larger the model in 2-D only
    const auto within = [&](int most) { return space == "planar" ? size <= most : size >= most; };
    add("product", size, [](auto& s, const auto& of) { product(s, of); });
    add("multigrid", size, [](auto& s, const auto& of) { multigrid(s, of); });
    add("iterate_1e-3", size, [](auto& s, const auto& of) { iterate(s, of, 1e-3); });
    add("iterate_1e-6", size, [](auto& s, const auto& of) { iterate(s, of, 1e-6); });
    if (within(factor_up_to)) {
      add("order", size, [](auto& s, const auto& of) { order(s, of); });
      add("factor", size, [](auto& s, const auto& of) { factor(s, of, 1); });
      add("factor_2_threads", size, [](auto& s, const auto& of) {
        factor(s, of, 2);
      })->UseRealTime();
      add("factor_solve", size, [](auto& s, const auto& of) { factor_solve(s, of); });
    }
    if (within(peers_up_to)) {
      add("peer_eigen_ldlt", size,
          [](auto& s, const auto& of) { peer_factor<EigenFactor>(s, of); });
      add("peer_eigen_cg", size, [](auto& s, const auto& of) { peer_iterate(s, of); });
#ifdef VOUSSOIR_BENCH_CHOLMOD
      add("peer_cholmod", size,
          [](auto& s, const auto& of) { peer_factor<Eigen::CholmodSupernodalLLT<Sparse>>(s, of); });
#endif
    }
    add("equilibrium", size, [](auto& s, const auto& of) { equilibrium_search(s, of); });
  }
}

/// Remembers what each row took at each size.
class Fitting : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const auto bodies = run.counters.find("bodies");
      const std::string name = run.run_name.function_name;
      if (run.run_type != Run::RT_Iteration || run.error_occurred || bodies == run.counters.end() ||
          bodies->second.value < 1e4)
        continue;
      points_[name.substr(0, name.rfind('/'))].emplace_back(
          std::log(bodies->second.value),
          std::log(run.cpu_accumulated_time / static_cast<double>(run.iterations)));
    }
  }
  /// Exponents by least squares.
  void print() const {
    std::printf("\n%-28s %s\n", "row", "CPU time from 10 000 bodies grows as bodies^");
    for (const auto& [name, points] : points_) {
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;
      for (const auto& [size, time] : points) {
        n += 1, x += size, y += time, xx += size * size, xy += size * time;
      }
      const double spread = n * xx - x * x;
      if (spread > 1e-6) std::printf("%-28s %.2f\n", name.c_str(), (n * xy - x * y) / spread);
    }
  }

 private:
  std::map<std::string, std::vector<std::pair<double, double>>> points_;
};

}  // namespace

int main(int argc, char** argv) {
  bool large = false;
  for (int k = 1; k < argc; ++k)
    if (std::strcmp(argv[k], "--large") == 0) {
      large = true;
      std::copy(argv + k + 1, argv + argc, argv + k);
      --argc, --k;
    }
  std::vector<int> widths{70, 150, 300};
  if (large) widths.push_back(858);
  // Peers take minutes where ours take seconds.
  add_family("planar", widths, planar, 300, large ? 300 : 150);
  add_family("spatial", {200, 100, 72, 45}, spatial, 72, large ? 100 : 200);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Fitting reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  reporter.print();
  return 0;
}
