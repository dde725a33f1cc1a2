# What every target of the project is compiled with. Consumers inherit none of it but C++20.
add_library(impinge_options INTERFACE)
target_compile_features(impinge_options INTERFACE cxx_std_20)
# Answers are defined on doubles in which every product and sum is rounded once (Pose). Compilers may otherwise fuse a*b + c
# into one rounding: g++ does so by default, even across intrinsics.
target_compile_options(impinge_options INTERFACE -ffp-contract=off)
target_compile_options(impinge_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# A designated initializer names what is not zero.
target_compile_options(impinge_options INTERFACE -Wno-missing-field-initializers)
# g++ 12 warns of std::string's operator+ without cause (its bug 105651). Clang, and so clang-tidy, does not know the option.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_CXX_CLANG_TIDY)
  target_compile_options(impinge_options INTERFACE -Wno-restrict)
endif()
# Highway 1.0.3 does not compile its run-time dispatch where the compiler may already use all of AVX-512's extensions
# (-march=native on such a machine): the best target is then one that the list of targets leaves out. impinge uses none.
target_compile_definitions(impinge_options INTERFACE HWY_DISABLED_TARGETS=HWY_AVX3_DL)
if(IMPINGE_WARNINGS_AS_ERRORS)
  target_compile_options(impinge_options INTERFACE -Werror)
endif()

# The library and the readers alone are compiled with these sanitizers, which cost two to three times the compiler's time; tests
# are not. Undefined behaviour traps: its messages would double the code. Without the checks of each pointer, a quarter of the
# compiler's time: null pointers fault anyway. And without the frames on the heap that catch uses of a stack after its return:
# with them, tests took three times as long.
option(IMPINGE_SANITIZE "Compile the library and the file readers with the address and undefined-behaviour sanitizers" OFF)
add_library(impinge_sanitized INTERFACE)
if(IMPINGE_SANITIZE)
  target_compile_options(impinge_sanitized INTERFACE -g1 -fno-omit-frame-pointer -fsanitize=address,undefined
    -fsanitize-undefined-trap-on-error -fno-sanitize=null,alignment --param asan-use-after-return=0)
  target_link_options(impinge_sanitized INTERFACE -fsanitize=address)
endif()
