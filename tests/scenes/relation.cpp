// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "tests/scenes/relation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge::test {
namespace {

/// How far two boxes are apart, along the axis where they are furthest.
double gap(const Box& a, const Box& b) { return max_component(max(a.lo - b.hi, b.lo - a.hi)); }

struct Solid {
  std::vector<Triangle> triangles;
  std::vector<Box> boxes;
  Box box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
  double orientation = 1;  ///< -1: normals look inwards
};

Solid solid_of(const scenes::MeshData& data, const Mesh& mesh, const Pose& pose) {
  Solid solid;
  solid.triangles = world_triangles(mesh, pose);
  for (const Triangle& t : solid.triangles) {
    solid.boxes.push_back(box_of(t));
    solid.box = {min(solid.box.lo, solid.boxes.back().lo), max(solid.box.hi, solid.boxes.back().hi)};
  }
  solid.orientation = volume(data) < 0 ? -1 : 1;
  return solid;
}

/// How often a solid winds around a point (van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983).
double winding(const Solid& solid, const Point& p) {
  double sum = 0;
  for (const Triangle& t : solid.triangles) {
    const Point a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

double segments_apart(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Point u = q - p, v = s - r, w = p - r;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w), det = uu * vv - uv * uv;
  double best = std::numeric_limits<double>::infinity();
  const auto at = [&](double x, double y) {
    x = std::clamp(x, 0.0, 1.0), y = std::clamp(y, 0.0, 1.0);
    best = std::min(best, norm(w + x * u - y * v));
  };
  if (det > 0) at((uv * vw - vv * uw) / det, (uu * vw - uv * uw) / det);
  for (const double x : {0.0, 1.0}) at(x, (vw + x * uv) / vv);
  for (const double y : {0.0, 1.0}) at((y * uv - uw) / uu, y);
  return best;
}

double above_triangle(const Point& p, const Triangle& t) {
  const Point n = cross(t[1] - t[0], t[2] - t[0]);
  for (int i = 0; i < 3; ++i)
    if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) < 0) return std::numeric_limits<double>::infinity();
  return std::fabs(dot(n, p - t[0])) / norm(n);
}

double triangles_apart(const Triangle& a, const Triangle& b) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    best = std::min({best, above_triangle(a[i], b), above_triangle(b[i], a)});
    for (int k = 0; k < 3; ++k) best = std::min(best, segments_apart(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return best;
}

double apart(const Solid& a, const Solid& b, double reach) {
  double best = reach;
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    if (gap(a.boxes[i], b.box) >= best) continue;
    for (std::size_t k = 0; k < b.triangles.size(); ++k)
      if (gap(a.boxes[i], b.boxes[k]) < best) best = std::min(best, triangles_apart(a.triangles[i], b.triangles[k]));
  }
  return best;
}

struct Sides {
  bool inside = false, outside = false;
};

/// On which sides of `other` points just below the surface of `solid` are.
Sides sides(const Solid& solid, const Solid& other) {
  constexpr double kBelow = 1.0 / 32, kTouch = 1.0 / 128;
  constexpr std::size_t kMostTriangles = 400;
  Sides found;
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
    if (gap(solid.boxes[i], other.box) > kBelow)
      found.outside = true;
    else
      near.push_back(i);
  }
  const std::size_t step = 1 + near.size() / kMostTriangles;
  for (std::size_t i = 0; i < near.size() && !(found.inside && found.outside); i += step) {
    const Triangle& t = solid.triangles[near[i]];
    const Point normal = cross(t[1] - t[0], t[2] - t[0]);
    const Point down = (-kBelow * solid.orientation / norm(normal)) * normal;
    for (const auto& [u, v, w] : {Point{0.34, 0.33, 0.33}, {0.8, 0.1, 0.1}, {0.1, 0.8, 0.1}, {0.1, 0.1, 0.8}}) {
      const Point p = u * t[0] + v * t[1] + w * t[2] + down;
      const double turns = std::fabs(winding(other, p));
      bool is_on = false;
      for (std::size_t k = 0; k < other.triangles.size() && !is_on; ++k)
        is_on = gap(Box{p, p}, other.boxes[k]) < kTouch && triangles_apart({p, p, p}, other.triangles[k]) < kTouch;
      if (is_on) continue;
      (turns > 0.5 ? found.inside : found.outside) = true;
    }
  }
  return found;
}

}  // namespace

double volume(const scenes::MeshData& mesh) {
  double sum = 0;
  const auto at = [&](std::size_t i) {
    const double* const p = &mesh.xyz[3 * mesh.triangles[i]];
    return Point{p[0], p[1], p[2]};
  };
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) sum += dot(at(i), cross(at(i + 1), at(i + 2))) / 6;
  return sum;
}

Relation relation(const scenes::MeshData& data_a, const Pose& pose_a, const scenes::MeshData& data_b,
                  const Pose& pose_b, double reach) {
  const Mesh mesh_a = mesh_of(data_a), mesh_b = mesh_of(data_b);
  const Solid a = solid_of(data_a, mesh_a, pose_a), b = solid_of(data_b, mesh_b, pose_b);
  if (gap(a.box, b.box) > reach) return {Verdict::apart, -1, reach};
  const Contacts contacts = collide(mesh_a, pose_a, mesh_b, pose_b).value();
  const bool is_crossing =
      std::find(contacts.kinds.begin(), contacts.kinds.end(), Kind::crossing) != contacts.kinds.end();
  const bool is_contact = !contacts.kinds.empty();
  const Sides of_a = sides(a, b), of_b = sides(b, a);
  if (is_crossing || of_a.inside || of_b.inside) {
    if (is_crossing || (of_a.outside && of_b.outside)) return {Verdict::penetrating};
    if (!of_a.outside && !of_b.outside) return {Verdict::duplicate};
    return {Verdict::inside, of_a.outside ? 1 : 0};
  }
  return is_contact ? Relation{Verdict::touching} : Relation{Verdict::apart, -1, apart(a, b, reach)};
}

}  // namespace impinge::test
