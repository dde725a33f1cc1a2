// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/cells_within.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "clash/slab.hpp"
#include "clash/triangle_locator.hpp"
#include "core/local_frame.hpp"

namespace impinge::clash {
namespace {

using solid::kInside;
using solid::kOutside;

bool has_inner_shells(const solid::Part& part) {
  return std::any_of(part.sides.begin(), part.sides.end(), [](const auto& side) { return side.front == side.back; });
}

/// The triangles of one part that are near the other.
struct NearSide {
  const std::vector<std::uint32_t>& triangles;  ///< sorted
  std::vector<TrianglePair> pairs;              ///< own triangle first, sorted, without pairs of two small triangles
  const LeftOut& left_out;
};

/// Locates the boundary of one part in the other.
class OneSide {
 public:
  OneSide(const solid::Part& own, const solid::Part& other, const LocatorSettings& space, NearSide near)
      : own_(own), other_(other), space_(space), near_(std::move(near)) {}

  /// The bits of triangles that are not near the other part: by a vertex of each shell without near triangles, and by
  /// the vertices at which near triangles adjoin others.
  std::uint8_t look_at_clear() {
    std::vector<bool> is_met(own_.topology.shells, false);
    std::uint32_t unmet = own_.topology.shells;
    const auto meet = [&](std::uint32_t t) {
      const std::uint32_t shell = shell_of(t);
      const bool is_first = shell != solid::Topology::kNoShell && !is_met[shell];
      if (is_first) is_met[shell] = true, --unmet;
      return is_first;
    };
    for (const std::uint32_t t : near_.triangles) meet(t);
    std::uint8_t bits = 0;
    const auto& triangles = own_.body.placed.mesh->triangles;
    for (std::uint32_t t = 0; unmet > 0 && t < triangles.size(); ++t)
      if (meet(t)) bits |= locate(other_, own_.body.world[triangles[t][0]]);
    for (std::uint32_t t = 0; has_degenerate_cells() && t < triangles.size(); ++t)
      if (shell_of(t) == solid::Topology::kNoShell && !is_near(t))
        bits |= locate(other_, own_.body.world[triangles[t][0]]);
    return bits | look_at_rims();
  }

  /// The bits of the near triangles, which are cut into pieces. Passes those of each triangle to `so_far`, until it
  /// returns true. False if some triangle could not be located.
  template <class SoFar>
  bool look_at_near(const SoFar& so_far) {
    TriangleLocator near(other_, space_);
    std::size_t first = 0;
    for (const std::uint32_t t : near_.triangles) {
      std::size_t last = first;
      while (last < near_.pairs.size() && near_.pairs[last].a == t) ++last;
      const auto pairs = std::span(near_.pairs).subspan(first, last - first);
      first = last;
      if (!counts(t)) continue;
      const auto& left_out = near_.left_out;
      const auto bits =
          near.look_at(own_.body.triangle(t), pairs, {left_out.at(t, 0), left_out.at(t, 1), left_out.at(t, 2)});
      if (!bits) return false;
      if (so_far(*bits)) return true;
    }
    return true;
  }

 private:
  [[nodiscard]] std::uint32_t shell_of(std::uint32_t triangle) const { return own_.topology.shell[triangle]; }
  /// Degenerate triangles are segments or points: they are no part of a solid's boundary, but of a surface.
  [[nodiscard]] bool has_degenerate_cells() const { return !own_.solid && own_.topology.degenerate > 0; }
  [[nodiscard]] bool counts(std::uint32_t triangle) const {
    return !own_.solid || shell_of(triangle) != solid::Topology::kNoShell;
  }
  [[nodiscard]] bool is_near(std::uint32_t triangle) const {
    return std::binary_search(near_.triangles.begin(), near_.triangles.end(), triangle);
  }

  std::uint8_t look_at_rims() const {
    std::vector<std::uint32_t> rim;
    const auto& triangles = own_.body.placed.mesh->triangles;
    const auto& position = own_.topology.position;
    for (const std::uint32_t t : near_.triangles)
      for (const std::uint32_t vertex : triangles[t]) rim.push_back(vertex);
    std::sort(rim.begin(), rim.end(), [&](std::uint32_t v, std::uint32_t w) { return position[v] < position[w]; });
    std::uint8_t bits = 0;
    for (std::size_t i = 0; i < rim.size() && bits != (kInside | kOutside) && !space_.stop.stop_requested(); ++i) {
      const std::uint32_t at = position[rim[i]];
      if (i > 0 && position[rim[i - 1]] == at) continue;
      const auto fan = own_.topology.fan(at);
      const bool is_clear =
          std::any_of(fan.begin(), fan.end(), [&](std::uint32_t t) { return counts(t) && !is_near(t); });
      if (is_clear) bits |= locate(other_, own_.body.world[rim[i]]);
    }
    return bits;
  }

  const solid::Part& own_;
  const solid::Part& other_;
  const LocatorSettings& space_;
  NearSide near_;
};

std::vector<TrianglePair> swapped(const std::vector<TrianglePair>& near) {
  std::vector<TrianglePair> result(near.size());
  std::transform(near.begin(), near.end(), result.begin(), [](const TrianglePair& p) {
    return TrianglePair{p.b, p.a};
  });
  std::sort(result.begin(), result.end(), [](const auto& p, const auto& q) { return p.a < q.a; });
  return result;
}

}  // namespace

std::optional<solid::Cells> cells_within(const solid::Part& a, const solid::Part& b, const CellsWithinSearch& search) {
  if (has_inner_shells(a) || has_inner_shells(b)) return std::nullopt;
  const LocalFrame frame = local_frame(a.body.box, b.body.box);
  if (frame.unit * search.tolerance < kLeastTolerance * frame.scale) return std::nullopt;
  const LocatorSettings space{frame, search.tolerance, search.stop};

  const ContactPairs& met = search.contact_pairs;
  solid::Cells cells;
  OneSide side_a(a, b, space, {met.near_a, met.near, met.of_a});
  OneSide side_b(b, a, space, {met.near_b, swapped(met.near), met.of_b});
  cells.a |= side_a.look_at_clear(), cells.b |= side_b.look_at_clear();
  const auto enough = [&] { return search.enough(cells); };
  if (enough()) return cells;
  const bool told = side_a.look_at_near([&](std::uint8_t bits) { return cells.a |= bits, enough(); }) &&
                    (enough() || side_b.look_at_near([&](std::uint8_t bits) { return cells.b |= bits, enough(); }));
  return told ? std::optional(cells) : std::nullopt;
}

}  // namespace impinge::clash
