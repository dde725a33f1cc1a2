// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/float_environment.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>

namespace impinge {

// All arithmetic is SSE's, so its control register is the whole environment: exceptions masked, nearest, no FTZ, no
// DAZ.
FloatEnvironment::FloatEnvironment() : saved_(_mm_getcsr()) { _mm_setcsr(0x1F80); }
FloatEnvironment::~FloatEnvironment() { _mm_setcsr(saved_); }

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
