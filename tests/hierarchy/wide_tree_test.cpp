// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "hierarchy/wide_tree.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>

#include "scenes/hard.hpp"
#include "scenes/motion.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/hierarchy/wide_trees.hpp"

namespace impinge {
namespace {

using hierarchy::Frame;
using hierarchy::kNoBox;
using hierarchy::kWidth;
using hierarchy::TreeRef;
using hierarchy::WideLeaf;
using hierarchy::WideNode;
using hierarchy::WideTree;

/// 2^-k x, exactly.
mpq_class in_unit(double x, int unit_exponent) {
  mpq_class result(x);
  if (unit_exponent > 0) mpq_div_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(unit_exponent));
  if (unit_exponent < 0) mpq_mul_2exp(result.get_mpq_t(), result.get_mpq_t(), static_cast<mp_bitcnt_t>(-unit_exponent));
  return result;
}

/// A vertex in a frame. Rationals are slow: they are asked only where long doubles leave a doubt.
class Local {
 public:
  Local(const Frame& frame, const Vec3& vertex, int unit_exponent)
      : frame_(frame), vertex_(vertex), unit_exponent_(unit_exponent) {
    long double size = 0;
    for (int l = 0; l < 3; ++l) {
      const long double d = std::ldexp(static_cast<long double>(component(vertex, l)), -unit_exponent) -
                            static_cast<long double>(frame.origin[l]);
      for (int i = 0; i < 3; ++i) x_[i] += frame.axes[l][i] * d;
      size += std::abs(d);  // no axis has a component of 2
    }
    // The difference, three products and two sums are rounded; axes and origin are no long doubles' fault.
    error_ = 16 * std::numeric_limits<long double>::epsilon() * size + std::numeric_limits<long double>::min();
  }

  /// Whether coordinate i is certainly within `reach` of `center`.
  [[nodiscard]] bool is_within(int i, float center, float reach) const {
    const long double distance = std::abs(x_[i] - static_cast<long double>(center));
    if (distance + 2 * error_ + 2 * std::numeric_limits<long double>::epsilon() * std::abs(center) <= reach)
      return true;
    mpq_class x = -mpq_class(center);
    for (int l = 0; l < 3; ++l)
      x +=
          mpq_class(frame_.axes[l][i]) * (in_unit(component(vertex_, l), unit_exponent_) - mpq_class(frame_.origin[l]));
    return abs(x) <= mpq_class(reach);
  }

 private:
  const Frame& frame_;
  const Vec3& vertex_;
  int unit_exponent_;
  long double x_[3] = {}, error_;
};

void expect_true_frame(const Frame& frame) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      long double e = i == j ? -1 : 0;  // products of floats are exact, and sums next to it
      for (int l = 0; l < 3; ++l) e += static_cast<long double>(frame.axes[l][i]) * frame.axes[l][j];
      ASSERT_LE(std::abs(e), 0x1p-20 - 0x1p-50);
    }
  for (int l = 0; l < 3; ++l) {
    ASSERT_TRUE(std::isfinite(frame.origin[l]));
    ASSERT_EQ(frame.axes[l][3], 0);
  }
  ASSERT_EQ(frame.origin[3], 0);
}

/// Makes the whole tree and holds it against all that its headers promise, by exact arithmetic.
class Inspection {
 public:
  Inspection(const MeshData& mesh, std::uint32_t leaf_size, WideTree& tree)
      : mesh_(mesh), leaf_size_(leaf_size), tree_(tree), times_in_leaf_(mesh.triangles.size()) {}

  void run() {
    hierarchy::MadeNodes made;
    const TreeRef root = tree_.root(made);
    EXPECT_EQ(made.nodes, 1u);
    EXPECT_EQ(tree_.root(made).bits(), root.bits());
    EXPECT_EQ(made.nodes, 1u);
    ASSERT_NO_FATAL_FAILURE(run_all(made));
    EXPECT_EQ(made.nodes, nodes_ + leaves_);
  }

  /// Of a tree of which some is made.
  void run_all(hierarchy::MadeNodes& made) {
    const TreeRef root = tree_.root(made);
    ASSERT_NO_FATAL_FAILURE(inspect(root, static_cast<std::uint32_t>(times_in_leaf_.size()), made));
    EXPECT_EQ(times_in_leaf_, std::vector<std::uint32_t>(times_in_leaf_.size(), 1));
  }

