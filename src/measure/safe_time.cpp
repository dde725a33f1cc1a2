// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "measure/safe_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/shapes.hpp"
#include "exact/triangle_pair.hpp"
#include "measure/pair_queue.hpp"
#include "measure/pair_walk.hpp"
#include "measure/triangle_distance.hpp"

namespace impinge::measure {
namespace {

/// Makes of a number that is rounded a few times a bound.
constexpr double kUp = 1 + 0x1p-40, kDown = 1 - 0x1p-40;

/// Points of a body, all within a sphere.
struct Ball {
  Vec3 center, velocity;  ///< of the centre
  double radius, speed;   ///< of the fastest point
};

double radius_of(const hierarchy::TreeRef& ref) {
  if (ref.is_leaf()) {
    const float* const half = ref.leaf().half;
    return norm({half[0], half[1], half[2]});
  }
  const hierarchy::WideNode& node = ref.node();
  std::array<double, 3> most{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::uint32_t lane = 0; lane < node.size; ++lane)
      most[i] = std::max(most[i], std::abs(double{node.center[i][lane]}) + double{node.half[i][lane]});
  return norm({most[0], most[1], most[2]});
}

/// How fast the points of a body are.
class Speeds {
 public:
  explicit Speeds(const MovingTree& moving)
      : twist_(moving.twist), unit_(std::ldexp(1.0, moving.body.tree->unit_exponent())) {
    const Pose& pose = moving.body.pose;
    const Vec3& t = translation_ = {pose.t[0], pose.t[1], pose.t[2]};
    rotation_ = to_mat3(pose.R);
    const Mat3 columns = transpose(rotation_);
    Mat3 turned;
    for (std::size_t i = 0; i < 3; ++i) turned[i] = cross(twist_.angular, columns[i]);
    map_ = transpose(turned);
    origin_ = twist_.linear + cross(twist_.angular, t);
    turning_ = norm(twist_.angular) * kUp;
    // The body's points are a little beside where the motion has them, and products are rounded.
    place_error_ = 0x1p-40 * (norm(t) + sum(moving.body.mesh->max_abs));
    error_ = twist_.error + turning_ * place_error_;
  }

  /// A node's points as a sphere. A frame's radius is that of the largest coordinate; frames are orthonormal to 2^-20,
  /// and poses to 1e-6.
  [[nodiscard]] Ball of(const hierarchy::TreeRef& ref) const {
    const hierarchy::Frame& frame = frame_of(ref);
    const Vec3 middle = unit_ * Vec3{frame.origin[0], frame.origin[1], frame.origin[2]};
    const double radius = unit_ * radius_of(ref) * (1 + 0x1p-17);
    Ball ball{rotation_ * middle + translation_, map_ * middle + origin_, radius, 0};
    ball.speed = norm(ball.velocity) * kUp + turning_ * radius + error_;
    return ball;
  }
  /// Of a point of the world.
  [[nodiscard]] Vec3 at(const Vec3& x) const { return twist_.linear + cross(twist_.angular, x); }
  /// How fast the velocity of a point turns, at most.
  [[nodiscard]] double turning_of(const Vec3& velocity) const {
    return norm(cross(twist_.angular, velocity)) * kUp + turning_ * error_;
  }
  /// The same of a sphere's points.
  [[nodiscard]] double turning_of(const Ball& ball) const {
    return turning_of(ball.velocity) + turning_ * turning_ * ball.radius;
  }
  /// How much faster than its centre a sphere's points are along a direction.
  [[nodiscard]] double spread_along(const Vec3& n, const Ball& ball) const {
    return norm(cross(n, twist_.angular)) * kUp * ball.radius;
  }
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] double place_error() const { return place_error_; }

