// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "schedule/split.hpp"

#include <algorithm>

namespace impinge::schedule {
namespace {

/// Parts of the portion that the speeds ask for. The first speed rests on constants measured on another scene; later
/// ones rest on this query.
constexpr double kFirstPortion = 0.5, kNextPortion = 0.8;

}  // namespace

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

double cpu_portion(double left, int threads) { return left / (64 * threads); }

double DevicePortions::next(double left, double cpu_done, double elapsed) const {
  const double cpu = cpu_done / elapsed;
  const bool is_first = weight_ == 0;
  const double device = is_first ? cpu * ratio_ : weight_ / seconds_;
  return (is_first ? kFirstPortion : kNextPortion) * device_portion(left, {cpu, device, delay_});
}

void DevicePortions::done(double weight, double seconds) {
  weight_ += weight, seconds_ += std::max(seconds - delay_, 1e-9);
  delay_ = question_;
}

}  // namespace impinge::schedule