 private:
  /// The triangles below.
  std::vector<std::uint32_t> inspect(const TreeRef& ref, std::uint32_t count, hierarchy::MadeNodes& made) {
    std::vector<std::uint32_t> ids;
    if (ref.is_leaf()) {
      ++leaves_;
      EXPECT_EQ(ref.leaf().count, count);
      inspect(ref.leaf());
      ids.assign(ref.leaf().ids(), ref.leaf().ids() + ref.leaf().count);
      for (const std::uint32_t id : ids) ++times_in_leaf_.at(id);
      return ids;
    }
    ++nodes_;
    WideNode& node = ref.node();
    EXPECT_GT(count, leaf_size_);
    EXPECT_GE(node.size, 2u);
    expect_true_frame(node.frame);
    EXPECT_LT(node.frame.radius, kInfinity);
    for (std::uint32_t lane = node.size; lane < kWidth; ++lane)
      for (int i = 0; i < 3; ++i) EXPECT_EQ(node.half[i][lane], kNoBox);
    for (std::uint32_t lane = 0; lane < node.size; ++lane) {
      EXPECT_GT(node.count[lane], 0u);
      const TreeRef child = tree_.child(node, static_cast<int>(lane), made);
      const std::uint64_t made_before = made.nodes;
      EXPECT_EQ(tree_.child(node, static_cast<int>(lane), made).bits(), child.bits());
      EXPECT_EQ(made.nodes, made_before);
      const auto below = inspect(child, node.count[lane], made);
      if (testing::Test::HasFailure()) return ids;
      expect_in_box(node, lane, below);
      ids.insert(ids.end(), below.begin(), below.end());
    }
    EXPECT_EQ(ids.size(), count);
    return ids;
  }

  void expect_in_box(const WideNode& node, std::uint32_t lane, const std::vector<std::uint32_t>& ids) {
    for (const std::uint32_t id : ids)
      for (const std::uint32_t v : mesh_.triangles[id]) {
        const Local x(node.frame, mesh_.vertices[v], tree_.unit_exponent());
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(x.is_within(i, node.center[i][lane], node.half[i][lane]));
          ASSERT_TRUE(x.is_within(i, 0, node.frame.radius));
        }
      }
  }

  void inspect(const WideLeaf& leaf) {
    EXPECT_GE(leaf.count, 1u);
    EXPECT_LE(leaf.count, leaf_size_);
    EXPECT_EQ(leaf.stride, (leaf.count + 15) / 16 * 16);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(leaf.row(0)) % 64, 0u);
    ASSERT_NO_FATAL_FAILURE(expect_true_frame(leaf.frame));
    for (std::uint32_t j = 0; j < leaf.count; ++j)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Local x(leaf.frame, mesh_.vertices[mesh_.triangles[leaf.ids()[j]][corner]], tree_.unit_exponent());
        std::array<float, 3> stored;
        for (int i = 0; i < 3; ++i) {
          stored[static_cast<std::size_t>(i)] = leaf.row(static_cast<int>(3 * corner) + i)[j];
          ASSERT_TRUE(x.is_within(i, stored[static_cast<std::size_t>(i)], leaf.error));
          ASSERT_TRUE(x.is_within(i, 0, leaf.half[i]));
          ASSERT_TRUE(x.is_within(i, 0, leaf.frame.radius));
        }
        expect_inverse_error(leaf, stored);
      }
    for (int i = 0; i < 9; ++i)
      for (std::uint32_t j = leaf.count; j < leaf.stride; ++j) ASSERT_EQ(leaf.row(i)[j], WideLeaf::kNoTriangle);
  }

  /// |F⁻¹x - Fᵀx| is below the leaf's bound if |x - F Fᵀx| is below it by what F may stretch.
  template <class Number>
  static Number squared_defect(const Frame& frame, const std::array<float, 3>& x) {
    Number squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      Number rest = x[i];
      for (const auto& component : frame.axes) {
        Number back = 0;
        for (std::size_t k = 0; k < 3; ++k) back += Number(component[k]) * Number(x[k]);
        rest -= Number(component[i]) * back;
      }
      squares += rest * rest;
    }
    return squares;
  }
  static void expect_inverse_error(const WideLeaf& leaf, const std::array<float, 3>& x) {
    const double bound = leaf.inverse_error * (1 - 0x1p-19);
    const long double size = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
    const long double rounding = 32 * std::numeric_limits<long double>::epsilon() * size;
    if (std::sqrt(squared_defect<long double>(leaf.frame, x)) + rounding <= bound) return;
    ASSERT_LE(squared_defect<mpq_class>(leaf.frame, x), mpq_class(bound) * mpq_class(bound));
  }

  const MeshData& mesh_;
  const std::uint32_t leaf_size_;
  WideTree& tree_;
  std::vector<std::uint32_t> times_in_leaf_;
  std::uint64_t nodes_ = 0, leaves_ = 0;
};

