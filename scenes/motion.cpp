// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/motion.hpp"

#include <algorithm>
#include <cmath>

namespace impinge::scenes {
namespace {

std::array<double, 9> product(const std::array<double, 9>& a, const std::array<double, 9>& b) {
  std::array<double, 9> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[3 * i + j] = (a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j]) + a[3 * i + 2] * b[6 + j];
    }
  }
  return c;
}

std::array<double, 3> map_point(const Pose& pose, double x, double y, double z) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = ((pose.R[3 * i] * x + pose.R[3 * i + 1] * y) + pose.R[3 * i + 2] * z) + pose.t[i];
  }
  return result;
}

bool is_identity(const Pose& pose) { return pose.R == Pose{}.R && pose.t == Pose{}.t; }

}  // namespace

std::array<double, 9> random_rotation(Random& random) {
  // A point of the ball, pushed out to the sphere of unit quaternions: needs nothing that rounds differently elsewhere.
  double w = 0, x = 0, y = 0, z = 0, norm = 0;
  do {
    w = random.uniform(-1, 1);
    x = random.uniform(-1, 1);
    y = random.uniform(-1, 1);
    z = random.uniform(-1, 1);
    norm = w * w + x * x + y * y + z * z;
  } while (norm > 1 || norm < 0.01);
  const double length = std::sqrt(norm);
  w /= length;
  x /= length;
  y /= length;
  z /= length;
  return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
          2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
          2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
}

Pose random_motion(Random& random, double reach) {
  Pose pose;
  pose.R = random_rotation(random);
  for (double& t : pose.t) {
    t = random.uniform(-reach, reach);
  }
  return pose;
}

std::array<double, 9> stretched_rotation(Random& random, double off) {
  // R (I + S) with S symmetric and small: RᵀR - I becomes 2 S + S^2.
  std::array<double, 6> s{};
  double largest = 0;
  for (double& x : s) {
    x = random.uniform(-1, 1);
    largest = std::max(largest, std::fabs(x));
  }
  for (double& x : s) {
    x *= off / 2 / largest;
  }
  return product(random_rotation(random), {1 + s[0], s[1], s[2], s[1], 1 + s[3], s[4], s[2], s[4], 1 + s[5]});
}

PlacedScene moved(PlacedScene scene, const Pose& motion) {
  for (PlacedObject& object : scene.objects) {
    if (is_identity(object.pose)) {
      object.pose = motion;
    } else {
      object.pose.t = map_point(motion, object.pose.t[0], object.pose.t[1], object.pose.t[2]);
      object.pose.R = object.pose.R == Pose{}.R ? motion.R : product(motion.R, object.pose.R);
    }
  }
  return scene;
}

MeshData baked(const MeshData& mesh, const Pose& pose) {
  MeshData result = mesh;
  for (std::size_t i = 0; i < mesh.xyz.size(); i += 3) {
    const auto world = map_point(pose, mesh.xyz[i], mesh.xyz[i + 1], mesh.xyz[i + 2]);
    std::copy(world.begin(), world.end(), result.xyz.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return result;
}

PlacedScene baked(const PlacedScene& scene) {
  PlacedScene result;
  for (const PlacedObject& object : scene.objects) {
    const auto mesh = static_cast<std::uint32_t>(result.meshes.size());
    result.objects.push_back({.mesh = mesh, .group = object.group});
    result.meshes.push_back(baked(scene.meshes[object.mesh], object.pose));
  }
  return result;
}

}  // namespace impinge::scenes
