// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/tolerance_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "report/review.hpp"

namespace impinge::report {
namespace {

/// Of fewer pairs than these nothing is said, as the table shows as much: 5, or a tenth of what fails.
constexpr std::size_t kLeastPairs = 5, kLeastShare = 10;
/// How many times the length before it the length after a gap is. Of lengths at random, ten to a decade, one in 150
/// (e^-5) is followed by a gap of half a decade.
constexpr double kWide = 3;

/// The least number of two digits above a length.
double round_up(double length) {
  const int power = static_cast<int>(std::floor(std::log10(length))) - 1;
  for (int digits = 10;; ++digits) {
    const std::string text = fmt::format("{}e{}", digits, power);
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    if (rounded > length) return rounded;
  }
}

/// No |world coordinate| is larger.
double largest_coordinate(const Assembly& assembly) {
  double largest = 0;
  for (const io::Object& object : assembly.objects) {
    const Point center = world_vertex(object.pose, object.mesh.sphere_center());
    const double farthest = std::max({std::fabs(center.x), std::fabs(center.y), std::fabs(center.z)});
    largest = std::max(largest, farthest + object.mesh.sphere_radius());
  }
  return largest;
}

}  // namespace

std::optional<ToleranceAdvice> advise_tolerance(std::span<const Reach> failing, double least) {
  const auto most = [](const Reach& reach) { return std::max(reach.fails_below, reach.depth); };
  std::vector<Reach> excused;
  std::ranges::copy_if(
      failing, std::back_inserter(excused), [](double t) { return std::isfinite(t); }, &Reach::fails_below);
  std::ranges::sort(excused, {}, most);
  const double deepest = excused.empty() ? 0 : most(excused.back());
  double above = std::numeric_limits<double>::infinity();  // the least length after a gap
  for (const Reach& reach : failing)
    if (std::isinf(reach.fails_below) && reach.depth > deepest) above = std::min(above, reach.depth);

  std::optional<ToleranceAdvice> advice;
  double widest = kWide;
  for (std::size_t i = excused.size(); i >= std::max(kLeastPairs, failing.size() / kLeastShare); --i) {
    const double before = std::max(most(excused[i - 1]), least), gap = std::isfinite(above) ? above / before : 0;
    if (gap >= widest) widest = gap, advice = ToleranceAdvice{round_up(before), i};
    above = std::min(above, excused[i - 1].fails_below);
  }
  return advice;
}

std::optional<ToleranceAdvice> advise_tolerance(const Review& review) {
  const FailOn& fail_on = review.options.fail_on;
  if (!review.plan.tests().empty() || !fail_on.penetration || !fail_on.inside || fail_on.contact || fail_on.clearance)
    return std::nullopt;
  std::vector<Reach> failing;
  // Below the first tolerances are raised. The automatic one is of each pair, and what it excuses must stay excused.
  double least = 0x1p-42 * largest_coordinate(review.assembly);
  for (std::size_t i = 0; i < review.clashes.pairs.size(); ++i) {
    const Clash& pair = review.clashes.pairs[i];
    least = std::max(least, pair.tolerance);
    if (review.standings[i].fails) failing.push_back({pair.fails_below, depth_of(pair.overlap_depth).hi});
  }
  return least > 0 ? advise_tolerance(failing, least) : std::nullopt;
}

}  // namespace impinge::report
