// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/mesh_pieces.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/pose.hpp"
#include "core/stopped.hpp"
#include "exact/segment.hpp"
#include "exact/triangle_pair.hpp"
#include "impinge/collide.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/mesh_state.hpp"
#include "solid/classify.hpp"
#include "solid/topology.hpp"

namespace impinge {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Some triangles of a mesh as a mesh, with the vertices that they use.
Mesh mesh_of(const Mesh& whole, const Triangles& triangles) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(whole.vertex_count(), kUnused), corners;
  std::vector<double> xyz;
  for (const auto& triangle : triangles) {
    for (const std::uint32_t v : triangle) {
      if (number[v] == kUnused) {
        number[v] = static_cast<std::uint32_t>(xyz.size() / 3);
        const Point& vertex = whole.vertices()[v];
        xyz.insert(xyz.end(), {vertex.x, vertex.y, vertex.z});
      }
      corners.push_back(number[v]);
    }
  }
  return Mesh::create(std::span<const double>(xyz), corners).value();
}

/// The pairs of a mesh's own triangles that cross or share an area, in order.
Result<std::vector<TrianglePair>> self_crossings(const Mesh& mesh, const solid::Body& body, int threads,
                                                 const std::stop_token& stop) {
  const auto contacts = self_collide(
      mesh, {}, {.limit = kMostContacts, .kinds = kCrossing | kCoplanar, .threads = threads, .stop = stop});
  if (!contacts) return contacts.error();
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0; i < contacts->triangles.size(); ++i) {
    if (stop.stop_requested()) return cancelled();
    const TrianglePair& pair = contacts->triangles[i];
    if (contacts->kinds[i] == Kind::crossing || exact::share_area(body.triangle(pair.a), body.triangle(pair.b)))
      pairs.push_back(pair);
  }
  return pairs;
}

double area_of(const solid::Body& body) {
  const LocalFrame frame = local_frame(body.box, body.box);
  double area = 0;
  for (std::uint32_t t = 0; t < body.size(); ++t) {
    const Triangle triangle = frame.to_local(body.triangle(t));
    area += norm(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
  }
  return area / frame.unit / frame.unit;
}

/// The first vertices of the mesh at two positions.
std::array<std::uint32_t, 2> vertices_at(const std::array<std::uint32_t, 2>& positions,
                                         const solid::Topology& topology) {
  const auto first = [&](std::uint32_t at) {
    return static_cast<std::uint32_t>(std::find(topology.position.begin(), topology.position.end(), at) -
                                      topology.position.begin());
  };
  return {first(positions[0]), first(positions[1])};
}

/// A piece that is the whole mesh needs no mesh of its own, nor if all of its triangles were turned: then it winds as
/// often the other way. Only of closed pieces it matters how they wind.
void make_meshes(const Mesh& mesh, std::uint64_t turned, MeshPieces& result) {
  const std::size_t all = mesh.triangle_count();
  const auto is_whole = [&](const solid::ClassedPiece& piece) {
    return piece.triangles.size() == all && (piece.part_class != PartClass::solid || turned == 0 || turned == all);
  };
  Triangles boundary;
  const bool are_others = result.pieces.size() != 1 || !is_whole(result.pieces.front().found);
  for (MeshPieces::Piece& piece : result.pieces) {
    if (are_others) piece.mesh = mesh_of(mesh, piece.found.triangles);
    boundary.insert(boundary.end(), piece.found.triangles.begin(), piece.found.triangles.end());
    piece.found.triangles = {};
  }
  if (boundary.size() < all || (turned > 0 && turned < all)) result.boundary = mesh_of(mesh, boundary);
}

}  // namespace

Result<std::shared_ptr<const MeshPieces>> pieces_of(const Mesh& mesh, int threads, const std::stop_token& stop) {
  MeshPiecesCache& cache = mesh.state().pieces_cache;
  if (auto known = cache.find()) return known;
  if (!in_exact_domain(Pose{}, mesh.state().data)) return not_in_exact_domain("the mesh");
  const solid::Body body = solid::make_body(mesh.state().placed({}));
  const solid::Topology topology = solid::examine(body);
  solid::Classification found = solid::classify(body, topology, stop);
  if (stop.stop_requested()) return cancelled();
  const auto crossings = self_crossings(mesh, body, threads, stop);
  if (!crossings) return crossings.error();

  auto result = std::make_shared<MeshPieces>();
  PartFacts& facts = result->facts;
  facts.part_class = found.best, facts.turned = found.turned, facts.unclear_edges = found.unclear_edges;
  facts.closed = topology.closed, facts.open_edges = topology.open_edges.size();
  facts.degenerate = topology.degenerate, facts.area = area_of(body);
  facts.self_crossings = crossings->size();
  if (!crossings->empty()) facts.self_crossing = crossings->front();
  if (!topology.open_edges.empty()) result->open_edge = vertices_at(topology.open_edges.front(), topology);
  result->unclear_edge = found.unclear_edge, facts.pieces = found.counts();
  for (solid::ClassedPiece& piece : found.pieces) {
    facts.volume += piece.volume, facts.radius = std::max(facts.radius, piece.radius);
    result->pieces.push_back({std::nullopt, std::move(piece)});
  }
  make_meshes(mesh, found.turned, *result);
  cache.keep(result);
  return std::shared_ptr<const MeshPieces>(std::move(result));
}

clash::PlacedPart placed_in_pieces(const MeshPieces& pieces, const solid::Body& whole) {
  const Pose& pose = whole.placed.pose;
  clash::PlacedPart part{whole, {}};
  for (const MeshPieces::Piece& piece : pieces.pieces) {
    const solid::ClassedPiece& found = piece.found;
    clash::PlacedPiece placed{.body = piece.mesh ? solid::make_body(piece.mesh->state().placed(pose)) : whole,
                              .part_class = found.part_class,
                              .inner_points = found.inner_points,
                              .radius = found.radius,
                              .tree = found.tree ? &*found.tree : nullptr,
                              .open_edges = found.open_edges ? &*found.open_edges : nullptr,
                              .frame = found.frame,
                              .to_mesh = inverse(to_mat3(pose.R))};
    for (solid::InnerPoint& inner : placed.inner_points) pose_all_vertices(pose, {&inner.point, 1});
    part.pieces.push_back(std::move(placed));
  }
  return part;
}

Result<bool> meets_itself(const Mesh& mesh, const solid::Body& body, const std::stop_token& stop) {
  const Pose& pose = body.placed.pose;
  const auto contacts = self_collide(mesh, pose, {.limit = kMostContacts, .threads = 1, .stop = stop});
  if (!contacts) return contacts.error();
  if (contacts->truncated) return true;  // it may
  for (const TrianglePair& pair : contacts->triangles)
    if (exact::is_proper(body.triangle(pair.a)) && exact::is_proper(body.triangle(pair.b))) return true;
  return false;
}

}  // namespace impinge
