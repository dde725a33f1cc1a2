// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"

namespace impinge {

class ClashMemory;       // clash.hpp
struct Clashes;          // clash.hpp
struct ClashOptions;     // clash.hpp
class ContactManifolds;  // manifolds.hpp
struct MotionOptions;    // impacts.hpp
struct SceneImpacts;     // impacts.hpp

/// An object of one scene, or of none. A removed object's id is never valid again, though its index is used anew.
struct ObjectId {
  std::uint32_t index = 0xFFFFFFFF;  ///< what `Contacts::objects` holds; canonical order is by it
  std::uint32_t generation = 0;      ///< tells a later object at the same index apart, and one of another scene
  friend bool operator==(const ObjectId&, const ObjectId&) = default;
};

/// A pair of triangles that touch, of two of a scene's objects.
struct Touch {
  std::array<std::uint32_t, 2> objects{};  ///< the lower first
  TrianglePair triangles{};
};

struct ConfigurationOptions {
  bool witnesses = false;  ///< a `Touch` for each configuration
  int threads = 0;         ///< at most so many; 0: all there are
  std::stop_token stop{};
};

/// What was found of many configurations.
struct Configurations {
  std::vector<std::uint8_t> touches;              ///< by configuration: 1 if something touches, else 0
  std::vector<std::optional<Touch>> witnesses{};  ///< by configuration, if wanted; which one is open
};

/// How near two of a scene's objects are to each other.
struct ObjectDistance {
  std::array<std::uint32_t, 2> objects{};  ///< the lower first
  Nearest nearest{};                       ///< a of the first of them
};

/// What an object is, and what it is tested against: two objects are tested against each other if the mask of each has
/// a bit of the other's category, besides what groups and ignored pairs leave out.
struct Filter {
  std::uint64_t category = 1;
  std::uint64_t mask = ~std::uint64_t{0};
  friend bool operator==(const Filter&, const Filter&) = default;
};

/// Placed meshes that are asked about again and again. Keeps which objects are near each other between frames.
/// A copy shares the meshes with the original, has the same ids, and is as up to date. A scene that was moved from may
/// only be destroyed or assigned to. Const calls are safe from many threads at once; the others need the scene to
/// themselves.
class Scene {
 public:
  Scene();
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&);
  Scene& operator=(const Scene&);

  /// Objects of one non-zero group are not tested against each other. Errors: `bad_pose`.
  Result<ObjectId> add(Mesh mesh, const Pose& pose = {}, std::uint32_t group = 0);
  /// Errors: `unknown_id`, `bad_pose`; the object then stays where it was.
  Result<void> set_pose(ObjectId id, const Pose& pose);
  /// The same for many, as many poses as ids: all of them, or with an error none; it names the place.
  Result<void> set_poses(std::span<const ObjectId> ids, std::span<const Pose> poses);
  /// Gives the object another shape; its id, its group, its filter, the pairs that ignore it and what `self` says
  /// stay. Errors: likewise.
  Result<void> set_mesh(ObjectId id, Mesh mesh, const Pose& pose = {});
  /// Deforms the object's mesh, as `Mesh::deformed` does; other objects that share the mesh keep theirs. Errors:
  /// `unknown_id`, and those of `Mesh::deformed`; the object then stays as it was.
  Result<void> set_vertices(ObjectId id, std::span<const double> xyz);
  /// Forgets the object and all that was said of it. Errors: `unknown_id`.
  Result<void> remove(ObjectId id);
  /// Leaves this pair out of every query from now on. Errors: `unknown_id`, `bad_option` (an object with itself).
  Result<void> ignore(ObjectId a, ObjectId b);
  /// Takes an ignored pair back in. Errors: `unknown_id`.
  Result<void> unignore(ObjectId a, ObjectId b);

  /// From now on, instead of `Filter{}`, which every new object has. Errors: `unknown_id`.
  Result<void> set_filter(ObjectId id, const Filter& filter);
  /// Whether `collide` tests this object against itself too, as `self_collide` does; its row is of the object and the
  /// object, whatever its group and filter. At first it does not. Errors: `unknown_id`.
  Result<void> self(ObjectId id, bool on);

  [[nodiscard]] std::size_t size() const noexcept;
  /// Of the object that answers call by this index. Errors: `unknown_id`.
  Result<ObjectId> id(std::uint32_t index) const;
  /// Errors: `unknown_id`.
  Result<Pose> pose(ObjectId id) const;

