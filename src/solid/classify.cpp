// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/classify.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/local_frame.hpp"
#include "solid/inner_points.hpp"
#include "solid/orientation.hpp"
#include "solid/pieces.hpp"
#include "solid/triangle_tree.hpp"
#include "solid/unclear_edges.hpp"

namespace impinge::solid {
namespace {

/// Triangles of which there are two or more with the same corners, all but the first of them.
std::vector<bool> repeated_triangles(const Body& body, const Topology& topology) {
  std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> by_corners;
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    auto corners = topology.corners(body, t);
    std::sort(corners.begin(), corners.end());
    by_corners.emplace_back(corners, t);
  }
  std::sort(by_corners.begin(), by_corners.end());
  std::vector<bool> repeated(body.size());
  for (std::size_t i = 1; i < by_corners.size(); ++i)
    if (by_corners[i].first == by_corners[i - 1].first) repeated[by_corners[i].second] = true;
  return repeated;
}

/// Classifies the pieces of a body, but for some of its triangles.
class Classifier {
 public:
  Classifier(const Body& body, const Topology& topology, const std::vector<bool>& left_out, const std::stop_token& stop)
      : body_(body),
        topology_(topology),
        stop_(stop),
        frame_(local_frame(body.box, body.box)),
        orientation_(orient(body, topology, left_out, stop)),
        is_within_material_(body.size()) {}

  Classification run() {
    result_.turned =
        static_cast<std::uint64_t>(std::count(orientation_.is_turned.begin(), orientation_.is_turned.end(), true));
    for (const Piece& piece : pieces_of(body_, topology_, orientation_, stop_)) {
      if (stop_.stop_requested()) break;
      Local local = this->local(piece);
      const PartClass found = piece.closed ? class_of_closed(piece, local) : class_of_open(piece, local);
      result_.best = std::min(result_.best, found);
      list(piece, found, std::move(local.tree));
    }
    return std::move(result_);
  }
  [[nodiscard]] bool has_inner_point() const { return has_inner_point_; }

 private:
  void list(const Piece& piece, PartClass part_class, TriangleTree&& tree) {
    ClassedPiece listed{.part_class = part_class};
    double volume = 0;
    for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
      const std::uint32_t t = piece.triangles[i];
      if (is_within_material_[t]) continue;
      auto triangle = body_.placed.mesh->triangles[t];
      if (orientation_.is_turned[t]) std::swap(triangle[1], triangle[2]);
      listed.triangles.push_back(triangle);
      const Triangle& local = tree.triangles()[i];
      volume += dot(local[0], cross(local[1], local[2])) / 6;
    }
    if (part_class == PartClass::solid) listed.volume = std::abs(volume) / frame_.unit / frame_.unit / frame_.unit;
    if (part_class == PartClass::cracked) {
      listed.tree = std::move(tree), listed.frame = frame_;
      listed.open_edges.emplace(std::move(open_edges_), stop_);
    }
    if (part_class != PartClass::surface) {
      for (const InnerPoint& inner : inner_points_) {
        listed.inner_points.push_back({frame_.to_world(inner.point), inner.radius / frame_.unit});
        listed.radius = std::max(listed.radius, listed.inner_points.back().radius);
      }
    }
    result_.pieces.push_back(std::move(listed));
  }

  /// A piece in local coordinates, its triangles turned.
  struct Local {
    TriangleTree tree;
    double size;
    std::vector<std::uint32_t> sample;  ///< triangles whose inner points are looked for
  };
  [[nodiscard]] Local local(const Piece& piece) const {
    std::vector<Triangle> triangles;
    triangles.reserve(piece.triangles.size());
    for (const std::uint32_t t : piece.triangles) {
      Triangle triangle = frame_.to_local(body_.triangle(t));
      if (orientation_.is_turned[t]) std::swap(triangle[1], triangle[2]);
      triangles.push_back(triangle);
    }
    Box box = box_of(triangles.front());
    for (const Triangle& t : triangles) box = {min(box.lo, box_of(t).lo), max(box.hi, box_of(t).hi)};
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> sample = spread_by_area(triangles, all, kSample);
    return {TriangleTree(std::move(triangles), stop_), norm(box.hi - box.lo), std::move(sample)};
  }

  PartClass class_of_closed(const Piece& piece, const Local& local) {
    const InnerSearch search{local.tree, local.size, true, stop_};
    find_inner_points(search, local);
    if (inner_points_.empty()) return PartClass::surface;
    find_shells_within_material(piece, local);
    has_inner_point_ = true;
    return PartClass::solid;
  }

  /// Returns the largest radius.
  double find_inner_points(const InnerSearch& search, const Local& local) {
    inner_points_.clear();
    double largest = 0;
    for (const std::uint32_t t : local.sample) {
      if (stop_.stop_requested()) break;
      const auto found = inner_point(search, t);
      if (!found) continue;
      inner_points_.push_back(*found), largest = std::max(largest, found->radius);
    }
    return largest;
  }

