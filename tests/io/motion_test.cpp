// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Where nodes are at a time, against the formulas of glTF 2.0, appendix C, written out anew.
#include <cmath>
#include <numbers>
#include <random>

#include "support.hpp"

namespace impinge::io {
namespace {

constexpr double kPi = std::numbers::pi;
using Vector = std::array<double, 3>;
using Quaternion = std::array<double, 4>;

/// v turned by q: q v q* with Hamilton's products, one after the other.
Vector turned(const Quaternion& q, const Vector& v) {
  const auto times = [](const Quaternion& a, const Quaternion& b) {
    const auto [ax, ay, az, aw] = a;
    const auto [bx, by, bz, bw] = b;
    return Quaternion{aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
                      aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz};
  };
  const Quaternion out = times(times(q, {v[0], v[1], v[2], 0}), {-q[0], -q[1], -q[2], q[3]});
  return {out[0], out[1], out[2]};
}

Vector mapped(const Affine& map, const Vector& v) {
  Vector out = map.t;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k) out[row] += map.m[3 * row + k] * v[k];
  return out;
}

void expect_near(const Vector& found, const Vector& expected, double most, const std::string& where) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], most) << where << ", coordinate " << k;
}

Quaternion about_z(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

Model one_node() {
  Model model;
  model.nodes.emplace_back();
  return model;
}

Animation moving(Track track) {
  const double end = track.times.back();
  return {"", end, {std::move(track)}};
}

TEST(Motion, StepsHoldTheKeyBefore) {
  const Animation animation =
      moving({0, Track::Property::translation, Track::Between::step, {1, 2, 4}, {1, 0, 0, 2, 5, 0, 3, 0, 7}});
  const auto at = [&](double t) { return nodes_at(one_node(), animation, t).at(0).t; };
  EXPECT_EQ(at(-1), (Vector{1, 0, 0}));
  EXPECT_EQ(at(1), (Vector{1, 0, 0}));
  EXPECT_EQ(at(std::nextafter(2, 0)), (Vector{1, 0, 0}));
  EXPECT_EQ(at(2), (Vector{2, 5, 0}));
  EXPECT_EQ(at(3.999), (Vector{2, 5, 0}));
  EXPECT_EQ(at(4), (Vector{3, 0, 7}));
  EXPECT_EQ(at(100), (Vector{3, 0, 7}));
}

TEST(Motion, LinesRunEvenly) {
  const Animation animation =
      moving({0, Track::Property::scale, Track::Between::linear, {1, 2, 4}, {1, 1, 1, 3, 1, 1, 3, 2, 9}});
  const auto at = [&](double t) { return mapped(nodes_at(one_node(), animation, t).at(0), {1, 1, 1}); };
  EXPECT_EQ(at(0), (Vector{1, 1, 1}));
  EXPECT_EQ(at(1.25), (Vector{1.5, 1, 1}));
  EXPECT_EQ(at(2), (Vector{3, 1, 1}));
  EXPECT_EQ(at(2.5), (Vector{3, 1.25, 3}));
  EXPECT_EQ(at(9), (Vector{3, 2, 9}));
}

TEST(Motion, KeysAtOneTimeJumpThere) {
  const Animation animation = moving(
      {0, Track::Property::translation, Track::Between::linear, {0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}});
  EXPECT_EQ(nodes_at(one_node(), animation, 0.5)[0].t[0], 0.5);
  EXPECT_EQ(nodes_at(one_node(), animation, 1)[0].t[0], 5);
  EXPECT_EQ(nodes_at(one_node(), animation, 1.5)[0].t[0], 5.5);
}

/// About one axis the way between two rotations is that of the angle.
TEST(Motion, RotationsTakeTheShorterWay) {
  for (const double from : {0.0, 0.3, 3.0, -2.0}) {
    for (const double by : {1e-9, 0.1, 1.0, 3.1, -0.5, -3.1})
      for (const double sign : {1.0, -1.0}) {  // a quaternion and its negative are the same rotation
        const Quaternion a = about_z(from);
        Quaternion b = about_z(from + by);
        for (double& c : b) c *= sign;
        const Animation animation = moving({0,
                                            Track::Property::rotation,
                                            Track::Between::linear,
                                            {0, 2},
                                            {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]}});
        for (const double t : {0.0, 0.4, 1.0, 1.9, 2.0}) {
          const double angle = from + by * t / 2;
          expect_near(mapped(nodes_at(one_node(), animation, t)[0], {1, 0, 2}), {std::cos(angle), std::sin(angle), 2},
                      1e-12, std::to_string(from) + " by " + std::to_string(by) + " at " + std::to_string(t));
        }
      }
  }
}

