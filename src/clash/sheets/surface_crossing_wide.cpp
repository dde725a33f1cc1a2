// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "clash/sheets/far_sides.hpp"
#include "clash/sheets/sheets.hpp"
#include "clash/sheets/surface_crossing.hpp"
#include "core/disjoint_sets.hpp"
#include "measure/nearest.hpp"

namespace impinge::clash {
namespace {

/// Where two sheets are near each other.
struct Place {
  SidesSeen a_at_b, b_at_a;
  Box box{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};  ///< of what is near
};

/// So many near triangles are held at most; where there are more, nothing is seen along branches.
constexpr std::size_t kMostNearBranches = std::size_t{1} << 20;

/// Around which triangles of some sheets the surface is bent; looked up once. Elsewhere what goes on beyond an edge is
/// over one of the triangles there, as wide as they are taken: a bend of 2^-6 makes room for 1/16 of the tolerance in
/// four.
class Bends {
 public:
  explicit Bends(const Sheets& sheets) : bent_(sheets.ids.size()) {}
  bool operator()(std::uint32_t index, const PartTriangle& triangle) {
    if (!bent_[index]) bent_[index] = is_bent_around(triangle);
    return *bent_[index];
  }

 private:
  std::vector<std::optional<bool>> bent_;
};

/// Which triangles of some sheets are small beside the tolerance: pairs of them are open as well.
std::vector<bool> small_ones(const solid::Part& part, const Sheets& sheets, double tolerance) {
  std::vector<bool> small;
  for (const std::uint32_t id : sheets.ids) small.push_back(is_small(part.body.triangle(id), tolerance));
  return small;
}

bool branches(const Sheets& sheets) {
  return std::any_of(sheets.links.begin(), sheets.links.end(), [](const auto& links) { return !links.empty(); });
}

/// Near pairs of two surfaces, by the places that they make.
class Places {
 public:
  Places(const solid::Part& a, const solid::Part& b, double tolerance, const ContactPairs& contact_pairs,
         const std::stop_token& stop)
      : a_(a),
        b_(b),
        tolerance_(tolerance),
        contact_pairs_(contact_pairs),
        stop_(stop),
        of_a_(sheets_of(a, contact_pairs.near_a, tolerance)),
        of_b_(sheets_of(b, contact_pairs.near_b, tolerance)),
        groups_(of_a_.ids.size() + of_b_.ids.size()),
        is_asked_(of_a_.ids.size()),
        lain_a_(of_a_.ids.size()),
        lain_b_(of_b_.ids.size()),
        far_(a.body, b.body, tolerance),
        ends_a_(a, of_a_, far_.frame(), tolerance),
        ends_b_(b, of_b_, far_.frame(), tolerance) {}

  /// Those in which a triangle of a is open, or a pair is small.
  void ask(std::span<const std::uint32_t> open_a) {
    const auto count_a = static_cast<std::uint32_t>(of_a_.ids.size());
    std::vector<bool> is_open(count_a);
    for (const std::uint32_t id : open_a) is_open[of_a_.index(id)] = true;
    const std::vector<bool> small_a = small_ones(a_, of_a_, tolerance_), small_b = small_ones(b_, of_b_, tolerance_);
    each_near([&](const TrianglePair&, std::uint32_t i, std::uint32_t j) {
      groups_.join(i, count_a + j);
      if (small_a[i] && small_b[j]) is_open[i] = true;
      return true;
    });
    for (std::uint32_t i = 0; i < count_a; ++i)
      if (is_open[i]) is_asked_[groups_.find(i)] = true;
  }

