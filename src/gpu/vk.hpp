// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

// Before anything of Vulkan: its functions' variables get names of our own (cmake/vulkan.cmake).
#include "volk_names.h"
//
#include <volk.h>

#include <exception>
#include <string>
#include <utility>

namespace impinge::gpu {

/// Something that the device could not do: lost, out of memory, or a limit of it. Never leaves the library: whoever
/// asked has the CPU do the work.
class Failure : public std::exception {
 public:
  explicit Failure(std::string what, VkResult result = VK_SUCCESS) : what_(std::move(what)), result_(result) {}
  [[nodiscard]] const char* what() const noexcept override { return what_.c_str(); }
  [[nodiscard]] VkResult result() const { return result_; }

 private:
  std::string what_;
  VkResult result_;
};

/// Throws a Failure unless the result is one of success. `what`: what was being done, as in "allocating memory".
void check(VkResult result, const char* what);

}  // namespace impinge::gpu
