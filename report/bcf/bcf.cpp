// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string_view>

#include "report/bcf/bcf_xml.hpp"
#include "report/bcf/snapshot.hpp"
#include "report/bcf/zip.hpp"
#include "report/share.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

Placed placed(const io::Object& object) {
  Placed part{{}, object.mesh.triangles()};
  part.vertices.reserve(object.mesh.vertices().size());
  for (const Point& vertex : object.mesh.vertices()) part.vertices.push_back(world_vertex(object.pose, vertex));
  return part;
}

Scenery scenery_of(const Review& review, const Clash& clash, const Place& place) {
  Scenery scenery;
  for (std::size_t side = 0; side < 2; ++side)
    scenery.parts[side] = placed(review.assembly.objects[clash.objects[side]]);
  if (clash.verdict == Verdict::inside && clash.inner >= 0) scenery.glass = static_cast<std::size_t>(1 - clash.inner);
  for (const Region& region : clash.regions) {
    scenery.lines.insert(scenery.lines.end(), region.lines.begin(), region.lines.end());
    if (region.lines.empty()) scenery.lines.push_back({region.centroid});
  }
  if (clash.nearest && clash.regions.empty()) {
    scenery.lines.push_back({clash.nearest->a, clash.nearest->b});
    scenery.lines.push_back({clash.nearest->a});
    scenery.lines.push_back({clash.nearest->b});
  }
  if (scenery.lines.empty()) scenery.lines.push_back({place.at});
  return scenery;
}

/// Adds the parts near the clash, of the storeys that its two parts are in if they are in some: cut open above the
/// clash, or below if it is looked at from there, and before it. The boxes are those of all objects.
void add_surroundings(const Review& review, std::span<const Bounds> boxes, const Clash& clash, const Place& place,
                      const View& view, bool y_up, Scenery& scenery) {
  constexpr std::size_t kMostTriangles = 50'000;
  const std::vector<io::Object>& objects = review.assembly.objects;
  const auto& [a, b] = clash.objects;
  const std::array<std::string_view, 2> storeys{property_of(objects[a], "storey"), property_of(objects[b], "storey")};
  const bool has_storey = !storeys[0].empty() || !storeys[1].empty();
  const Point target = middle(place.box.lo, place.box.hi);
  const double radius = view.distance * std::sin(kFieldOfView / 2 * std::numbers::pi / 180);
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    const Bounds& box = boxes[i];
    if (i == a || i == b || box.is_empty()) continue;
    const Point nearest{std::clamp(target.x, box.lo.x, box.hi.x), std::clamp(target.y, box.lo.y, box.hi.y),
                        std::clamp(target.z, box.lo.z, box.hi.z)};
    constexpr double kSeen = 4;  // in radii: the picture's corners, and what is behind the clash
    const double distance = length(nearest - target);
    if (!(distance < kSeen * radius)) continue;
    if (has_storey && std::ranges::find(storeys, property_of(objects[i], "storey")) == storeys.end()) continue;
    near.emplace_back(distance, i);
  }
  std::ranges::sort(near);
  std::size_t triangles = 0;
  for (const auto& [distance, i] : near) {
    const std::size_t more = objects[i].mesh.triangle_count();
    if (triangles + more > kMostTriangles) continue;
    triangles += more;
    scenery.around.push_back(placed(objects[i]));
  }
  const Point up = y_up ? Point{0, 1, 0} : Point{0, 0, 1}, lid = dot(view.forward, up) < 0 ? up : -1.0 * up;
  const double high = std::max(dot(lid, place.box.lo), dot(lid, place.box.hi));
  scenery.kept = {{lid, high + radius / 2}, {-1.0 * view.forward, radius / 2 - dot(view.forward, target)}};
}

/// The three files of a topic's folder.
std::array<Member, 3> files_of(const Review& review, std::span<const Bounds> boxes, std::size_t pair,
                               std::size_t rank) {
  const Clash& clash = review.clashes.pairs[pair];
  const Place place = place_of(review, boxes, pair);
  Scenery scenery = scenery_of(review, clash, place);
  const Conventions conventions = conventions_of(review.options, review.assembly);
  const auto radius = [&](std::size_t side) {
    return review.assembly.objects[clash.objects[side]].mesh.sphere_radius();
  };
  const View view = clearest(scenery, views_of(place, {radius(0), radius(1)}, conventions.y_up));
  add_surroundings(review, boxes, clash, place, view, conventions.y_up, scenery);
  const std::string& id = review.ids[pair];
  return {Member{id + "/markup.bcf", markup_of(review, pair, rank)},
          Member{id + "/viewpoint.bcfv", viewpoint_of(review, pair, view, scenery.lines, conventions)},
          Member{id + "/snapshot.png", png_of(draw(scenery, view)), false}};
}

}  // namespace

Topics topics_of(const Review& review) {
  Topics topics;
  for (const std::size_t pair : ranked(review.clashes.pairs))
    if (review.standings[pair].fails) topics.pairs.push_back(pair);
  const auto kept = static_cast<std::size_t>(std::min<std::uint64_t>(topics.pairs.size(), review.options.topics));
  topics.left_out = topics.pairs.size() - kept;
  topics.pairs.resize(kept);
  return topics;
}

Result<void> write_bcf(Sink& sink, const Review& review, const Topics& topics, const std::function<void()>& done) {
  const std::stop_token& stop = review.options.stop;
  const BcfVersion version = review.options.bcf_version;
  std::vector<Member> members(3 * topics.pairs.size());
  const std::vector<Bounds> boxes = topics.pairs.empty() ? std::vector<Bounds>() : boxes_of(review);
  share(topics.pairs.size(), review.options.threads, [&](std::size_t i) {
    if (stop.stop_requested()) return;
    std::array<Member, 3> files = files_of(review, boxes, topics.pairs[i], i + 1);
    std::move(files.begin(), files.end(), members.begin() + 3 * static_cast<std::ptrdiff_t>(i));
    done();
  });
  if (stop.stop_requested()) return interrupted();
  if (!review.assembly.skipped.empty())
    members.insert(members.begin(), {guid_of_skipped(review) + "/markup.bcf", markup_of_skipped(review)});
  members.insert(members.begin(), {"bcf.version", version_document(version)});
  if (version == BcfVersion::v3_0)
    members.insert(members.begin() + 1, {"extensions.xml", extensions_document(review, topics.pairs)});
  return write_zip(sink, members, stop);
}

}  // namespace impinge::report
