// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/cut_triangle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/number.hpp"

namespace impinge::solid {
namespace {

using exact::integer;
using exact::lowest_bit_of;
using Int = exact::Integer;
using IntPoint = std::array<Int, 3>;

/// A piece with so few traces near it is not divided any further.
constexpr std::size_t kFew = 12;

Int dot(const IntPoint& p, const IntPoint& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
IntPoint difference(const IntPoint& p, const IntPoint& q) { return {p[0] - q[0], p[1] - q[1], p[2] - q[2]}; }
IntPoint cross(const IntPoint& p, const IntPoint& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// A number as its first digits, in [1, 2), and an exponent; relatively within 2^-52.
struct Digits {
  double fraction = 0;
  int exponent = 0;
};
Digits digits_of(const Int& x) {
  if (x.is_zero()) return {};
  const auto* const limbs = x.backend().limbs();
  const unsigned n = x.backend().size();
  constexpr int kBits = std::numeric_limits<boost::multiprecision::limb_type>::digits;
  // The highest limb may hold a single bit; the next one has enough.
  const double high = static_cast<double>(limbs[n - 1]), low = n > 1 ? static_cast<double>(limbs[n - 2]) : 0;
  int exponent = 0;
  const double fraction = 2 * std::frexp(high + std::ldexp(low, -kBits), &exponent);
  return {x.sign() < 0 ? -fraction : fraction, exponent - 1 + kBits * static_cast<int>(n - 1)};
}

/// x / w, relatively within 2^-50 but where it is below 2^-1000.
double quotient(const Int& x, const Digits& w) {
  const Digits digits = digits_of(x);
  return std::ldexp(digits.fraction / w.fraction, digits.exponent - w.exponent);
}

}  // namespace

CutTriangle::CutTriangle(const Triangle& triangle, std::span<const Triangle> shared, std::span<const Triangle> cutting)
    : origin_(triangle[0]) {
  unit_ = lowest_bit_of(triangle, std::numeric_limits<int>::max());
  for (const auto& others : {shared, cutting})
    for (const Triangle& other : others) unit_ = lowest_bit_of(other, unit_);
  const std::array corners{on_grid(triangle[0]), on_grid(triangle[1]), on_grid(triangle[2])};
  normal_ = cross(corners[1], corners[2]);  // the first is the origin
  for (int axis = 0; axis < 3; ++axis)
    if (abs(normal_[axis]) > abs(normal_[w_])) w_ = axis;
  u_ = (w_ + 1) % 3, v_ = (w_ + 2) % 3;
  Piece whole;
  for (std::size_t i = 0; i < 3; ++i)
    whole.push_back({line(corners[i], corners[(i + 1) % 3]), normal_[w_].sign(), corner(corners[i])});

  std::vector<Trace> traces;
  for (const Triangle& other : shared) traces.push_back(trace_of_coplanar(other));
  for (const Triangle& other : cutting) traces.push_back(trace_of_crossing(other));
  std::vector<const Trace*> all;
  for (const Trace& trace : traces)
    if (!trace.corners.empty()) all.push_back(&trace);
  divide(std::move(whole), all, 2 * static_cast<int>(std::bit_width(all.size() / kFew)));
}

CutTriangle::IntPoint CutTriangle::on_grid(const Vec3& p) const {
  return {integer(p.x, unit_) - integer(origin_.x, unit_), integer(p.y, unit_) - integer(origin_.y, unit_),
          integer(p.z, unit_) - integer(origin_.z, unit_)};
}

CutTriangle::Corner CutTriangle::corner(Int u, Int v, Int w) {
  if (w < 0) u = -u, v = -v, w = -w;
  const Digits digits = digits_of(w);
  const std::array rounded{quotient(u, digits), quotient(v, digits)};
  return {std::move(u), std::move(v), std::move(w), rounded};
}

CutTriangle::Corner CutTriangle::corner(const IntPoint& p) const { return corner(p[u_], p[v_], 1); }

CutTriangle::Corner CutTriangle::meeting(const Line& p, const Line& q) {
  return corner(p.b * q.c - q.b * p.c, p.c * q.a - q.c * p.a, p.a * q.b - q.a * p.b);
}

const CutTriangle::Line* CutTriangle::line(Int a, Int b, Int c) {
  const std::array digits{digits_of(a), digits_of(b), digits_of(c)};
  const int largest = std::max({digits[0].exponent, digits[1].exponent, digits[2].exponent});
  std::array<double, 3> rounded{};
  for (std::size_t i = 0; i < 3; ++i) rounded[i] = std::ldexp(digits[i].fraction, digits[i].exponent - largest);
  return &lines_.emplace_back(Line{std::move(a), std::move(b), std::move(c), rounded});
}

const CutTriangle::Line* CutTriangle::line(const IntPoint& from, const IntPoint& to) {
  Int a = from[v_] - to[v_], b = to[u_] - from[u_];
  Int c = -(a * from[u_] + b * from[v_]);
  return line(std::move(a), std::move(b), std::move(c));
}

// Three products of numbers that are each within 2^-50 of the exact ones, but for what is below 2^-1000, and two sums:
// 2^-48 of the sum of their sizes is more than three times what they are off.
int CutTriangle::side(const Line& line, const Corner& p) {
  const double a = line.rounded[0] * p.rounded[0], b = line.rounded[1] * p.rounded[1], c = line.rounded[2];
  const double value = a + b + c;
  const double nothing = 0x1p-900 * (1 + std::abs(p.rounded[0]) + std::abs(p.rounded[1]));
  const double bound = 0x1p-48 * (std::abs(a) + std::abs(b) + std::abs(c)) + nothing;
  if (std::abs(value) > bound) return value > 0 ? 1 : -1;
  return Int(line.a * p.u + line.b * p.v + line.c * p.w).sign();
}

std::vector<int> CutTriangle::sides_if_cut(const Piece& piece, const Line& line) {
  std::vector<int> sides;
  sides.reserve(piece.size());
  bool above = false, below = false;
  for (const Edge& edge : piece) {
    sides.push_back(side(line, edge.from));
    above |= sides.back() > 0, below |= sides.back() < 0;
  }
  if (!above || !below) sides.clear();
  return sides;
}

CutTriangle::Piece CutTriangle::part_of(const Piece& piece, const Line& line, int side, const std::vector<int>& sides) {
  Piece part;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Edge& edge = piece[i];
    const int from = sides[i] * side, to = sides[(i + 1) % piece.size()] * side;
    if (from > 0 || (from == 0 && to > 0)) part.push_back(edge);
    if (from < 0 && to > 0) part.push_back({edge.line, edge.side, meeting(*edge.line, line)});
    if (from == 0 && to < 0) part.push_back({&line, side, edge.from});
    if (from > 0 && to < 0) part.push_back({&line, side, meeting(*edge.line, line)});
  }
  return part;
}

CutTriangle::Bounds CutTriangle::grown(Bounds bounds, const Corner& corner) {
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = corner.rounded[i], off = 0x1p-49 * std::abs(x) + 0x1p-900;
    bounds.lo[i] = std::min(bounds.lo[i], x - off), bounds.hi[i] = std::max(bounds.hi[i], x + off);
  }
  return bounds;
}

CutTriangle::Bounds CutTriangle::bounds_of(const Piece& piece) {
  Bounds bounds = kNowhere;
  for (const Edge& edge : piece) bounds = grown(bounds, edge.from);
  return bounds;
}

CutTriangle::Trace CutTriangle::trace_of_coplanar(const Triangle& triangle) {
  const std::array points{on_grid(triangle[0]), on_grid(triangle[1]), on_grid(triangle[2])};
  Trace trace{{}, {}, 0, kNowhere};
  for (std::size_t i = 0; i < 3; ++i) {
    trace.corners.push_back(corner(points[i]));
    trace.lines.push_back(line(points[i], points[(i + 1) % 3]));
    trace.bounds = grown(trace.bounds, trace.corners.back());
  }
  trace.inner = side(*trace.lines[0], trace.corners[2]);
  return trace;
}

// With the origin in the triangle's plane n . x = 0, the other's m . x = d meets it where, n_w times the second less
// m_w times the first, (n_w m_u - m_w n_u) u + (n_w m_v - m_w n_v) v = n_w d.
CutTriangle::Trace CutTriangle::trace_of_crossing(const Triangle& triangle) {
  const std::array points{on_grid(triangle[0]), on_grid(triangle[1]), on_grid(triangle[2])};
  const std::array heights{dot(normal_, points[0]), dot(normal_, points[1]), dot(normal_, points[2])};
  Trace trace{{}, {}, 0, kNowhere};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const IntPoint &p = points[i], &q = points[j];
    if (heights[i].is_zero()) trace.corners.push_back(corner(p));
    if (heights[i].sign() * heights[j].sign() < 0)
      trace.corners.push_back(corner(heights[i] * q[u_] - heights[j] * p[u_], heights[i] * q[v_] - heights[j] * p[v_],
                                     heights[i] - heights[j]));
  }
  for (const Corner& end : trace.corners) trace.bounds = grown(trace.bounds, end);
  const IntPoint m = cross(difference(points[1], points[0]), difference(points[2], points[0]));
  const Int &n = normal_[w_], d = dot(m, points[0]);
  trace.lines = {line(n * m[u_] - m[w_] * normal_[u_], n * m[v_] - m[w_] * normal_[v_], -n * d)};
  return trace;
}

