// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <voussoir/core/memory.hpp>

#include "support/folder.hpp"

namespace memory_test {

using namespace voussoir;

TEST_SUITE("core/memory") {
  TEST_CASE("what is left of a container's limit, files that were read not counted as taken") {
    const voussoir_test::Folder folder;
    const std::string path = folder / "";
    const auto write = [&](const char* name, const std::string& text) {
      std::ofstream(folder / name) << text;
    };
    CHECK(std::isinf(detail::left_of_container(path)));
    write("memory.max", "max\n");
    write("memory.current", "700\n");
    CHECK(std::isinf(detail::left_of_container(path)));
    write("memory.max", "1000\n");
    CHECK(detail::left_of_container(path) == 300);
    write("memory.stat", "anon 150\nfile 550\ninactive_file 250\nactive_file 200\n");
    CHECK(detail::left_of_container(path) == 750);
    write("memory.current", "1200\n");
    write("memory.stat", "anon 1200\ninactive_file 0\nactive_file 0\n");
    CHECK(detail::left_of_container(path) == 0);
  }

  TEST_CASE("there is memory for this test") { CHECK(available_memory() > 1e6); }
}

}  // namespace memory_test