void expect_true_tree(const scenes::MeshData& numbers, std::initializer_list<std::uint32_t> leaf_sizes) {
  const Mesh mesh = test::mesh_of(numbers);
  for (const std::uint32_t leaf_size : leaf_sizes) {
    SCOPED_TRACE("leaf size " + std::to_string(leaf_size));
    WideTree tree(test::numbers_of(mesh), leaf_size);
    ASSERT_NO_FATAL_FAILURE(Inspection(test::numbers_of(mesh), leaf_size, tree).run());
  }
}
void expect_true_trees(const scenes::MeshData& numbers) { expect_true_tree(numbers, {1, 2, 7, 8, 16, 64, 255, 256}); }

TEST(WideTree, IsTrueForShapes) {
  expect_true_trees(scenes::uv_sphere(20, 20));
  expect_true_trees(scenes::torus_knot_of(968));
  expect_true_trees(scenes::box({-4, -2, -0.5}, {4, 2, 0.5}, 6));
  expect_true_trees(scenes::cube());
}

TEST(WideTree, IsTrueForSoups) {
  test::Seeded seeded(1);
  expect_true_trees(scenes::triangle_soup(seeded.random, 500, 0.1));
  expect_true_trees(scenes::integer_soup(seeded.random, 500, 2));
  expect_true_trees(scenes::degenerate_soup(seeded.random, 500, 2));
  expect_true_trees(scenes::sliver_soup(seeded.random, 300));
  expect_true_trees(scenes::sliver_soup(seeded.random, 300, 1e-300));
}

/// Large enough for frames and cuts to be chosen by a sample.
TEST(WideTree, IsTrueForSampledNodes) {
  test::Seeded seeded(2);
  expect_true_trees(scenes::torus_knot_of(9612));
  expect_true_trees(scenes::triangle_soup(seeded.random, 20000, 0.02));
  expect_true_trees(scenes::degenerate_soup(seeded.random, 20000, 100));
  expect_true_trees(scenes::sliver_soup(seeded.random, 5000));
}

TEST(WideTree, IsTrueForTrianglesInAPointOrOnALine) {
  scenes::MeshData points, one, line;
  const std::uint32_t v = one.add_vertex(1e6, 1e-6, 0.3);
  for (int i = 0; i < 3000; ++i) {
    points.add_triangle({0.1, 0.2, 0.3, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3});
    one.add_triangle(v, v, v);
    const double x = i * 0.001;
    line.add_triangle({x, 2 * x, -x, x + 0.001, 2 * x + 0.002, -x - 0.001, x, 2 * x, -x});
  }
  expect_true_trees(points);
  expect_true_trees(one);
  expect_true_trees(line);
  expect_true_trees(scenes::with_duplicates(scenes::cube(), 100));
}

TEST(WideTree, IsTrueFarFromTheOrigin) {
  test::Seeded seeded(3);
  for (const double offset : {1e6, 1e9, 1e15}) {
    SCOPED_TRACE(offset);
    expect_true_trees(scenes::shifted(scenes::triangle_soup(seeded.random, 200, 0.2), offset, -offset, offset / 3));
    expect_true_trees(scenes::shifted(scenes::triangle_soup(seeded.random, 200, 0.2), 0, offset, 0));
  }
}

