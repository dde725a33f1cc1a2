// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// A cloth falls onto a table and hangs down around it, and never passes through it or itself: not at the end of any
// step, and not in between. Each step moves vertices by their speed and keeps edges at their lengths (position based
// dynamics, Müller et al. 2007), asks `find_impacts` what would meet on the way, and takes from the vertices concerned
// what they approach each other by along the normal. `collision_free_step` then goes as far as nothing meets, which it
// is certain of whatever was left undone before.
//
// What depends on rounding is not derived: the middle of the cloth lies on the table if it is at most 2 cm above its
// top, z = 0, and its rim hangs if it is 10 cm below it.
//
// prints: # steps, # of them cut short, contacts in all of them: 0
// prints: the middle lies on the table, the rim hangs
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "impinge/collide.hpp"
#include "impinge/impacts.hpp"
#include "shapes.hpp"

namespace {

using impinge::Point;

constexpr int kCells = 8, kSteps = 90, kRounds = 4;
constexpr double kStep = 1.0 / 100, kGravity = 9.81, kSide = 0.8, kApart = 1e-4;

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

using Edge = std::array<std::uint32_t, 2>;

/// A cloth with wrinkles, 10 cm above the table.
impinge::Mesh make_cloth() {
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j)
      xyz.insert(xyz.end(), {kSide * i / kCells - 0.41, kSide * j / kCells - 0.39, 0.1 + 0.003 * (i * j % 5)});
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const auto at = [](int k, int l) { return static_cast<std::uint32_t>(k * (kCells + 1) + l); };
      triangles.insert(triangles.end(),
                       {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return value_of(impinge::Mesh::create(xyz, triangles));
}

impinge::Mesh deformed(const impinge::Mesh& mesh, std::span<const Point> points) {
  std::vector<double> xyz;
  for (const Point& p : points) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  return value_of(mesh.deformed(xyz));
}

/// Brings edges back to their lengths.
void keep_lengths(std::span<const Edge> edges, std::span<const double> lengths, std::span<Point> points) {
  for (int round = 0; round < 10; ++round)
    for (std::size_t e = 0; e < edges.size(); ++e) {
      Point &a = points[edges[e][0]], &b = points[edges[e][1]];
      const double now = std::sqrt(dot(b - a, b - a)), share = 0.5 * (1 - lengths[e] / now);
      const Point correction = share * (b - a);
      a = a + correction, b = b - correction;
    }
}

/// The vertices that an impact is about, on its first or its second side.
std::vector<std::uint32_t> vertices_of(const impinge::Mesh& mesh, const impinge::Impact& impact, bool first) {
  using impinge::Feature;
  const std::uint32_t index = first ? impact.a : impact.b;
  if (impact.feature == Feature::edge_edge) return {mesh.edges()[index][0], mesh.edges()[index][1]};
  if ((impact.feature == Feature::vertex_face) == first) return {index};
  return {mesh.triangles()[index].begin(), mesh.triangles()[index].end()};
}

/// Lets the vertices of an impact move on together along its normal, or those of the cloth stay where they are if the
/// other side is the table; and a little apart.
void respond(const impinge::Mesh& cloth, const impinge::Impact& impact, bool with_itself, std::span<Point> points) {
  const auto way = [&](std::uint32_t v) { return dot(points[v] - cloth.vertices()[v], impact.normal); };
  const auto mean = [&](std::span<const std::uint32_t> side) {
    double sum = 0;
    for (const std::uint32_t v : side) sum += way(v);
    return sum / static_cast<double>(side.size());
  };
  const auto first = vertices_of(cloth, impact, true);
  const auto second = with_itself ? vertices_of(cloth, impact, false) : std::vector<std::uint32_t>{};
  const double level = with_itself ? 0.5 * (mean(first) + mean(second)) : 0;
  for (const std::uint32_t v : first) points[v] = points[v] + std::max(0.0, level + kApart - way(v)) * impact.normal;
  for (const std::uint32_t v : second) points[v] = points[v] + std::min(0.0, level - kApart - way(v)) * impact.normal;
}

}  // namespace

int main() {
  const impinge::Mesh table = box({-0.2, -0.2, -0.05}, {0.2, 0.2, 0});
  impinge::Mesh cloth = make_cloth();
  const std::size_t count = cloth.vertex_count();
  const std::vector<Edge> edges(cloth.edges().begin(), cloth.edges().end());
  std::vector<double> lengths;
  for (const Edge& e : edges) {
    const Point way = cloth.vertices()[e[1]] - cloth.vertices()[e[0]];
    lengths.push_back(std::sqrt(dot(way, way)));
  }
  std::vector<Point> speeds(count, Point{0, 0, 0});
  int cut = 0;
  std::size_t contacts = 0;
  for (int step = 0; step < kSteps; ++step) {
    std::vector<Point> points(cloth.vertices().begin(), cloth.vertices().end());
    for (std::size_t v = 0; v < count; ++v)
      points[v] = points[v] + kStep * (0.98 * speeds[v] - Point{0, 0, kStep * kGravity});
    keep_lengths(edges, lengths, points);

    impinge::Moving motion{cloth, deformed(cloth, points)};
    for (int round = 0; round < kRounds; ++round) {
      const auto with_table = value_of(impinge::find_impacts(motion, {table, table}));
      const auto with_itself = value_of(impinge::find_impacts(motion));
      if (!with_table.earliest && !with_itself.earliest) break;
      for (const auto& impact : with_itself.impacts) respond(cloth, impact, true, points);
      for (const auto& impact : with_table.impacts) respond(cloth, impact, false, points);
      motion.to = deformed(cloth, points);
    }
    const std::array<impinge::Moving, 2> all{{motion, {table, table}}};
    impinge::Step done = value_of(impinge::collision_free_step(all));
    cut += done.time < 1 ? 1 : 0;
    const impinge::Mesh& end = done.ends[0];
    for (std::size_t v = 0; v < count; ++v) speeds[v] = 1 / kStep * (end.vertices()[v] - cloth.vertices()[v]);
    cloth = end;
    contacts += value_of(impinge::self_collide(cloth)).triangles.size();
    contacts += value_of(impinge::collide(cloth, {}, table, {})).triangles.size();
  }
  const double middle = cloth.vertices()[count / 2].z;
  const auto lower = [](const Point& a, const Point& b) { return a.z < b.z; };
  const double rim = std::min_element(cloth.vertices().begin(), cloth.vertices().end(), lower)->z;
  std::cout << kSteps << " steps, " << cut << " of them cut short, contacts in all of them: " << contacts << '\n'
            << "the middle " << (middle > 0 && middle < 0.02 ? "lies" : "does not lie") << " on the table, the rim "
            << (rim < -0.1 ? "hangs" : "does not hang") << '\n';
}
