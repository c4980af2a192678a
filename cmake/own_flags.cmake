# SPDX-License-Identifier: MIT
# voussoir_warnings: the warnings we keep our code free of.
# voussoir_own: these, and what makes results repeat; linked by every target of ours, by no user.
set(gnu_like "$<COMPILE_LANG_AND_ID:CXX,GNU,Clang,AppleClang>")

add_library(voussoir_warnings INTERFACE)
target_compile_options(
  voussoir_warnings
  INTERFACE
    "$<${gnu_like}:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow>"
    "$<$<AND:${gnu_like},$<BOOL:${VOUSSOIR_WERROR}>>:-Werror>"
)

add_library(voussoir_own INTERFACE)
target_link_libraries(voussoir_own INTERFACE voussoir_warnings)
target_compile_options(
  voussoir_own
  INTERFACE "$<${gnu_like}:-ffp-contract=off>" # the same digits with and without FMA
            "$<$<AND:${gnu_like},$<BOOL:${VOUSSOIR_NATIVE}>>:-march=native>")

# Files that read, write and call take a compiler twice as long with optimisation, and run little:
# the presets for tests leave it out there. ${computing_compile} puts it back for one file of such a
# target.
option(VOUSSOIR_QUICK_COMPILE "Do not optimise what computes little (for tests)" OFF)
set(quick_compile "")
set(computing_compile "")
if(VOUSSOIR_QUICK_COMPILE)
  set(quick_compile "$<${gnu_like}:-O0>")
  set(computing_compile "$<${gnu_like}:-O1>")
endif()