  /// For what lies along sheets that branch: which other pieces it is near.
  void look_along_branches() {
    if (branches(of_b_)) near_a_.resize(of_a_.ids.size());
    if (branches(of_a_)) near_b_.resize(of_b_.ids.size());
    if (near_a_.empty() && near_b_.empty()) return;
    each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      if (far_.lie_along(local(a_, pair.a), local(b_, pair.b)))
        lain_a_[of_a_.piece[i]] = lain_b_[of_b_.piece[j]] = true;
      if (!near_a_.empty()) near_a_[i].note(of_b_.piece[j]);
      if (!near_b_.empty()) near_b_[j].note(of_a_.piece[i]);
      return true;
    });
    std::size_t left = kMostNearBranches;
    each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      if (has_several(near_a_, i)) near_a_[i].entries.push_back({local(b_, pair.b), of_b_.piece[j]}), --left;
      if (left > 0 && has_several(near_b_, j))
        near_b_[j].entries.push_back({local(a_, pair.a), of_a_.piece[i]}), --left;
      return left > 0;
    });
    if (left == 0) near_a_.clear(), near_b_.clear();
  }

  /// Whether in one of those that are asked each sheet goes on, on both sides of the other.
  bool pass() {
    Bends bent_a(of_a_), bent_b(of_b_);
    std::map<std::array<std::uint32_t, 3>, Place> places;
    bool pass = false;
    each_asked([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      Place& place = places[{groups_.find(i), of_a_.cluster[i], of_b_.cluster[j]}];
      const PartTriangle own{a_, ends_a_, far_.frame(), pair.a, local(a_, pair.a)},
          other{b_, ends_b_, far_.frame(), pair.b, local(b_, pair.b)};
      const std::uint8_t known_a = place.b_at_a.from(of_a_, i), known_b = place.a_at_b.from(of_b_, j);
      place.b_at_a.add(of_a_, i, far_.see(other.local, own, bent_a(i, own), known_a, place.box));
      place.a_at_b.add(of_b_, j, far_.see(own.local, other, bent_b(j, other), known_b, place.box));
      if (has_several(near_b_, j)) far_.see_along(other.local, own, i, of_a_, near_b_[j], lain_a_, place.b_at_a);
      if (has_several(near_a_, i)) far_.see_along(own.local, other, j, of_b_, near_a_[i], lain_b_, place.a_at_b);
      pass = place.a_at_b.has_both() && place.b_at_a.has_both() && far_.is_long(place.box);
      return !pass;
    });
    return pass;
  }

 private:
  static bool has_several(const std::vector<NearTriangles>& near, std::uint32_t index) {
    return !near.empty() && near[index].has_several;
  }

  [[nodiscard]] Triangle local(const solid::Part& part, std::uint32_t id) const {
    return far_.frame().to_local(part.body.triangle(id));
  }

  /// Every near pair of proper triangles and their places in the sheets, those that the contact_pairs left out too.
  template <class Take>
  void each_near(const Take& take) const {
    const auto take_proper = [&](const TrianglePair& pair) {
      return !a_.is_boundary(pair.a) || !b_.is_boundary(pair.b) || take(pair, of_a_.index(pair.a), of_b_.index(pair.b));
    };
    if (!contact_pairs_.is_whole)
      return measure::near_pairs(a_.body.placed, b_.body.placed, tolerance_, take_proper, stop_);
    for (const TrianglePair& pair : contact_pairs_.near)
      if (stop_.stop_requested() || !take_proper(pair)) return;
  }

  template <class Take>
  void each_asked(const Take& take) {
    each_near([&](const TrianglePair& pair, std::uint32_t i, std::uint32_t j) {
      return !is_asked_[groups_.find(i)] || take(pair, i, j);
    });
  }

  const solid::Part &a_, &b_;
  double tolerance_;
  const ContactPairs& contact_pairs_;
  const std::stop_token& stop_;
  Sheets of_a_, of_b_;
  DisjointSets groups_;                         ///< of triangles that hang together by near pairs: a's, then b's
  std::vector<bool> is_asked_;                  ///< by the lowest member of a group, which is of a
  std::vector<NearTriangles> near_a_, near_b_;  ///< what the other part has near each triangle, if it branches
  std::vector<bool> lain_a_, lain_b_;           ///< pieces along which the other part lies
  FarSides far_;
  SheetEnds ends_a_, ends_b_;
};

}  // namespace

bool surfaces_cross_widely(const solid::Part& a, const solid::Part& b, double tolerance,
                           const ContactPairs& contact_pairs, std::span<const std::uint32_t> open_a,
                           const std::stop_token& stop) {
  if (open_a.empty() && !contact_pairs.leaves_out_small) return false;
  Places places(a, b, tolerance, contact_pairs, stop);
  places.ask(open_a);
  places.look_along_branches();
  return places.pass();
}

}  // namespace impinge::clash
