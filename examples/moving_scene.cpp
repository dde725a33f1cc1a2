// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A scene that moves: a `Scene` keeps what it has sorted and built from frame to frame, and a `Workspace` the memory of
// its answers. Objects are moved, `update` finds again which are near each other, and `collide` gives the contacts.
//
// Three crates of side 1 stand at x = 0, 3 and 6, and a fourth of the same size, half as high above, passes over them
// by 1 a frame. It touches the crate at 3 k where |x - 3 k| <= 1: flush faces touch.
//
// prints: frame 0: the slider touches crate 0
// prints: frame 1: the slider touches crate 0
// prints: frame 2: the slider touches crate 1
// prints: frame 3: the slider touches crate 1
// prints: frame 4: the slider touches crate 1
// prints: frame 5: the slider touches crate 2
// prints: frame 6: the slider touches crate 2
// prints: frame 7: the slider touches crate 2
// prints: frame 8: the slider touches nothing
#include "shapes.hpp"

int main() {
  const auto crate = box({0, 0, 0}, {1, 1, 1});
  impinge::Scene scene;
  for (const double x : {0, 3, 6}) value_of(scene.add(crate, {.t{x, 0, 0}}));
  const impinge::ObjectId slider = value_of(scene.add(crate));

  impinge::Workspace workspace;
  for (int frame = 0; frame < 9; ++frame) {
    const bool is_moved = scene.set_pose(slider, {.t{double(frame), 0, 0.5}}).has_value() && scene.update().has_value();
    if (!is_moved) return 1;
    auto contacts = value_of(scene.collide({}, &workspace));
    std::cout << "frame " << frame << ": the slider touches";
    for (const auto& [first, second] : contacts.objects) std::cout << " crate " << first;
    std::cout << (contacts.objects.empty() ? " nothing\n" : "\n");
    workspace.recycle(std::move(contacts));  // its memory serves the next frame
  }
}
