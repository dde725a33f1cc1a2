// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/overlap_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "clash/depth.hpp"
#include "core/local_frame.hpp"
#include "exact/orientation.hpp"
#include "exact/triangle_pair.hpp"
#include "solid/locate.hpp"

namespace impinge::clash {
namespace {

/// Where the border of one triangle crosses another triangle.
struct Crossing {
  std::size_t edge;  ///< from corner `edge` to the next
  bool enters;       ///< goes from the front of the other triangle to its back
  double along;      ///< 0 at the edge's beginning, 1 at its end
  Vec3 point;        ///< local
};

/// Whether the open edge crosses the open triangle: +1 from its front to its back, -1 the other way. `is_plain`
/// becomes false where a corner or an edge of one is on the other, or may be.
int crossing_way(const Vec3& from, const Vec3& to, const Triangle& t, bool& is_plain) {
  const int before = exact::orient3d(t[0], t[1], t[2], from), after = exact::orient3d(t[0], t[1], t[2], to);
  if (before * after > 0) return 0;
  int least = 1, most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int turn = exact::orient3d(from, to, t[i], t[(i + 1) % 3]);
    least = std::min(least, turn), most = std::max(most, turn);
  }
  if (least < 0 && most > 0) return 0;
  if (before == 0 || after == 0 || least != most) is_plain = false;
  return before > 0 ? 1 : -1;
}

struct Overlap {
  double volume = 0, rounding = 0;
  double area = 0;  ///< of the triangles there
};

/// The moment of one body's triangles within the other one: sums over triangles of the volume, seen from the origin of
/// the frame, of what of the triangle the other body winds around.
///
/// Within a triangle with the normal N the area inside the other body is, by Green's theorem, the sum over its
/// border of (p - o) x (q - o) . N. That border is made of the segments in which the other body's triangles cross this
/// one, and of what of its own edges is inside. With o at a corner only the opposite edge counts.
class Side {
 public:
  Side(const solid::Body& body, const solid::Body& other, const LocalFrame& frame)
      : body_(body), other_(other), frame_(frame), parts_(body.size()) {}

  void add(std::uint32_t triangle, const std::vector<Crossing>& own, const std::vector<Crossing>& others) {
    // Along this triangle what is inside of the other lies on the left: a segment ends where this one's border goes in.
    Vec3 begin{}, end{};
    for (const Crossing& crossing : own) (crossing.enters ? end : begin) = crossing.point;
    for (const Crossing& crossing : others) (crossing.enters ? begin : end) = crossing.point;
    Inside& inside = parts_[triangle];
    const Vec3 o = frame_.to_local(body_.triangle(triangle)[0]);
    inside.segments = inside.segments + cross(begin - o, end - o);
    for (const Crossing& crossing : own)
      if (crossing.edge == 1) inside.edge += (crossing.enters ? 1 : -1) * (1 - crossing.along);
  }

  /// In local units. Nothing if a vertex is on the other body.
  [[nodiscard]] std::optional<Overlap> sum(const std::stop_token& stop) const {
    Overlap all;
    std::vector<int> winding(body_.world.size(), kUnknown);
    for (std::uint32_t t = 0; t < body_.size() && !stop.stop_requested(); ++t) {
      const Triangle world = body_.triangle(t);
      if (!overlap(box_of(world), other_.box)) continue;
      int& at_begin = winding[body_.placed.mesh->triangles[t][1]];
      if (at_begin == kUnknown) {
        const auto found = solid::winding_number(other_.placed, world[1]);
        if (!found) return std::nullopt;
        at_begin = *found;
      }
      const Triangle local = frame_.to_local(world);
      const Vec3 normal = cross(local[1] - local[0], local[2] - local[0]);
      const double square = dot(normal, normal);
      if (!(square > 0)) continue;
      const double share = at_begin + parts_[t].edge + dot(normal, parts_[t].segments) / square;
      all.volume += share * dot(normal, local[0]) / 6;
      all.area += std::sqrt(square) / 2;
      // An estimate: coordinates were rounded once, and products of differences of them a few times.
      const double extent = std::max(norm(local[1] - local[0]), norm(local[2] - local[0]));
      const double away = max_component(max(abs(local[0]), max(abs(local[1]), abs(local[2]))));
      all.rounding += 0x1p-47 * extent * (extent + away) * away;
    }
    return all;
  }