/// Halves the piece, so that each trace is tested against pieces near it only. Where there are many traces, the piece
/// is cut between them as well, which does no harm.
void CutTriangle::divide(Piece piece, const std::vector<const Trace*>& traces, int depth) {
  const Bounds bounds = bounds_of(piece);
  std::vector<const Trace*> near;
  for (const Trace* const trace : traces)
    if (overlap(bounds, trace->bounds)) near.push_back(trace);
  if (depth > 0 && near.size() > kFew) {
    const std::size_t axis = bounds.hi[0] - bounds.lo[0] < bounds.hi[1] - bounds.lo[1] ? 1 : 0;
    const Line* const between = line_between(near, axis);
    if (const std::vector<int> sides = sides_if_cut(piece, *between); !sides.empty()) {
      divide(part_of(piece, *between, 1, sides), near, depth - 1);
      return divide(part_of(piece, *between, -1, sides), near, depth - 1);
    }
  }
  std::vector<Piece> pieces;
  pieces.push_back(std::move(piece));
  for (const Trace* const trace : near) trace->inner != 0 ? take_out(*trace, pieces) : split(*trace, pieces);
  std::move(pieces.begin(), pieces.end(), std::back_inserter(pieces_));
}

/// A line across an axis with half of the traces' centres on either side.
const CutTriangle::Line* CutTriangle::line_between(const std::vector<const Trace*>& traces, std::size_t axis) {
  std::vector<double> centers;
  centers.reserve(traces.size());
  for (const Trace* const trace : traces)
    centers.push_back(0.5 * trace->bounds.lo[axis] + 0.5 * trace->bounds.hi[axis]);
  const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
  std::nth_element(centers.begin(), middle, centers.end());
  const int unit = *middle != 0 ? std::min(0, lowest_bit(*middle)) : 0;
  const Int along = Int(1) << -unit, at = -integer(*middle, unit);
  return axis == 0 ? line(along, 0, at) : line(0, along, at);
}

