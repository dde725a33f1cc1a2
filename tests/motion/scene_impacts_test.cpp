// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "impinge/contact_history.hpp"
#include "impinge/impacts.hpp"
#include "impinge/scene.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::Random;
using SceneRow = std::tuple<std::uint32_t, std::uint32_t, Feature, std::uint32_t, std::uint32_t, double, double>;

std::vector<SceneRow> scene_rows(const SceneImpacts& found) {
  EXPECT_EQ(found.offsets.size(), found.objects.size() + 1);
  EXPECT_EQ(found.offsets.back(), found.impacts.size());
  std::vector<SceneRow> result;
  for (std::size_t row = 0; row < found.objects.size(); ++row)
    for (std::uint64_t i = found.offsets[row]; i < found.offsets[row + 1]; ++i) {
      const Impact& x = found.impacts[i];
      result.emplace_back(found.objects[row][0], found.objects[row][1], x.feature, x.a, x.b, x.time.lo, x.time.hi);
    }
  return result;
}

SceneImpacts scene_impacts(Result<SceneImpacts> result) {
  EXPECT_TRUE(result) << result.error().message;
  return *std::move(result);
}

/// The world vertices as a mesh.
Mesh world_mesh(const Mesh& mesh, const Pose& pose) {
  std::vector<double> xyz;
  for (const Point& p : mesh.vertices()) {
    const Point q = world_vertex(pose, p);
    xyz.insert(xyz.end(), {q.x, q.y, q.z});
  }
  return *mesh.deformed(xyz);
}

struct Known {
  ObjectId id;
  Mesh mesh;
  Pose pose;
  Mesh start;  ///< world vertices
  std::uint32_t group;
  bool self = false;

  /// Of an object that has got other triangles: no motion.
  [[nodiscard]] Moving way() const {
    const Mesh end = world_mesh(mesh, pose);
    return {std::ranges::equal(start.triangles(), end.triangles()) ? start : end, end};
  }
};

/// Pair by pair, in order.
std::vector<SceneRow> pair_by_pair(const std::map<std::uint32_t, Known>& objects, const auto& are_tested) {
  std::vector<SceneRow> result;
  std::map<std::uint32_t, Moving> ways;
  for (const auto& [i, object] : objects) ways.emplace(i, object.way());
  const auto add = [&](std::uint32_t i, std::uint32_t j, const Impacts& impacts) {
    for (const Impact& x : impacts.impacts) result.emplace_back(i, j, x.feature, x.a, x.b, x.time.lo, x.time.hi);
  };
  for (const auto& [i, a] : objects)
    for (const auto& [j, b] : objects) {
      if (i == j && a.self) add(i, j, *find_impacts(ways.at(i)));
      if (i < j && are_tested(a, b)) add(i, j, *find_impacts(ways.at(i), ways.at(j)));
    }
  return result;
}

