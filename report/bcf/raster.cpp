// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/raster.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace impinge::report {
namespace {

/// What of a triangle or a segment is farther away than `least`: up to 4 corners.
std::size_t cut(std::span<const Point> corners, double least, std::array<Point, 4>& out) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point &p = corners[i], &q = corners[(i + 1) % corners.size()];
    if (p.z >= least) out[count++] = p;
    if ((p.z >= least) != (q.z >= least) && (corners.size() > 2 || i == 0)) {
      const double t = (least - p.z) / (q.z - p.z);
      out[count] = p + t * (q - p);
      out[count++].z = least;
    }
  }
  return count;
}

struct Range {
  std::size_t first, last;  ///< the last excluded
};
/// The pixels whose middles lie between two coordinates.
Range pixels_between(double lo, double hi, std::size_t count) {
  const double most = static_cast<double>(count);
  return {static_cast<std::size_t>(std::clamp(std::ceil(lo - 0.5), 0.0, most)),
          static_cast<std::size_t>(std::clamp(std::floor(hi + 0.5), 0.0, most))};
}

/// What is 0 at two corners of a triangle and 1 at the third, and linear between them.
struct Share {
  Projected zero;
  double per_x, per_y;
  [[nodiscard]] double at(double x, double y) const { return per_x * (x - zero.x) + per_y * (y - zero.y); }
};

void fill(Layer& layer, const Lens& lens, const std::array<Projected, 3>& c, unsigned char light) {
  const Range rows =
      pixels_between(std::min({c[0].y, c[1].y, c[2].y}), std::max({c[0].y, c[1].y, c[2].y}), lens.height);
  const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
  if (rows.first >= rows.last || !(std::abs(area) > 0) || !std::isfinite(area)) return;
  const double left = std::min({c[0].x, c[1].x, c[2].x}), right = std::max({c[0].x, c[1].x, c[2].x});
  const auto share = [&](const Projected& p, const Projected& q) {
    return Share{p, (p.y - q.y) / area, (q.x - p.x) / area};
  };
  const std::array<Share, 3> shares{share(c[1], c[2]), share(c[2], c[0]), share(c[0], c[1])};
  double per_x = 0;  // how fast nearness grows
  for (std::size_t k = 0; k < 3; ++k) per_x += shares[k].per_x * c[k].nearness;
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    const double y = static_cast<double>(row) + 0.5;
    double from = left, to = right;  // where no share is negative
    for (const Share& s : shares) {
      const double here = s.at(s.zero.x, y);
      if (s.per_x > 0) from = std::max(from, s.zero.x - here / s.per_x);
      if (s.per_x < 0) to = std::min(to, s.zero.x - here / s.per_x);
    }
    const Range columns = pixels_between(from, to, lens.width);
    if (columns.first >= columns.last) continue;
    const double x = static_cast<double>(columns.first) + 0.5;
    double nearness = 0;
    for (std::size_t k = 0; k < 3; ++k) nearness += shares[k].at(x, y) * c[k].nearness;
    for (std::size_t column = columns.first; column < columns.last; ++column, nearness += per_x) {
      const std::size_t at = row * lens.width + column;
      if (static_cast<float>(nearness) <= layer.nearness[at]) continue;
      layer.nearness[at] = static_cast<float>(nearness);
      layer.shading[at] = light;
    }
  }
}

/// How much light a triangle takes: whichever side is seen, most from beside the viewer.
unsigned char light_on(const std::array<Point, 3>& corners) {
  constexpr Point kToLight{-0.35, 0.55, -0.76};
  const Point normal = unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
  return static_cast<unsigned char>(std::lround(255 * (0.42 + 0.58 * std::abs(dot(normal, kToLight)))));
}

Layer empty_layer(const Lens& lens) {
  return {std::vector<float>(lens.width * lens.height), std::vector<unsigned char>(lens.width * lens.height)};
}

/// A triangle in coordinates of the eye.
void draw(Layer& layer, const Lens& lens, const std::array<Point, 3>& corners, unsigned char light) {
  std::array<Point, 4> kept{};
  const std::size_t count = cut(corners, lens.least(), kept);
  for (std::size_t i = 2; i < count; ++i)
    fill(layer, lens, {lens.project(kept[0]), lens.project(kept[i - 1]), lens.project(kept[i])}, light);
}

/// What of a convex polygon is in a half-space (Sutherland and Hodgman).
std::vector<Point> clipped(const std::vector<Point>& polygon, const HalfSpace& kept) {
  std::vector<Point> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double beyond_p = dot(kept.normal, p) - kept.most, beyond_q = dot(kept.normal, q) - kept.most;
    if (beyond_p <= 0) inside.push_back(p);
    if ((beyond_p <= 0) != (beyond_q <= 0)) inside.push_back(p + beyond_p / (beyond_p - beyond_q) * (q - p));
  }
  return inside;
}

}  // namespace

