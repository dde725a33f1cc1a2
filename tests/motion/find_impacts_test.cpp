// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <tuple>
#include <vector>

#include "impinge/collide.hpp"
#include "impinge/impacts.hpp"
#include "impinge/io.hpp"
#include "impinge/predicates.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

using scenes::Random;
constexpr Adjacency kByIndex = Adjacency::by_index;
using Row = std::tuple<Feature, std::uint32_t, std::uint32_t, double, double>;

std::vector<Row> rows(const std::vector<Impact>& impacts) {
  std::vector<Row> result;
  for (const Impact& x : impacts) result.emplace_back(x.feature, x.a, x.b, x.time.lo, x.time.hi);
  return result;
}

Impacts found(Result<Impacts> result) {
  EXPECT_TRUE(result) << result.error().message;
  return *std::move(result);
}

/// Every vertex against every face and every edge against every edge.
std::vector<Row> brute_force(const Moving& a, const Moving& b, bool itself) {
  std::vector<Row> result;
  const auto add = [&](Feature feature, std::uint32_t i, std::uint32_t j, const std::optional<Interval>& time) {
    if (time) result.emplace_back(feature, i, j, time->lo, time->hi);
  };
  const auto used = [](const Mesh& mesh) {
    std::set<std::uint32_t> vertices;
    for (const auto& triangle : mesh.triangles()) vertices.insert(triangle.begin(), triangle.end());
    return vertices;
  };
  const auto vertex_against_faces = [&](const Moving& of, const Moving& faces, Feature feature) {
    for (const std::uint32_t v : used(of.from))
      for (std::uint32_t f = 0; f < faces.from.triangle_count(); ++f) {
        const auto& c = faces.from.triangles()[f];
        if (itself && (c[0] == v || c[1] == v || c[2] == v)) continue;
        const auto face = [&](const Mesh& mesh) {
          return Triangle{mesh.vertices()[c[0]], mesh.vertices()[c[1]], mesh.vertices()[c[2]]};
        };
        const bool swapped = feature == Feature::face_vertex;
        add(feature, swapped ? f : v, swapped ? v : f,
            vertex_face_impact(of.from.vertices()[v], face(faces.from), of.to.vertices()[v], face(faces.to)));
      }
  };
  vertex_against_faces(a, b, Feature::vertex_face);
  if (!itself) vertex_against_faces(b, a, Feature::face_vertex);
  const auto edge = [](const Mesh& mesh, const std::array<std::uint32_t, 2>& e) {
    return Segment{mesh.vertices()[e[0]], mesh.vertices()[e[1]]};
  };
  const auto first = a.from.edges(), second = b.from.edges();
  for (std::uint32_t i = 0; i < first.size(); ++i)
    for (std::uint32_t j = itself ? i + 1 : 0; j < second.size(); ++j) {
      const auto &e = first[i], &f = second[j];
      if (itself && (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1])) continue;
      add(Feature::edge_edge, i, j, edge_edge_impact(edge(a.from, e), edge(b.from, f), edge(a.to, e), edge(b.to, f)));
    }
  std::sort(result.begin(), result.end());
  return result;
}

