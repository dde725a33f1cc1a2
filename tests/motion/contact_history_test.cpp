// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/contact_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using Change = ContactEvent::Kind;
/// An object for good: which one of all that there ever were.
using Pair = std::array<int, 2>;

Pose placed_at(double x, double y = 0) { return {.t{x, y, 0}}; }

const Mesh& cube() {
  static const Mesh mesh = test::mesh_of(scenes::cube());
  return mesh;
}

std::vector<ContactEvent> events_of(Result<std::span<const ContactEvent>> result) {
  EXPECT_TRUE(result) << result.error().message;
  return {result->begin(), result->end()};
}

std::string text_of(const std::vector<ContactEvent>& events) {
  constexpr std::array kNames{"enter", "stay", "leave", "pass"};
  std::string text;
  for (const ContactEvent& event : events)
    text += std::string(kNames[static_cast<std::size_t>(event.kind)]) + ' ' + std::to_string(event.objects[0].index) +
            ' ' + std::to_string(event.objects[1].index) + '\n';
  return text;
}

TEST(ContactHistory, TellsHowACubeFliesPastOthers) {
  Scene scene;
  const ObjectId flying = scene.add(cube(), placed_at(-3, 0.5)).value();
  for (const double x : {0, 3, 6}) ASSERT_TRUE(scene.add(cube(), placed_at(x)));
  ContactHistory history;
  const auto move_to = [&](double x) {
    EXPECT_TRUE(scene.set_pose(flying, placed_at(x, 0.5)));
    const SceneImpacts impacts = scene.find_impacts().value();
    scene.step();
    return text_of(events_of(history.update(scene, scene.collide().value(), &impacts)));
  };
  EXPECT_EQ(move_to(-2), "");
  EXPECT_EQ(move_to(-1), "enter 0 1\n");  // flush
  EXPECT_EQ(move_to(0), "stay 0 1\n");
  EXPECT_EQ(move_to(4), "leave 0 1\nenter 0 2\n");
  EXPECT_EQ(move_to(4.5), "leave 0 2\n");
  EXPECT_EQ(move_to(1.5), "pass 0 2\n");
  EXPECT_EQ(move_to(9), "pass 0 2\npass 0 3\n");
  EXPECT_EQ(move_to(9), "");
}

TEST(ContactHistory, LeavesWhatIsGoneThoughItsIndexIsUsedAnew) {
  Scene scene;
  ASSERT_TRUE(scene.add(cube()));
  ObjectId other = scene.add(cube(), placed_at(1)).value();
  ContactHistory history;
  const auto update = [&] { return events_of(history.update(scene, scene.collide().value())); };
  EXPECT_EQ(text_of(update()), "enter 0 1\n");
  const ObjectId gone = other;
  ASSERT_TRUE(scene.remove(other));
  other = scene.add(cube(), placed_at(1)).value();
  const auto events = update();
  EXPECT_EQ(text_of(events), "leave 0 1\nenter 0 1\n");
  EXPECT_EQ(events[0].objects[1], gone);
  EXPECT_EQ(events[1].objects[1], other);
  ASSERT_TRUE(scene.set_filter(other, {.mask = 0}));
  EXPECT_EQ(text_of(update()), "leave 0 1\n");
  ASSERT_TRUE(scene.set_filter(other, {}));
  EXPECT_EQ(text_of(update()), "enter 0 1\n");
  // Another scene has other objects.
  Scene second;
  EXPECT_EQ(text_of(events_of(history.update(second, second.collide().value()))), "leave 0 1\n");
}

TEST(ContactHistory, IsAsItWasAfterAnError) {
  Scene scene, empty;
  ASSERT_TRUE(scene.add(cube()));
  ASSERT_TRUE(scene.add(cube(), placed_at(1)));
  ContactHistory history;
  const Contacts contacts = scene.collide().value();
  EXPECT_EQ(text_of(events_of(history.update(scene, contacts))), "enter 0 1\n");
  const SceneImpacts impacts = scene.find_impacts().value(), some = scene.find_impacts({.limit = 1}).value();
  EXPECT_EQ(history.update(scene, scene.collide({.limit = 1}).value()).error().code, Code::bad_option);
  EXPECT_EQ(history.update(scene, contacts, &some).error().code, Code::bad_option);
  EXPECT_EQ(history.update(empty, contacts).error().code, Code::unknown_id);
  EXPECT_NE(history.update(empty, {}, &impacts).error().message.find("between.objects[0] names object 0"),
            std::string::npos);
  EXPECT_EQ(text_of(events_of(history.update(scene, contacts, &impacts))), "stay 0 1\n");
}

