// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/regions/shared_parts.hpp"

#include <algorithm>

#include "clash/regions/shared_within.hpp"
#include "core/stopped.hpp"

namespace impinge::clash {

void SharedParts::add_vertex(const Corner& corner) {
  std::uint64_t& last = vertex_rows_[corner.edges];
  if (last == 0 || corners_[last >> kSizeBits].point != corner.point) {
    last = corners_.size() << kSizeBits | 1;
    corners_.push_back(corner);
  }
  rows_.push_back(last);
}

void SharedParts::append(const SharedParts& others) {
  const std::uint64_t shift = corners_.size() << kSizeBits;
  for (const std::uint64_t row : others.rows_) rows_.push_back(row + shift);
  corners_.insert(corners_.end(), others.corners_.begin(), others.corners_.end());
  widen_gap(others.gap_);
}

SharedParts shared_parts(const solid::Body& a, const solid::Body& b, std::span<const exact::Contact> contacts,
                         const Reach& reach, const ForEach& for_each, const std::stop_token& stop) {
  constexpr std::size_t kChunk = 1024;
  const SharedWithinSetting near{local_frame(a.box, b.box), reach.tolerance, reach.resolution};
  std::vector<SharedParts> pieces((contacts.size() + kChunk - 1) / kChunk);
  run_each(for_each, pieces.size(), [&](std::size_t i) {
    throw_if_stopped(stop);
    for (const exact::Contact& pair : contacts.subspan(i * kChunk, std::min(kChunk, contacts.size() - i * kChunk))) {
      const Triangle of_a = a.triangle(pair.a), of_b = b.triangle(pair.b);
      if (reach.tolerance > 0) {
        const SharedWithin part = shared_within(of_a, of_b, near);
        pieces[i].add({part.shared.corners.data(), part.shared.size});
        pieces[i].widen_gap(part.gap);
      } else if (const auto vertex = common_vertex(of_a, of_b)) {
        pieces[i].add_vertex(*vertex);
      } else {
        const SharedPart part = shared_part(of_a, of_b);
        pieces[i].add({part.corners.data(), part.size});
      }
    }
  });
  SharedParts parts;
  parts.reserve(contacts.size());
  for (SharedParts& piece : pieces) {
    throw_if_stopped(stop);
    parts.append(piece);
    piece = {};
  }
  return parts;
}

}  // namespace impinge::clash