TEST(WideTree, IsTrueAtEveryScale) {
  test::Seeded seeded(4);
  for (const double scale : {0x1p-1060, 0x1p-350, 0x1p-300, 0x1p-70, 0x1p70, 0x1p299, 0x1p900}) {
    SCOPED_TRACE(scale);
    expect_true_trees(scenes::scaled(scenes::triangle_soup(seeded.random, 100, 1), scale, scale, scale));
    expect_true_trees(scenes::scaled(scenes::triangle_soup(seeded.random, 100, 1), scale, scale * 0x1p-40, 0));
  }
  // A plane at 2^290 whose own extent is 2^-350.
  scenes::MeshData plane = scenes::scaled(scenes::flat_grid(5, 5), 0x1p-350, 0x1p-350, 1);
  expect_true_trees(scenes::shifted(std::move(plane), 0, 0, 0x1p290));
}

TEST(WideTree, IsTrueForExponentiallySpacedTriangles) {
  for (const double base : {2.0, 1.05}) {
    scenes::MeshData numbers;
    for (int i = base == 2 ? -350 : -700; i <= 290; ++i) {
      const double x = std::pow(base, i);
      numbers.add_triangle({x, 0, 0, x, x, 0, x, 0, x});
    }
    expect_true_trees(numbers);
  }
}

std::uint32_t depth_of(WideTree& tree, const TreeRef& ref) {
  if (ref.is_leaf()) return 0;
  hierarchy::MadeNodes made;
  std::uint32_t deepest = 0;
  for (std::uint32_t lane = 0; lane < ref.node().size; ++lane)
    deepest = std::max(deepest, depth_of(tree, tree.child(ref.node(), static_cast<int>(lane), made)));
  return deepest + 1;
}

/// Each node peels off the largest few, until cuts by count set in.
TEST(WideTree, IsOfBoundedDepth) {
  scenes::MeshData numbers;
  for (int i = 0; i < 48000; ++i) {
    const double x = 0x1p250 * std::pow(1.01, -i);
    numbers.add_triangle({x, 0, 0, x, x, 0, x, 0, x});
  }
  const Mesh mesh = test::mesh_of(numbers);
  WideTree tree(test::numbers_of(mesh), 1);
  hierarchy::MadeNodes made;
  const std::uint32_t depth = depth_of(tree, tree.root(made));
  EXPECT_GT(depth, 20u);
  EXPECT_LE(depth, 20u + 6u);  // 8^6 > 48000
}

TEST(WideTree, HasAUnitOfAboutTheExtent) {
  for (const double scale : {0x1p-350, 0x1.8p-70, 1.0, 0x1.fp70, 0x1p299}) {
    const Mesh mesh =
        test::mesh_of(scenes::shifted(scenes::scaled(scenes::cube(), scale, scale / 3, 0), scale * 1e6, 0, 0));
    const double extent = std::ldexp(scale, -WideTree(test::numbers_of(mesh), 16).unit_exponent());
    EXPECT_GE(extent, 0.5 - 1e-9) << scale;
    EXPECT_LT(extent, 1 + 1e-9) << scale;
  }
}

/// The sum over leaves of their box's surface, and the largest, in the mesh's unit.
struct Surface {
  double sum = 0, largest = 0;
};
Surface leaf_surface(WideTree& tree) {
  hierarchy::MadeNodes made;
  std::vector<TreeRef> open{tree.root(made)};
  Surface surface;
  while (!open.empty()) {
    const TreeRef next = open.back();
    open.pop_back();
    if (next.is_leaf()) {
      const float(&h)[3] = next.leaf().half;
      const double own =
          std::ldexp(8 * (double{h[0]} * h[1] + double{h[1]} * h[2] + double{h[2]} * h[0]), 2 * tree.unit_exponent());
      surface.sum += own;
      surface.largest = std::max(surface.largest, own);
    } else {
      for (std::uint32_t lane = 0; lane < next.node().size; ++lane)
        open.push_back(tree.child(next.node(), static_cast<int>(lane), made));
    }
  }
  return surface;
}

Surface leaf_surface(const Mesh& mesh) {
  WideTree tree(test::numbers_of(mesh), 16);
  return leaf_surface(tree);
}

