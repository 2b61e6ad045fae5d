# Warnings, and the floating-point rules on which equal bits on any number of ranks rest: no contraction
# into fused multiply-adds (GCC contracts a loop's vector body and its tail differently), never -ffast-math.
add_library(slipscale_compiler_settings INTERFACE)
target_compile_options(slipscale_compiler_settings INTERFACE
  -ffp-contract=off
  # GCC 12 sees a false overlap in "literal" + std::to_string(n) at -O3.
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${SLIPSCALE_WERROR}>:-Werror>)