/// Pieces, triangles and chords are convex: the interior of a piece meets a chord, or the interior of a triangle,
/// unless an edge of one has all of the other on its outer side.
bool CutTriangle::meets_inside(const Piece& piece, const Trace& trace) {
  if (!overlap(bounds_of(piece), trace.bounds)) return false;
  for (const Edge& edge : piece)
    if (std::all_of(trace.corners.begin(), trace.corners.end(),
                    [&](const Corner& p) { return side(*edge.line, p) * edge.side <= 0; }))
      return false;
  if (trace.inner == 0) return true;
  return std::none_of(trace.lines.begin(), trace.lines.end(), [&](const Line* line) {
    return std::all_of(piece.begin(), piece.end(),
                       [&](const Edge& edge) { return side(*line, edge.from) * trace.inner <= 0; });
  });
}

void CutTriangle::take_out(const Trace& trace, std::vector<Piece>& pieces) const {
  std::vector<Piece> left;
  for (Piece& piece : pieces) {
    if (!meets_inside(piece, trace)) {
      left.push_back(std::move(piece));
      continue;
    }
    for (const Line* const edge : trace.lines) {  // the part beyond an edge is kept; the rest goes on to the next edge
      const std::vector<int> sides = sides_if_cut(piece, *edge);
      if (sides.empty()) continue;
      left.push_back(part_of(piece, *edge, -trace.inner, sides));
      piece = part_of(piece, *edge, trace.inner, sides);
    }
  }
  pieces = std::move(left);
}

