// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge_verdict_oracle [--tetrahedra] SCENE SET: reads a scene of solids (scenes/scene_file.hpp) and writes the
/// verdict on each pair of objects, by CGAL's Nef polyhedra: sets of points that are cut, joined and asked whether they
/// are empty.
///
/// A solid is made shell by shell (what hangs together by edges). A shell that is a simple closed surface becomes the
/// set that it encloses; for any other, and for all with --tetrahedra, that set is the symmetric difference of the
/// tetrahedra from one point to all its triangles. How often shells wind around a place is then counted, and the places
/// where that is not zero are the solid: closed, and the closure of its interior.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact.hpp"
#include "read_scene.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Corners = std::array<std::size_t, 3>;

/// Triangles over points that are all different.
struct Surface {
  std::vector<Point> points;
  std::vector<Corners> triangles;
};

Surface by_position(const oracle::WorldObject& object) {
  Surface surface;
  std::map<std::array<double, 3>, std::size_t> known;
  for (const oracle::WorldTriangle& triangle : object.triangles) {
    Corners corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<double, 3>& at = triangle[k];  // -0 and 0 are one key: a map compares by <
      const auto [place, is_new] = known.try_emplace(at, surface.points.size());
      if (is_new) surface.points.emplace_back(at[0], at[1], at[2]);
      corners[k] = place->second;
    }
    surface.triangles.push_back(corners);
  }
  return surface;
}

using Edge = std::array<std::size_t, 2>;

Edge edge_of(const Corners& t, std::size_t k) { return {t[k], t[(k + 1) % 3]}; }

bool is_closed(const Surface& surface) {
  std::map<Edge, int> balance;
  for (const Corners& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [from, to] = edge_of(t, k);
      balance[{std::min(from, to), std::max(from, to)}] += from == to ? 0 : from < to ? 1 : -1;
    }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

/// A triangle's use of an edge.
struct Use {
  std::size_t triangle;
  std::size_t corner;  ///< where the edge begins
};

/// Which uses of an edge go straight on in which others: those of two coplanar triangles on either side of the edge
/// that look the same way. Nothing unless each use has one.
std::optional<std::vector<std::array<Use, 2>>> straight_on(const Surface& s, std::vector<Use> uses) {
  std::vector<std::array<Use, 2>> pairs;
  while (!uses.empty()) {
    const Use use = uses.back();
    uses.pop_back();
    const Corners& t = s.triangles[use.triangle];
    const Point &p = s.points[t[use.corner]], &q = s.points[t[(use.corner + 1) % 3]];
    const Point& apex = s.points[t[(use.corner + 2) % 3]];
    const auto goes_on = [&](const Use& other) {
      const Corners& u = s.triangles[other.triangle];
      const Point& beyond = s.points[u[(other.corner + 2) % 3]];
      return u[other.corner] != t[use.corner] && !CGAL::collinear(p, q, apex) && !CGAL::collinear(p, q, beyond) &&
             CGAL::orientation(p, q, apex, beyond) == CGAL::COPLANAR &&
             CGAL::coplanar_orientation(p, q, apex, beyond) == CGAL::NEGATIVE;
    };
    const auto found = std::find_if(uses.begin(), uses.end(), goes_on);
    if (found == uses.end()) return std::nullopt;
    pairs.push_back({use, *found});
    uses.erase(found);
  }
  return pairs;
}

/// The surface in pieces that hang together by edges. Where more than two triangles use an edge and all go straight on
/// there, pieces pass through each other: each is closed, and what they wind around adds up.
std::vector<Surface> shells_of(const Surface& surface) {
  std::vector<std::size_t> leader(surface.triangles.size());
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (leader[i] != i) i = leader[i] = leader[leader[i]];
    return i;
  };
  std::map<Edge, std::vector<Use>> edges;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      Edge edge = edge_of(surface.triangles[i], k);
      std::sort(edge.begin(), edge.end());
      edges[edge].push_back({i, k});
    }
  for (const auto& [edge, uses] : edges) {
    const auto pairs = uses.size() > 2 ? straight_on(surface, uses) : std::nullopt;
    if (pairs) {
      for (const auto& [one, two] : *pairs) leader[find(one.triangle)] = find(two.triangle);
    } else {
      for (const Use& use : uses) leader[find(use.triangle)] = find(uses[0].triangle);
    }
  }
  std::map<std::size_t, Surface> shells;
  for (std::size_t i = 0; i < leader.size(); ++i)
    shells.try_emplace(find(i)).first->second.triangles.push_back(surface.triangles[i]);
  std::vector<Surface> result;
  for (auto& [first, shell] : shells) {
    std::map<std::size_t, std::size_t> renamed;
    for (Corners& t : shell.triangles)
      for (std::size_t& corner : t) {
        const auto [place, is_new] = renamed.try_emplace(corner, shell.points.size());
        if (is_new) shell.points.push_back(surface.points[corner]);
        corner = place->second;
      }
    result.push_back(std::move(shell));
  }
  return result;
}

