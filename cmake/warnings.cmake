# One interface target that every room links: warnings are errors, and no contraction of a*b+c, so that the same source
# gives the same bits on every machine (docs/design/determinism.md).
add_library(ins_options INTERFACE)
target_compile_options(ins_options INTERFACE
  -Wall -Wextra -Werror -Wconversion -Wdouble-promotion -Wshadow -Wpedantic
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes>
  # Clang's C++ counts more among these than GCC's: double to long double, constants of one number type alone, signs.
  "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:-Wno-double-promotion;-Wno-unused-const-variable;-Wno-sign-conversion>"
  -ffp-contract=off)
if(INS_SANITIZE)
  target_compile_options(ins_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
    # A target on Eigen (INS_EIGEN): four checks of every pointer would double the compiler's time over its templates.
    "$<$<BOOL:$<TARGET_PROPERTY:INS_EIGEN>>:-fno-sanitize=null,alignment,pointer-overflow,object-size>")
  target_link_options(ins_options INTERFACE -fsanitize=address,undefined)
endif()
if(INS_COVERAGE)
  target_compile_options(ins_options INTERFACE --coverage)
  target_link_options(ins_options INTERFACE --coverage)
endif()
