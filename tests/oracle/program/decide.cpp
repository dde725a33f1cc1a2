// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "decide.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "../rational.hpp"

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;

struct Element {
  std::uint32_t object, triangle;
  std::array<Point, 3> corners;
  bool proper;
};

Corners corners_of(const WorldTriangle& t) {
  Corners corners;
  for (const auto& v : t) corners.push_back(vec(v[0], v[1], v[2]));
  return simplified(corners);
}

Corners corners_of(const Element& element) {
  Corners corners;
  for (const Point& p : element.corners) corners.push_back(vec(p.x(), p.y(), p.z()));
  return simplified(corners);
}

/// Signs of the corners of `of` against the plane of `plane`.
std::array<int, 3> sides(const Element& plane, const Element& of) {
  std::array<int, 3> result{};
  const auto& p = plane.corners;
  for (std::size_t i = 0; i < 3; ++i) result[i] = static_cast<int>(CGAL::orientation(p[0], p[1], p[2], of.corners[i]));
  return result;
}

bool straddles(const std::array<int, 3>& s) {
  return *std::min_element(s.begin(), s.end()) < 0 && *std::max_element(s.begin(), s.end()) > 0;
}

/// An edge of `a`, with its ends strictly on either side of the plane of `b` (`a_sides`), goes through the open
/// triangle `b`. Then `a` has interior points in the open triangle `b` as near that place as wanted, so the pair is
/// crossing.
bool edge_pierces(const Element& a, const Element& b, const std::array<int, 3>& a_sides) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (a_sides[i] * a_sides[j] >= 0) continue;
    const auto turn = [&](std::size_t k) {
      return CGAL::orientation(a.corners[i], a.corners[j], b.corners[k], b.corners[(k + 1) % 3]);
    };
    const auto first = turn(0);
    if (first != CGAL::COPLANAR && turn(1) == first && turn(2) == first) return true;
  }
  return false;
}

std::optional<Meeting> decide(const Element& a, const Element& b, Counts& counts) {
  ++counts.candidates;
  if (!a.proper || !b.proper) {  // CGAL's tests ask for proper triangles
    ++counts.rationals;
    return meeting(corners_of(a), corners_of(b));
  }
  if (!CGAL::do_intersect(Triangle(a.corners[0], a.corners[1], a.corners[2]),
                          Triangle(b.corners[0], b.corners[1], b.corners[2]))) {
    return std::nullopt;
  }
  const auto a_sides = sides(b, a);
  if (a_sides == std::array<int, 3>{0, 0, 0}) return Meeting::coplanar;
  const auto b_sides = sides(a, b);
  // A triangle on one closed side of the other's plane, but not in it, has no inner point in that plane.
  if (!straddles(a_sides) || !straddles(b_sides)) return Meeting::touching;
  if (edge_pierces(a, b, a_sides) || edge_pierces(b, a, b_sides)) return Meeting::crossing;
  ++counts.rationals;
  return meeting(corners_of(a), corners_of(b));
}

std::vector<Element> elements_of(const std::vector<WorldObject>& objects) {
  std::vector<Element> elements;
  for (std::uint32_t o = 0; o < objects.size(); ++o)
    for (std::uint32_t t = 0; t < objects[o].triangles.size(); ++t) {
      const WorldTriangle& w = objects[o].triangles[t];
      const auto point = [&](std::size_t i) { return Point(w[i][0], w[i][1], w[i][2]); };
      Element element{o, t, {point(0), point(1), point(2)}, false};
      element.proper = !CGAL::collinear(element.corners[0], element.corners[1], element.corners[2]);
      elements.push_back(element);
    }
  return elements;
}

using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Element*>;

std::vector<Box> boxes_of(const std::vector<Element>& elements, std::uint32_t from, std::uint32_t to) {
  std::vector<Box> boxes;
  for (const Element& element : elements)
    if (element.object >= from && element.object < to) {
      const auto& c = element.corners;
      boxes.emplace_back(c[0].bbox() + c[1].bbox() + c[2].bbox(), &element);
    }
  return boxes;
}

bool compared(const std::vector<WorldObject>& objects, std::uint32_t a, std::uint32_t b) {
  return a != b && (objects[a].group == 0 || objects[a].group != objects[b].group);
}

Contact contact(std::uint32_t object_a, std::uint32_t object_b, std::uint32_t a, std::uint32_t b, Meeting kind) {
  return {object_a, object_b, a, b, static_cast<std::uint32_t>(kind)};
}

}  // namespace

std::vector<Contact> contacts_of(const std::vector<WorldObject>& objects, Counts& counts) {
  const std::vector<Element> elements = elements_of(objects);
  std::vector<Contact> contacts;
  const auto visit = [&](const Box& box_a, const Box& box_b) {
    const Element* a = box_a.handle();
    const Element* b = box_b.handle();
    if (!compared(objects, a->object, b->object)) return;
    if (a->object > b->object) std::swap(a, b);
    if (const auto kind = decide(*a, *b, counts))
      contacts.push_back(contact(a->object, b->object, a->triangle, b->triangle, *kind));
  };
  if (objects.size() == 2) {
    auto first = boxes_of(elements, 0, 1);
    auto second = boxes_of(elements, 1, 2);
    CGAL::box_intersection_d(first.begin(), first.end(), second.begin(), second.end(), visit);
  } else {
    auto all = boxes_of(elements, 0, static_cast<std::uint32_t>(objects.size()));
    CGAL::box_self_intersection_d(all.begin(), all.end(), visit);
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

std::vector<Contact> contacts_by_rationals(const std::vector<WorldObject>& objects) {
  std::vector<std::vector<Corners>> shapes;
  for (const WorldObject& object : objects) {
    auto& of_object = shapes.emplace_back();
    for (const WorldTriangle& triangle : object.triangles) of_object.push_back(corners_of(triangle));
  }
  std::vector<Contact> contacts;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
    for (std::uint32_t j = i + 1; j < objects.size(); ++j) {
      if (!compared(objects, i, j)) continue;
      for (std::uint32_t a = 0; a < shapes[i].size(); ++a)
        for (std::uint32_t b = 0; b < shapes[j].size(); ++b)
          if (const auto kind = meeting(shapes[i][a], shapes[j][b])) contacts.push_back(contact(i, j, a, b, *kind));
    }
  return contacts;
}

}  // namespace oracle
