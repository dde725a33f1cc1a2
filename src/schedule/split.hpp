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

}  // namespace impinge::schedule
