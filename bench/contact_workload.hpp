// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

/// Blocks and candidate pairs for the contact benchmarks, in plain numbers: programs compiled with
/// different vector flags meet here, and the layout of Eigen's types follows those flags.
namespace voussoir_bench {

/// Where a block is: a point p of its own frame lies at position + turn(p).
template <int Dim>
struct Place {
  std::array<double, Dim> position;           ///< [m]
  std::array<double, Dim == 2 ? 1 : 4> turn;  ///< angle [rad], or unit quaternion w x y z
};

template <int Dim>
struct WorkloadBlock {
  std::vector<std::array<double, Dim>> vertices;  ///< own frame [m]; 2-D: anticlockwise
  std::vector<std::vector<int>> faces;  ///< 3-D: vertices, anticlockwise seen from outside
  std::array<Place<Dim>, 2> places;     ///< at step 0 and at step 1, a little later
  double slenderness;                   ///< least width / diameter [-]
};

/// Two blocks whose bounding boxes, inflated by a millimetre, overlap; the exact answer at step 0.
struct CandidatePair {
  std::size_t a, b;
  double separation;             ///< < 0: least penetration depth; > 0: they are apart [m]
  std::array<double, 3> normal;  ///< from a to b
};

/// The file format of both is described at `read_workload`.
template <int Dim>
struct Workload {
  std::string name;
  std::vector<WorkloadBlock<Dim>> blocks;
  std::vector<CandidatePair> pairs;

  [[nodiscard]] double slenderness(const CandidatePair& pair) const {
    const double a = blocks[pair.a].slenderness, b = blocks[pair.b].slenderness;
    return a < b ? a : b;
  }
};

/// Reads `<folder>/<name>.blocks` and `<folder>/<name>.pairs`: numbers between blanks.
///
/// blocks: their count; then of each the number of vertices, in 3-D the number of faces, the
/// slenderness, the places at steps 0 and 1 (position, then angle or quaternion), the vertices, and
/// in 3-D of each face the number of its vertices and these.
/// pairs: their count; then of each a, b, separation, the normal (three numbers), a measure of the
/// overlap and a code of the touching features, which are not used here.
///
/// @throws std::runtime_error  a file is missing, ends early or has what is no number
template <int Dim>
[[nodiscard]] Workload<Dim> read_workload(const std::string& folder, const std::string& name);

/// Writes the two files that `read_workload` reads.
/// @throws std::runtime_error  a file cannot be written
template <int Dim>
void write_workload(const std::string& folder, const Workload<Dim>& workload);

extern template Workload<2> read_workload<2>(const std::string&, const std::string&);
extern template Workload<3> read_workload<3>(const std::string&, const std::string&);
extern template void write_workload<2>(const std::string&, const Workload<2>&);
extern template void write_workload<3>(const std::string&, const Workload<3>&);

}  // namespace voussoir_bench
