// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "impinge/scene.hpp"

/// Contact manifolds: what a solver of rigid bodies asks of each contact. Lengths are in the caller's unit.
namespace impinge {

/// Two points that a solver moves apart along the manifold's normal: (a - b) * normal is the depth.
struct ManifoldPoint {
  Point a{}, b{};
  double depth = 0;  ///< 0 or more
};

/// One connected region of contact between two objects.
struct Manifold {
  std::array<std::uint32_t, 2> objects{};  ///< the lower first; called a and b
  std::uint64_t id = 0;                    ///< stays while the region persists; never used again
  Point middle{};                          ///< of the contour, by length; without length of its points
  /// Unit: the way in which b must go to leave a; {0, 0, 0} where contact says none, and depths are 0 then.
  Point normal{};
  double depth = 0;  ///< of its deepest point
  std::array<ManifoldPoint, 4> points{};
  std::uint32_t size = 0;  ///< how many points there are, 1 to 4
};

/// Makes manifolds of contacts, frame by frame, and keeps what the next frame needs.
///
/// A region is what hangs together of the pairs of triangles in contact: two pairs belong to one if in both meshes
/// their triangles are the same or have a vertex in common (by equal coordinates). Its contour is what the pairs share,
/// segments and polygons. Of two closed meshes the contour bounds a patch of a's surface that lies inside b, and one of
/// b's inside a; with the contour, which belongs to both, these are what is measured:
///   - The extent along a direction n is the greatest p * n of a's patch less the least of b's. Moved by it along n,
///     the patch of b leaves that of a: a plane lies between the two.
///   - The normal is the contour's vector area (half the integral of r x dr, turned so that b leaves a), or the outward
///     normal of the triangle of a or of b (reversed) in contact that is nearest to it in direction: of these three the
///     one with the least extent. That is a local separation, not the least of all directions. The direction that
///     `Region` has without area stands in for that of an area where there is none, or where sides are flush and the
///     contour, which then has the lines of both patches there, does not close; of open meshes it is the normal.
///   - The depth of the manifold is that extent. So it is exact, but for rounding, for a box on a box or on a plane,
///     with sides flush or not, a ball on a plane, and two edges that cross.
///   - The patch that is thinner along the normal is the reference: a plane touches it at its farthest. Points are
///     those of the other patch, and their depths how far they lie beyond that plane. Up to four are chosen: the
///     deepest one, and others far from it and from each other, deep ones before shallow ones.
/// Of an open mesh the side that its normals look to counts as outside. Where its contour does not close, as along the
/// rim of a sheet, surfaces have no inside: patches are the contour alone, and the depth says how far that is from
/// plane. What goes right through something, a bolt through a plate, has a manifold at either face, of which neither
/// knows how to pull it out.
///
/// Which pairs touch is exact; everything here is computed from it in double, about the middle of the smaller object.
class ContactManifolds {
 public:
  ContactManifolds();
  ~ContactManifolds();
  ContactManifolds(ContactManifolds&&) noexcept;
  ContactManifolds& operator=(ContactManifolds&&) noexcept;

  /// The manifolds of all contacts that `Scene::collide` found, in the order of their objects, none of an object with
  /// itself; valid until the next call. Of the regions that two objects had in the last call and have now, the two that
  /// are nearest to each other are one and keep its id, then the two nearest of the others, and so on, however far they
  /// moved; what is left over gets a new id. Likewise their points go on in the order of the last call. Both are told
  /// in a's own frame. An object that was removed or belongs to another scene shares no id with one at its index. A
  /// steady series of calls allocates nothing; an object's mesh is looked through when it is first in contact. Errors:
  /// `unknown_id` (contacts of objects or triangles that the scene does not have), `bad_option` (contacts that were cut
  /// off at a limit, found by `Find::first`, or of some kinds alone), `out_of_memory`.
  Result<std::span<const Manifold>> update(const Scene& scene, const Contacts& contacts);

  struct State;  // internal

 private:
  std::unique_ptr<State> state_;
};

}  // namespace impinge
