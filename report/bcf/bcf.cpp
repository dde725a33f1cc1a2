// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "report/bcf/bcf_xml.hpp"
#include "report/bcf/snapshot.hpp"
#include "report/bcf/zip.hpp"
#include "report/share.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

Scenery scenery_of(const Review& review, const Clash& clash, const Place& place) {
  Scenery scenery;
  for (std::size_t side = 0; side < 2; ++side) {
    const io::Object& object = review.assembly.objects[clash.objects[side]];
    for (const Point& vertex : object.mesh.vertices())
      scenery.parts[side].vertices.push_back(world_vertex(object.pose, vertex));
    scenery.parts[side].triangles = object.mesh.triangles();
  }
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

/// The three files of a topic's folder.
std::array<Member, 3> files_of(const Review& review, std::size_t pair, std::size_t rank) {
  const Clash& clash = review.clashes.pairs[pair];
  const Place place = place_of(review, pair);
  const Scenery scenery = scenery_of(review, clash, place);
  const Conventions conventions = conventions_of(review.options, review.assembly);
  const auto radius = [&](std::size_t side) {
    return review.assembly.objects[clash.objects[side]].mesh.sphere_radius();
  };
  const View view = clearest(scenery, views_of(place, {radius(0), radius(1)}, conventions.y_up));
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
  share(topics.pairs.size(), review.options.threads, [&](std::size_t i) {
    if (stop.stop_requested()) return;
    std::array<Member, 3> files = files_of(review, topics.pairs[i], i + 1);
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
