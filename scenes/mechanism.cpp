// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "scenes/glb.hpp"

namespace impinge::scenes {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Flat snapped(const Flat& p) { return {scenes::snapped(p[0]), scenes::snapped(p[1])}; }

/// A bar from its origin to (length, 0), rounded off by half hexagons.
Loop bar(double length, double half_width) {
  const double w = scenes::snapped(half_width), d = scenes::snapped(half_width / 2);
  return {{-d, -w}, {length + d, -w}, {length + w, 0}, {length + d, w}, {-d, w}, {-w, 0}};
}

Loop rectangle(double x, double y) { return {{-x, -y}, {x, -y}, {x, y}, {-x, y}}; }

FlatPart still(std::string name, Loop outline, const Flat& place) {
  return {std::move(name), std::move(outline), 0, 1, {0}, {0}, {place}};
}

/// Teeth of a quarter of the pitch at their tips and half of it at their feet; with a phase of 0 one looks along +x.
Loop gear(int teeth, double tip, double foot, double phase) {
  Loop outline;
  for (int i = 0; i < teeth; ++i) {
    const auto corner = [&](double share, double radius) {
      const double angle = kTurn * (i + share + phase) / teeth;
      outline.push_back(snapped({radius * std::cos(angle), radius * std::sin(angle)}));
    };
    corner(-0.25, foot), corner(-0.125, tip), corner(0.125, tip), corner(0.25, foot);
  }
  return outline;
}

/// Turning evenly about `place`; keys are nearer than half a turn, so that the way between them is plain.
FlatPart wheel(std::string name, Loop outline, const Flat& place, double seconds, double turns) {
  FlatPart part{std::move(name), std::move(outline), 0, 1, {}, {}, {}};
  const int keys = 1 + static_cast<int>(std::ceil(8 * std::fabs(turns)));
  for (int i = 0; i < keys; ++i) {
    const double share = static_cast<double>(i) / (keys - 1);
    part.times.push_back(seconds * share), part.angles.push_back(kTurn * turns * share), part.places.push_back(place);
  }
  return part;
}

MeshData solid(const FlatPart& part) {
  Section section;
  for (std::size_t i = 0; i < part.outline.size(); ++i)
    section.fill({{0, 0}, part.outline[i], part.outline[(i + 1) % part.outline.size()]}, 0);
  return extruded(section, part.low, part.high);
}

}  // namespace

std::vector<FlatPart> four_bar_linkage(double seconds) {
  constexpr double kGround = 6, kCrank = 2, kCoupler = 6, kRocker = 4;
  constexpr int kKeys = 721;
  FlatPart crank{"crank", bar(kCrank, 0.25), 0, 1, {}, {}, {}};
  FlatPart coupler{"coupler", bar(kCoupler, 0.25), 1.5, 2.5, {}, {}, {}};
  FlatPart rocker{"rocker", bar(kRocker, 0.25), 0, 1, {}, {}, {}};
  for (int i = 0; i < kKeys; ++i) {
    const double angle = kTurn * i / (kKeys - 1);
    const Flat pin{kCrank * std::cos(angle), kCrank * std::sin(angle)};
    // The rocker's pin: at the coupler's length from the crank's, and at its own from the ground's, on the left of the
    // way from the first to the second.
    const double dx = kGround - pin[0], dy = -pin[1], apart = std::hypot(dx, dy);
    const double along = (kCoupler * kCoupler - kRocker * kRocker + apart * apart) / (2 * apart);
    const double aside = std::sqrt(kCoupler * kCoupler - along * along);
    const Flat end{pin[0] + (along * dx - aside * dy) / apart, pin[1] + (along * dy + aside * dx) / apart};
    for (FlatPart* const part : {&crank, &coupler, &rocker}) part->times.push_back(seconds * i / (kKeys - 1));
    crank.angles.push_back(angle), crank.places.push_back({0, 0});
    coupler.angles.push_back(std::atan2(end[1] - pin[1], end[0] - pin[0])), coupler.places.push_back(pin);
    rocker.angles.push_back(std::atan2(end[1], end[0] - kGround)), rocker.places.push_back({kGround, 0});
  }
  FlatPart post = still("post", rectangle(0.5, 0.5), {3, -3});
  post.high = 3;
  return {std::move(crank), std::move(coupler), std::move(rocker), std::move(post),
          still("stop", rectangle(0.25, 1), {3.75, 3})};
}

std::vector<FlatPart> gear_pair(double seconds, double distance) {
  constexpr int kSmall = 12, kLarge = 18;
  // A tooth of the one looks into a gap of the other.
  return {
      wheel("pinion", gear(kSmall, 3.5, 2.75, 0), {0, 0}, seconds, 1),
      wheel("wheel", gear(kLarge, 5.125, 4.375, 0.5), {distance, 0}, seconds, -static_cast<double>(kSmall) / kLarge)};
}

FlatPose at(const FlatPart& part, double seconds) {
  const auto after =
      static_cast<std::size_t>(std::upper_bound(part.times.begin(), part.times.end(), seconds) - part.times.begin());
  if (after == 0) return {part.angles.front(), part.places.front()};
  if (after == part.times.size()) return {part.angles.back(), part.places.back()};
  const std::size_t i = after - 1;
  const double u = (seconds - part.times[i]) / (part.times[after] - part.times[i]);
  const auto between = [u](double a, double b) { return (1 - u) * a + u * b; };
  return {between(part.angles[i], part.angles[after]),
          {between(part.places[i][0], part.places[after][0]), between(part.places[i][1], part.places[after][1])}};
}

std::string animated_glb(const std::vector<FlatPart>& parts) {
  PlacedScene scene;
  std::vector<std::string> names;
  std::vector<NodeMotion> motions;
  for (const FlatPart& part : parts) {
    NodeMotion motion{part.times, {}, {}};
    for (std::size_t i = 0; i < part.times.size(); ++i) {
      motion.rotations.push_back({0, 0, std::sin(part.angles[i] / 2), std::cos(part.angles[i] / 2)});
      motion.translations.push_back({part.places[i][0], part.places[i][1], 0});
    }
    scene.objects.push_back({static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(solid(part));
    names.push_back(part.name);
    motions.push_back(std::move(motion));
  }
  return glb_bytes(scene, names, motions);
}

}  // namespace impinge::scenes
