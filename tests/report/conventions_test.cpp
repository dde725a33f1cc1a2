// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Which axis is up in the coordinates of several files, by their formats. That files are read so is seen in units_test
// and page_test, or by looking at them.
#include "report/conventions.hpp"

#include <gtest/gtest.h>

namespace impinge::test {
namespace {

using report::is_y_up;

TEST(UpwardAxis, IsThatOfTheFormat) {
  for (const char* file : {"a.glb", "a.gltf", "a.dae", "a.3ds", "a.3DS", "a.x", "a.fbx"})
    EXPECT_TRUE(is_y_up({file}, {})) << file;
  for (const char* file : {"a.ifc", "a.ifczip", "a.IfcZip", "a.3mf", "a.blend", "a.obj", "a.OBJ", "a.off", "a.ply",
                           "a.stl", "a.amf", "ifc/glb.obj"})
    EXPECT_FALSE(is_y_up({file}, {})) << file;
}

TEST(UpwardAxis, OfSeveralFilesIsThatOfTheFirstWhichHasOne) {
  EXPECT_TRUE(is_y_up({"a.obj", "b.stl", "house.dae"}, {}));
  EXPECT_TRUE(is_y_up({"house.dae", "a.obj"}, {}));
  EXPECT_TRUE(is_y_up({"a.obj", "house.dae", "b.3mf"}, {}));
  EXPECT_FALSE(is_y_up({"a.obj", "b.3mf", "house.dae"}, {}));
  EXPECT_FALSE(is_y_up({"a.obj", "b.stl"}, {}));
}

TEST(UpwardAxis, IsWhatTheCallSays) {
  EXPECT_FALSE(is_y_up({"house.dae"}, false));
  EXPECT_TRUE(is_y_up({"a.stl", "b.3mf"}, true));
}

}  // namespace
}  // namespace impinge::test