/// A sheet of n x n squares whose vertices are on a lattice of `steps` in each unit, where `place` puts them.
scenes::MeshData sheet(int n, const std::function<Point(double, double)>& place) {
  scenes::MeshData mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const Point p = place(i / double(n), j / double(n));
      mesh.xyz.insert(mesh.xyz.end(), {p.x, p.y, p.z});
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mesh.triangles.insert(mesh.triangles.end(),
                            {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
  return mesh;
}

double on_lattice(double x, double steps) { return std::round(x * steps) / steps; }

/// A sheet that flutters: on a coarse lattice many vertices meet others exactly.
Moving fluttering(Random& random, int n, double steps, double z, double squares = 0.6) {
  const auto state = [&](double lift) {
    return test::mesh_of(sheet(n, [&](double x, double y) {
      const auto about = [&](double w, double by) { return on_lattice(w + random.uniform(-by, by), steps); };
      return Point{about(x, squares / n), about(y, squares / n), about(lift, 0.2)};
    }));
  };
  Mesh from = state(z);
  return {std::move(from), state(-z)};
}

/// The soonest, of those the first in order.
Row first_of(const std::vector<Row>& impacts) {
  return *std::ranges::min_element(impacts, {},
                                   [](const Row& x) { return std::tuple(std::get<3>(x), std::get<4>(x), x); });
}

TEST(FindImpacts, OfTwoMeshesAreThoseOfEveryPairOfFeatures) {
  test::Seeded seeded(20263);
  std::size_t count = 0;
  for (const double steps : {8.0, 64.0, 0x1p40})
    for (int i = 0; i < 6; ++i) {
      const int n = 2 + i % 4;
      const Moving a = fluttering(seeded.random, n, steps, 0.3), b = fluttering(seeded.random, 5 - n % 2, steps, -0.1);
      const auto expected = brute_force(a, b, false);
      for (const int threads : {1, 2}) {
        const Impacts impacts = found(find_impacts(a, b, {.threads = threads}));
        EXPECT_EQ(expected, rows(impacts.impacts));
        EXPECT_FALSE(impacts.truncated);
        for (const double end : {1.0, 0.75}) {
          std::vector<Row> until = expected;
          std::erase_if(until, [&](const Row& x) { return std::get<4>(x) > end; });
          if (!until.empty()) until = {first_of(until)};
          EXPECT_EQ(rows(found(find_impacts(a, b, {.earliest = true, .end = end, .threads = threads})).impacts), until);
        }
      }
      count += expected.size();
    }
  EXPECT_GT(count, 1000u);
}

TEST(FindImpacts, TheFirstAloneIsTheFirstOfAll) {
  // So many that the search knows an early one long before its end. On the coarse lattice many are first.
  test::Seeded seeded(20267);
  for (const double steps : {16.0, 0x1p40})
    for (const double z : {0.0, 0.3, 0.8}) {
      const Moving a = fluttering(seeded.random, 16, steps, z, 1.5), b = fluttering(seeded.random, 14, steps, -z, 1.5);
      const auto expect_first = [](const auto& find, double end) {
        std::vector<Row> all = rows(found(find({.end = end})).impacts);
        if (!all.empty()) all = {first_of(all)};
        for (const int threads : {1, 2})
          EXPECT_EQ(rows(found(find({.earliest = true, .end = end, .threads = threads})).impacts), all);
        return !all.empty();
      };
      const auto of_two = [&](const MotionOptions& options) { return find_impacts(a, b, options); };
      const auto of_one = [&](const MotionOptions& options) { return find_impacts(a, options); };
      EXPECT_TRUE(expect_first(of_two, 1) && expect_first(of_one, 1));
      expect_first(of_two, 0.4), expect_first(of_one, 0.4);
    }
}

TEST(FindImpacts, OfAMeshWithItselfLeaveOutSharedVertices) {
  test::Seeded seeded(20264);
  std::size_t count = 0;
  for (const double steps : {8.0, 64.0, 0x1p40})
    for (int i = 0; i < 5; ++i) {
      const Moving mesh = fluttering(seeded.random, 2 + i, steps, 0.3, 1.5);
      const auto expected = brute_force(mesh, mesh, true);
      const Impacts impacts = found(find_impacts(mesh, {.adjacency = kByIndex}));
      EXPECT_EQ(expected, rows(impacts.impacts));
      count += expected.size();

      // Back again from a deformed mesh, which shares what was found out, whether it is near or far from where that
      // was.
      for (const double scale : {1.0, -0.5}) {
        std::vector<double> xyz;
        for (const Point& p : mesh.to.vertices()) xyz.insert(xyz.end(), {scale * p.z, p.x, p.y});
        const Moving back{*mesh.from.deformed(xyz), mesh.from};
        EXPECT_EQ(brute_force(back, back, true), rows(found(find_impacts(back, {.adjacency = kByIndex})).impacts));
      }

      // The first so many, the first of all, and those until some time.
      const Impacts few = found(find_impacts(mesh, {.adjacency = kByIndex, .limit = expected.size() / 2}));
      EXPECT_EQ(std::vector(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(expected.size() / 2)),
                rows(few.impacts));
      EXPECT_EQ(few.truncated, !expected.empty());
      if (expected.empty()) continue;
      const Row first = first_of(expected);
      for (const Impacts& x : {few, impacts}) {
        EXPECT_EQ(x.earliest->lo, std::get<3>(first));
        EXPECT_EQ(x.earliest->hi, std::get<4>(first));
      }
      EXPECT_EQ(rows(found(find_impacts(mesh, {.earliest = true, .adjacency = kByIndex})).impacts), std::vector{first});
      for (const double end : {0.0, 0.25, std::get<4>(first), std::nextafter(std::get<3>(first), -1)}) {
        if (end < 0) continue;
        std::vector<Row> until;
        std::copy_if(expected.begin(), expected.end(), std::back_inserter(until),
                     [&](const Row& x) { return std::get<4>(x) <= end; });
        EXPECT_EQ(rows(found(find_impacts(mesh, {.end = end, .adjacency = kByIndex})).impacts), until);
      }
    }
  EXPECT_GT(count, 1000u);
}

TEST(FindImpacts, ByPositionTakeEqualVerticesForOne) {
  test::Seeded seeded(20265);
  const Moving whole = fluttering(seeded.random, 4, 16, 0.3, 1.5);
  // The same with corners of its own for each triangle: vertex 3 i + k is corner k of triangle i.
  const auto apart = [&](const Mesh& mesh) {
    scenes::MeshData soup;
    for (const auto& triangle : mesh.triangles())
      for (const std::uint32_t v : triangle) {
        const Point& p = mesh.vertices()[v];
        soup.triangles.push_back(static_cast<std::uint32_t>(soup.xyz.size() / 3));
        soup.xyz.insert(soup.xyz.end(), {p.x, p.y, p.z});
      }
    return test::mesh_of(soup);
  };
  const Moving soup{apart(whole.from), apart(whole.to)};
  const Impacts expected = found(find_impacts(whole)), impacts = found(find_impacts(soup));
  // By what they are: places do not depend on numbers.
  const auto places = [](const Moving& mesh, const Impacts& all) {
    std::vector<std::vector<std::tuple<double, double, double>>> result;
    for (const Impact& x : all.impacts) {
      std::vector<std::uint32_t> vertices;
      if (x.feature == Feature::edge_edge) {
        for (const std::uint32_t e : {x.a, x.b})
          for (const std::uint32_t v : mesh.from.edges()[e]) vertices.push_back(v);
      } else {
        vertices.push_back(x.a);
        for (const std::uint32_t v : mesh.from.triangles()[x.b]) vertices.push_back(v);
      }
      std::vector<std::tuple<double, double, double>> points{{double(x.feature != Feature::edge_edge), x.time.lo, 0}};
      for (const std::uint32_t v : vertices) {
        const Point& p = mesh.from.vertices()[v];
        points.emplace_back(p.x, p.y, p.z);
      }
      std::sort(points.begin() + 1, points.end());
      result.push_back(points);
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  EXPECT_EQ(places(whole, expected), places(soup, impacts));
  EXPECT_GT(expected.impacts.size(), 20u);
  EXPECT_TRUE(std::is_sorted(impacts.impacts.begin(), impacts.impacts.end(), [](const Impact& x, const Impact& y) {
    return std::tie(x.feature, x.a, x.b) < std::tie(y.feature, y.a, y.b);
  }));
  // By index every triangle meets its neighbours all the time.
  EXPECT_EQ(found(find_impacts(soup, {.adjacency = kByIndex})).earliest->hi, 0);
}

TEST(FindImpacts, WithoutThemAMeshThatIsFreeOfSelfCollisionStaysFree) {
  test::Seeded seeded(20266);
  int free = 0, met = 0;
  for (int i = 0; i < 300; ++i) {
    const Moving mesh = fluttering(seeded.random, 3, 64, 0.05, 0.5);
    const auto meets_itself = [](const Mesh& state) {
      const auto contacts = self_collide(state, {}, {.adjacency = kByIndex});
      EXPECT_TRUE(contacts) << contacts.error().message;
      return !contacts->triangles.empty();
    };
    if (meets_itself(mesh.from)) continue;
    if (!found(find_impacts(mesh, {.adjacency = kByIndex})).impacts.empty()) {
      ++met;
      continue;
    }
    ++free;
    for (const double t : {0.25, 0.5, 0.75, 1.0}) {  // exact on the lattice
      std::vector<double> xyz;
      for (std::size_t v = 0; v < mesh.from.vertex_count(); ++v) {
        const Point &p = mesh.from.vertices()[v], &q = mesh.to.vertices()[v];
        for (const auto& [x, y] : {std::pair(p.x, q.x), {p.y, q.y}, {p.z, q.z}}) xyz.push_back((1 - t) * x + t * y);
      }
      EXPECT_FALSE(meets_itself(*mesh.from.deformed(xyz))) << t;
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(met, 20);
}

TEST(FindImpacts, SayWhereAndAlongWhich) {
  // A cube falls onto a plate that rises towards it: they meet half-way, face on face.
  const auto cube = [](double z) { return test::mesh_of(scenes::box({0, 0, z}, {1, 1, z + 1})); };
  const auto plate = [](double z) { return test::mesh_of(scenes::box({-1, -1, z - 1}, {2, 2, z})); };
  const Impacts impacts = found(find_impacts({cube(3), cube(1)}, {plate(0), plate(2)}));
  ASSERT_FALSE(impacts.impacts.empty());
  EXPECT_EQ(impacts.earliest->lo, 0.75);
  EXPECT_EQ(impacts.earliest->hi, 0.75);
  int under = 0;
  for (const Impact& x : impacts.impacts) {
    if (x.feature != Feature::vertex_face || x.time.lo != 0.75) continue;
    EXPECT_EQ(x.point.z, 1.5);
    EXPECT_EQ(x.normal, (Point{0, 0, 1}));
    ++under;
  }
  EXPECT_GE(under, 4);
}

TEST(FindImpacts, SayWhatIsWrong) {
  const Mesh cube = test::mesh_of(scenes::cube()), fine = test::mesh_of(scenes::box({0, 0, 0}, {1, 1, 1}, 2));
  const auto fails = [](const Result<Impacts>& result, Code code, const std::string& words) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
  };
  fails(find_impacts({cube, fine}), Code::bad_mesh, "vertices at the start");
  fails(find_impacts({cube, cube}, {cube, fine}), Code::bad_mesh, "the second mesh");
  scenes::MeshData other = scenes::cube();
  std::swap(other.triangles[3], other.triangles[4]);
  fails(find_impacts({cube, test::mesh_of(other)}), Code::bad_mesh, "triangle 1 has other vertices");
  fails(find_impacts({cube, cube}, {.end = 1.5}), Code::bad_option, "0 to 1");
  fails(find_impacts({cube, cube}, {.threads = -1}), Code::bad_option, "threads");
  std::stop_source stop;
  stop.request_stop();
  fails(find_impacts({fine, fine}, {.stop = stop.get_token()}), Code::cancelled, "stopped");
  const Mesh empty = test::mesh_of({});
  EXPECT_TRUE(found(find_impacts({empty, empty}, {cube, cube})).impacts.empty());
  EXPECT_FALSE(found(find_impacts({empty, empty})).earliest);
}

namespace fs = std::filesystem;
using Ids = std::set<std::pair<std::uint32_t, std::uint32_t>>;

nlohmann::json json_of(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

/// Steps of the "Sample Scalable CCD Ground Truth Data" (Wang et al. 2021): folders frames, boxes and mma_bool, where
/// ids are those of vertices, then of edges, then of faces.
TEST(GroundTruth, OfPublicScenesIsFoundWhole) {
  const char* const folder = std::getenv("IMPINGE_CCD_DIR");
  if (folder == nullptr) GTEST_SKIP() << "set IMPINGE_CCD_DIR to a folder of scenes of the ground truth";
  int steps = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::smatch number;
    const std::string name = entry.path().filename().string();
    if (!std::regex_match(name, number, std::regex(R"((\d+)(vf)\.json)"))) continue;
    const fs::path scene = entry.path().parent_path().parent_path();
    SCOPED_TRACE(scene.string() + " " + number[1].str());
    const auto frame = [&](int n) {
      auto model = io::read(scene / "frames" / (std::to_string(n) + ".ply"));
      EXPECT_TRUE(model) << model.error().message;
      return model->objects.at(0).mesh;
    };
    const int n = std::stoi(number[1]);
    const Moving mesh{frame(n), frame(n + 1)};
    Ids truth, found;
    for (const std::string kind : {"vf", "ee"}) {
      const auto boxes = json_of(scene / "boxes" / (number[1].str() + kind + ".json")),
                 meet = json_of(scene / "mma_bool" / (number[1].str() + kind + "_mma_bool.json"));
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const auto a = boxes[i][0].get<std::uint32_t>(), b = boxes[i][1].get<std::uint32_t>();
        if (meet[i].get<bool>()) truth.emplace(std::min(a, b), std::max(a, b));
      }
    }
    const auto impacts = find_impacts(mesh);
    ASSERT_TRUE(impacts) << impacts.error().message;
    const auto vertices = static_cast<std::uint32_t>(mesh.from.vertex_count()),
               edges = static_cast<std::uint32_t>(mesh.from.edges().size());
    std::size_t faces = 0;
    for (const Impact& x : impacts->impacts) {
      const bool on_edges = x.feature == Feature::edge_edge;
      found.emplace(on_edges ? vertices + x.a : x.a, on_edges ? vertices + x.b : vertices + edges + x.b);
      faces += std::size_t{!on_edges};
    }
    EXPECT_EQ(truth, found);
    std::cout << scene.filename().string() << ": " << faces << " of a vertex and a face, "
              << impacts->impacts.size() - faces << " of two edges, the first at " << impacts->earliest->lo << '\n';
    ++steps;
  }
  EXPECT_GT(steps, 0);
}

}  // namespace
}  // namespace impinge
