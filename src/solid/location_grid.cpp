// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "solid/location_grid.hpp"

#include <algorithm>
#include <cmath>

#include "solid/locate.hpp"

namespace impinge::solid {
namespace {

/// Cells for each triangle, so that a fine surface leaves most of them empty, and the most along an axis.
constexpr double kCellsPerTriangle = 8, kMostCells = 256;

}  // namespace

LocationGrid::LocationGrid(const Body& body) : placed_(body.placed), box_(body.box) {
  // Near to cubes.
  const Vec3 size = box_.hi - box_.lo;
  const Vec3 share = (1 / max_component(size)) * size;
  const double filled = std::max(share.x * share.y * share.z, 0x1p-40);
  const double along = std::cbrt(kCellsPerTriangle * static_cast<double>(body.size()) / filled);
  const auto cells = [&](double part) { return std::clamp(std::floor(along * part), 1.0, kMostCells); };
  const Vec3 number{cells(share.x), cells(share.y), cells(share.z)};
  const auto per_length = [](double n, double length) { return std::isfinite(n / length) ? n / length : 0; };
  per_length_ = {per_length(number.x, size.x), per_length(number.y, size.y), per_length(number.z, size.z)};
  size_ = {static_cast<std::size_t>(number.x), static_cast<std::size_t>(number.y), static_cast<std::size_t>(number.z)};
  cells_.assign(size_[0] * size_[1] * size_[2], unknown);
  occupy(body);
  std::vector<Place> ahead;
  for (std::size_t i = 0; i < size_[0]; ++i)
    for (std::size_t j = 0; j < size_[1]; ++j)
      for (std::size_t k = 0; k < size_[2]; ++k)
        if (cells_[index({i, j, k})] == unknown) fill({i, j, k}, ahead);
}

/// The cell of a point in the box. Along an axis its number never falls as the coordinate grows, since a difference, a
/// product and a floor do not fall either. So a triangle that meets the box of two
/// points, both of one cell or of two that share a side, has its lowest place no higher than the higher cell's and its
/// highest no lower than the lower one's: it occupies one of the two. Whatever was rounded, points of such cells that
/// are not occupied have no triangle between them, and the body winds as often around both.
LocationGrid::Place LocationGrid::place(const Vec3& p) const {
  const auto along = [&](double x, double from, double per_length, std::size_t size) {
    return std::min(static_cast<std::size_t>((x - from) * per_length), size - 1);
  };
  return {along(p.x, box_.lo.x, per_length_.x, size_[0]), along(p.y, box_.lo.y, per_length_.y, size_[1]),
          along(p.z, box_.lo.z, per_length_.z, size_[2])};
}

void LocationGrid::occupy(const Body& body) {
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const Box box = box_of(body.triangle(t));
    const Place low = place(box.lo), high = place(box.hi);
    for (std::size_t i = low[0]; i <= high[0]; ++i)
      for (std::size_t j = low[1]; j <= high[1]; ++j)
        std::fill_n(cells_.begin() + static_cast<std::ptrdiff_t>(index({i, j, low[2]})), high[2] - low[2] + 1,
                    occupied);
  }
}

/// Asks whether a cell is inside, and marks all unknown cells that are connected to it through common sides alike. A
/// cell whose middle, as computed, lies outside of the cell counts as occupied.
void LocationGrid::fill(const Place& at, std::vector<Place>& ahead) {
  const auto middle = [](std::size_t i, double from, double per_length) {
    return per_length > 0 ? from + (static_cast<double>(i) + 0.5) / per_length : from;
  };
  const Vec3 point{middle(at[0], box_.lo.x, per_length_.x), middle(at[1], box_.lo.y, per_length_.y),
                   middle(at[2], box_.lo.z, per_length_.z)};
  cells_[index(at)] = occupied;
  if (!overlap({point, point}, box_) || place(point) != at) return;
  const std::optional<int> winding = winding_number(placed_, point);
  if (!winding) return;
  const Cell cell = *winding != 0 ? inside : outside;
  cells_[index(at)] = cell;
  ahead.assign(1, at);
  while (!ahead.empty()) {
    const Place here = ahead.back();
    ahead.pop_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool up : {false, true}) {
        Place next = here;
        if (up ? next[axis] + 1 == size_[axis] : next[axis] == 0) continue;
        next[axis] += up ? 1 : -1;
        Cell& other = cells_[index(next)];
        if (other == unknown) other = cell, ahead.push_back(next);
      }
  }
}

std::optional<bool> LocationGrid::winds_around(const Vec3& point) const {
  if (!overlap({point, point}, box_)) return false;
  const Cell cell = cells_[index(place(point))];
  if (cell != occupied) return cell == inside;
  const std::optional<int> winding = winding_number(placed_, point);
  return winding ? std::optional(*winding != 0) : std::nullopt;
}

}  // namespace impinge::solid
