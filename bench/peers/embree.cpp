// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/peers/embree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>

#include "bench/peers/common.hpp"

namespace impinge::bench {
namespace {

std::atomic<std::ptrdiff_t> bytes{0};

bool count_bytes(void*, ssize_t change, bool) {
  bytes += change;
  return true;
}

/// One thread: Embree builds and collides on the caller's own.
RTCDevice device() {
  static const RTCDevice device = [] {
    const RTCDevice made = rtcNewDevice("threads=1,set_affinity=0");
    rtcSetDeviceMemoryMonitorFunction(made, count_bytes, nullptr);
    return made;
  }();
  return device;
}

struct Vec {
  double x, y, z;
};
Vec operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// How high three points stand above a triangle's plane.
std::array<double, 3> heights(const Triangle& points, const Triangle& plane) {
  const Vec normal = cross(plane[1] - plane[0], plane[2] - plane[0]);
  return {dot(normal, points[0] - plane[0]), dot(normal, points[1] - plane[0]), dot(normal, points[2] - plane[0])};
}

bool on_one_side(const std::array<double, 3>& h) {
  return (h[0] > 0 && h[1] > 0 && h[2] > 0) || (h[0] < 0 && h[1] < 0 && h[2] < 0);
}

/// Whether the line through p and q goes through the triangle: the signs of its three edges as seen along the line.
bool line_meets(const Point& p, const Point& q, const Triangle& t) {
  const Vec along = q - p, a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const Vec m = cross(along, c);
  const double u = dot(b, m), v = -dot(a, m), w = dot(along, cross(b, a));
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

/// Triangles in one plane: apart if all of one lies beyond an edge of the other, as seen along the largest coordinate
/// of the plane's normal.
bool coplanar_triangles_meet(const Triangle& a, const Triangle& b, const Vec& normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  const auto flat = [&](const Point& p) {
    return x >= y && x >= z ? std::array{p.y, p.z} : y >= z ? std::array{p.z, p.x} : std::array{p.x, p.y};
  };
  const auto edge_separates = [&](const Triangle& t, const Triangle& other) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = flat(t[i]), q = flat(t[(i + 1) % 3]), inside = flat(t[(i + 2) % 3]);
      const auto side = [&](const std::array<double, 2>& r) {
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
      };
      const double turn = side(inside) < 0 ? -1 : 1;
      if (turn * side(flat(other[0])) < 0 && turn * side(flat(other[1])) < 0 && turn * side(flat(other[2])) < 0)
        return true;
    }
    return false;
  };
  return !edge_separates(a, b) && !edge_separates(b, a);
}

/// Edges of the one against the other, both ways round, after the planes: the way of Devillers and Guigue, with signs
/// as double arithmetic gives them.
bool triangles_meet(const Triangle& a, const Triangle& b) {
  const auto above_b = heights(a, b);
  if (on_one_side(above_b)) return false;
  const auto above_a = heights(b, a);
  if (on_one_side(above_a)) return false;
  if (above_b == std::array{0.0, 0.0, 0.0}) return coplanar_triangles_meet(a, b, cross(b[1] - b[0], b[2] - b[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (above_b[i] * above_b[j] <= 0 && line_meets(a[i], a[j], b)) return true;
    if (above_a[i] * above_a[j] <= 0 && line_meets(b[i], b[j], a)) return true;
  }
  return false;
}

/// The next float below or above, or one beyond it: cheaper than std::nextafter, as wide as one needs.
constexpr float kUlp = std::numeric_limits<float>::epsilon(), kTiny = std::numeric_limits<float>::min();
float below(double x) {
  const auto f = static_cast<float>(x);
  return f - (std::fabs(f) * kUlp + kTiny);
}
float above(double x) {
  const auto f = static_cast<float>(x);
  return f + (std::fabs(f) * kUlp + kTiny);
}

}  // namespace

struct EmbreeBody::State {
  const scenes::MeshData* data;
  std::vector<Point> vertices;
  RTCScene scene = rtcNewScene(device());
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
  std::vector<TrianglePair> pairs;

  explicit State(const scenes::MeshData& mesh) : data(&mesh) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
  }

  [[nodiscard]] Triangle triangle(std::size_t i) const {
    const std::uint32_t* corner = &data->triangles[3 * i];
    return {vertices[corner[0]], vertices[corner[1]], vertices[corner[2]]};
  }

  static void bounds(const RTCBoundsFunctionArguments* arguments) {
    const auto [p, q, r] = static_cast<const State*>(arguments->geometryUserPtr)->triangle(arguments->primID);
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = below(std::min({p.x, q.x, r.x}));
    box.lower_y = below(std::min({p.y, q.y, r.y}));
    box.lower_z = below(std::min({p.z, q.z, r.z}));
    box.upper_x = above(std::max({p.x, q.x, r.x}));
    box.upper_y = above(std::max({p.y, q.y, r.y}));
    box.upper_z = above(std::max({p.z, q.z, r.z}));
  }

  void commit() const {
    rtcCommitGeometry(geometry);
    rtcCommitScene(scene);
  }
};

EmbreeBody::EmbreeBody(const scenes::MeshData& data, const Pose& pose, Motion motion)
    : state_(std::make_unique<State>(data)) {
  State& state = *state_;
  state.vertices = placed(data, pose);
  const bool moves = motion == Motion::moving;
  if (moves) rtcSetSceneFlags(state.scene, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(state.scene, moves ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
  rtcSetGeometryBuildQuality(state.geometry, moves ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_HIGH);
  rtcSetGeometryUserPrimitiveCount(state.geometry, static_cast<unsigned>(data.triangle_count()));
  rtcSetGeometryUserData(state.geometry, &state);
  rtcSetGeometryBoundsFunction(state.geometry, State::bounds, nullptr);
  rtcCommitGeometry(state.geometry);
  rtcAttachGeometry(state.scene, state.geometry);
  rtcCommitScene(state.scene);
}

EmbreeBody::EmbreeBody(EmbreeBody&&) noexcept = default;
EmbreeBody::~EmbreeBody() = default;

void EmbreeBody::move(const Pose& pose) {
  const std::vector<double>& xyz = state_->data->xyz;
  for (std::size_t i = 0; i < state_->vertices.size(); ++i)
    state_->vertices[i] = placed(pose, {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]});
  state_->commit();
}

void EmbreeBody::deform(const scenes::MeshData& data, const Pose& pose) {
  state_->data = &data;
  move(pose);
}

std::size_t EmbreeBody::collide(const EmbreeBody& b) {
  struct Query {
    State &a, &b;
  };
  Query query{*state_, *b.state_};
  query.a.pairs.clear();
  const auto test = [](void* user, RTCCollision* candidates, unsigned count) {
    const Query& q = *static_cast<Query*>(user);
    for (const RTCCollision& c : std::span(candidates, count))
      if (triangles_meet(q.a.triangle(c.primID0), q.b.triangle(c.primID1))) q.a.pairs.push_back({c.primID0, c.primID1});
  };
  rtcCollide(query.a.scene, query.b.scene, test, &query);
  return query.a.pairs.size();
}

std::vector<TrianglePair> EmbreeBody::pairs() const { return sorted(state_->pairs); }

std::size_t EmbreeBody::bytes_held() { return static_cast<std::size_t>(bytes.load()); }

}  // namespace impinge::bench