 private:
  static constexpr int kUnknown = 1 << 30;
  struct Inside {
    Vec3 segments{0, 0, 0};
    double edge = 0;  ///< how much of the edge from corner 1 to 2, but for the winding number at corner 1
  };
  const solid::Body &body_, &other_;
  const LocalFrame& frame_;
  std::vector<Inside> parts_;
};

/// Appends where the border of one triangle crosses another.
void find_crossings(const Triangle& border, const Triangle& t, const LocalFrame& frame, std::vector<Crossing>& found,
                    bool& is_plain) {
  const Triangle plane = frame.to_local(t);
  const Vec3 normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Vec3 &from = border[edge], &to = border[(edge + 1) % 3];
    const int way = crossing_way(from, to, t, is_plain);
    if (way == 0) continue;
    // From the lesser end, so that the triangles on both sides of the edge find the same point.
    const bool is_turned = std::tie(to.x, to.y, to.z) < std::tie(from.x, from.y, from.z);
    const Vec3 p = frame.to_local(is_turned ? to : from), q = frame.to_local(is_turned ? from : to);
    const double h = dot(normal, p - plane[0]), k = dot(normal, q - plane[0]);
    const double along = h == k ? 0.5 : std::clamp(h / (h - k), 0.0, 1.0);
    found.push_back({edge, way > 0, is_turned ? 1 - along : along, p + along * (q - p)});
  }
}

/// Nothing unless the two are in general position.
std::optional<Overlap> overlap_in_general_position(const solid::Body& a, const solid::Body& b,
                                                   const std::stop_token& stop) {
  const LocalFrame frame = local_frame(intersection(a.box, b.box), intersection(a.box, b.box));
  Side side_a(a, b, frame), side_b(b, a, frame);
  std::vector<Crossing> of_a, of_b;
  for (const TrianglePair& pair : touching_pairs(a, b, stop)) {
    const Triangle ta = a.triangle(pair.a), tb = b.triangle(pair.b);
    bool is_plain = true;
    of_a.clear(), of_b.clear();
    find_crossings(ta, tb, frame, of_a, is_plain);
    find_crossings(tb, ta, frame, of_b, is_plain);
    if (!is_plain) {
      if (exact::classify(ta, tb)) return std::nullopt;
      continue;
    }
    if (of_a.size() + of_b.size() != 2) continue;  // apart
    side_a.add(pair.a, of_a, of_b), side_b.add(pair.b, of_b, of_a);
  }
  const auto in_b = side_a.sum(stop), in_a = side_b.sum(stop);
  if (!in_a || !in_b) return std::nullopt;
  const double unit = 1 / frame.unit, cube = unit * unit * unit;
  // Negative where one of the two is inside out.
  return Overlap{std::abs(in_a->volume + in_b->volume) * cube, (in_a->rounding + in_b->rounding) * cube,
                 std::min(in_a->area, in_b->area) * unit * unit};
}

// Flush faces and shared edges are no general position, but volume is as good beside it: b is shifted by a little, in a
// direction that is parallel to nothing that people draw. The volume changes by no more than what the smaller surface
// sweeps.
std::optional<OverlapVolume> volume_of_two(const solid::Body& a, const solid::Body& b, const std::stop_token& stop) {
  const Box common = intersection(a.box, b.box);
  if (is_empty(common)) return OverlapVolume{};
  const double largest = std::max(largest_coordinate(a.box), largest_coordinate(b.box));
  const double size = std::max(0x1p-30 * norm(common.hi - common.lo), 0x1p-40 * largest);
  constexpr std::array<Vec3, 4> kDirections{
      {{.6180, .5257, .4142}, {-.4494, .7321, .3028}, {.7071, -.3596, .5642}, {-.5403, -.4161, .6456}}};
  for (const Vec3& direction : kDirections) {
    if (stop.stop_requested()) break;
    hierarchy::PlacedTree shifted = b.placed;
    const Vec3 shift = size * direction;
    shifted.pose.t = {shifted.pose.t[0] + shift.x, shifted.pose.t[1] + shift.y, shifted.pose.t[2] + shift.z};
    const auto found = overlap_in_general_position(a, solid::make_body(shifted), stop);
    // The vertices were rounded anew, each to 2^-49 of the largest coordinate.
    if (found) return OverlapVolume{found->volume, found->rounding + found->area * (size + 0x1p-49 * largest)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<OverlapVolume> overlap_volume(const PlacedPart& a, const PlacedPart& b, const std::stop_token& stop) {
  OverlapVolume sum;
  for (const PlacedPiece& p : a.pieces) {
    for (const PlacedPiece& q : b.pieces) {
      if (p.part_class != PartClass::solid || q.part_class != PartClass::solid) continue;
      const auto found = volume_of_two(p.body, q.body, stop);
      if (!found) return std::nullopt;
      sum.volume += found->volume, sum.error += found->error;
    }
  }
  return sum;
}

}  // namespace impinge::clash
