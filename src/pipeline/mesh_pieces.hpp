// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

#include "clash/reach.hpp"
#include "impinge/clash.hpp"
#include "impinge/mesh.hpp"

namespace impinge {

/// What a mesh is as a part, found once in its own frame, wherever its objects stand.
struct MeshPieces {
  struct Piece {
    std::optional<Mesh> mesh;  ///< its triangles, turned; nothing: those of the whole mesh
    solid::ClassedPiece found;
  };
  std::vector<Piece> pieces;
  /// The triangles of all pieces, turned, where they are others than the mesh's.
  std::optional<Mesh> boundary;
  PartFacts facts;                                                      ///< edges in the mesh's own frame
  std::optional<std::array<std::uint32_t, 2>> open_edge, unclear_edge;  ///< the mesh vertices of the first of each
};

/// Keeps what was found out about a mesh. Safe to use from several threads.
class MeshPiecesCache {
 public:
  [[nodiscard]] std::shared_ptr<const MeshPieces> find() const {
    const std::lock_guard lock(mutex_);
    return known_;
  }
  void keep(std::shared_ptr<const MeshPieces> pieces) {
    const std::lock_guard lock(mutex_);
    known_ = std::move(pieces);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const MeshPieces> known_;
};

/// Takes from the mesh's cache what was found before. Errors: `cancelled`, and those of `collide`.
Result<std::shared_ptr<const MeshPieces>> pieces_of(const Mesh& mesh, int threads, const std::stop_token& stop);

/// The placed mesh as a part in pieces; `pieces` must outlive it.
clash::PlacedPart placed_in_pieces(const MeshPieces& pieces, const solid::Body& whole);

/// Whether some two triangles of a placed mesh share more than a common corner or a common edge; `body` is that of the
/// mesh.
Result<bool> meets_itself(const Mesh& mesh, const solid::Body& body, const std::stop_token& stop);

}  // namespace impinge
