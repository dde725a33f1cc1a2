// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "scenes/step.hpp"
#include "support.hpp"

namespace impinge::io {

/// By the divergence theorem, about the first vertex.
inline double volume_of(const Object& object) {
  const auto points = points_of(object);
  double six = 0;
  for (const auto& [a, b, c] : triangles_of(object)) {
    const Point o = points[0];
    const auto from = [&](std::uint32_t i) { return Point{points[i].x - o.x, points[i].y - o.y, points[i].z - o.z}; };
    const Point p = from(a), q = from(b), r = from(c);
    six += p.x * (q.y * r.z - q.z * r.y) - p.y * (q.x * r.z - q.z * r.x) + p.z * (q.x * r.y - q.y * r.x);
  }
  return six / 6;
}

/// Whether as many triangles run along each edge one way as the other.
inline bool is_closed(const Object& object) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const auto& t : triangles_of(object))
    for (int k = 0; k < 3; ++k) ++ways[{t[k], t[(k + 1) % 3]}], --ways[{t[(k + 1) % 3], t[k]}];
  return std::all_of(ways.begin(), ways.end(), [](const auto& way) { return way.second == 0; });
}

struct Box {
  Point low, high;
};
inline Box box_of(const Object& object) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Point& vertex : object.mesh.vertices()) {
    const Point p = world_vertex(object.pose, vertex);
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

inline void expect_box(const Object& object, const Box& expected, double error) {
  const Box box = box_of(object);
  EXPECT_NEAR(box.low.x, expected.low.x, error) << object.name;
  EXPECT_NEAR(box.low.y, expected.low.y, error) << object.name;
  EXPECT_NEAR(box.low.z, expected.low.z, error) << object.name;
  EXPECT_NEAR(box.high.x, expected.high.x, error) << object.name;
  EXPECT_NEAR(box.high.y, expected.high.y, error) << object.name;
  EXPECT_NEAR(box.high.z, expected.high.z, error) << object.name;
}

/// A file of which lines are formatted.
class IfcFile : public scenes::Step {
 public:
  using Step::flat_axes;
  using Step::line;
  using Step::Step;
  using Step::text;

  template <class... Args>
  std::string line(fmt::format_string<Args...> text, Args&&... args) {
    return line(fmt::format(text, std::forward<Args>(args)...));
  }
  std::string related(const std::string& kind, const std::string& first, const std::string& second) {
    return line("{}('{}',$,$,$,{},{})", kind, guid(), first, second);
  }
  std::string place(const Point& at = {}) { return placement("$", axes(at)); }
  std::string body(const std::string& items) { return shape(shown(items)); }
  std::string block(double x, double y, double z) { return body(extruded(rectangle(x, y), z)); }
  std::string flat_axes(double x, double y, const std::string& direction = "$") {
    return line("IFCAXIS2PLACEMENT2D({},{})", point(x, y), direction);
  }
  /// Through points of the plane, back to the first one if it is closed.
  std::string polyline(const std::vector<std::array<double, 2>>& corners, bool is_closed = false) {
    std::vector<std::string> points;
    for (const auto& [x, y] : corners) points.push_back(point(x, y));
    if (is_closed) points.push_back(points.front());
    return line("IFCPOLYLINE(({}))", fmt::join(points, ","));
  }
  std::string map_of(const std::string& representation) {
    return line("IFCREPRESENTATIONMAP({},{})", origin, representation);
  }
  /// What the map shows by a transformation: its first and second axis, where to, its scale and its third axis.
  std::string mapped(const std::string& map, const std::string& axes = "$,$", const Point& to = {},
                     const std::string& scale = "$,$") {
    return line("IFCMAPPEDITEM({},{})", map,
                line("IFCCARTESIANTRANSFORMATIONOPERATOR3D({},{},{})", axes, point(to), scale));
  }
  /// A placement on axes, which is not read.
  std::string on_grid() { return line("IFCGRIDPLACEMENT({},$)", line("IFCVIRTUALGRIDINTERSECTION(($,$),(0.,0.,0.))")); }
  /// Lines by which the mapped item of "#9000" shows itself, on which web-ifc traps.
  [[nodiscard]] std::string shows_itself(const std::string& item) const {
    return fmt::format(
        "#9000=IFCREPRESENTATIONMAP({},#9001);\n"
        "#9001=IFCSHAPEREPRESENTATION({},'Body','MappedRepresentation',({}));\n",
        origin, context, item);
  }
  /// The text with lines of their own numbers at its end.
  [[nodiscard]] std::string text(const std::string& more) const {
    std::string text = Step::text();
    return text.insert(text.find("ENDSEC;\nEND-"), more);
  }
};

inline Model read_ifc(const scenes::Step& step) { return read_text(step.text(), "case.ifc"); }

inline std::string good_text() {
  IfcFile file;
  file.solid("box", file.extruded(file.rectangle(1, 1), 1));
  return file.text();
}

}  // namespace impinge::io
