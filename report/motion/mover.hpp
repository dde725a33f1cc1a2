// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "impinge/io.hpp"

/// Where the parts of an animated file are at a time.
namespace impinge::report {

/// A mesh and where it stands.
struct Posed {
  Mesh mesh;
  Pose pose;
  Affine map;  ///< from the model's mesh to the world: the pose, or what made this mesh of that one
};

class Mover {
 public:
  /// Both outlive this. The animation is one of the model's.
  Mover(const io::Model& model, const io::Animation& animation);

  /// All objects of the model at a time of the animation. One that the animation moves rigidly keeps its mesh; one that
  /// it stretches or mirrors gets a mesh of its own at each time. Errors: `bad_file` (coordinates that are not finite;
  /// a part that is flat at rest, of which no shape is left), with the object's name.
  [[nodiscard]] Result<std::vector<Posed>> at(double seconds) const;

  /// The objects of these indices, in this order. Errors: as above.
  [[nodiscard]] Result<std::vector<Posed>> at(double seconds, std::span<const std::uint32_t> objects) const;

  /// How long the animation runs.
  [[nodiscard]] double seconds() const noexcept { return animation_.seconds; }

  /// Objects with the same number stand still to each other all the time; 0: they do not move at all.
  [[nodiscard]] const std::vector<std::uint32_t>& bodies() const noexcept { return bodies_; }

 private:
  [[nodiscard]] Result<Posed> place(std::size_t object, const std::vector<Affine>& worlds, double seconds) const;

  const io::Model& model_;
  const io::Animation& animation_;
  std::vector<std::uint32_t> bodies_;
  std::vector<Affine> rest_;  ///< of each node
};

}  // namespace impinge::report