/// Every object that there ever was has a number of its own here, so that a pair never stands for two.
TEST(ContactHistory, HasALeaveForEachEnterWhateverHappens) {
  test::Seeded seeded(20291);
  const auto below = [&](int n) { return seeded.random.integer(0, n - 1); };
  std::map<Change, int> counts;
  for (int run = 0; run < 10; ++run) {
    Scene scene;
    ContactHistory history;
    std::map<std::uint32_t, ObjectId> ids;                           // by index
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> numbers;  // by index and generation
    const auto number = [&](const ObjectId& id) { return numbers.at({id.index, id.generation}); };
    const auto any_pose = [&] {
      return placed_at(1.5 * below(6), 1.5 * below(2));
    };  // those in one place touch, others do not
    const auto add = [&] {
      const ObjectId id = scene.add(cube(), any_pose(), static_cast<std::uint32_t>(below(3))).value();
      ids[id.index] = id;
      numbers.emplace(std::pair(id.index, id.generation), static_cast<int>(numbers.size()));
    };
    for (int i = 0; i < 6; ++i) add();
    std::set<Pair> touching;
    for (int frame = 0; frame < 40; ++frame) {
      for (int change = below(3); change > 0; --change) {
        const ObjectId id = ids.at(static_cast<std::uint32_t>(below(6))),
                       other = ids.at(static_cast<std::uint32_t>(below(6)));
        switch (below(7)) {
          case 0:
            ASSERT_TRUE(scene.remove(id));
            add();
            break;
          case 1:
            ASSERT_TRUE(scene.set_filter(id, {.category = 1, .mask = below(4) == 0 ? 0u : 1u}));
            break;
          case 2:
            if (id != other) {
              ASSERT_TRUE(scene.ignore(id, other));
            }
            break;
          case 3:
            if (id != other) {
              ASSERT_TRUE(scene.unignore(id, other));
            }
            break;
          default:
            ASSERT_TRUE(scene.set_pose(id, any_pose()));
        }
      }
      // What touches by the contacts, and what has met by the impacts.
      const Contacts contacts = scene.collide({.threads = 1}).value();
      const SceneImpacts impacts = scene.find_impacts({.threads = 1}).value();
      const auto pair_of = [&](const std::array<std::uint32_t, 2>& objects) {
        return Pair{number(ids.at(objects[0])), number(ids.at(objects[1]))};
      };
      std::set<Pair> now, met, met_at_start;
      for (const auto& objects : contacts.objects) now.insert(pair_of(objects));
      for (std::size_t row = 0; row < impacts.objects.size(); ++row)
        for (std::uint64_t i = impacts.offsets[row]; i < impacts.offsets[row + 1]; ++i)
          (impacts.impacts[i].time.hi == 0 ? met_at_start : met).insert(pair_of(impacts.objects[row]));
      scene.step();

      std::map<Pair, Change> expected;
      for (const Pair& pair : touching) expected.emplace(pair, now.contains(pair) ? Change::stay : Change::leave);
      for (const Pair& pair : now) expected.try_emplace(pair, Change::enter);
      for (const Pair& pair : met)
        if (!met_at_start.contains(pair)) expected.try_emplace(pair, Change::pass);
      std::map<Pair, Change> found;
      const auto events = events_of(history.update(scene, contacts, &impacts));
      for (const ContactEvent& event : events) {
        EXPECT_TRUE(found.emplace(Pair{number(event.objects[0]), number(event.objects[1])}, event.kind).second);
        EXPECT_LT(event.objects[0].index, event.objects[1].index);
        ++counts[event.kind];
      }
      EXPECT_EQ(found, expected) << "frame " << frame << " of run " << run;
      EXPECT_TRUE(std::ranges::is_sorted(events, {}, [](const ContactEvent& event) {
        return std::tuple(event.objects[0].index, event.objects[1].index, event.kind != Change::leave);
      }));
      touching = now;
    }
    // In the end all is gone.
    for (const auto& [index, id] : ids) ASSERT_TRUE(scene.remove(id));
    const auto last = events_of(history.update(scene, scene.collide().value()));
    EXPECT_EQ(last.size(), touching.size());
    for (const ContactEvent& event : last) EXPECT_EQ(event.kind, Change::leave);
    counts[Change::leave] += static_cast<int>(last.size());
  }
  EXPECT_EQ(counts[Change::enter], counts[Change::leave]);
  for (const Change kind : {Change::enter, Change::stay, Change::leave, Change::pass}) EXPECT_GT(counts[kind], 20);
}

}  // namespace
}  // namespace impinge
