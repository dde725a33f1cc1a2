// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cfenv>

namespace impinge {

/// Round to nearest with denormals on, for as long as the guard lives; then the caller's mode again (contract 3.2: game
/// engines flush denormals, other libraries change the rounding). Public calls and every task of a worker hold one.
class FloatEnvironment {
 public:
  FloatEnvironment();
  ~FloatEnvironment();
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
#if defined(__x86_64__)
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace impinge
