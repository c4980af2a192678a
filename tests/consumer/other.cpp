// SPDX-License-Identifier: MIT
#include <voussoir/voussoir.hpp>

const char* version_seen_by_other();
const char* version_seen_by_other() { return VOUSSOIR_VERSION_STRING; }
