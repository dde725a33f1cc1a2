// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A physics loop with events. Each frame moves what moves, asks what was met on the way (`Scene::find_impacts`) and
// what touches now (`Scene::collide`), and has `ContactHistory` tell what came of both: enter, stay, leave, and pass
// for what was met between two frames alone.
//
// A crate of side 1 falls from z = 3 onto a floor whose top is z = 0. Its speed goes down by 1/2 a frame: z is 5/2, 3/2
// and, with the speed -3/2, 0. It is thrown back with 2/3 of that, and is at 1/2, 1/2 and 0 again, with -1/2, which is
// too slow to be thrown back: it rests. A pellet of side 1/4 flies by 4 a frame, its back at x = 4, 8 and 12. A wall
// from x = 10 to 10 + 1/16 is between the last two, and it meets it after 7/4 of those 4: 7/16 = 0.4375. At x = 12 and
// beyond there is nothing.
//
// prints: frame 3: enter floor crate
// prints: frame 3: pass wall pellet after 0.4375 of the way
// prints: frame 4: leave floor crate
// prints: frame 6: enter floor crate
// prints: frame 7: stay floor crate
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>

#include "impinge/contact_history.hpp"
#include "impinge/impacts.hpp"
#include "impinge/scene.hpp"
#include "shapes.hpp"

int main() {
  using Kind = impinge::ContactEvent::Kind;
  impinge::Scene scene;
  const impinge::ObjectId floor = value_of(scene.add(box({-9, -9, -1}, {9, 9, 0})));
  const impinge::ObjectId wall = value_of(scene.add(box({10, -9, -1}, {10.0625, 9, 9})));
  double height = 3, speed = 0, x = 0;
  const impinge::ObjectId crate = value_of(scene.add(box({0, 0, 0}, {1, 1, 1}), {.t{0, 0, height}}));
  const impinge::ObjectId pellet = value_of(scene.add(box({0, 5, 5}, {0.25, 5.25, 5.25})));
  const std::map<std::uint32_t, std::string> names{
      {floor.index, "floor"}, {wall.index, "wall"}, {crate.index, "crate"}, {pellet.index, "pellet"}};

  impinge::ContactHistory history;
  for (int frame = 1; frame <= 7; ++frame) {
    speed -= 0.5;
    height = std::max(0.0, height + speed);
    x += 4;
    const std::array ids{crate, pellet};
    const std::array<impinge::Pose, 2> poses{{{.t{0, 0, height}}, {.t{x, 0, 0}}}};
    value_of(scene.set_poses(ids, poses));
    value_of(scene.update());
    const impinge::SceneImpacts met = value_of(scene.find_impacts());
    scene.step();
    for (const impinge::ContactEvent& event : value_of(history.update(scene, value_of(scene.collide()), &met))) {
      constexpr std::array kKinds{"enter", "stay", "leave", "pass"};
      const std::array objects{event.objects[0].index, event.objects[1].index};
      std::cout << "frame " << frame << ": " << kKinds[static_cast<std::size_t>(event.kind)] << ' '
                << names.at(objects[0]) << ' ' << names.at(objects[1]);
      if (event.kind == Kind::pass) {
        const auto row = std::find(met.objects.begin(), met.objects.end(), objects) - met.objects.begin();
        const auto impacts = std::span(met.impacts).subspan(met.offsets[row], met.offsets[row + 1] - met.offsets[row]);
        const auto first =
            std::ranges::min_element(impacts, {}, [](const impinge::Impact& impact) { return impact.time.lo; });
        std::cout << " after " << first->time.lo << " of the way";
      }
      std::cout << '\n';
      if (event.kind == Kind::enter) speed = speed < -1 ? -2.0 / 3 * speed : 0;
    }
  }
}
