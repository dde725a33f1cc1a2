// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "pipeline/ready_device.hpp"

/// Programs that link this run on one software driver, with the validation layer on and silent.
namespace impinge::test {

/// Whether this run is to do the smaller set.
bool is_smaller_set();

/// Opens devices anew, with these limits; the former ones again when it ends.
class WithLimits {
 public:
  explicit WithLimits(const gpu::Limits& limits);
  ~WithLimits();
  WithLimits(const WithLimits&) = delete;
  WithLimits& operator=(const WithLimits&) = delete;
};

}  // namespace impinge::test