/// All detail in a tiny part of the extent: single precision about the middle of it all would not tell it apart.
TEST(WideTree, IsTightBesideAFarOutlier) {
  scenes::MeshData knot = scenes::torus_knot_of(9612);
  const Surface alone = leaf_surface(test::mesh_of(knot));
  knot.add_triangle({3e7, 3e7, 3e7, 3e7, 3e7, 3e7, 3e7, 3e7, 3e7});
  knot.add_triangle({-5e7, 3e7, 0, -5e7, 3e7, 0, -5e7, 3e7, 0});
  EXPECT_LT(leaf_surface(test::mesh_of(knot)).sum, 1.1 * alone.sum);
  expect_true_tree(knot, {16});

  // Two clusters, so that no base is near both.
  scenes::MeshData two = scenes::torus_knot_of(9612);
  const scenes::MeshData far = scenes::shifted(two, 1e8, 1e7, 0);
  const auto offset = static_cast<std::uint32_t>(two.vertex_count());
  two.xyz.insert(two.xyz.end(), far.xyz.begin(), far.xyz.end());
  for (const std::uint32_t v : far.triangles) two.triangles.push_back(v + offset);
  EXPECT_LT(leaf_surface(test::mesh_of(two)).sum, 2.1 * alone.sum);
}

TEST(WideTree, IsTightAroundATurnedPlane) {
  test::Seeded seeded(5);
  const auto plane = scenes::baked(scenes::flat_grid(60, 60), scenes::random_motion(seeded.random, 100));
  const Surface surface = leaf_surface(test::mesh_of(plane));
  EXPECT_LT(surface.sum, 2 * 3600 * 1.2);  // both sides
}

TEST(WideTree, TakesLittleMemoryOnceItIsWhole) {
  for (const int triangles : {968, 9612, 40000}) {
    const Mesh mesh = test::mesh_of(scenes::torus_knot_of(triangles));
    WideTree tree(test::numbers_of(mesh), 16);
    tree.build([](std::size_t count, const auto& body) {
      for (std::size_t i = 0; i < count; ++i) body(i);
    });
    hierarchy::MadeNodes made;
    tree.root(made);
    EXPECT_EQ(made.nodes, 0u);
    EXPECT_LT(tree.bytes(), 80 * mesh.triangle_count() + 4096) << triangles;  // 4096: its arena's last block
  }
}

/// Runs body(0) .. body(n - 1) on a thread each.
template <class Body>
void on_threads(std::size_t n, const Body& body) {
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < n; ++i) threads.emplace_back([&, i] { body(i); });
  for (std::thread& thread : threads) thread.join();
}

/// Makes all in an order of its own.
void make_shuffled(WideTree& tree, std::uint64_t seed, hierarchy::MadeNodes& made) {
  scenes::Random random(seed);
  std::vector<TreeRef> open{tree.root(made)};
  while (!open.empty()) {
    std::swap(open.back(), open[static_cast<std::size_t>(random.integer(0, static_cast<int>(open.size()) - 1))]);
    const TreeRef next = open.back();
    open.pop_back();
    if (next.is_leaf()) continue;
    const int size = static_cast<int>(next.node().size), turn = random.integer(0, size - 1);
    for (int i = 0; i < size; ++i) open.push_back(tree.child(next.node(), (i + turn) % size, made));
  }
}

TEST(WideTree, IsTheSameHoweverItIsMade) {
  const Mesh mesh = test::mesh_of(scenes::torus_knot_of(9612));
  WideTree plain(test::numbers_of(mesh), 16);
  const std::string expected = test::bytes_of(plain);
  for (std::uint64_t round = 0; round < 5; ++round) {
    WideTree shared(test::numbers_of(mesh), 16);
    std::vector<hierarchy::MadeNodes> made(4);
    on_threads(4, [&](std::size_t i) { make_shuffled(shared, 4 * round + i, made[i]); });
    WideTree alone(test::numbers_of(mesh), 16);
    hierarchy::MadeNodes made_alone;
    make_shuffled(alone, 100 + round, made_alone);
    EXPECT_EQ(made[0].nodes + made[1].nodes + made[2].nodes + made[3].nodes, made_alone.nodes);
    ASSERT_TRUE(test::bytes_of(shared) == expected);
    ASSERT_TRUE(test::bytes_of(alone) == expected);
  }
}