 private:
  const Twist& twist_;
  double unit_, turning_, error_, place_error_;
  Mat3 rotation_, map_;        ///< `map_` is of a point of the mesh, to its velocity
  Vec3 translation_, origin_;  ///< the velocity of the mesh's origin
};

/// How long c + b s - a s² / 2, with a >= 0, stays positive.
double time_above_zero(double a, double b, double c) {
  if (!(c > 0)) return 0;
  // The same of all three multiplied by a power of two: no square overflows, for places are below 2^300.
  if (std::max({a, std::abs(b), c}) > 0x1p500) a *= 0x1p-600, b *= 0x1p-600, c *= 0x1p-600;
  const double root = std::sqrt(b * b + 2 * a * c);
  if (b <= 0) return 2 * c / (root - b);  // infinite where nothing moves
  return a > 0 ? (root + b) / a : kInfinity;
}

class TimeSearch {
 public:
  TimeSearch(const PairWalk& walk, const Speeds& a, const Speeds& b, const Approach& approach, PairMemory& memory)
      : walk_(walk), a_(a), b_(b), approach_(approach), memory_(memory), limit_(approach.within) {}

  SafeTime run(LimitingPair& last, const std::stop_token& stop) {
    LimitingPair first = last;
    if (walk_.is_swapped()) std::swap(first.triangle_a, first.triangle_b);
    test(first.triangle_a, first.triangle_b);
    const bool is_whole = search_pairs(
        walk_, memory_, limit_, stop, [this](NodePair& pair) { return search_or_open(pair); },
        [this] { return !(limit_ > 0); });
    if (!is_whole) return {};
    SafeTime safe{limit_ * kDown, limiting_.has_value(), {}};
    if (!limiting_) return safe;
    if (walk_.is_swapped())
      std::swap(limiting_->a, limiting_->b), std::swap(limiting_->triangle_a, limiting_->triangle_b);
    last = {limiting_->triangle_a, limiting_->triangle_b};
    const bool is_near = limiting_->distance + limiting_->error <= approach_.tolerance;
    if (limiting_->distance == 0 || (is_near && limiting_way_ <= approach_.tolerance)) safe.met = limiting_;
    return safe;
  }

 private:
  /// A pair of such a speed limits the time if it is nearer.
  [[nodiscard]] double reach_at(double speed) const { return (approach_.slack + limit_ * speed) * kUp; }
  /// Until a pair that is so far apart may have met.
  [[nodiscard]] double time_over(double distance, double speed) const {
    const double way = distance - approach_.slack;
    return way > 0 ? way / speed * kDown : 0;
  }

  /// Whether it was two leaves. A pair's `lower` is its time here.
  bool search_or_open(NodePair& pair) {
    std::vector<NodePair>& children = memory_.children;
    walk_.reach(pair);
    const Ball a = a_.of(pair.a), b = b_.of(pair.b);
    const double speed = a.speed + b.speed;
    children.clear();
    if (time_between(a, b) >= limit_) return false;
    if (pair.a.is_leaf() && pair.b.is_leaf()) {
      search_leaves(pair, speed);
      return true;
    }
    walk_.open(pair, reach_at(speed), children);
    for (NodePair& child : children) child.lower = time_over(child.lower, speed);
    return false;
  }

  void search_leaves(const NodePair& pair, double speed) {
    std::vector<NearTriangles>& near = memory_.near;
    walk_.open_leaves(pair, reach_at(speed), Wanted::all, near);
    const auto is_near = [&](const NearTriangles& candidate) {
      return limit_ > 0 && walk_.world_length(candidate.lower) <= reach_at(speed);
    };
    nearest_first(near, is_near, [&](const NearTriangles& candidate) {
      test(pair.a.leaf().ids()[candidate.a], pair.b.leaf().ids()[candidate.b]);
    });
  }

  void test(std::uint32_t id_a, std::uint32_t id_b) {
    const Triangle a = world_triangle(walk_.a(), id_a), b = world_triangle(walk_.b(), id_b);
    if (overlap(box_of(a), box_of(b)) && exact::classify(a, b)) {
      const auto [p, q] = common_point(a, b);
      limit_ = 0, limiting_ = {0, 0, p, q, id_a, id_b}, limiting_way_ = 0;
      return;
    }
    Triangle velocity_a, velocity_b;
    double speed_a = 0, speed_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      velocity_a[i] = a_.at(a[i]), speed_a = std::max(speed_a, norm(velocity_a[i]));
      velocity_b[i] = b_.at(b[i]), speed_b = std::max(speed_b, norm(velocity_b[i]));
    }
    const double speed = (speed_a + speed_b) * kUp + a_.error() + b_.error();
    const double reach = reach_at(speed);
    const Vec3 guess = limiting_ ? limiting_->b - limiting_->a : Vec3{0, 0, 0};
    TriangleDistance d = triangle_distance(a, b, reach, guess);
    if (d.lower > reach) return;
    if (!std::isfinite(d.distance)) d = triangle_distance(a, b, kInfinity);  // the guess tells no points
    const double over = time_over(d.lower, speed);
    if (!(over < limit_)) return;
    const double along = std::max(over, time_along(d.b - d.a, a, velocity_a, b, velocity_b));
    const double time = std::max(over, std::min(along, kShort));
    if (!(time < limit_)) return;
    // They share no point, even if the distance was rounded to 0.
    limiting_ = {std::max(d.distance, std::numeric_limits<double>::denorm_min()), d.margin, d.a, d.b, id_a, id_b};
    limit_ = time, limiting_way_ = along * speed;
  }

