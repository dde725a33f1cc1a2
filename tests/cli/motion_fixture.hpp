// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "program.hpp"
#include "scenes/mechanism.hpp"
#include "tests/io/animated_gltf.hpp"

namespace impinge::test {

/// Two cubes from -1 to 1, nodes 0 and 1, of which an animation may move the second one.
inline AnimatedGltf still_and_moving() {
  AnimatedGltf file;
  file.roots({file.node({{"name", "still"}, {"mesh", 0}}), file.node({{"name", "moving"}, {"mesh", 0}})});
  file.animation("pass");
  return file;
}

/// impinge motion on a file that a test writes.
class Motion : public testing::Test {
 protected:
  void write(const AnimatedGltf& file) const { folder.write("case.glb", file.glb()); }
  void write(const std::vector<scenes::FlatPart>& parts) const {
    folder.write("case.glb", scenes::animated_glb(parts));
  }
  [[nodiscard]] Ended run(const Words& more = {}) const {
    return impinge(folder, joined({"motion", "case.glb"}, more));
  }
  [[nodiscard]] std::string refused(const Words& more = {}) const {
    return refusal(folder, joined({"motion", "case.glb"}, more));
  }
  [[nodiscard]] json report(const Words& more = {}, int code = 1) const {
    return document(folder, joined({"motion", "case.glb"}, more), code);
  }
  Folder folder;
};

}  // namespace impinge::test
