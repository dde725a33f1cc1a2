// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "clash/shared_parts.hpp"

#include <algorithm>

namespace impinge::clash {

SharedParts shared_parts(const Side& a, const Side& b, std::span<const exact::Contact> contacts,
                         const ForEach& for_each, const std::stop_token& stop) {
  constexpr std::size_t kChunk = 1024;
  struct Piece {
    std::vector<std::uint8_t> sizes;
    std::vector<Corner> corners;
  };
  std::vector<Piece> pieces((contacts.size() + kChunk - 1) / kChunk);
  run_each(for_each, pieces.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    for (const exact::Contact& pair : contacts.subspan(i * kChunk, std::min(kChunk, contacts.size() - i * kChunk))) {
      const SharedPart part = shared_part(a.body.triangle(pair.a), b.body.triangle(pair.b));
      pieces[i].sizes.push_back(part.size);
      pieces[i].corners.insert(pieces[i].corners.end(), part.corners.begin(), part.corners.begin() + part.size);
    }
  });
  SharedParts parts;
  parts.offsets.reserve(contacts.size() + 1);
  parts.offsets.push_back(0);
  for (Piece& piece : pieces) {
    for (const std::uint8_t size : piece.sizes) parts.offsets.push_back(parts.offsets.back() + size);
    parts.corners.insert(parts.corners.end(), piece.corners.begin(), piece.corners.end());
    piece = {};
  }
  return parts;
}

}  // namespace impinge::clash
