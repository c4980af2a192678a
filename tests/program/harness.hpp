// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/folder.hpp"

/// Runs the program as a user does, from a file to a folder, in a place of its own.
namespace voussoir_test {

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::string write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
  return path;
}

/// Every file below a folder, hidden ones too, with its content; empty if there is no such folder.
inline std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_regular_file() ? read_file(entry.path().string()) : "";
  return files;
}

/// The first occurrence of `from` replaced; it must be there, or a test would test nothing.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the text has no " + from);
  return text.replace(at, from.size(), to);
}

/// How the program ended and what it said.
struct Outcome {
  int status = -1;  ///< exit status; 1000 + number of the signal that killed it
  std::string out, err;
};

/// The program while it runs: standard output is a pipe, standard error a file.
class Running {
 public:
  /// @param output  file that takes its standard output in place of the pipe; empty: none
  explicit Running(std::vector<std::string> arguments, const std::string& output = "") {
    arguments.insert(arguments.begin(), VOUSSOIR_TEST_PROGRAM);
    std::vector<char*> raw;
    for (std::string& a : arguments) raw.push_back(a.data());
    raw.push_back(nullptr);
    std::array<int, 2> pipe_ends{};
    if (pipe(pipe_ends.data()) != 0) throw std::runtime_error("no pipe");
    out_ = pipe_ends[0];
    const std::string err = errors_ / "stderr";
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (output.empty())
      posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    else
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY, 0);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[0]);
    posix_spawn_file_actions_addclose(&actions, pipe_ends[1]);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT,
                                     0600);
    const int failed = posix_spawn(&process_, raw[0], &actions, nullptr, raw.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(pipe_ends[1]);
    if (failed != 0) throw std::runtime_error("cannot start " + arguments.front());
  }
  ~Running() { close(out_); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void signal(int number) const { kill(process_, number); }
  [[nodiscard]] pid_t process() const { return process_; }

  [[nodiscard]] Outcome wait() {
    Outcome outcome;
    std::array<char, 4096> buffer{};
    for (ssize_t n = 0; (n = read(out_, buffer.data(), buffer.size())) > 0;)
      outcome.out.append(buffer.data(), static_cast<std::size_t>(n));
    int status = 0;
    if (waitpid(process_, &status, 0) != process_) throw std::runtime_error("the program is lost");
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    outcome.err = read_file(errors_ / "stderr");
    return outcome;
  }

 private:
  Folder errors_;
  pid_t process_ = -1;
  int out_ = -1;
};

inline Outcome run_program(std::vector<std::string> arguments) {
  return Running(std::move(arguments)).wait();
}

/// The text of a small input: a 4 m tunnel in 24 m x 20 m of rock, some 800 blocks.
struct InputText {
  std::string shape = "shape = \"circle\"\ndiameter = \"4 m\"\n";
  std::string joints = R"([[joint_set]]
dip = "70 deg"
dip_direction = "E"
sd = "1 deg"
intensity = "1 /m^2"
extent = "2 m"
[[joint_set]]
dip = "20 deg"
dip_direction = "W"
intensity = "1 /m^2"
extent = "2 m"
)";
  std::string bolts = R"([support.bolts]
length = "2 m"
spacing = "30 deg"
stiffness = "0.2 GN/m"
rupture_force = "200 kN"
)";
  std::string lining = R"([support.lining]
thickness = "8 cm"
E = "25 GPa"
interface = { kn = "1 GPa/m", friction = "30 deg" }
)";
  std::string rest;

  [[nodiscard]] std::string text() const {
    return "[model]\nwidth = \"24 m\"\nbelow_invert = \"8 m\"\nseed = 3\n[tunnel]\n" + shape +
           "cover = \"8 m\"\nfacets = 24\n[rock]\ndensity = \"2700 kg/m^3\"\n[stress]\nK0 = 1.0\n" +
           joints +
           "[joint]\nkn = \"5 GPa/m\"\nks = \"0.5 GPa/m\"\nfriction = \"35 deg\"\n"
           "[blocks]\nmin_inscribed_radius = \"0.2 m\"\nmax_elongation = 5\n"
           "min_wall_area = \"0.02 m^2\"\n" +
           bolts + lining + rest;
  }
};

/// A 3 m tunnel in some 150 blocks: a case takes milliseconds.
inline std::string small_input() {
  InputText input;
  input.shape = "shape = \"circle\"\ndiameter = \"3 m\"\n";
  input.rest =
      "[diagram]\nspacing = [\"30 deg\", \"60 deg\", \"none\"]\n"
      "thickness = [\"0 cm\", \"8 cm\"]\n";
  std::string text = input.text();
  text = replaced(text, "width = \"24 m\"", "width = \"14 m\"");
  text = replaced(text, "below_invert = \"8 m\"", "below_invert = \"4 m\"");
  return replaced(text, "cover = \"8 m\"", "cover = \"4 m\"");
}

}  // namespace voussoir_test
