// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// 300 cubes fall onto a floor and come to rest: contacts from `Scene::collide`, what a solver needs of them from
// `ContactManifolds`, and the solver itself, sequential impulses (Catto, "Iterative dynamics with temporal coherence",
// 2005): each point of each manifold in turn gets the impulse that ends its approach, and friction within Coulomb's
// cone.
//
// What depends on rounding is not derived. Settled means: nine of ten move slower than 5 cm and half a radian a second,
// and no contact is deeper than an eighth of an edge.
//
// prints: step 50: # manifolds, # points
// prints: ...
// prints: step 400: # manifolds, # points
// prints: # of 300 cubes rest, the deepest contact is # thousandths of an edge deep: the pile has settled
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "impinge/manifolds.hpp"
#include "impinge/scene.hpp"
#include "shapes.hpp"

namespace {

using impinge::Point;

constexpr int kCubes = 300, kSteps = 400, kRounds = 12;
constexpr double kStep = 1.0 / 100, kGravity = 9.81, kFriction = 0.6, kDamping = 0.99, kEdge = 0.2;
constexpr double kInertia = kEdge * kEdge / 6;  // of a cube of mass 1, about any axis

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double s, Point a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Point a) { return std::sqrt(dot(a, a)); }

struct Body {
  Point position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
  std::array<double, 4> turn{1, 0, 0, 0};  // w, x, y, z
  double inverse_mass = 0;                 // 0: the floor

  [[nodiscard]] Point velocity_at(Point p) const { return velocity + cross(spin, p - position); }
  void push(Point impulse, Point at) {
    velocity = velocity + inverse_mass * impulse;
    spin = spin + (inverse_mass / kInertia) * cross(at - position, impulse);
  }
  /// What a unit of impulse along a direction changes of the speed along it.
  [[nodiscard]] double yields(Point at, Point direction) const {
    const Point arm = cross(at - position, direction);
    return inverse_mass * (1 + dot(arm, arm) / kInertia);
  }
  void move() {
    position = position + kStep * velocity;
    const auto [w, x, y, z] = turn;
    const Point v{x, y, z}, change = (kStep / 2) * (w * spin + cross(spin, v));
    turn = {w - kStep / 2 * dot(spin, v), x + change.x, y + change.y, z + change.z};
    const double norm = std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
    for (double& q : turn) q /= norm;
  }
};

struct Contact {
  Body *a, *b;
  Point at, normal, across[2];
  double approach, mass, across_mass[2], pushed = 0, rubbed[2] = {0, 0};

  Contact(Body& first, Body& second, const impinge::Manifold& manifold, const impinge::ManifoldPoint& point)
      : a(&first), b(&second), at(0.5 * (point.a + point.b)), normal(manifold.normal) {
    const Point other = std::abs(normal.x) < 0.5 ? Point{1, 0, 0} : Point{0, 1, 0}, side = cross(normal, other);
    across[0] = (1 / length(side)) * side;
    across[1] = cross(normal, across[0]);
    mass = 1 / (a->yields(at, normal) + b->yields(at, normal));
    for (int i : {0, 1}) across_mass[i] = 1 / (a->yields(at, across[i]) + b->yields(at, across[i]));
    // A fifth of what lies deeper than a hundredth of an edge is undone in this step.
    approach = 0.2 / kStep * std::max(0.0, point.depth - 0.01 * kEdge);
  }
  void push(double impulse, Point along) {
    a->push(-impulse * along, at);
    b->push(impulse * along, at);
  }
  void solve() {
    const auto speed = [&](Point along) { return dot(b->velocity_at(at) - a->velocity_at(at), along); };
    const double before = pushed;
    pushed = std::max(0.0, before + mass * (approach - speed(normal)));
    push(pushed - before, normal);
    for (int i : {0, 1}) {
      const double was = rubbed[i], most = kFriction * pushed;
      rubbed[i] = std::clamp(was - across_mass[i] * speed(across[i]), -most, most);
      push(rubbed[i] - was, across[i]);
    }
  }
};

}  // namespace

int main() {
  const double half = kEdge / 2;
  const impinge::Mesh cube = box({-half, -half, -half}, {half, half, half}), floor = box({-4, -4, -1}, {4, 4, 0});
  impinge::Scene scene;
  std::vector<Body> bodies(1 + kCubes);
  std::vector<impinge::ObjectId> ids{value_of(scene.add(floor))};
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random() % 2001) / 1000 - 1; };  // -1 to 1
  for (int i = 0; i < kCubes; ++i) {
    Body& body = bodies[1 + i];
    body.inverse_mass = 1;
    body.position = {0.36 * (i % 8 - 4) + 0.01 * uniform(), 0.36 * (i / 8 % 8 - 4) + 0.01 * uniform(),
                     0.2 + 0.36 * (i / 64)};
    body.turn = {1, uniform(), uniform(), uniform()};
    ids.push_back(value_of(scene.add(cube)));
  }
  std::vector<impinge::Pose> poses(ids.size());
  impinge::ContactManifolds manifolds;
  double deepest = 0;
  for (int step = 1; step <= kSteps; ++step) {
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const auto& [w, x, y, z] = bodies[i].turn;
      const Point& at = bodies[i].position;
      poses[i] = value_of(impinge::Pose::from_quaternion({w, x, y, z}, {at.x, at.y, at.z}));
    }
    value_of(scene.set_poses(ids, poses));
    value_of(scene.update());
    const auto found = value_of(manifolds.update(scene, value_of(scene.collide())));

    std::vector<Contact> points;
    deepest = 0;
    for (const impinge::Manifold& manifold : found) {
      deepest = std::max(deepest, manifold.depth);
      if (length(manifold.normal) == 0) continue;
      for (std::uint32_t i = 0; i < manifold.size; ++i)
        points.emplace_back(bodies[manifold.objects[0]], bodies[manifold.objects[1]], manifold, manifold.points[i]);
    }
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      bodies[i].velocity = kDamping * bodies[i].velocity - Point{0, 0, kStep * kGravity};
      bodies[i].spin = kDamping * bodies[i].spin;
    }
    for (int round = 0; round < kRounds; ++round)
      for (Contact& point : points) point.solve();
    for (std::size_t i = 1; i < bodies.size(); ++i) bodies[i].move();
    if (step % 50 == 0)
      std::cout << "step " << step << ": " << found.size() << " manifolds, " << points.size() << " points\n";
  }
  const auto resting = std::count_if(bodies.begin() + 1, bodies.end(), [](const Body& body) {
    return length(body.velocity) < 0.05 && length(body.spin) < 0.5 && body.position.z > 0;
  });
  const bool has_settled = resting >= kCubes * 9 / 10 && deepest < kEdge / 8;
  std::cout << resting << " of " << kCubes << " cubes rest, the deepest contact is "
            << std::lround(1000 * deepest / kEdge)
            << " thousandths of an edge deep: " << (has_settled ? "the pile has settled" : "it has not settled")
            << '\n';
}