TEST(SceneImpacts, AreThoseOfEveryPairThatIsTested) {
  test::Seeded seeded(20281);
  Random& random = seeded.random;
  const auto below = [&](int n) { return static_cast<std::uint32_t>(random.integer(0, n - 1)); };
  const std::vector<Mesh> shapes{test::mesh_of(scenes::cube()), test::mesh_of(scenes::flat_grid(3, 2, 0.5)),
                                 test::mesh_of(scenes::uv_sphere(5, 4, 0.6)), test::mesh_of({})};
  std::size_t impacts = 0, with_itself = 0;
  for (int run = 0; run < 12; ++run) {
    Scene scene;
    std::map<std::uint32_t, Known> known;
    const auto any_pose = [&] {
      return run % 2 == 0 ? scenes::random_motion(random, 2) : Pose{.t{double(below(4)), double(below(3)), 0}};
    };
    const auto add = [&] {
      const Mesh& mesh = shapes[below(4)];
      const Pose pose = any_pose();
      const auto group = below(3);
      const ObjectId id = scene.add(mesh, pose, group).value();
      known.insert_or_assign(id.index, Known{id, mesh, pose, world_mesh(mesh, pose), group});
    };
    for (int i = 0; i < 9; ++i) add();
    for (int frame = 0; frame < 4; ++frame) {
      for (int change = 0; change < 8; ++change) {
        Known& object = known.at(below(9));
        switch (below(6)) {
          case 0:
          case 1:
            object.pose = any_pose();
            ASSERT_TRUE(scene.set_pose(object.id, object.pose));
            break;
          case 2: {
            std::vector<double> xyz;
            for (const Point& p : object.mesh.vertices())
              for (const double x : {p.x, p.y, p.z}) xyz.push_back(x + random.uniform(-0.5, 0.5));
            ASSERT_TRUE(scene.set_vertices(object.id, xyz));
            object.mesh = *object.mesh.deformed(xyz);
            break;
          }
          case 3:
            object.self = !object.self;
            ASSERT_TRUE(scene.self(object.id, object.self));
            break;
          case 4:
            ASSERT_TRUE(scene.remove(object.id));
            add();  // at the same index
            break;
          default:
            object.mesh = shapes[below(4)];
            ASSERT_TRUE(scene.set_mesh(object.id, object.mesh, object.pose));
        }
      }
      const std::uint32_t one = below(8), filtered = below(9);
      ASSERT_TRUE(scene.ignore(known.at(one).id, known.at(one + 1).id));
      ASSERT_TRUE(scene.set_filter(known.at(filtered).id, {.category = 2, .mask = 2}));
      const auto are_tested = [&](const Known& a, const Known& b) {
        const bool is_ignored = a.id.index == one && b.id.index == one + 1;
        return !is_ignored && a.id.index != filtered && b.id.index != filtered && (a.group == 0 || a.group != b.group);
      };
      const auto expected = pair_by_pair(known, are_tested);
      for (const int threads : {1, 2})
        EXPECT_EQ(scene_rows(scene_impacts(scene.find_impacts({.threads = threads}))), expected);
      impacts += expected.size();
      with_itself += static_cast<std::size_t>(
          std::ranges::count_if(expected, [](const SceneRow& row) { return std::get<0>(row) == std::get<1>(row); }));
      const SceneImpacts few = scene_impacts(scene.find_impacts({.limit = expected.size() / 2}));
      EXPECT_EQ(scene_rows(few),
                std::vector(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(expected.size() / 2)));
      EXPECT_EQ(few.truncated, !expected.empty());
      if (!expected.empty()) {
        const SceneRow first = *std::ranges::min_element(
            expected, {}, [](const SceneRow& x) { return std::tuple(std::get<5>(x), std::get<6>(x), x); });
        EXPECT_EQ(scene_rows(scene_impacts(scene.find_impacts({.earliest = true}))), std::vector{first});
        EXPECT_EQ(few.earliest->lo, std::get<5>(first));
      }
      ASSERT_TRUE(scene.unignore(known.at(one).id, known.at(one + 1).id));
      ASSERT_TRUE(scene.set_filter(known.at(filtered).id, {}));
      scene.step();
      for (auto& [index, object] : known) object.start = world_mesh(object.mesh, object.pose);
    }
  }
  EXPECT_GT(impacts, 5000u);
  EXPECT_GT(with_itself, 50u);
}

Pose moved_by(double x, double y = 0) { return {.t{x, y, 0}}; }

/// docs/hash.md
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}
std::uint64_t folded(std::uint64_t h, std::uint64_t w) { return mixed(h ^ mixed(w)); }
std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }

std::uint64_t key_of(const Mesh& mesh, const Pose& pose) {
  std::uint64_t vertices = 0, triangles = 0, i = 0, j = 0;
  for (const Point& p : mesh.vertices())
    vertices += folded(folded(folded(i++, bits_of(p.x)), bits_of(p.y)), bits_of(p.z));
  for (const auto& [a, b, c] : mesh.triangles()) triangles += folded(folded(folded(j++, a), b), c);
  std::uint64_t h = folded(folded(folded(mesh.vertex_count(), mesh.triangle_count()), vertices), triangles);
  for (const double x : pose.R) h = folded(h, bits_of(x));
  for (const double x : pose.t) h = folded(h, bits_of(x));
  return h;
}