/// The cubic Hermite spline in its other form, by de Casteljau's algorithm on Bezier's control points.
double spline(double a, double out_tangent, double b, double in_tangent, double u, double seconds) {
  std::array<double, 4> p{a, a + seconds * out_tangent / 3, b - seconds * in_tangent / 3, b};
  for (std::size_t left = 3; left > 0; --left)
    for (std::size_t i = 0; i < left; ++i) p[i] += u * (p[i + 1] - p[i]);
  return p[0];
}

TEST(Motion, SplinesGoThroughTheirKeysWithTheirTangents) {
  const unsigned seed = 5;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };
  for (const bool is_rotation : {false, true}) {
    const std::size_t n = is_rotation ? 4 : 3, keys = 5;
    Track track{0,
                is_rotation ? Track::Property::rotation : Track::Property::translation,
                Track::Between::cubic,
                {0.5, 1, 3, 3.25, 7},
                {}};
    for (std::size_t i = 0; i < keys * 3 * n; ++i) track.values.push_back(number());
    const Animation animation = moving(track);
    for (double t = 0.5; t < 7; t += 0.0625) {
      std::size_t key = 0;
      while (key + 2 < keys && track.times[key + 1] <= t) ++key;
      const double seconds = track.times[key + 1] - track.times[key], u = (t - track.times[key]) / seconds;
      std::vector<double> expected;
      for (std::size_t k = 0; k < n; ++k) {
        const auto part = [&](std::size_t which, std::size_t of) { return track.values[(3 * of + which) * n + k]; };
        expected.push_back(spline(part(1, key), part(2, key), part(1, key + 1), part(0, key + 1), u, seconds));
      }
      const Affine found = nodes_at(one_node(), animation, t)[0];
      if (!is_rotation) {
        expect_near(found.t, {expected[0], expected[1], expected[2]}, 1e-12, std::to_string(t));
        continue;
      }
      Quaternion q{expected[0], expected[1], expected[2], expected[3]};
      const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
      for (double& c : q) c /= length;
      expect_near(mapped(found, {1, 2, 3}), turned(q, {1, 2, 3}), 1e-12, std::to_string(t));
    }
  }
}

TEST(Motion, ChildrenGoWithTheirParents) {
  Model model;
  model.nodes.push_back({std::nullopt, {{0, -1, 0, 1, 0, 0, 0, 0, 1}, {10, 0, 0}}});  // still: a quarter turn
  model.nodes.push_back({0, {{9, 9, 9, 9, 9, 9, 9, 9, 9}, {}}, {2, 1, 1}, about_z(kPi / 2), {1, 2, 3}});
  model.nodes.push_back({1, {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 5}}});
  const Animation animation =
      moving({1, Track::Property::translation, Track::Between::linear, {0, 1}, {1, 2, 3, 5, 2, 3}});
  const std::vector<Affine> worlds = nodes_at(model, animation, 0.5);
  ASSERT_EQ(worlds.size(), 3u);
  // (1, 1, 0) of the last: up to (1, 1, 5), scaled (2, 1, 5), turned (-1, 2, 5), moved (2, 4, 8), turned, moved.
  expect_near(mapped(worlds[2], {1, 1, 0}), {10 - 4, 2, 8}, 1e-14, "the last");
  // Without a track a node is where its matrix says, whatever its parts say.
  EXPECT_EQ(nodes_at(model, {}, 0)[1].m[8], 9);
}

TEST(Motion, ARotationOfNoLengthTurnsNothing) {
  const Animation animation =
      moving({0, Track::Property::rotation, Track::Between::linear, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 0}});
  EXPECT_EQ(nodes_at(one_node(), animation, 0.5)[0].m, (Affine{}.m));
}

}  // namespace
}  // namespace impinge::io