void CutTriangle::split(const Trace& trace, std::vector<Piece>& pieces) const {
  std::vector<Piece> parts;
  for (Piece& piece : pieces) {
    const std::vector<int> sides =
        meets_inside(piece, trace) ? sides_if_cut(piece, *trace.lines[0]) : std::vector<int>{};
    if (sides.empty()) {
      parts.push_back(std::move(piece));
    } else {
      parts.push_back(part_of(piece, *trace.lines[0], 1, sides));
      parts.push_back(part_of(piece, *trace.lines[0], -1, sides));
    }
  }
  pieces = std::move(parts);
}

bool CutTriangle::holds(const Piece& piece, const Corner& p) {
  return std::all_of(piece.begin(), piece.end(), [&](const Edge& edge) { return side(*edge.line, p) * edge.side > 0; });
}

std::vector<exact::RationalPoint> CutTriangle::corners(std::size_t i) const {
  std::vector<exact::RationalPoint> points;
  for (const Edge& edge : pieces_[i]) points.push_back(in_space(edge.from));
  return points;
}

// The mean of the rounded corners has few digits, and is inside unless the piece is a sliver; the exact mean of the
// first three corners, which are not collinear, always is.
exact::RationalPoint CutTriangle::point_in(std::size_t i) const {
  const Piece& piece = pieces_[i];
  double u = 0, v = 0;
  for (const Edge& edge : piece) u += edge.from.rounded[0], v += edge.from.rounded[1];
  u /= static_cast<double>(piece.size()), v /= static_cast<double>(piece.size());
  const int unit = std::min({0, u != 0 ? lowest_bit(u) : 0, v != 0 ? lowest_bit(v) : 0});
  const Corner mean = corner(integer(u, unit), integer(v, unit), Int(1) << -unit);
  if (holds(piece, mean)) return in_space(mean);
  const Corner &p = piece[0].from, &q = piece[1].from, &r = piece[2].from;
  const Int pq = p.w * q.w, qr = q.w * r.w, rp = r.w * p.w;
  return in_space(corner(p.u * qr + q.u * rp + r.u * pq, p.v * qr + q.v * rp + r.v * pq, 3 * pq * r.w));
}

exact::RationalPoint CutTriangle::in_space(const Corner& p) const {
  const auto in_world = [&](const Int& numerator, const Int& denominator, double origin) {
    const exact::Rational step = unit_ >= 0 ? exact::Rational(numerator << unit_, denominator)
                                            : exact::Rational(numerator, denominator << -unit_);
    return exact::Rational(origin) + step;
  };
  exact::RationalPoint point;
  point[u_] = in_world(p.u, p.w, component(origin_, u_));
  point[v_] = in_world(p.v, p.w, component(origin_, v_));
  // The last coordinate follows from n . x = 0.
  const Int& n = normal_[w_];
  const Int rest = -(normal_[u_] * p.u + normal_[v_] * p.v);
  point[w_] =
      n > 0 ? in_world(rest, n * p.w, component(origin_, w_)) : in_world(-rest, -n * p.w, component(origin_, w_));
  return point;
}

}  // namespace impinge::solid