Kernel::Triangle_3 triangle(const Surface& s, const Corners& t) {
  return {s.points[t[0]], s.points[t[1]], s.points[t[2]]};
}

/// Six times the volume that the shell winds around.
Kernel::FT volume(const Surface& shell) {
  Kernel::FT sum = 0;
  const Point& origin = shell.points.front();
  for (const Corners& t : shell.triangles)
    sum += CGAL::determinant(shell.points[t[0]] - origin, shell.points[t[1]] - origin, shell.points[t[2]] - origin);
  return sum;
}

bool one_fan_at_each_point(const Surface& shell) {
  // The edges opposite to a point, followed from one to the next, make one ring.
  std::vector<std::map<std::size_t, std::size_t>> next(shell.points.size());
  for (const Corners& t : shell.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (!next[t[k]].emplace(t[(k + 1) % 3], t[(k + 2) % 3]).second) return false;
  for (const auto& ring : next) {
    std::size_t at = ring.begin()->first, steps = 0;
    do {
      const auto found = ring.find(at);
      if (found == ring.end()) return false;
      at = found->second;
      ++steps;
    } while (at != ring.begin()->first && steps <= ring.size());
    if (steps != ring.size()) return false;
  }
  return true;
}

/// Whether two triangles share no more than the corners and edges that they have in common.
bool meet_as_neighbours(const Surface& s, const Corners& a, const Corners& b) {
  std::vector<std::size_t> of_a, of_b;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::find(b.begin(), b.end(), a[k]) != b.end()) of_a.push_back(k);
    if (std::find(a.begin(), a.end(), b[k]) != a.end()) of_b.push_back(k);
  }
  const auto opposite = [&](const Corners& t, std::size_t k) {
    return Kernel::Segment_3(s.points[t[(k + 1) % 3]], s.points[t[(k + 2) % 3]]);
  };
  if (of_a.empty()) return !CGAL::do_intersect(triangle(s, a), triangle(s, b));
  if (of_a.size() == 1)
    return !CGAL::do_intersect(opposite(a, of_a[0]), triangle(s, b)) &&
           !CGAL::do_intersect(opposite(b, of_b[0]), triangle(s, a));
  if (of_a.size() == 3) return false;
  const std::size_t apex_a = a[3 - of_a[0] - of_a[1]], apex_b = b[3 - of_b[0] - of_b[1]];
  const Point &p = s.points[a[of_a[0]]], &q = s.points[a[of_a[1]]];
  return CGAL::orientation(p, q, s.points[apex_a], s.points[apex_b]) != CGAL::COPLANAR ||
         CGAL::coplanar_orientation(p, q, s.points[apex_a], s.points[apex_b]) == CGAL::NEGATIVE;
}

/// A closed surface that CGAL takes as a polyhedron: every edge has two sides, every point one fan, nothing touches.
bool is_simple(const Surface& shell) {
  for (const Corners& t : shell.triangles)
    if (triangle(shell, t).is_degenerate()) return false;
  if (!one_fan_at_each_point(shell)) return false;
  for (std::size_t i = 0; i < shell.triangles.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!meet_as_neighbours(shell, shell.triangles[i], shell.triangles[j])) return false;
  return true;
}

struct Builder : CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
  explicit Builder(const Surface& s) : shell(s) {}
  void operator()(Polyhedron::HalfedgeDS& target) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(target, true);
    builder.begin_surface(shell.points.size(), shell.triangles.size());
    for (const Point& p : shell.points) builder.add_vertex(p);
    for (const Corners& t : shell.triangles) builder.add_facet(t.begin(), t.end());
    builder.end_surface();
  }
  const Surface& shell;
};

Nef as_polyhedron(Surface shell) {
  if (volume(shell) < 0)
    for (Corners& t : shell.triangles) std::swap(t[1], t[2]);
  Polyhedron polyhedron;
  Builder builder(shell);
  polyhedron.delegate(builder);
  return Nef(polyhedron);
}

Nef tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d) {
  Polyhedron polyhedron;
  if (CGAL::orientation(a, b, c, d) == CGAL::POSITIVE) {
    polyhedron.make_tetrahedron(a, b, c, d);
  } else {
    polyhedron.make_tetrahedron(a, c, b, d);
  }
  return Nef(polyhedron);
}

