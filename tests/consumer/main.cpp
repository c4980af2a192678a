// SPDX-License-Identifier: MIT
#include <cstdio>
#include <voussoir/voussoir.hpp>

const char* version_seen_by_other();

int main() {
  std::printf("voussoir %s\n", VOUSSOIR_VERSION_STRING);
  return voussoir::version == version_seen_by_other() ? 0 : 1;
}
