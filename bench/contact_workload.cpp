// SPDX-License-Identifier: MIT
#include "contact_workload.hpp"

#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace voussoir_bench {

namespace {

/// Numbers between blanks; 20 MB of them in a fraction of a second.
class NumberFile {
 public:
  explicit NumberFile(const std::string& path) : path_(path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + ": cannot be read");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    at_ = text_.data();
  }

  template <class Number>
  Number next() {
    const char* end = text_.data() + text_.size();
    while (at_ != end && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    Number value{};
    const auto [stop, error] = std::from_chars(at_, end, value);
    if (error != std::errc())
      throw std::runtime_error(path_ + ": no number at byte " + std::to_string(at_ - text_.data()));
    at_ = stop;
    return value;
  }
  template <class Numbers>
  void fill(Numbers& numbers) {
    for (auto& number : numbers) number = next<typename Numbers::value_type>();
  }

 private:
  std::string path_, text_;
  const char* at_ = nullptr;
};

using Output = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

Output open(const std::string& path) {
  Output file(std::fopen(path.c_str(), "w"), &std::fclose);
  if (!file) throw std::runtime_error(path + ": cannot be written");
  return file;
}

template <class Numbers>
void print(std::FILE* file, const Numbers& numbers) {
  for (const double number : numbers) std::fprintf(file, " %.17g", number);
}

}  // namespace

template <int Dim>
Workload<Dim> read_workload(const std::string& folder, const std::string& name) {
  Workload<Dim> workload;
  workload.name = name;
  NumberFile blocks(folder + "/" + name + ".blocks");
  workload.blocks.resize(blocks.next<std::size_t>());
  for (auto& block : workload.blocks) {
    block.vertices.resize(blocks.next<std::size_t>());
    if constexpr (Dim == 3) block.faces.resize(blocks.next<std::size_t>());
    block.slenderness = blocks.next<double>();
    for (auto& place : block.places) {
      blocks.fill(place.position);
      blocks.fill(place.turn);
    }
    for (auto& vertex : block.vertices) blocks.fill(vertex);
    for (auto& face : block.faces) {
      face.resize(blocks.next<std::size_t>());
      blocks.fill(face);
    }
  }
  NumberFile pairs(folder + "/" + name + ".pairs");
  workload.pairs.resize(pairs.next<std::size_t>());
  for (auto& pair : workload.pairs) {
    pair.a = pairs.next<std::size_t>();
    pair.b = pairs.next<std::size_t>();
    if (pair.a >= workload.blocks.size() || pair.b >= workload.blocks.size())
      throw std::runtime_error(folder + "/" + name + ".pairs: names a block that is not there");
    pair.separation = pairs.next<double>();
    pairs.fill(pair.normal);
    pairs.next<double>();  // measure of the overlap
    pairs.next<int>();     // touching features
  }
  return workload;
}

template <int Dim>
void write_workload(const std::string& folder, const Workload<Dim>& workload) {
  const Output blocks = open(folder + "/" + workload.name + ".blocks");
  std::fprintf(blocks.get(), "%zu\n", workload.blocks.size());
  for (const auto& block : workload.blocks) {
    std::fprintf(blocks.get(), "%zu", block.vertices.size());
    if constexpr (Dim == 3) std::fprintf(blocks.get(), " %zu", block.faces.size());
    std::fprintf(blocks.get(), " %.6g", block.slenderness);
    for (const auto& place : block.places) {
      print(blocks.get(), place.position);
      print(blocks.get(), place.turn);
    }
    for (const auto& vertex : block.vertices) print(blocks.get(), vertex);
    for (const auto& face : block.faces) {
      std::fprintf(blocks.get(), " %zu", face.size());
      for (const int vertex : face) std::fprintf(blocks.get(), " %d", vertex);
    }
    std::fputc('\n', blocks.get());
  }
  const Output pairs = open(folder + "/" + workload.name + ".pairs");
  std::fprintf(pairs.get(), "%zu\n", workload.pairs.size());
  for (const auto& pair : workload.pairs) {
    std::fprintf(pairs.get(), "%zu %zu %.17g", pair.a, pair.b, pair.separation);
    print(pairs.get(), pair.normal);
    std::fputs(" 0 0\n", pairs.get());
  }
}

template Workload<2> read_workload<2>(const std::string&, const std::string&);
template Workload<3> read_workload<3>(const std::string&, const std::string&);
template void write_workload<2>(const std::string&, const Workload<2>&);
template void write_workload<3>(const std::string&, const Workload<3>&);

}  // namespace voussoir_bench
