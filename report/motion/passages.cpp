// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/passages.hpp"

#include <algorithm>
#include <cmath>

#include "impinge/sweeps.hpp"

namespace impinge::report {
namespace {

/// A box around a part's sphere on its way.
struct Swept {
  std::uint32_t object;
  std::array<double, 3> lo, hi;
};

/// A screw of at most half a turn leaves the straight line between the sphere's two places by at most half of its
/// length.
Swept sweep_of(std::uint32_t object, const Posed& from, const Posed& to) {
  const Point center = from.mesh.sphere_center();
  const Point p = world_vertex(from.pose, center), q = world_vertex(to.pose, center);
  const double way = std::hypot(q.x - p.x, q.y - p.y, q.z - p.z);
  const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), way});
  const double around = from.mesh.sphere_radius() + way / 2 + 1e-6 * (from.mesh.sphere_radius() + size);
  Swept swept{object, {p.x, p.y, p.z}, {p.x, p.y, p.z}};
  const std::array<double, 3> end{q.x, q.y, q.z};
  for (std::size_t k = 0; k < 3; ++k) {
    swept.lo[k] = std::min(swept.lo[k], end[k]) - around;
    swept.hi[k] = std::max(swept.hi[k], end[k]) + around;
  }
  return swept;
}

bool may_meet(const Swept& a, const Swept& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]) return false;
  return true;
}

}  // namespace

Result<std::vector<Passage>> passages_between(const std::vector<Posed>& from, const std::vector<Posed>& to,
                                              std::span<const std::uint32_t> bodies, const PassageOptions& options) {
  std::vector<Swept> swept;
  for (std::uint32_t i = 0; i < from.size(); ++i)
    if (&from[i].mesh.state() == &to[i].mesh.state() && from[i].mesh.triangle_count() > 0)
      swept.push_back(sweep_of(i, from[i], to[i]));
  std::ranges::sort(swept, {}, [](const Swept& each) { return each.lo[0]; });
  std::vector<Passage> passages;
  Workspace workspace;
  for (std::size_t k = 0; k < swept.size(); ++k) {
    for (std::size_t l = k + 1; l < swept.size() && swept[l].lo[0] <= swept[k].hi[0]; ++l) {
      const std::uint32_t i = std::min(swept[k].object, swept[l].object),
                          j = std::max(swept[k].object, swept[l].object);
      if (bodies[i] == bodies[j] || !may_meet(swept[k], swept[l]) || options.skip({i, j})) continue;
      const double a = from[i].mesh.sphere_radius(), b = from[j].mesh.sphere_radius();
      const double near = std::max({0x1p-20 * (a + b), 0x1p-10 * std::min(a, b), options.tolerance});
      if (!(near > 0)) continue;
      const auto meet = [&](const std::vector<Posed>& start, const std::vector<Posed>& end) {
        return time_of_impact(from[i].mesh, {start[i].pose, end[i].pose}, from[j].mesh, {start[j].pose, end[j].pose},
                              near, options.measure, &workspace);
      };
      const auto first = meet(from, to);
      if (!first && first.error().code == Code::out_of_range) continue;
      if (!first) return first.error();
      if (!*first) continue;
      const auto last = meet(to, from);
      if (!last && last.error().code == Code::out_of_range) continue;
      if (!last) return last.error();
      passages.push_back({{i, j}, (*first)->time.lo, *last ? 1 - (*last)->time.lo : 1});
    }
  }
  std::ranges::sort(passages, {}, &Passage::objects);
  return passages;
}

}  // namespace impinge::report