  /// A patch that lies within another is no boundary where the piece winds around what is on either side of it.
  void find_shells_within_material(const Piece& piece, const Local& local) {
    std::map<std::uint32_t, bool> is_within;  // by patch
    const double least = InnerSearch{local.tree, local.size, true}.least();
    for (std::size_t i = 0; i < piece.triangles.size(); ++i) {
      const std::uint32_t patch = orientation_.patch[piece.triangles[i]];
      if (orientation_.outermost[patch] == patch || is_within.contains(patch)) continue;
      const Triangle& t = local.tree.triangles()[i];
      const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]), middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
      if (!(norm(normal) > 0)) continue;
      const Vec3 off = (least / norm(normal)) * normal;
      const auto winds_around = [&](const Vec3& p) { return std::abs(local.tree.winding_number(p)) > 0.5; };
      is_within[patch] = winds_around(middle - off) && winds_around(middle + off);
    }
    for (const std::uint32_t t : piece.triangles) {
      const auto found = is_within.find(orientation_.patch[t]);
      is_within_material_[t] = found != is_within.end() && found->second;
    }
  }

  PartClass class_of_open(const Piece& piece, const Local& local) {
    const InnerSearch search{local.tree, local.size, false, stop_};
    const std::vector<OpenEdge> edges = open_edges_of(body_, topology_, orientation_, stop_);
    const double radius = find_inner_points(search, local);
    result_.unclear_edges = edges.size();
    if (inner_points_.empty()) return PartClass::surface;
    has_inner_point_ = true;
    open_edges_.clear();
    for (const OpenEdge& edge : edges) {
      const auto& corners = body_.placed.mesh->triangles[edge.triangle];
      const Vec3 end = frame_.to_local(body_.world[corners[(edge.k + 1) % 3]]);
      open_edges_.push_back({frame_.to_local(body_.world[corners[edge.k]]), end, end});
    }

    std::vector<std::uint32_t> place(body_.size());
    for (std::uint32_t i = 0; i < piece.triangles.size(); ++i) place[piece.triangles[i]] = i;
    std::vector<std::vector<std::uint32_t>> components = components_of(body_, topology_, piece.triangles);
    for (std::vector<std::uint32_t>& component : components)
      for (std::uint32_t& t : component) t = place[t];
    std::vector<OpenEdge> placed;
    for (const OpenEdge& edge : edges) placed.push_back({place[edge.triangle], corner_after_turning(edge)});
    const UnclearEdges unclear = unclear_edges(search, placed, components);
    result_.unclear_edges = unclear.count;
    if (unclear.first) {
      const OpenEdge& first = edges[*unclear.first];
      const auto& vertices = body_.placed.mesh->triangles[first.triangle];
      result_.unclear_edge = {vertices[first.k], vertices[(first.k + 1) % 3]};
    }
    if (unclear.length > unclear.whole_length / 10) return PartClass::surface;
    return unclear.length <= 4 * radius ? PartClass::cracked : PartClass::surface;
  }

  /// Turning exchanges the last two corners: the edge from corner 1 is the same, the other two are exchanged.
  [[nodiscard]] std::uint8_t corner_after_turning(const OpenEdge& edge) const {
    if (!orientation_.is_turned[edge.triangle] || edge.k == 1) return edge.k;
    return edge.k == 0 ? 2 : 0;
  }

  static constexpr std::size_t kSample = 64;

  const Body& body_;
  const Topology& topology_;
  const std::stop_token& stop_;
  LocalFrame frame_;
  Orientation orientation_;
  std::vector<bool> is_within_material_;  ///< per triangle
  Classification result_;
  std::vector<InnerPoint> inner_points_;  ///< of the last piece, in local coordinates
  std::vector<Triangle> open_edges_;      ///< of the last open piece, likewise, as segments
  bool has_inner_point_ = false;
};

}  // namespace

Classification classify(const Body& body, const Topology& topology, const std::stop_token& stop) {
  std::vector<bool> left_out(body.size());
  if (body.size() == 0) return {};
  // A triangle with two equal corners runs through one edge to and fro.
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const auto [p, q, r] = topology.corners(body, t);
    left_out[t] = p == q || q == r || r == p;
  }
  Classifier classifier(body, topology, left_out, stop);
  Classification found = classifier.run();
  if (classifier.has_inner_point() || stop.stop_requested()) return found;
  // Some programs write each triangle twice, once for each side: then nothing winds around anything.
  const std::vector<bool> repeated = repeated_triangles(body, topology);
  if (std::find(repeated.begin(), repeated.end(), true) == repeated.end()) return found;
  for (std::size_t t = 0; t < left_out.size(); ++t) left_out[t] = left_out[t] || repeated[t];
  Classification once = Classifier(body, topology, left_out, stop).run();
  return once.best == PartClass::surface ? std::move(found) : std::move(once);
}

}  // namespace impinge::solid