Layer layer_of(const Placed& part, const Lens& lens) {
  Layer layer = empty_layer(lens);
  std::vector<Point> seen;
  seen.reserve(part.vertices.size());
  for (const Point& vertex : part.vertices) seen.push_back(lens.seen(vertex));
  for (const auto& triangle : part.triangles) {
    const std::array<Point, 3> corners{seen[triangle[0]], seen[triangle[1]], seen[triangle[2]]};
    draw(layer, lens, corners, light_on(corners));
  }
  return layer;
}

Layer layer_of(std::span<const Placed> parts, std::span<const HalfSpace> kept, const Lens& lens) {
  Layer layer = empty_layer(lens);
  for (const Placed& part : parts) {
    for (const auto& [a, b, c] : part.triangles) {
      std::vector<Point> polygon{part.vertices[a], part.vertices[b], part.vertices[c]};
      const std::array<Point, 3> seen{lens.seen(polygon[0]), lens.seen(polygon[1]), lens.seen(polygon[2])};
      const bool is_back = dot(cross(polygon[1] - polygon[0], polygon[2] - polygon[0]), polygon[0] - lens.view.eye) > 0;
      const unsigned char light = is_back ? 0 : light_on(seen);
      for (const HalfSpace& each : kept) polygon = clipped(polygon, each);
      for (std::size_t i = 2; i < polygon.size(); ++i)
        draw(layer, lens, {lens.seen(polygon[0]), lens.seen(polygon[i - 1]), lens.seen(polygon[i])}, light);
    }
  }
  return layer;
}

namespace {

/// Where lines are drawn.
class Marks {
 public:
  Marks(const Lens& lens, const std::array<Layer, 2>& layers, double width)
      : pixels(lens.width * lens.height), lens_(lens), layers_(layers), half_width_(width / 2) {}

  void line(Projected p, Projected q) {
    if (!shorten(p, q)) return;
    const int steps = static_cast<int>(std::ceil(std::max({std::abs(q.x - p.x), std::abs(q.y - p.y), 1.0})));
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      dot({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.nearness + t * (q.nearness - p.nearness)}, half_width_);
    }
  }
  void dot(const Projected& p) { dot(p, 3 * half_width_); }

  std::vector<unsigned char> pixels;

 private:
  void dot(const Projected& p, double radius) {
    const Range rows = pixels_between(p.y - radius, p.y + radius, lens_.height);
    const Range columns = pixels_between(p.x - radius, p.x + radius, lens_.width);
    for (std::size_t row = rows.first; row < rows.last; ++row) {
      for (std::size_t column = columns.first; column < columns.last; ++column) {
        const double x = static_cast<double>(column) + 0.5 - p.x, y = static_cast<double>(row) + 0.5 - p.y;
        if (x * x + y * y > radius * radius) continue;
        // The line lies on the parts: a hair's breadth behind them counts as before them.
        constexpr double kHair = 1.004;
        const std::size_t at = row * lens_.width + column;
        const float before = std::max(layers_[0].nearness[at], layers_[1].nearness[at]);
        const unsigned char mark = kHair * p.nearness >= static_cast<double>(before) ? kVisible : kHidden;
        pixels[at] = std::max(pixels[at], mark);
      }
    }
  }
  /// Cuts off what is far outside the picture (Liang and Barsky); false if nothing is left.
  [[nodiscard]] bool shorten(Projected& p, Projected& q) const {
    const Projected from = p, to = q;
    double first = 0, last = 1;
    const auto clip = [&](double start, double way, double most) {
      if (way == 0) return start >= -half_width_ && start <= most + half_width_;
      const double t0 = (-half_width_ - start) / way, t1 = (most + half_width_ - start) / way;
      first = std::max(first, std::min(t0, t1));
      last = std::min(last, std::max(t0, t1));
      return first <= last;
    };
    if (!clip(from.x, to.x - from.x, static_cast<double>(lens_.width))) return false;
    if (!clip(from.y, to.y - from.y, static_cast<double>(lens_.height))) return false;
    const auto at = [&](double t) {
      return Projected{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                       from.nearness + t * (to.nearness - from.nearness)};
    };
    p = at(first);
    q = at(last);
    return std::isfinite(p.x + p.y + q.x + q.y);
  }

  const Lens& lens_;
  const std::array<Layer, 2>& layers_;
  double half_width_;
};

}  // namespace

std::vector<unsigned char> marks_of(const std::vector<std::vector<Point>>& lines, const std::array<Layer, 2>& layers,
                                    const Lens& lens, double width) {
  Marks marks(lens, layers, width);
  for (const auto& line : lines) {
    if (line.size() == 1 && lens.seen(line[0]).z >= lens.least()) marks.dot(lens.project(lens.seen(line[0])));
    for (std::size_t i = 1; i < line.size(); ++i) {
      const std::array<Point, 2> ends{lens.seen(line[i - 1]), lens.seen(line[i])};
      std::array<Point, 4> kept{};
      if (cut(ends, lens.least(), kept) == 2) marks.line(lens.project(kept[0]), lens.project(kept[1]));
    }
  }
  return std::move(marks.pixels);
}

}  // namespace impinge::report
