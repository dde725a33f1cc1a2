// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/written.hpp"

namespace impinge::report {
namespace {

void add(WrittenRemarks& written, const Point& place, const Remark& remark) {
  if (remark.is_empty()) return;
  written.regions.push_back({{place.x, place.y, place.z}, {remark.status, remark.comment}});
}

}  // namespace

WrittenRemarks written_about(const Previous::Pair& pair) {
  WrittenRemarks written{pair.remark.status, pair.remark.comment, {}};
  for (const Previous::OldRegion& region : pair.regions) add(written, region.centroid, region.remark);
  return written;
}

WrittenRemarks written_about(const Resolved& resolved) {
  WrittenRemarks written{resolved.remark.status, resolved.remark.comment, {}};
  for (const Resolved& region : resolved.regions) add(written, region.centroid.value_or(Point{}), region.remark);
  return written;
}

}  // namespace impinge::report
