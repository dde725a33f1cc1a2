// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/place.hpp"

#include "report/conventions.hpp"
#include "report/grid_names.hpp"
#include "report/share.hpp"

namespace impinge::report {
namespace {

Bounds bounds_of(const io::Object& object) {
  Bounds bounds;
  const auto vertices = object.mesh.vertices();
  for (const auto& triangle : object.mesh.triangles())
    for (const std::uint32_t corner : triangle) bounds.add(world_vertex(object.pose, vertices[corner]));
  return bounds;
}

}  // namespace

std::vector<Bounds> boxes_of(const Review& review) {
  std::vector<Bounds> boxes(review.assembly.objects.size());
  share(boxes.size(), review.options.threads, [&](std::size_t i) {
    if (!review.options.stop.stop_requested()) boxes[i] = bounds_of(review.assembly.objects[i]);
  });
  return boxes;
}

std::vector<std::string> axes_of(Review& review) {
  std::vector<std::string> axes(review.clashes.pairs.size());
  if (review.assembly.grids.empty()) return axes;
  const GridNames grids(review.assembly.grids, conventions_of(review.options, review.assembly).y_up,
                        review.options.stop);
  review.warnings.insert(review.warnings.end(), grids.warnings().begin(), grids.warnings().end());
  const std::vector<Bounds> boxes = boxes_of(review);
  share(axes.size(), review.options.threads, [&](std::size_t i) {
    if (review.options.stop.stop_requested()) return;
    const Place place = place_of(review, boxes, i);
    if (place.is_found) axes[i] = grids.name_at(place.at, storeys_of(review, review.clashes.pairs[i]));
  });
  return axes;
}

Place place_of(const Review& review, std::span<const Bounds> boxes, std::size_t pair) {
  const Clash& clash = review.clashes.pairs[pair];
  Place place;
  for (const Region& region : clash.regions) {
    place.box.add(region.box[0]);
    place.box.add(region.box[1]);
  }
  if (!clash.regions.empty()) {
    place.at = clash.regions.front().centroid;
    return place;
  }
  if (clash.nearest && clash.verdict == Verdict::apart) {
    place.box.add(clash.nearest->a);
    place.box.add(clash.nearest->b);
  } else if (clash.inner >= 0) {
    place.box = boxes[clash.objects[static_cast<std::size_t>(clash.inner)]];
  } else {
    place.box = shared(boxes[clash.objects[0]], boxes[clash.objects[1]]);
    place.is_found = false;
  }
  // Boxes of parts that a tolerance calls touching may have a gap between them.
  if (place.box.is_empty()) std::swap(place.box.lo, place.box.hi);
  place.at = middle(place.box.lo, place.box.hi);
  return place;
}

}  // namespace impinge::report
