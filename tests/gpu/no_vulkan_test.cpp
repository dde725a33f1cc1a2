// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Where Vulkan is missing, or of no use, as the environment says (CMakeLists.txt): the CPU answers, and a warning
/// tells why.
#include <gtest/gtest.h>

#include <cstdlib>

#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

TEST(NoVulkan, TheCpuAnswersAndAWarningTellsWhy) {
  const char* const word = std::getenv("IMPINGE_TEST_WORD");
  ASSERT_NE(word, nullptr);
  const auto listed = devices();
  ASSERT_FALSE(listed);
  EXPECT_EQ(listed.error().code, Code::no_device);
  EXPECT_NE(listed.error().message.find(word), std::string::npos) << listed.error().message;

  const Mesh knot = test::mesh_of(scenes::torus_knot_of(968));
  const Pose moved{.t = {0.3, 0.2, 0.1}};
  const Contacts expected = collide(knot, {}, knot, moved, {.backend = "paper"}).value();
  for (const char* backend : {"gpu", "hybrid"}) {
    const auto found = collide(knot, {}, knot, moved, {.backend = backend});
    ASSERT_TRUE(found);
    test::expect_same(expected, *found);
    ASSERT_EQ(found->warnings.size(), 1u);
    EXPECT_NE(found->warnings[0].find(word), std::string::npos) << found->warnings[0];
  }
  const auto quiet = collide(knot, {}, knot, moved);
  EXPECT_TRUE(quiet->warnings.empty());
}

}  // namespace
}  // namespace impinge
