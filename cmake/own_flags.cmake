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