  /// How long two spheres stay apart along the line of their centres, as triangles do below.
  [[nodiscard]] double time_between(const Ball& a, const Ball& b) const {
    const Vec3 way = b.center - a.center;
    const double length = norm(way);
    const double gap =
        length * kDown - (a.radius + b.radius) * kUp - approach_.slack - a_.place_error() - b_.place_error();
    if (!(gap > 0)) return 0;
    const Vec3 n = (1 / length) * way;
    const double fast = (norm(a.velocity) + norm(b.velocity)) * 0x1p-48 + a_.error() + b_.error();
    const double opening =
        dot(n, b.velocity) - dot(n, a.velocity) - a_.spread_along(n, a) - b_.spread_along(n, b) - fast;
    return time_above_zero(a_.turning_of(a) + b_.turning_of(b), opening, gap) * kDown;
  }

  /// How long the triangles stay apart along a fixed direction. The place of a corner along it changes by its velocity
  /// and, in the time s, by at most half of s² times how fast that turns; of triangles the corners are the farthest.
  [[nodiscard]] double time_along(const Vec3& direction, const Triangle& a, const Triangle& velocity_a,
                                  const Triangle& b, const Triangle& velocity_b) const {
    const double length = norm(direction);
    if (!(length > 0) || !std::isfinite(length)) return 0;
    const Vec3 n = (1 / length) * direction;
    double size = 0;
    std::array<double, 3> place_a, place_b;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 of_a = a[i] - a[0], of_b = b[i] - a[0];
      place_a[i] = dot(n, of_a), place_b[i] = dot(n, of_b);
      size = std::max({size, norm(of_a), norm(of_b)});
    }
    // Differences and products are off by less than 8 u of their size, and n's length by 4 u.
    const double kept = (approach_.slack + 0x1p-48 * size) * kUp;
    double time = kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const double turning = a_.turning_of(velocity_a[i]) + b_.turning_of(velocity_b[j]);
        const double fast = (norm(velocity_a[i]) + norm(velocity_b[j])) * 0x1p-48 + a_.error() + b_.error();
        const double opening = dot(n, velocity_b[j]) - dot(n, velocity_a[i]) - fast;
        time = std::min(time, time_above_zero(turning, opening, place_b[j] - place_a[i] - kept));
      }
    }
    return time * kDown;
  }

  /// Along a direction two triangles may have much more time than their distance over their speed. Of pairs that are
  /// farther apart than they go in that time there may be very many, all of which would have to be looked at. So it
  /// counts up to this part of the whole way, where it saves most: what slides by closely needs few steps.
  static constexpr double kShort = 0x1p-8;

  const PairWalk& walk_;
  const Speeds &a_, &b_;
  const Approach& approach_;
  PairMemory& memory_;
  double limit_;  ///< later times are of no interest
  std::optional<NearestPair> limiting_{};
  double limiting_way_ = 0;  ///< how far the pair can go
};

}  // namespace

SafeTime safe_time(const MovingTree& a, const MovingTree& b, const Approach& approach, LimitingPair& last,
                   const SearchMeans& means) {
  const PairWalk walk(a.body, b.body, means.for_each);
  const Speeds of_a(walk.is_swapped() ? b : a), of_b(walk.is_swapped() ? a : b);
  std::optional<PairMemory> own;
  PairMemory& memory = means.memory != nullptr ? *means.memory : own.emplace();
  return TimeSearch(walk, of_a, of_b, approach, memory).run(last, means.stop);
}

}  // namespace impinge::measure