TEST(SceneImpacts, HaveTheHashThatTheDocumentationDefines) {
  const Mesh cube = test::mesh_of(scenes::cube()), box = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 2));
  Scene scene;
  const ObjectId id = scene.add(cube, moved_by(0, 0.5)).value();
  ASSERT_TRUE(scene.add(box, moved_by(3)));
  ASSERT_TRUE(scene.set_pose(id, moved_by(8, 0.5)));
  const std::uint64_t a = folded(key_of(cube, moved_by(0, 0.5)), key_of(cube, moved_by(8, 0.5)));
  const std::uint64_t b = folded(key_of(box, moved_by(3)), key_of(box, moved_by(3)));
  for (const std::uint64_t limit : {5u, 1000u}) {
    const SceneImpacts impacts = scene_impacts(scene.find_impacts({.limit = limit}));
    EXPECT_FALSE(impacts.impacts.empty());
    std::uint64_t sum = 0;
    for (const Impact& x : impacts.impacts) {
      constexpr std::array<std::array<std::uint64_t, 2>, 3> kFeatures{{{0, 1}, {1, 0}, {2, 2}}};
      const auto& [of_a, of_b] = kFeatures[static_cast<std::size_t>(x.feature)];
      const auto [lo, hi] = std::minmax({folded(folded(a, of_a), x.a), folded(folded(b, of_b), x.b)});
      sum += folded(folded(folded(lo, hi), bits_of(x.time.lo)), bits_of(x.time.hi));
    }
    EXPECT_EQ(impacts.hash, sum);
  }
}

TEST(SceneImpacts, HaveAHashThatKnowsNoIndices) {
  const Mesh cube = test::mesh_of(scenes::cube()), box = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 2));
  // A cube flies past a box that stands at x = 3.
  const auto hash_of = [&](bool swapped, double from, double to) {
    Scene scene;
    if (swapped) static_cast<void>(scene.add(box, moved_by(3)));
    const ObjectId id = scene.add(cube, moved_by(from, 0.5)).value();
    if (!swapped) static_cast<void>(scene.add(box, moved_by(3)));
    EXPECT_TRUE(scene.set_pose(id, moved_by(to, 0.5)));
    const SceneImpacts impacts = scene_impacts(scene.find_impacts());
    EXPECT_FALSE(impacts.impacts.empty());
    return impacts.hash;
  };
  EXPECT_EQ(hash_of(false, 0, 8), hash_of(true, 0, 8));
  const std::set<std::uint64_t> different{hash_of(false, 0, 8), hash_of(false, 0, 7), hash_of(false, -1, 8), 0};
  EXPECT_EQ(different.size(), 4u);
}

TEST(SceneImpacts, SayWhatIsWrong) {
  const auto fails = [](const Result<SceneImpacts>& result, Code code, const std::string& words) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  Scene scene;
  EXPECT_FALSE(scene_impacts(scene.find_impacts()).earliest);
  const Mesh cube = test::mesh_of(scenes::cube());
  ASSERT_TRUE(scene.add(cube));
  const ObjectId id = scene.add(cube, moved_by(9)).value();
  EXPECT_FALSE(scene_impacts(scene.find_impacts()).earliest);
  fails(scene.find_impacts({.end = 2}), Code::bad_option, "0 to 1");
  ASSERT_TRUE(scene.set_pose(id, moved_by(0x1p301)));
  fails(scene.find_impacts(), Code::out_of_range, "object 1");
  scene.step();
  ASSERT_TRUE(scene.set_pose(id, moved_by(-0x1p299)));
  fails(scene.find_impacts(), Code::out_of_range, "object 1, at the start");
  scene.step();
  ASSERT_TRUE(scene.set_pose(id, moved_by(0x1p299)));  // through the other one
  EXPECT_TRUE(scene_impacts(scene.find_impacts()).earliest);
  std::stop_source stop;
  stop.request_stop();
  fails(scene.find_impacts({.stop = stop.get_token()}), Code::cancelled, "stopped");
  Scene copy = scene;
  scene.step();
  EXPECT_FALSE(scene_impacts(scene.find_impacts()).earliest);
  EXPECT_TRUE(scene_impacts(copy.find_impacts()).earliest) << "a copy has its own start";
}

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
