// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/orientation.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "core/local_frame.hpp"
#include "solid/nested_patches.hpp"

namespace impinge::solid {
namespace {

class Turning {
 public:
  Turning(const Body& body, const Topology& topology, const std::vector<bool>& left_out, const std::stop_token& stop)
      : body_(body), topology_(topology), left_out_(left_out), stop_(stop), frame_(local_frame(body.box, body.box)) {
    result_.patch.assign(body.size(), Orientation::kNoPatch);
    result_.is_turned.assign(body.size(), false);
  }

  Orientation run() {
    find_neighbours();
    for (std::uint32_t t = 0; t < body_.size() && !stop_.stop_requested(); ++t)
      if (!left_out_[t] && result_.patch[t] == Orientation::kNoPatch) turn_patch(t);
    find_closed_patches();
    result_.outermost = outermost_patches(body_, topology_, result_, stop_);
    turn_negative_patches();
    return std::move(result_);
  }

 private:
  /// Across an edge.
  struct Neighbour {
    std::uint32_t triangle = Orientation::kNoPatch;
    bool agrees = true;  ///< runs through the edge the other way
  };

  void find_neighbours() {
    neighbours_.resize(body_.size());
    std::vector<EdgeUse> kept;
    const auto see = [&](std::uint32_t /*low*/, std::span<const EdgeUse> uses) {
      kept.clear();
      std::copy_if(uses.begin(), uses.end(), std::back_inserter(kept),
                   [&](const EdgeUse& use) { return !left_out_[use.triangle]; });
      if (kept.size() != 2 || kept[0].triangle == kept[1].triangle) return;
      const bool agree = kept[0].way != kept[1].way;
      neighbours_[kept[0].triangle][kept[0].k] = {kept[1].triangle, agree};
      neighbours_[kept[1].triangle][kept[1].k] = {kept[0].triangle, agree};
    };
    for_each_edge(body_, topology_, see, stop_);
  }

  [[nodiscard]] double area_of(std::uint32_t t) const {
    const Triangle triangle = frame_.to_local(body_.triangle(t));
    return norm(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  }

  /// Collects the patch of its first triangle, with each triangle turned if it must be to agree with that one.
  void turn_patch(std::uint32_t first) {
    const auto patch = static_cast<std::uint32_t>(patches_++);
    std::vector<std::uint32_t> members{first};
    result_.patch[first] = patch;
    bool fits = true;
    double kept = 0, turned = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::uint32_t t = members[i];
      (result_.is_turned[t] ? turned : kept) += area_of(t);
      for (const Neighbour& next : neighbours_[t]) {
        if (next.triangle == Orientation::kNoPatch) continue;
        const bool must_turn = result_.is_turned[t] == next.agrees;
        if (result_.patch[next.triangle] == Orientation::kNoPatch) {
          result_.patch[next.triangle] = patch;
          result_.is_turned[next.triangle] = must_turn;
          members.push_back(next.triangle);
        } else {
          fits = fits && result_.is_turned[next.triangle] == must_turn;
        }
      }
    }
    for (const std::uint32_t t : members) result_.is_turned[t] = fits && result_.is_turned[t] != (turned > kept);
  }

  void find_closed_patches() {
    result_.is_closed.assign(patches_, true);
    std::vector<std::pair<std::uint32_t, int>> ways;  // by patch
    const auto see = [&](std::uint32_t /*low*/, std::span<const EdgeUse> uses) {
      ways.clear();
      for (const EdgeUse& use : uses)
        if (!left_out_[use.triangle])
          ways.emplace_back(result_.patch[use.triangle], result_.is_turned[use.triangle] ? -use.way : use.way);
      std::sort(ways.begin(), ways.end());
      for (std::size_t first = 0, last = 0; first < ways.size(); first = last) {
        int balance = 0;
        for (; last < ways.size() && ways[last].first == ways[first].first; ++last) balance += ways[last].second;
        if (balance != 0) result_.is_closed[ways[first].first] = false;
      }
    };
    for_each_edge(body_, topology_, see, stop_);
  }

  void turn_negative_patches() {
    std::vector<double> volumes(patches_, 0);
    for (std::uint32_t t = 0; t < body_.size(); ++t) {
      if (left_out_[t] || stop_.stop_requested()) continue;
      const auto [a, b, c] = frame_.to_local(body_.triangle(t));
      volumes[result_.patch[t]] += (result_.is_turned[t] ? -1 : 1) * dot(a, cross(b - a, c - a));
    }
    for (std::uint32_t t = 0; t < body_.size(); ++t) {
      if (left_out_[t] || stop_.stop_requested() || !result_.is_closed[result_.patch[t]]) continue;
      if (volumes[result_.outermost[result_.patch[t]]] < 0) result_.is_turned[t] = !result_.is_turned[t];
    }
  }

  const Body& body_;
  const Topology& topology_;
  const std::vector<bool>& left_out_;
  const std::stop_token& stop_;
  LocalFrame frame_;
  std::vector<std::array<Neighbour, 3>> neighbours_;  ///< per triangle and edge
  std::size_t patches_ = 0;
  Orientation result_;
};

}  // namespace

Orientation orient(const Body& body, const Topology& topology, const std::vector<bool>& left_out,
                   const std::stop_token& stop) {
  return Turning(body, topology, left_out, stop).run();
}

}  // namespace impinge::solid
