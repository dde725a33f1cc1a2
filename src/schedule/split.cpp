// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/split.hpp"

#include <algorithm>

namespace impinge::schedule {

double predict_device_seconds(const Statistics& counts, const DeviceConstants& constants) {
  return static_cast<double>(counts.box_tests) * constants.box_test +
         static_cast<double>(counts.element_tests) * constants.element_test +
         static_cast<double>(counts.leaf_pairs) * constants.leaf_pair;
}

// With x on the device, it ends after question + x / device, and the CPU after (left - x) / cpu.
double device_portion(double left, const Speeds& speeds) {
  if (!(speeds.cpu > 0) || !(speeds.device > 0)) return 0;
  return std::max(0.0, (left / speeds.cpu - speeds.question) / (1 / speeds.device + 1 / speeds.cpu));
}

}  // namespace impinge::schedule
