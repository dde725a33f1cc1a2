// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/region_measures.hpp"

#include <algorithm>

#include "clash/regions/lines.hpp"
#include "clash/regions/split.hpp"
#include "core/stopped.hpp"

namespace impinge::clash {
namespace {

/// Opposite directions cancel if no more than this share of their lengths is left.
constexpr double kCancelled = 1e-6;
/// Directions are equal, and planes parallel, up to this sine.
constexpr double kFlat = 1e-9;

/// A power of two near a length, so that products of lengths neither over- nor underflow.
double unit_of(double length) { return length > 0 ? std::ldexp(1.0, std::ilogb(length)) : 1; }

Vec3 unit(Vec3 v) {
  const double largest = max_component(abs(v));
  if (!(largest > 0)) return {0, 0, 0};
  v = (1 / unit_of(largest)) * v;
  const double length = norm(v);
  return {v.x / length, v.y / length, v.z / length};
}

/// The outward unit normal; 0 for a triangle without area.
Vec3 outward_normal(const solid::Part& part, std::uint32_t i) {
  const Triangle t = part.body.triangle(i);
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const double scale = 1 / unit_of(std::max(max_component(abs(u)), max_component(abs(v))));
  const Vec3 n = unit(cross(scale * u, scale * v));
  return part.is_inward(i) ? -1.0 * n : n;
}

/// A weighted mean of points.
struct Mean {
  double weight = 0;
  Vec3 sum{0, 0, 0};

  void add(double w, const Vec3& x) { weight += w, sum = sum + w * x; }
  [[nodiscard]] Vec3 value() const { return (1 / weight) * sum; }
};

/// Half the sum of r x dr along a closed line: the normal of a plane line, as long as its area. `about` is a point near
/// it.
Vec3 vector_area(std::span<const Vec3> points, const Vec3& about) {
  Vec3 twice{0, 0, 0};
  for (std::size_t i = 1; i < points.size(); ++i) twice = twice + cross(points[i - 1] - about, points[i] - about);
  return 0.5 * twice;
}

void add_lengths(std::span<const Vec3> points, Mean& mean) {
  for (std::size_t i = 1; i < points.size(); ++i)
    mean.add(norm(points[i] - points[i - 1]), 0.5 * (points[i - 1] + points[i]));
}

/// Works in coordinates about the middle of the region's box, in a unit near its size.
class Measures {
 public:
  Measures(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
           const SharedParts& parts, std::span<const std::uint32_t> members, double within, const std::stop_token& stop)
      : a_(a), b_(b), contacts_(contacts), parts_(parts), members_(members), within_(within), stop_(stop) {}

  Region region() {
    list_triangles();
    find_box();
    for (const std::uint32_t i : members_) {
      throw_if_stopped(stop_);
      add(contacts_[i], parts_[i]);
    }
    split_lines();
    std::vector<Polyline> lines = joined(lines_without_borders(), stop_);
    for (const Polyline& line : lines) add_crossing(line);
    std::vector<Polyline> outlines = joined(outline(), stop_);
    for (std::vector<Polyline>* some : {&lines, &outlines})
      for (Polyline& line : *some) {
        add_lengths(local(line.points), length_);
        region_.lines.push_back(std::move(line.points));
      }
    conclude();
    return std::move(region_);
  }

 private:
  [[nodiscard]] Vec3 local(const Vec3& p) const { return (1 / unit_) * (p - origin_); }

  static void keep_each_once(std::vector<std::uint32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  void list_triangles() {
    region_.pairs = members_.size();
    std::vector<std::uint32_t>&of_a = region_.triangles_a, &of_b = region_.triangles_b;
    for (const std::uint32_t i : members_) {  // in the order of a's
      throw_if_stopped(stop_);
      if (of_a.empty() || of_a.back() != contacts_[i].a) of_a.push_back(contacts_[i].a);
      of_b.push_back(contacts_[i].b);
      if (of_b.size() > 2 * b_.body.size()) keep_each_once(of_b);
    }
    keep_each_once(of_b);
  }

  void find_box() {
    Vec3 lo{kInfinity, kInfinity, kInfinity}, hi{-kInfinity, -kInfinity, -kInfinity};
    for (const std::uint32_t i : members_)
      for (const Corner& corner : parts_[i]) lo = min(lo, corner.point), hi = max(hi, corner.point);
    region_.box = {lo, hi};
    origin_ = 0.5 * lo + 0.5 * hi;
    unit_ = unit_of(max_component(hi - lo));
  }

  void add(const exact::Contact& pair, std::span<const Corner> corners) {
    const Vec3 normal_a = outward_normal(a_, pair.a), normal_b = outward_normal(b_, pair.b);
    if (corners.size() > 2) return add_polygon(corners, 0.5 * (normal_a - normal_b));
    for (const Corner& corner : corners)
      if (points_.empty() || points_.back() != corner.point) points_.push_back(corner.point);
    double weight = 1;
    if (corners.size() == 2) {
      const Vec3 &p = corners[0].point, &q = corners[1].point;
      weight = norm(local(q) - local(p));
      pieces_.push_back(piece(p, q, weight * flow(normal_a, normal_b, q - p)));
    }
    Normals& normals = corners.size() == 2 ? of_lines_ : of_points_;
    normals.a.add(weight, normal_a);
    normals.b.add(weight, normal_b);
  }

  /// +1 if the part of a's surface inside b is on the left of the direction `way`, seen from outside a; -1 if it is on
  /// the right; 0 if that is not certain. Where an edge of a only touches b, the flows of its two triangles cancel.
  static double flow(const Vec3& normal_a, const Vec3& normal_b, const Vec3& way) {
    const Vec3 along = cross(normal_a, normal_b);
    if (!(norm(along) > kFlat)) return 0;
    const double step = dot(along, unit(way));
    return step > 0 ? 1 : step < 0 ? -1 : 0;
  }

  void add_polygon(std::span<const Corner> corners, const Vec3& direction) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i <= corners.size(); ++i) {
      points.push_back(local(corners[i % corners.size()].point));
      if (i == 0) continue;
      const Piece border = piece(corners[i - 1].point, corners[i % corners.size()].point);
      if (border.from != border.to) borders_.push_back(border);
    }
    add_area(points, direction);
  }

