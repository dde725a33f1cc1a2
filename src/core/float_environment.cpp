// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/float_environment.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>

namespace impinge {

namespace {

// All arithmetic is SSE's, so its control register is the whole environment: exceptions masked, nearest, no FTZ, no
// DAZ. The six lowest bits only say which exceptions there have been.
constexpr unsigned kNearest = 0x1F80, kFlags = 0x3F;

}  // namespace

// Not written where it is so already, as it nearly always is: where a program has ever met a denormal number, that
// takes up to 70 ns (Emerald Rapids).
FloatEnvironment::FloatEnvironment() : saved_(_mm_getcsr()) {
  if ((saved_ & ~kFlags) != kNearest) _mm_setcsr(kNearest);
}
FloatEnvironment::~FloatEnvironment() {
  if ((saved_ & ~kFlags) != kNearest) _mm_setcsr(saved_);
}

}  // namespace impinge
#else
namespace impinge {

FloatEnvironment::FloatEnvironment() {
  std::fegetenv(&saved_);
  std::fesetenv(FE_DFL_ENV);
}
FloatEnvironment::~FloatEnvironment() { std::fesetenv(&saved_); }

}  // namespace impinge
#endif