  /// Finds out anew which objects are near each other, after some were added, moved or removed, on up to `threads`
  /// threads (0: all there are). Without it `collide` does so in a copy each time: the answer is the same, only slower.
  /// (The backends "paper" and "raster" have no use for it: what they keep of the last query is in the workspace.)
  /// Errors: `bad_option`.
  Result<void> update(int threads = 0);

  /// Every pair of triangles of two different objects that share a point, and of one where `self` says so. Errors: as
  /// the function `collide`.
  Result<Contacts> collide(const Options& options = {}, Workspace* workspace = nullptr) const;
  /// The same of one object and all others, not of it with itself. Errors: likewise, and `unknown_id`.
  Result<Contacts> collide_with(ObjectId id, const Options& options = {}, Workspace* workspace = nullptr) const;
  /// The same of a mesh that is not in the scene and all objects; in the rows it comes second, as object 2^32 - 1.
  /// Errors: as `collide`.
  Result<Contacts> collide_with(const Mesh& mesh, const Pose& pose = {}, const Options& options = {},
                                Workspace* workspace = nullptr) const;
  /// Whether any two different objects share a point: the search stops at the first that do. Errors: as `collide`.
  Result<bool> touches_any(const ConfigurationOptions& options = {}, Workspace* workspace = nullptr) const;
  /// The same of a mesh that is not in the scene and any object. Errors: likewise.
  Result<bool> touches_with(const Mesh& mesh, const Pose& pose = {}, const ConfigurationOptions& options = {},
                            Workspace* workspace = nullptr) const;

  /// For each configuration, which is a pose for each of these objects, whether one of them touches another one or any
  /// other object of the scene. Objects that are not named are not tested against each other. The scene does not
  /// change. `poses` has ids.size() poses for each configuration in turn. Errors: `unknown_id`, `bad_option`,
  /// `bad_pose` and `out_of_range` (which name the id or the configuration), `cancelled`.
  Result<Configurations> collide_configurations(std::span<const ObjectId> ids, std::span<const Pose> poses,
                                                const ConfigurationOptions& options = {}) const;
  /// Some configuration that touches, or nothing: of a path, those at its ends and in its middle are tried first, then
  /// those half-way between. Errors: likewise; with one, poses behind it may not have been looked at.
  Result<std::optional<std::size_t>> first_touching(std::span<const ObjectId> ids, std::span<const Pose> poses,
                                                    const ConfigurationOptions& options = {}) const;

  /// The two objects that are nearest to each other, of all that are tested against each other: pruned over all pairs
  /// together. Nothing if there are none, or none within `stop_above`. Errors: `bad_option`, `out_of_range`,
  /// `cancelled`.
  Result<std::optional<ObjectDistance>> distance(const MeasureOptions& options = {}) const;
  /// The `count` pairs of objects that are nearest, the nearest first; fewer if there are fewer, or not so many within
  /// `stop_above`. Which of several that are equally near, and in what order those below `enough_below` come, is open.
  /// Errors: likewise.
  Result<std::vector<ObjectDistance>> closest(std::size_t count, const MeasureOptions& options = {}) const;
  /// The same as `distance` of one object and all others. Errors: likewise, and `unknown_id`.
  Result<std::optional<ObjectDistance>> distance_with(ObjectId id, const MeasureOptions& options = {}) const;
  /// The same for each configuration, of what moves and everything. Errors: as `collide_configurations`.
  Result<std::vector<std::optional<ObjectDistance>>> distance_configurations(std::span<const ObjectId> ids,
                                                                             std::span<const Pose> poses,
                                                                             const MeasureOptions& options = {}) const;

  /// Ends a motion: where everything is now is where the next one starts. (The mesh that an object had where it starts
  /// is kept until then.)
  void step() noexcept;
  /// What meets between the last `step()` and now: all impacts of pairs that `collide` would test, and of an object
  /// with itself where `self` says so. World vertices go on straight lines at constant speed from where they were to
  /// where they are, those of an object that turned too: exact on the world vertices of both ends (`Pose`). An object
  /// that was added since then starts where it was put; one whose mesh has other triangles stands where it is. Looks at
  /// every object, moved or not. Errors: as `find_impacts` of two meshes (impacts.hpp); `out_of_range`, as `collide`,
  /// at either end.
  Result<SceneImpacts> find_impacts(const MotionOptions& options) const;
  Result<SceneImpacts> find_impacts() const;

  struct State;  // internal

 private:
  friend class ContactManifolds;
  friend Result<Clashes> find_clashes(const Scene& scene, const ClashOptions& options, ClashMemory* memory);
  std::unique_ptr<State> state_;
};

}  // namespace impinge
