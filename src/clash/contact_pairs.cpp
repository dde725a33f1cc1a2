// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/contact_pairs.hpp"

#include <algorithm>
#include <tuple>

#include "clash/vertex_contact.hpp"
#include "exact/orientation.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/nearest.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::clash {
namespace {

bool is_proper(const Triangle& t) { return exact::find_projection(t[0], t[1], t[2]) >= 0; }

/// The kind of contact of two triangles that share one corner and nothing else.
Kind kind_of(const Triangle& a, const Triangle& b, std::size_t corner_b) {
  for (const std::size_t other : {(corner_b + 1) % 3, (corner_b + 2) % 3})
    if (exact::orient3d(a[0], a[1], a[2], b[other]) != 0) return Kind::touching;
  return is_proper(a) && is_proper(b) ? Kind::coplanar : Kind::touching;
}

/// A set of triangles that takes no memory while it is empty.
class Marks {
 public:
  [[nodiscard]] bool has(std::uint32_t triangle) const { return !marks_.empty() && marks_[triangle]; }
  /// Returns false if the triangle was in the set.
  bool add(std::uint32_t triangle, std::size_t triangles) {
    if (marks_.empty()) marks_.resize(triangles);
    const bool is_new = !marks_[triangle];
    marks_[triangle] = true;
    return is_new;
  }

 private:
  std::vector<bool> marks_;
};

class ContactSearch {
 public:
  ContactSearch(const solid::Body& a, const solid::Body& b, const ContactPairsGoal& goal) : a_(a), b_(b), goal_(goal) {}

  ContactPairs run() {
    const auto take = [&](const TrianglePair& pair) { return look_at(pair), true; };
    measure::candidate_pairs(a_.placed, b_.placed, goal_.within, take, goal_.stop);
    const auto by_triangles = [](const auto& p, const auto& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); };
    std::sort(result_.near.begin(), result_.near.end(), by_triangles);
    std::sort(result_.contacts.begin(), result_.contacts.end(), by_triangles);
    for (const TrianglePair& pair : result_.near) result_.near_a.push_back(pair.a), result_.near_b.push_back(pair.b);
    for (std::vector<std::uint32_t>* list : {&result_.near_a, &result_.near_b}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    return std::move(result_);
  }

 private:
  void look_at(const TrianglePair& pair) {
    const Triangle a = a_.triangle(pair.a), b = b_.triangle(pair.b);
    if (const auto vertex_contact = find_vertex_contact(a, b, goal_.within)) return look_at(pair, *vertex_contact);
    const bool are_small = is_small(a, goal_.within) && is_small(b, goal_.within);
    const bool is_known = are_small && small_a_.has(pair.a) && small_b_.has(pair.b);
    if (is_known ? !overlap(box_of(a), box_of(b)) : measure::triangle_distance(a, b, goal_.within).lower > goal_.within)
      return;
    keep(pair, are_small);
    if (const auto kind = exact::classify(a, b)) count(pair, *kind, true);
  }

  void keep(const TrianglePair& pair, bool are_small) {
    if (!are_small) return result_.near.push_back(pair);
    result_.is_whole = false, result_.leaves_out_small = true;
    if (small_a_.add(pair.a, a_.size())) result_.near_a.push_back(pair.a);
    if (small_b_.add(pair.b, b_.size())) result_.near_b.push_back(pair.b);
  }

  void look_at(const TrianglePair& pair, const VertexContact& vertex_contact) {
    const bool is_first_of_a = result_.of_a.meet(pair.a, vertex_contact.corner_a, a_.size());
    const bool is_first = result_.of_b.meet(pair.b, vertex_contact.corner_b, b_.size()) || is_first_of_a;
    const Triangle a = a_.triangle(pair.a), b = b_.triangle(pair.b);
    if (is_first) {
      keep(pair, is_small(a, goal_.within) && is_small(b, goal_.within));
    } else {
      result_.of_a.leave_out(pair.a, vertex_contact.corner_a), result_.of_b.leave_out(pair.b, vertex_contact.corner_b);
      result_.is_whole = false;
    }
    if (vertex_contact.is_one_point) {
      count(pair, kind_of(a, b, vertex_contact.corner_b), is_first || goal_.all_contacts);
    } else if (const auto kind = exact::classify(a, b)) {
      count(pair, *kind, true);
    }
  }

  void count(const TrianglePair& pair, Kind kind, bool is_kept) {
    ++result_.counts[static_cast<std::size_t>(kind)];
    if (is_kept) result_.contacts.push_back({pair.a, pair.b, kind});
  }

  const solid::Body &a_, &b_;
  const ContactPairsGoal& goal_;
  ContactPairs result_;
  Marks small_a_, small_b_;  ///< triangles in some near pair of small ones
};

}  // namespace

bool is_small(const Triangle& triangle, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i)
    if (norm(triangle[(i + 1) % 3] - triangle[i]) > 4 * tolerance) return false;
  return true;
}

bool LeftOut::meet(std::uint32_t triangle, std::uint8_t corner, std::size_t triangles) {
  if (bits_.empty()) bits_.resize(triangles);
  const auto bit = static_cast<std::uint8_t>(1 << corner);
  const bool is_first = (bits_[triangle] & bit) == 0;
  bits_[triangle] |= bit;
  return is_first;
}

ContactPairs find_contact_pairs(const solid::Body& a, const solid::Body& b, const ContactPairsGoal& goal) {
  return ContactSearch(a, b, goal).run();
}

}  // namespace impinge::clash
