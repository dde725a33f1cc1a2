// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What comes within a distance of each other, against distances in rationals, and a speed that nothing exceeds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "impinge/impacts.hpp"
#include "impinge/predicates.hpp"
#include "impinge/scene.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"
#include "tests/motion/rational_impact.hpp"

namespace impinge::separation {
namespace {

using oracle::Features;
using oracle::Points;
using scenes::Random;

struct Case {
  Points from, to;
};

/// Degenerate triangles with one vertex or one edge are these.
Mesh mesh_with(const Points& points, std::size_t first, std::size_t count) {
  std::vector<double> xyz;
  for (std::size_t i = first; i < first + count; ++i) xyz.insert(xyz.end(), {points[i].x, points[i].y, points[i].z});
  const std::uint32_t last = static_cast<std::uint32_t>(count) - 1;
  return *Mesh::create(xyz, std::array<std::uint32_t, 3>{0, std::min(1U, last), last});
}

std::optional<Impact> ask(Features features, const Case& c, MotionOptions options) {
  options.threads = 1;
  const std::size_t first = features == Features::vertex_face ? 1 : 2;
  const auto impacts = find_impacts({mesh_with(c.from, 0, first), mesh_with(c.to, 0, first)},
                                    {mesh_with(c.from, first, 4 - first), mesh_with(c.to, first, 4 - first)}, options);
  EXPECT_TRUE(impacts) << impacts.error().message;
  const Feature feature = features == Features::vertex_face ? Feature::vertex_face : Feature::edge_edge;
  for (const Impact& impact : impacts->impacts)
    if (impact.feature == feature) return impact;
  return std::nullopt;
}

std::string text(const Case& c, double separation) {
  std::string result = fmt::format("separation {:a}: ", separation);
  for (const Points* points : {&c.from, &c.to})
    for (const Point& p : *points) result += fmt::format("{{{:a}, {:a}, {:a}}} ", p.x, p.y, p.z);
  return result;
}

/// As `MotionOptions::separation` has it.
mpq_class tolerance_of(const Case& c, double separation) {
  mpq_class most = 0;
  for (const Points* p : {&c.from, &c.to})
    for (std::size_t i = 1; i < 4; ++i)
      for (const auto& [x, y] : {std::pair((*p)[0].x, (*p)[i].x), {(*p)[0].y, (*p)[i].y}, {(*p)[0].z, (*p)[i].z}})
        most = std::max(most, mpq_class(abs(mpq_class(x) - mpq_class(y))));
  return mpq_class(separation) * mpq_class(0x1p-10) + most * mpq_class(0x1p-32);
}

/// More than the speed at which any two points of the features approach each other.
double speed_bound(const Case& c, Features features) {
  double most = 0;
  const std::size_t first = features == Features::vertex_face ? 1 : 2;
  const auto way = [&](std::size_t i) {
    return std::array{c.to[i].x - c.from[i].x, c.to[i].y - c.from[i].y, c.to[i].z - c.from[i].z};
  };
  for (std::size_t i = 0; i < first; ++i)
    for (std::size_t j = first; j < 4; ++j) {
      const auto v = way(i), w = way(j);
      most = std::max(most, std::hypot(v[0] - w[0], v[1] - w[1], v[2] - w[2]));
    }
  return most * (1 + 0x1p-40);
}

/// Expects them to be farther apart than the separation from 0 to `until`: at times so near to each other that they
/// must be between, too. Where these are too many, at some times only.
void expect_beyond(Features features, const Case& c, double separation, double until) {
  const double speed = speed_bound(c, features);
  const mpq_class square = mpq_class(separation) * mpq_class(separation);
  double time = 0;
  for (int i = 0; time < until; ++i) {
    const mpq_class at = oracle::squared_distance(features, c.from, c.to, time);
    ASSERT_GT(at, square) << text(c, separation) << " at " << time;
    const double free = (std::sqrt(at.get_d()) * (1 - 0x1p-40) - separation) / speed * (1 - 0x1p-40);
    time += std::max(free, i < 200 ? 0x1p-45 : 0.01 * (until - time) + 0x1p-45);
  }
}

/// Returns whether they come near.
bool check(Features features, const Case& c, double separation) {
  const auto found = ask(features, c, {.separation = separation});
  expect_beyond(features, c, separation, found ? found->time.lo : 1);
  if (!found) {
    EXPECT_GT(oracle::squared_distance(features, c.from, c.to, 1), mpq_class(separation) * mpq_class(separation));
    return false;
  }
  EXPECT_EQ(found->time.lo, found->time.hi);
  const mpq_class most = mpq_class(separation) + tolerance_of(c, separation);
  EXPECT_LE(oracle::squared_distance(features, c.from, c.to, found->time.lo), mpq_class(most * most))
      << text(c, separation) << " at " << found->time.lo;
  return true;
}

Point anywhere(Random& random, double size = 1) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}
Point on_lattice(Random& random, int size) {
  const auto x = [&] { return static_cast<double>(random.integer(-size, size)); };
  return {x(), x(), x()};
}
Point plus(const Point& p, const Point& d, double factor) {
  return {p.x + factor * d.x, p.y + factor * d.y, p.z + factor * d.z};
}
double small(Random& random, int least) { return std::ldexp(1.0, -random.integer(0, least)); }

struct Family {
  std::string name;
  std::function<Points(Random&)> points;  ///< at one end
};

const std::vector<Family>& families() {
  const auto four = [](const auto& point) {
    return [point](Random& random) { return Points{point(random), point(random), point(random), point(random)}; };
  };
  static const std::vector<Family> all{
      {"anywhere", four([](Random& random) { return anywhere(random); })},
      {"lattice, with degenerate edges and faces", four([](Random& random) { return on_lattice(random, 2); })},
      {"far away", four([](Random& random) {
         return plus({0x1p30, -0x1p31, 0x1p29}, on_lattice(random, 256), 0x1p-8);
       })},
      {"plane", four([](Random& random) {
         const Point p = anywhere(random);
         return Point{p.x, p.y, 0};
       })},
      {"parallel edges, thin faces",
       [](Random& random) {
         Points p{anywhere(random), anywhere(random), anywhere(random), {}};
         const int from = random.integer(1, 2);
         p[3] =
             plus(plus(p[2], plus(p[1], p[2 - from], -1), random.uniform(0.5, 1)), anywhere(random), small(random, 55));
         return p;
       }},
      {"one above the other",
       [](Random& random) {
         const double height = small(random, 20);
         Points p;
         const int first = random.integer(1, 2);
         for (int i = 0; i < 4; ++i) {
           p[static_cast<std::size_t>(i)] = anywhere(random);
           p[static_cast<std::size_t>(i)].z = i < first ? height : 0;
         }
         return p;
       }},
  };
  return all;
}

TEST(Separation, IsKeptUntilTheTimeThatIsFoundAndReachedThen) {
  constexpr std::array kScales{-40, -20, -10, -3, 0, 1, 7, 20, 50, 100, 150, 200};
  for (const Family& family : families()) {
    SCOPED_TRACE(family.name);
    test::Seeded seeded(20281);
    for (const Features features : {Features::vertex_face, Features::edge_edge}) {
      int hits = 0, misses = 0;
      for (std::size_t i = 0; i < 96; ++i) {
        Case c{family.points(seeded.random), family.points(seeded.random)};
        const int motion = seeded.random.integer(0, 3);
        for (std::size_t k = 0; k < 4 && motion > 0; ++k)  // as it was, or almost
          c.to[k] = plus(c.from[k], anywhere(seeded.random), motion == 1 ? 0 : small(seeded.random, 30));
        double separation = seeded.random.uniform(0.5, 1) * small(seeded.random, 26);
        const double scale = std::ldexp(1.0, kScales[i % kScales.size()]);
        for (Points* points : {&c.from, &c.to})
          for (Point& p : *points) p = {scale * p.x, scale * p.y, scale * p.z};
        ++(check(features, c, scale * separation) ? hits : misses);
        if (testing::Test::HasFailure()) return;
      }
      EXPECT_GE(hits, 3);
      EXPECT_GE(misses, 3);
    }
  }
}

TEST(Separation, OfZeroIsTheExactAnswerAndALargerOneIsReachedNoLater) {
  for (const Family& family : families()) {
    SCOPED_TRACE(family.name);
    test::Seeded seeded(20282);
    for (int i = 0; i < 100; ++i) {
      const Case c{family.points(seeded.random), family.points(seeded.random)};
      const auto &p = c.from, &q = c.to;
      for (const Features features : {Features::vertex_face, Features::edge_edge}) {
        const auto exact = features == Features::vertex_face
                               ? vertex_face_impact(p[0], {p[1], p[2], p[3]}, q[0], {q[1], q[2], q[3]})
                               : edge_edge_impact({p[0], p[1]}, {p[2], p[3]}, {q[0], q[1]}, {q[2], q[3]});
        auto found = ask(features, c, {.separation = 0});
        ASSERT_EQ(exact.has_value(), found.has_value());
        if (exact) {
          EXPECT_EQ(exact->lo, found->time.lo);
          EXPECT_EQ(exact->hi, found->time.hi);
        }
        // Each is more than the one before and its tolerance.
        for (const double separation : {0x1p-60, 0x1p-20, 0x1p-10, 0.25, 1.0, 3.0, 0x1p40}) {
          const auto wider = ask(features, c, {.separation = separation});
          if (found) {
            ASSERT_TRUE(wider) << text(c, separation);
            EXPECT_LE(wider->time.lo, found->time.hi) << text(c, separation);
          }
          found = wider;
        }
        EXPECT_EQ(found->time.hi, 0);
      }
    }
  }
}

TEST(Separation, IsReachedByBothOrNeitherWhereRolesAreExchangedOrTimeRunsBack) {
  test::Seeded seeded(20283);
  int hits = 0;
  for (const Family& family : families())
    for (int i = 0; i < 60; ++i) {
      const Case c{family.points(seeded.random), family.points(seeded.random)};
      const double separation = small(seeded.random, 12);
      for (const Features features : {Features::vertex_face, Features::edge_edge}) {
        const auto found = ask(features, c, {.separation = separation});
        // What comes within the separation comes within a larger one by its tolerance, whoever is asked.
        const double larger = separation + 2 * tolerance_of(c, separation).get_d();
        const auto exchanged = [&](const Points& p) {
          return features == Features::vertex_face ? Points{p[0], p[3], p[1], p[2]} : Points{p[3], p[2], p[0], p[1]};
        };
        for (const Case& other : {Case{exchanged(c.from), exchanged(c.to)}, Case{c.to, c.from}}) {
          EXPECT_LE(found.has_value(), ask(features, other, {.separation = larger}).has_value()) << text(c, separation);
          EXPECT_LE(ask(features, other, {.separation = separation}).has_value(),
                    ask(features, c, {.separation = larger}).has_value())
              << text(c, separation);
        }
        hits += int{found.has_value()};
        if (!found) continue;
        // Until an earlier end there is nothing, and the time is the same until a later one.
        if (found->time.lo > 0) {
          EXPECT_FALSE(ask(features, c, {.end = std::nextafter(found->time.lo, 0), .separation = separation}));
        }
        for (const double later : {found->time.lo, (1 + found->time.lo) / 2}) {
          const auto again = ask(features, c, {.end = later, .separation = separation});
          ASSERT_TRUE(again) << text(c, separation);
          EXPECT_EQ(again->time.lo, found->time.lo);
        }
      }
    }
  EXPECT_GT(hits, 100);
}

using Row = std::tuple<Feature, std::uint32_t, std::uint32_t, double, double>;

std::vector<Row> rows(std::span<const Impact> impacts) {
  std::vector<Row> result;
  for (const Impact& x : impacts) result.emplace_back(x.feature, x.a, x.b, x.time.lo, x.time.hi);
  return result;
}

/// Every vertex and face and every two edges, one by one; with 0 where a triangle of the one and a triangle of the
/// other have a vertex in common, and not at all where the features have.
std::vector<Row> brute_force(const Moving& a, const Moving& b, bool itself, double separation) {
  using Vertices = std::set<std::uint32_t>;
  const auto common = [](const Vertices& x, const Vertices& y) {
    return std::ranges::any_of(x, [&](std::uint32_t v) { return y.contains(v); });
  };
  /// All of the triangles that have a feature.
  const auto around = [](const Mesh& mesh, const Vertices& feature) {
    Vertices all;
    for (const auto& triangle : mesh.triangles()) {
      const Vertices corners(triangle.begin(), triangle.end());
      if (std::ranges::includes(corners, feature)) all.insert(corners.begin(), corners.end());
    }
    return all;
  };
  std::vector<Row> result;
  const auto test = [&](Feature feature, std::uint32_t i, std::uint32_t j, const Moving& first,
                        const std::vector<std::uint32_t>& of_first, const Moving& second,
                        const std::vector<std::uint32_t>& of_second) {
    const Vertices one(of_first.begin(), of_first.end()), two(of_second.begin(), of_second.end());
    if (itself && common(one, two)) return;
    Case c;
    std::size_t k = 0;
    for (const auto& [mesh, vertices] : {std::pair(&first, &of_first), {&second, &of_second}})
      for (const std::uint32_t v : *vertices) c.from[k] = mesh->from.vertices()[v], c.to[k++] = mesh->to.vertices()[v];
    const bool near = itself && common(around(first.from, one), around(second.from, two));
    const auto found = ask(feature == Feature::edge_edge ? Features::edge_edge : Features::vertex_face, c,
                           {.separation = near ? 0 : separation});
    if (found) result.emplace_back(feature, i, j, found->time.lo, found->time.hi);
  };
  const auto vertices_and_faces = [&](Feature feature, const Moving& of, const Moving& faces) {
    for (std::uint32_t v = 0; v < of.from.vertex_count(); ++v)
      for (std::uint32_t f = 0; f < faces.from.triangle_count(); ++f) {
        const auto& c = faces.from.triangles()[f];
        const bool swapped = feature == Feature::face_vertex;
        test(feature, swapped ? f : v, swapped ? v : f, of, {v}, faces, {c[0], c[1], c[2]});
      }
  };
  vertices_and_faces(Feature::vertex_face, a, b);
  if (!itself) vertices_and_faces(Feature::face_vertex, b, a);
  const auto first = a.from.edges(), second = b.from.edges();
  for (std::uint32_t i = 0; i < first.size(); ++i)
    for (std::uint32_t j = itself ? i + 1 : 0; j < second.size(); ++j)
      test(Feature::edge_edge, i, j, a, {first[i][1], first[i][0]}, b, {second[j][1], second[j][0]});
  std::ranges::sort(result);
  return result;
}

/// A sheet that flutters.
Moving fluttering(Random& random, int n, double z, double by) {
  const auto state = [&](double height) {
    scenes::MeshData data = scenes::flat_grid(n, n, 1.0 / n);
    for (std::size_t i = 0; i < data.xyz.size(); ++i)
      data.xyz[i] += random.uniform(-by, by) + (i % 3 == 2 ? height : 0);
    return test::mesh_of(data);
  };
  Mesh from = state(z);
  return {std::move(from), state(0)};
}

/// No slab between two convex sets is wider than their distance, so that a normal along which they are that far apart
/// is right, and so is a point if nothing of its own feature is nearer to the other along it.
void expect_apart_along_normal(const Impact& impact, const Moving& a, const Moving& b, double separation) {
  EXPECT_NEAR(std::hypot(impact.normal.x, impact.normal.y, impact.normal.z), 1, 1e-9);
  const auto along = [&](const Point& p) {
    return impact.normal.x * p.x + impact.normal.y * p.y + impact.normal.z * p.z;
  };
  const auto along_all = [&](const Moving& mesh, std::span<const std::uint32_t> vertices) {
    std::vector<double> result;
    for (const std::uint32_t v : vertices) {
      const double t = impact.time.lo;
      result.push_back((1 - t) * along(mesh.from.vertices()[v]) + t * along(mesh.to.vertices()[v]));
    }
    return result;
  };
  const auto feature_of = [&](const Moving& mesh, Feature face, std::uint32_t index) {
    if (impact.feature == Feature::edge_edge) return along_all(mesh, mesh.from.edges()[index]);
    if (impact.feature == face) return along_all(mesh, mesh.from.triangles()[index]);
    return along_all(mesh, std::array{index});
  };
  const double least = std::ranges::min(feature_of(a, Feature::face_vertex, impact.a));
  const double most = std::ranges::max(feature_of(b, Feature::vertex_face, impact.b));
  if (impact.time.lo > 0) {
    EXPECT_NEAR(least - most, separation, 0x1p-10 * separation + 1e-9);
  }
  EXPECT_NEAR(along(impact.point), impact.feature == Feature::face_vertex ? most : least, 1e-9);
}

TEST(Separation, OfMeshesIsThatOfEveryPairOfFeatures) {
  test::Seeded seeded(20284);
  std::size_t count = 0;
  for (const double separation : {0.01, 0.1, 0.3})
    for (const int n : {1, 3}) {
      const Moving a = fluttering(seeded.random, n, 0.5, 0.2), b = fluttering(seeded.random, 4 - n, 0, 0.2);
      const auto of_two = brute_force(a, b, false, separation), of_one = brute_force(a, a, true, separation);
      for (const int threads : {1, 2}) {
        const auto two = find_impacts(a, b, {.separation = separation, .threads = threads});
        EXPECT_EQ(of_two, rows(two->impacts));
        for (const Impact& impact : two->impacts) expect_apart_along_normal(impact, a, b, separation);
        const auto one = find_impacts(a, {.separation = separation, .threads = threads});
        EXPECT_EQ(of_one, rows(one->impacts));
        const auto first = find_impacts(a, b, {.earliest = true, .separation = separation, .threads = threads});
        const auto soonest = std::ranges::min_element(of_two, {}, [](const Row& row) { return std::get<3>(row); });
        EXPECT_EQ(rows(first->impacts), std::vector{*soonest});
      }
      // As two objects of a scene.
      Scene scene;
      const ObjectId one = *scene.add(a.from, {}), two = *scene.add(b.from, {});
      ASSERT_TRUE(scene.self(one, true));
      scene.step();
      for (const auto& [id, mesh] : {std::pair(one, &a.to), {two, &b.to}}) {
        std::vector<double> xyz;
        for (const Point& p : mesh->vertices()) xyz.insert(xyz.end(), {p.x, p.y, p.z});
        ASSERT_TRUE(scene.set_vertices(id, xyz));
      }
      const auto all = scene.find_impacts({.separation = separation});
      auto expected = of_one;
      expected.insert(expected.end(), of_two.begin(), of_two.end());
      EXPECT_EQ(rows(all->impacts), expected);
      count += expected.size();
    }
  EXPECT_GT(count, 400u);
}

TEST(Separation, OfObjectsAndPlacesFollowsTheFormula) {
  // Cubes with the side 1 that approach each other on x: they are 2 - 2 t apart.
  const auto cube = [](double x) { return test::mesh_of(scenes::box({x, 0.25, 0.25}, {x + 1, 0.75, 0.75})); };
  const Mesh still = test::mesh_of(scenes::box({-1, 0, 0}, {0, 1, 1}));
  for (const double separation : {0.25, 0.5, 1.0, 1.75, 2.5, 1e308}) {
    const auto met = find_impacts({cube(2), cube(0)}, {still, still}, {.separation = separation});
    ASSERT_TRUE(met->earliest);
    const double expected = std::max(0.0, 1 - separation / 2);
    EXPECT_NEAR(met->earliest->lo, expected, std::min(0x1p-10, 0x1p-10 * separation));
    for (const Impact& impact : met->impacts) {
      if (impact.feature != Feature::vertex_face || impact.time.lo > met->earliest->lo || separation > 2) continue;
      EXPECT_EQ(impact.normal, (Point{1, 0, 0}));
      EXPECT_NEAR(impact.point.x, 2 - 2 * impact.time.lo, 1e-12);
    }
    Scene scene;
    const ObjectId moving = *scene.add(cube(2), {});
    ASSERT_TRUE(scene.add(still, {}));
    scene.step();
    ASSERT_TRUE(scene.set_pose(moving, Pose{.t = {-2, 0, 0}}));
    EXPECT_EQ(rows(scene.find_impacts({.separation = separation})->impacts), rows(met->impacts));
  }
  EXPECT_EQ(find_impacts({still, still}, {.separation = -1}).error().code, Code::bad_option);
  EXPECT_EQ(find_impacts({still, still}, {.separation = std::nan("")}).error().code, Code::bad_option);
}

TEST(Separation, IsKeptByCollisionFreeSteps) {
  test::Seeded seeded(20285);
  Moving a = fluttering(seeded.random, 2, 1, 0.1), b = fluttering(seeded.random, 3, -1, 0.1);
  const MotionOptions options{.separation = 0.125, .threads = 1};
  int cut = 0;
  for (int i = 0; i < 60; ++i) {
    const auto step = collision_free_step(std::array{a, b}, options);
    ASSERT_TRUE(step) << step.error().message;
    EXPECT_FALSE(find_impacts({a.from, step->ends[0]}, {b.from, step->ends[1]}, options)->earliest);
    EXPECT_FALSE(find_impacts({a.from, step->ends[0]}, options)->earliest);
    EXPECT_GT(distance(step->ends[0], {}, step->ends[1], {})->distance, options.separation);
    const auto met = find_impacts(a, b, options)->earliest;
    EXPECT_LE(step->time < 1, met || find_impacts(a, options)->earliest || find_impacts(b, options)->earliest);
    cut += int{step->time < 1};
    a = {step->ends[0], fluttering(seeded.random, 2, 0, 0.2).from};
    b = {step->ends[1], fluttering(seeded.random, 3, 0, 0.2).from};
  }
  EXPECT_GT(cut, 20);
  const auto wide = collision_free_step(std::array{a, b}, {.separation = 3});
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().code, Code::in_contact);
  EXPECT_NE(wide.error().message.find("within the separation"), std::string::npos) << wide.error().message;
}

}  // namespace
}  // namespace impinge::separation
