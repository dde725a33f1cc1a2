// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"

namespace impinge {

class ClashMemory;    // clash.hpp
struct Clashes;       // clash.hpp
struct ClashOptions;  // clash.hpp

/// An object of one scene. A removed object's id is never valid again, though its index is used anew.
struct ObjectId {
  std::uint32_t index = 0;       ///< what `Contacts::objects` holds; canonical order is by it
  std::uint32_t generation = 0;  ///< tells a later object at the same index apart
  friend bool operator==(const ObjectId&, const ObjectId&) = default;
};

/// Placed meshes that are asked about again and again. Keeps which objects are near each other between frames.
/// A scene that was moved from may only be destroyed or assigned to. Const calls are safe from many threads at once;
/// the others need the scene to themselves.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Objects of one non-zero group are not tested against each other. Errors: `bad_pose`.
  Result<ObjectId> add(Mesh mesh, const Pose& pose = {}, std::uint32_t group = 0);
  /// Errors: `unknown_id`, `bad_pose`; the object then stays where it was.
  Result<void> set_pose(ObjectId id, const Pose& pose);
  /// Gives the object another shape; its id, its group and the pairs that ignore it stay. Errors: likewise.
  Result<void> set_mesh(ObjectId id, Mesh mesh, const Pose& pose = {});
  /// Forgets the object and the pairs that ignore it. Errors: `unknown_id`.
  Result<void> remove(ObjectId id);
  /// Leaves this pair out of every query from now on. Errors: `unknown_id`, `bad_option` (an object with itself).
  Result<void> ignore(ObjectId a, ObjectId b);
  /// Takes an ignored pair back in. Errors: `unknown_id`.
  Result<void> unignore(ObjectId a, ObjectId b);

  [[nodiscard]] std::size_t size() const noexcept;
  /// Errors: `unknown_id`.
  Result<Pose> pose(ObjectId id) const;

  /// Finds out anew which objects are near each other, after some were added, moved or removed, on up to `threads`
  /// threads (0: all there are). Without it `collide` does so in a copy each time: the answer is the same, only slower.
  /// (The backends "paper" and "raster" have no use for it: what they keep of the last query is in the workspace.)
  /// Errors: `bad_option`.
  Result<void> update(int threads = 0);

  /// Every pair of triangles of two different objects that share a point. Errors: as the function `collide`.
  Result<Contacts> collide(const Options& options = {}, Workspace* workspace = nullptr) const;

  struct State;  // internal

 private:
  friend Result<Clashes> find_clashes(const Scene& scene, const ClashOptions& options, ClashMemory* memory);
  std::unique_ptr<State> state_;
};

}  // namespace impinge