/// Large enough for single splits to be shared by threads.
TEST(WideTree, IsTheSameWhenBuiltByThreads) {
  const Mesh mesh = test::mesh_of(scenes::bumpy_grid(300, 300));
  WideTree plain(test::numbers_of(mesh), 16);
  const std::string expected = test::bytes_of(plain);
  WideTree built(test::numbers_of(mesh), 16);
  built.build([](std::size_t count, const auto& body) {
    on_threads(4, [&](std::size_t thread) {
      for (std::size_t i = thread; i < count; i += 4) body(i);
    });
  });
  ASSERT_TRUE(test::bytes_of(built) == expected);
}

TEST(WideTree, IsTheSameOnEveryInstructionSet) {
  const Mesh mesh = test::mesh_of(scenes::torus_knot_of(9612));
  WideTree plain(test::numbers_of(mesh), 16);
  const std::string expected = test::bytes_of(plain);
  EXPECT_FALSE(test::instruction_sets().empty());
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    WideTree tree(test::numbers_of(mesh), 16);
    EXPECT_TRUE(test::bytes_of(tree) == expected);
  }
}

using Map = std::function<Vec3(const Vec3&)>;

scenes::MeshData deformed(scenes::MeshData mesh, const Map& map) {
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const Vec3 v = map({mesh.xyz[i], mesh.xyz[i + 1], mesh.xyz[i + 2]});
    mesh.xyz[i] = v.x, mesh.xyz[i + 1] = v.y, mesh.xyz[i + 2] = v.z;
  }
  return mesh;
}

