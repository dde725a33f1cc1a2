// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/gpu/environment.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

namespace impinge::test {
namespace {

std::string_view driver() {
  const char* const name = std::getenv("IMPINGE_TEST_DRIVER");
  return name != nullptr ? name : "";
}

/// A test that has no device to run on fails; so does one that the validation layer had something to say about.
class OnADevice : public testing::Environment {
 public:
  void SetUp() override {
    gpu::Devices::of_process().reopen({.trusts_software = true}, true);
    const auto choice = gpu::Devices::of_process().choose("");
    ASSERT_TRUE(choice.opened) << choice.complaint;
    const std::string_view name = choice.opened->device.physical().properties.deviceName;
    const std::string_view wanted = driver() == "swiftshader" ? "SwiftShader"
                                    : driver() == "lavapipe"  ? "llvmpipe"
                                                              : driver();
    EXPECT_NE(name.find(wanted), std::string_view::npos) << name;
  }
  void TearDown() override {
    gpu::Devices::of_process().reopen({.trusts_software = true},
                                      true);  // whatever is left over shows when the devices go
    EXPECT_EQ(gpu::Instance::validation_messages(), 0u);
  }
};

const auto* const kEnvironment = testing::AddGlobalTestEnvironment(new OnADevice);

}  // namespace

bool is_smaller_set() { return driver() == "swiftshader"; }

WithLimits::WithLimits(const gpu::Limits& limits) { gpu::Devices::of_process().reopen(limits, true); }
WithLimits::~WithLimits() { gpu::Devices::of_process().reopen({.trusts_software = true}, true); }

}  // namespace impinge::test
