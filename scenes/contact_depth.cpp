// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/contact_depth.hpp"

#include <cmath>
#include <numbers>

#include "impinge/collide.hpp"
#include "scenes/motion.hpp"

namespace impinge::scenes {
namespace {

struct Approach {
  Pose a, b;                        // sphere centres on the origin
  std::array<double, 3> direction;  // unit
};

Pose centered(Random& random, const Mesh& mesh) {
  Pose pose;
  pose.R = random_rotation(random);
  const Point center = world_vertex(pose, mesh.sphere_center());
  pose.t = {-center.x, -center.y, -center.z};
  return pose;
}

Approach random_approach(Random& random, const Mesh& a, const Mesh& b) {
  Approach approach;
  approach.a = centered(random, a);
  approach.b = centered(random, b);
  const auto axes = random_rotation(random);
  approach.direction = {axes[0], axes[3], axes[6]};
  return approach;
}

Pose moved_along(const Approach& approach, double distance) {
  Pose pose = approach.b;
  for (std::size_t k = 0; k < 3; ++k) {
    pose.t[k] += distance * approach.direction[k];
  }
  return pose;
}

/// By Rodrigues' formula; `axis` has length 1.
std::array<double, 9> rotation(const std::array<double, 3>& axis, double angle) {
  const auto [x, y, z] = axis;
  const double c = std::cos(angle), s = std::sin(angle), d = 1 - c;
  return {c + x * x * d,     x * y * d - z * s, x * z * d + y * s, y * x * d + z * s, c + y * y * d,
          y * z * d - x * s, z * x * d - y * s, z * y * d + x * s, c + z * z * d};
}

/// Turned, and moved so that the sphere's centre comes to stand at `center`.
Pose turned_about_center(const Mesh& mesh, const std::array<double, 9>& turn, const Point& center) {
  Pose pose{.R = turn};
  const Point c = world_vertex(pose, mesh.sphere_center());
  pose.t = {center.x - c.x, center.y - c.y, center.z - c.z};
  return pose;
}

}  // namespace

Result<PosePair> near_first_touch(Random& random, const Mesh& a, const Mesh& b, double depth) {
  const Approach approach = random_approach(random, a, b);
  double apart = 1.01 * (a.sphere_radius() + b.sphere_radius());
  double touching = 0;
  for (int step = 0; step < 12; ++step) {
    const double middle = (apart + touching) / 2;
    const auto contacts = collide(a, approach.a, b, moved_along(approach, middle), {.find = Options::Find::first});
    if (!contacts) {
      return contacts.error();
    }
    (contacts->triangles.empty() ? apart : touching) = middle;
  }
  return PosePair{approach.a, moved_along(approach, apart - depth * 2 * a.sphere_radius())};
}

Result<PosePair> with_contacts(Random& random, const Mesh& a, const Mesh& b, std::size_t contacts) {
  const Approach approach = random_approach(random, a, b);
  const auto off = [contacts](std::size_t found) {
    return std::fabs(static_cast<double>(found) / static_cast<double>(contacts) - 1);
  };
  double apart = 1.01 * (a.sphere_radius() + b.sphere_radius());
  double touching = 0;
  PosePair best{approach.a, moved_along(approach, apart)};
  double best_off = off(0);
  for (int step = 0; step < 40 && best_off > 0.1; ++step) {
    const double middle = (apart + touching) / 2;
    const PosePair poses{approach.a, moved_along(approach, middle)};
    const auto found = collide(a, poses.a, b, poses.b);
    if (!found) {
      return found.error();
    }
    const std::size_t n = found->triangles.size();
    if (off(n) < best_off) {
      best = poses;
      best_off = off(n);
    }
    (n < contacts ? apart : touching) = middle;
  }
  return best;
}

PosePair centers_apart(Random& random, const Mesh& a, const Mesh& b, double distance) {
  const Approach approach = random_approach(random, a, b);
  return {approach.a, moved_along(approach, distance * 2 * a.sphere_radius())};
}

std::vector<PosePair> small_steps(const Mesh& mesh, int steps) {
  constexpr double kTurn = 0.4 * std::numbers::pi / 180, kMove = 0.0014;
  const double diameter = 2 * mesh.sphere_radius();
  std::vector<PosePair> poses;
  for (int i = 0; i < steps; ++i) {
    const double x = (i - steps / 2) * kMove * diameter;
    poses.push_back({turned_about_center(mesh, rotation({0.6, 0.8, 0}, kTurn * i), {0, 0, 0}),
                     turned_about_center(mesh, rotation({0, -0.6, 0.8}, kTurn * i), {x, 0.05 * diameter, 0})});
  }
  return poses;
}

}  // namespace impinge::scenes