/// From nothing at all to what leaves no two vertices near each other, flat, far away, tiny and huge.
std::vector<Map> deformations(scenes::Random& random) {
  const auto noise = [&random](double size) {
    return [&random, size](const Vec3& v) {
      return v + Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
  };
  const auto twist = [](const Vec3& v) {
    const double c = std::cos(2 * v.x), s = std::sin(2 * v.x);
    return Vec3{v.x, c * v.y - s * v.z, s * v.y + c * v.z};
  };
  return {[](const Vec3& v) { return v; },
          noise(0.01),
          noise(1),
          twist,
          [](const Vec3& v) {
            return Vec3{-v.x, v.y, v.z};
          },
          [](const Vec3& v) {
            return Vec3{v.x, v.y, 0};
          },
          [](const Vec3& v) {
            return Vec3{v.x, 2 * v.x, -v.x};
          },
          [](const Vec3&) {
            return Vec3{0.1, -3, 1e6};
          },
          [](const Vec3& v) {
            return Vec3{1e9 + v.x, v.y - 1e15, 0.5 * v.z};
          },
          [](const Vec3& v) {
            return Vec3{v.x, v.y, 0.1 * 0x1p290};
          },
          [](const Vec3& v) {
            return Vec3{-0.7 * 0x1p100, 0.3 * 0x1p200, v.z};
          },
          [](const Vec3& v) { return 0x1p-340 * v; },
          [](const Vec3& v) {
            return Vec3{0x1p290 * v.x, 0x1p-340 * v.y, v.z};
          },
          [](const Vec3& v) { return std::exp2(100 * v.x) * v; }};
}

TEST(RefittedTree, IsTrueHoweverTheMeshIsDeformed) {
  test::Seeded seeded(6);
  scenes::MeshData line;
  for (int i = 0; i < 300; ++i) line.add_triangle({i * 0.01, 0, 0, i * 0.01 + 0.01, 0, 0, i * 0.01, 0, 0});
  for (const scenes::MeshData& numbers :
       {scenes::torus_knot_of(968), scenes::cube(), scenes::triangle_soup(seeded.random, 300, 0.1),
        scenes::degenerate_soup(seeded.random, 300, 2), scenes::sliver_soup(seeded.random, 100), line,
        scenes::with_duplicates(scenes::cube(), 20)}) {
    const Mesh mesh = test::mesh_of(numbers);
    const std::vector<Map> maps = deformations(seeded.random);
    for (const std::uint32_t leaf_size : {1u, 7u, 16u, 256u})
      for (std::size_t i = 0; i < maps.size(); ++i) {
        SCOPED_TRACE("leaf size " + std::to_string(leaf_size) + ", deformation " + std::to_string(i));
        WideTree source(test::numbers_of(mesh), leaf_size);
        const Mesh once = test::mesh_of(deformed(numbers, maps[i])),
                   twice = test::mesh_of(deformed(deformed(numbers, maps[i]), maps[3]));
        WideTree refitted(test::numbers_of(once), leaf_size, source.plan()),
            again(test::numbers_of(twice), leaf_size, refitted.plan());
        hierarchy::MadeNodes made;
        ASSERT_NO_FATAL_FAILURE(Inspection(test::numbers_of(once), leaf_size, refitted).run_all(made));
        ASSERT_NO_FATAL_FAILURE(Inspection(test::numbers_of(twice), leaf_size, again).run_all(made));
        // By what has become of the first, which has a plan of its own where it was made anew.
        WideTree later(test::numbers_of(twice), leaf_size, refitted.plan());
        ASSERT_NO_FATAL_FAILURE(Inspection(test::numbers_of(twice), leaf_size, later).run_all(made));
      }
  }
}

TEST(RefittedTree, IsMadeAsWalksReachIt) {
  const Mesh mesh = test::mesh_of(scenes::torus_knot_of(9612));
  WideTree source(test::numbers_of(mesh), 16);
  EXPECT_EQ(source.plan(0.5), nullptr);
  WideTree refitted(test::numbers_of(mesh), 16, source.plan());
  EXPECT_EQ(refitted.plan(0.5), source.plan(0.5));
  hierarchy::MadeNodes made;
  const hierarchy::TreeRef root = refitted.root(made);
  EXPECT_EQ(made.nodes, 1u);
  (void)refitted.child(root.node(), 0, made);
  EXPECT_EQ(made.nodes, 2u);
}

/// Asked for all the time, so that it comes between the only leaf's counting and its place in the tree.
TEST(RefittedTree, HasThePlanOfATreeThatAnotherThreadMakes) {
  const Mesh mesh = test::mesh_of(scenes::cube());
  for (int round = 0; round < 500; ++round) {
    WideTree source(test::numbers_of(mesh), 16);
    std::thread maker([&] { source.build(); });
    std::shared_ptr<const hierarchy::RefitPlan> plan;
    while (!plan) plan = source.plan(1);
    maker.join();
    WideTree refitted(test::numbers_of(mesh), 16, plan);
    hierarchy::MadeNodes made;
    ASSERT_NO_FATAL_FAILURE(Inspection(test::numbers_of(mesh), 16, refitted).run_all(made));
  }
}

/// What only turns keeps its boxes; what has become loose is made anew, as if it were a new mesh.
TEST(RefittedTree, IsTight) {
  test::Seeded seeded(7);
  const scenes::MeshData knot = scenes::torus_knot_of(9612);
  const Mesh mesh = test::mesh_of(knot);
  const auto surfaces = [&](const scenes::MeshData& to) {
    WideTree source(test::numbers_of(mesh), 16);
    const Mesh moved = test::mesh_of(to);
    WideTree refitted(test::numbers_of(moved), 16, source.plan());
    return leaf_surface(refitted).sum / leaf_surface(moved).sum;
  };
  EXPECT_LT(surfaces(scenes::baked(knot, scenes::random_motion(seeded.random, 10))), 1.1);
  const std::vector<Map> maps = deformations(seeded.random);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(surfaces(deformed(knot, maps[i])), 2) << "deformation " << i;
}

TEST(RefittedTree, IsTheSameOnEveryInstructionSetAndByThreads) {
  const scenes::MeshData knot = scenes::torus_knot_of(9612);
  test::Seeded seeded(8);
  const Mesh mesh = test::mesh_of(knot), moved = test::mesh_of(deformed(knot, deformations(seeded.random)[3]));
  WideTree source(test::numbers_of(mesh), 16);
  WideTree plain(test::numbers_of(moved), 16, source.plan());
  const std::string expected = test::bytes_of(plain);
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    WideTree refitted(test::numbers_of(moved), 16, source.plan());
    EXPECT_TRUE(test::bytes_of(refitted) == expected);
  }
  WideTree shared(test::numbers_of(moved), 16, source.plan());
  shared.build([](std::size_t count, const auto& body) { on_threads(count, body); });
  EXPECT_TRUE(test::bytes_of(shared) == expected);
}

}  // namespace
}  // namespace impinge
