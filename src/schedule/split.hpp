// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "schedule/cost.hpp"

namespace impinge::schedule {

/// What a device's part costs: T = C_0 + N_v C_v + N_p C_p + N_l C_l, equation 1 of the paper with a constant time for
/// each portion of work. In seconds.
struct DeviceConstants {
  double question = 0;       ///< C_0, of each portion
  double box_test = 0;       ///< C_v
  double element_test = 0;   ///< C_p, with what is found brought back
  double leaf_pair = 0;      ///< C_l
  double mesh_triangle = 0;  ///< of a mesh that is not on the device yet
};

/// Without C_0.
double predict_device_seconds(const Statistics& counts, const DeviceConstants& constants);

/// How fast both sides are, in a unit of weight a second, and what the device needs besides.
struct Speeds {
  double cpu = 0, device = 0;
  double question = 0;  ///< seconds
};

/// How much of the work that is left the device should take so that both end together; 0: it is not worth asking.
double device_portion(double left, const Speeds& speeds);

/// How much of what is left a CPU's thread takes at once: so little that none is long at it when the rest is done.
double cpu_portion(double left, int threads);

/// What a device takes of shared work, portion by portion, so that it ends when the CPU does. Each portion is less than
/// what the speeds of now ask for, so that the next can set right what they got wrong. In weight, and seconds.
class DevicePortions {
 public:
  /// `ratio`: the device's speed over the CPU's, by the cost function. `question`: of each portion; `upload`: before
  /// the first.
  DevicePortions(double ratio, double question, double upload)
      : ratio_(ratio), question_(question), delay_(question + upload) {}

  /// The CPU has not done enough for its speed to be known.
  [[nodiscard]] bool is_early(double cpu_done, double elapsed) const { return cpu_done <= 0 || elapsed < question_; }
  /// 0: nothing is worth asking for.
  [[nodiscard]] double next(double left, double cpu_done, double elapsed) const;
  /// A portion is done.
  void done(double weight, double seconds);

 private:
  double ratio_, question_, delay_;
  double weight_ = 0, seconds_ = 0;  ///< of all portions, without what is constant
};

}  // namespace impinge::schedule
