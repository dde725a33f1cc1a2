# What every target of the project is compiled with. Consumers inherit none of it but C++20.
add_library(impinge_options INTERFACE)
target_compile_features(impinge_options INTERFACE cxx_std_20)
# Answers are defined on doubles in which every product and sum is rounded once (Pose). Compilers may otherwise fuse a*b + c
# into one rounding: g++ does so by default, even across intrinsics.
target_compile_options(impinge_options INTERFACE -ffp-contract=off)
target_compile_options(impinge_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# A designated initializer names what is not zero.
target_compile_options(impinge_options INTERFACE -Wno-missing-field-initializers)
# Highway 1.0.3 does not compile its run-time dispatch where the compiler may already use all of AVX-512's extensions
# (-march=native on such a machine): the best target is then one that the list of targets leaves out. impinge uses none.
target_compile_definitions(impinge_options INTERFACE HWY_DISABLED_TARGETS=HWY_AVX3_DL)
if(IMPINGE_WARNINGS_AS_ERRORS)
  target_compile_options(impinge_options INTERFACE -Werror)
endif()