  /// Adds the area that a closed line spans: triangles from the line's middle, weighted by their share in the whole.
  void add_area(std::span<const Vec3> points, const Vec3& direction) {
    Mean border;
    add_lengths(points, border);
    if (!(border.weight > 0)) return;
    const Vec3 middle = border.value(), whole = vector_area(points, middle);
    const double area = norm(whole);
    if (!(area > 0)) return;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double share = dot(vector_area(points.subspan(i - 1, 2), middle), whole) / area;
      area_.add(share, (1.0 / 3) * (middle + points[i - 1] + points[i]));
    }
    direction_ = direction_ + area * direction;
  }

  [[nodiscard]] std::vector<Vec3> local(std::span<const Vec3> points) const {
    std::vector<Vec3> result;
    for (const Vec3& p : points) result.push_back(local(p));
    return result;
  }

  void add_crossing(const Polyline& line) {
    if (!line.closed() || line.flow == 0) return;
    const std::vector<Vec3> points = local(line.points);
    const Vec3 way = unit(vector_area(points, points[0]));
    add_area(points, line.flow > 0 ? way : -1.0 * way);
  }

  /// Splits pieces that overlap in part, as where triangles end within others' edges. The ends of exact pieces are off
  /// by half an ulp in each coordinate: a point and a line together by less than 2^-51 of the largest.
  void split_lines() {
    std::vector<Vec3> ends;
    for (const std::vector<Piece>* some : {&pieces_, &borders_})
      for (const Piece& piece : *some) ends.insert(ends.end(), {piece.from, piece.to});
    if (ends.size() <= 2) return;
    const double rounding = 0x1p-51 * max_component(max(abs(region_.box[0]), abs(region_.box[1])));
    const Splitter splitter(std::move(ends), {origin_, unit_, std::max(rounding, within_) / unit_, stop_});
    const bool were_moved = within_ > 0;
    pieces_ = were_moved ? splitter.split_closely(std::move(pieces_), merged) : splitter.split(pieces_);
    borders_ = were_moved ? splitter.split_closely(std::move(borders_), thinned) : splitter.split(borders_);
  }

  /// The pieces that are on no polygon's border: those on one belong to the area or its outline already.
  std::vector<Piece> lines_without_borders() {
    std::sort(borders_.begin(), borders_.end(), until_stopped(stop_, is_before));
    std::erase_if(pieces_,
                  [&](const Piece& x) { return std::binary_search(borders_.begin(), borders_.end(), x, is_before); });
    return std::move(pieces_);
  }
  /// The outline of the area: inside it each border belongs to an even number of polygons.
  std::vector<Piece> outline() {
    std::vector<Piece> result;
    for (std::size_t begin = 0, end = 0; begin < borders_.size(); begin = end) {
      while (end < borders_.size() && !is_before(borders_[begin], borders_[end])) ++end;
      if ((end - begin) % 2 != 0) result.push_back(borders_[begin]);
    }
    return result;
  }

  struct Normals {
    Mean a, b;
    /// Where only one of the two surfaces is flat, its normal is the direction.
    [[nodiscard]] Vec3 direction() const {
      const auto is_flat = [](const Mean& m) { return norm(m.sum) >= (1 - kFlat) * m.weight; };
      if (is_flat(a) != is_flat(b)) return is_flat(a) ? a.sum : -1.0 * b.sum;
      return a.sum - b.sum;
    }
  };

  void conclude() {
    std::sort(points_.begin(), points_.end(), until_stopped(stop_, less));
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    Mean points;
    for (const Vec3& p : points_) points.add(1, local(p));
    const bool has_area = area_.weight > 0, has_length = length_.weight > 0;
    const Mean& mean = has_area ? area_ : has_length ? length_ : points;
    region_.area = unit_ * unit_ * area_.weight;
    region_.length = unit_ * length_.weight;
    if (mean.weight > 0) region_.centroid = origin_ + unit_ * mean.value();
    const Normals& normals = of_lines_.a.weight > 0 ? of_lines_ : of_points_;
    const Vec3 direction = has_area ? direction_ : normals.direction();
    const double weight = has_area ? area_.weight : normals.a.weight;
    // An area is off by the distance over which its outline moved.
    const double off = has_area ? within_ / unit_ * length_.weight : 0;
    region_.normal = norm(direction) > kCancelled * weight + off ? unit(direction) : Vec3{0, 0, 0};
  }

  const solid::Part &a_, &b_;
  std::span<const exact::Contact> contacts_;
  const SharedParts& parts_;
  std::span<const std::uint32_t> members_;
  double within_;
  const std::stop_token& stop_;
  Region region_;
  Vec3 origin_{};
  double unit_ = 1;
  std::vector<Piece> pieces_, borders_;  ///< of pairs that share a segment, and of the borders of polygons
  std::vector<Vec3> points_;
  Mean area_, length_;
  Vec3 direction_{0, 0, 0};
  Normals of_lines_, of_points_;
};

}  // namespace

Region measured(const solid::Part& a, const solid::Part& b, std::span<const exact::Contact> contacts,
                const SharedParts& parts, std::span<const std::uint32_t> members, double within,
                const std::stop_token& stop) {
  return Measures(a, b, contacts, parts, members, within, stop).region();
}

}  // namespace impinge::clash