/// Where the shell winds an odd number of times: in once and out again, whatever it does along edges and points.
Nef as_tetrahedra(const Surface& shell) {
  std::vector<Nef> parts;
  const Point& apex = shell.points.front();
  for (const Corners& t : shell.triangles) {
    const Point &a = shell.points[t[0]], &b = shell.points[t[1]], &c = shell.points[t[2]];
    if (CGAL::orientation(apex, a, b, c) != CGAL::COPLANAR) parts.push_back(tetrahedron(apex, a, b, c));
  }
  while (parts.size() > 1) {  // small ones with small ones: the large are dear
    std::vector<Nef> joined;
    for (std::size_t i = 0; i + 1 < parts.size(); i += 2) joined.push_back((parts[i] ^ parts[i + 1]).regularization());
    if (parts.size() % 2 != 0) joined.push_back(parts.back());
    parts = std::move(joined);
  }
  return parts.empty() ? Nef(Nef::EMPTY) : parts.front();
}

/// A set of places around which the shells seen so far wind so many times.
struct Region {
  Nef places;
  int winding;
};

void add(std::vector<Region>& regions, Nef places, int winding) {
  places = places.regularization();
  if (!places.is_empty()) regions.push_back({places, winding});
}

Nef solid_of(const Surface& surface, bool tetrahedra) {
  std::vector<Region> regions;
  for (const Surface& shell : shells_of(surface)) {
    Nef rest = tetrahedra || !is_simple(shell) ? as_tetrahedra(shell) : as_polyhedron(shell);
    const int turn = volume(shell) < 0 ? -1 : 1;
    std::vector<Region> refined;
    const Nef enclosed = rest;
    for (const Region& region : regions) {
      add(refined, region.places * enclosed, region.winding + turn);
      add(refined, region.places - enclosed, region.winding);
      rest = rest - region.places;
    }
    add(refined, rest, turn);
    regions = std::move(refined);
  }
  Nef solid(Nef::EMPTY);
  for (const Region& region : regions)
    if (region.winding != 0) solid = solid + region.places;
  return solid.regularization();
}

/// The numbers of impinge::Verdict. Surfaces are not judged here.
enum class Verdict : std::uint32_t { duplicate = 0, inside = 1, penetrating = 2, touching = 4, apart = 5 };

struct Judgement {
  Verdict verdict;
  int inner = -1;  ///< with `inside`: which of the two
};

bool has_interior(const Nef& set) { return !set.interior().is_empty(); }

Judgement judge(const Nef& a, const Nef& b) {
  const Nef common = a * b;
  if (common.is_empty()) return {Verdict::apart};
  if (!has_interior(common)) return {Verdict::touching};
  const bool a_reaches_out = has_interior(a - b);
  const bool b_reaches_out = has_interior(b - a);
  if (!a_reaches_out && !b_reaches_out) return {Verdict::duplicate};
  if (a_reaches_out && b_reaches_out) return {Verdict::penetrating};
  return {Verdict::inside, a_reaches_out ? 1 : 0};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool tetrahedra = !arguments.empty() && arguments.front() == "--tetrahedra";
  if (tetrahedra) arguments.erase(arguments.begin());
  if (arguments.size() != 2) {
    std::cerr << "usage: impinge_verdict_oracle [--tetrahedra] SCENE SET\n";
    return 2;
  }
  const auto objects = oracle::read_scene(arguments[0]);
  if (!objects) {
    std::cerr << arguments[0] << ": not a scene that the oracle can read.\n";
    return 2;
  }
  std::vector<Nef> solids;
  for (const oracle::WorldObject& object : *objects) {
    const Surface surface = by_position(object);
    if (surface.triangles.empty() || !is_closed(surface)) {
      std::cerr << arguments[0] << ": object " << solids.size() << " is not closed.\n";
      return 2;
    }
    solids.push_back(solid_of(surface, tetrahedra));
  }
  std::vector<oracle::Contact> rows;
  for (std::uint32_t i = 0; i < solids.size(); ++i)
    for (std::uint32_t j = i + 1; j < solids.size(); ++j) {
      const Judgement judgement = judge(solids[i], solids[j]);
      rows.push_back(
          {i, j, static_cast<std::uint32_t>(judgement.verdict), static_cast<std::uint32_t>(judgement.inner + 1), 0});
    }
  if (!oracle::write_contacts(arguments[1], rows)) {
    std::cerr << arguments[1] << ": cannot be written.\n";
    return 2;
  }
  return 0;
}
