// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "impinge/io.hpp"

namespace impinge::report {

/// Names places by the crossing of grid axes that is nearest in plan, "B/3".
///
/// A place has a name within half a bay of the crossing: between two crossings of an axis it is within half of one of
/// the two bays; beyond the last crossing half of the last bay counts.
class GridNames {
 public:
  /// After a stop some crossings are missing.
  GridNames(std::span<const io::Grid> grids, bool y_up, const std::stop_token& stop = {});

  /// A sentence on each grid that names nothing, because two of its axes cross more often than axes do.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// By the grids of these storeys; else by those of no storey; else, if these storeys have none, by those of other
  /// storeys, if they agree. Empty: the place is by no crossing, or an axis there has no tag.
  [[nodiscard]] std::string name_at(const Point& at, std::span<const std::string_view> storeys) const;

 private:
  struct Flat {
    double x, y;
  };
  /// Two axes, the number of each in its grid, and for each how far along it they cross and its direction there.
  struct Crossing {
    Flat at;
    std::array<std::uint32_t, 2> axes;
    std::array<double, 2> along;
    std::array<Flat, 2> direction;
  };
  struct Axis {
    std::string tag;
    std::uint32_t family;
    bool is_closed;
    std::vector<Flat> points;
    std::vector<double> along;  ///< for each point how far along the axis it is
    /// Where it crosses axes of each family, in order: how far along it and where.
    std::array<std::vector<std::pair<double, Flat>>, 3> crossings;
  };
  struct PlanGrid {
    std::string storey;
    std::vector<Axis> axes;
    std::vector<Crossing> crossings;  ///< by x
  };
  struct Nearest {
    bool is_outside;
    double distance;
    std::string name;
  };

  static bool cross(PlanGrid& grid, std::uint32_t i, std::uint32_t j);
  static void consider(const PlanGrid& grid, const Flat& at, std::vector<Nearest>& found);
  template <class IsWanted>
  std::optional<std::string> name_by(const Flat& at, IsWanted is_wanted) const;

  bool y_up_;
  std::vector<PlanGrid> grids_;
  std::vector<std::string> warnings_;
};

}  // namespace impinge::report
