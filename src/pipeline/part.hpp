// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "clash/reach.hpp"
#include "core/stopped.hpp"
#include "impinge/clash.hpp"
#include "impinge/mesh.hpp"
#include "pipeline/mesh_pieces.hpp"
#include "solid/body.hpp"
#include "solid/part.hpp"

/// Makes the parts of a scene ready to be judged in pairs.
namespace impinge {

/// A mesh and where it stands in the world.
struct Placed {
  const Mesh* mesh;  ///< null: the object has no mesh, or was left out
  Pose pose;
};

/// Counts the steps of a query in the caller's `Progress`, if there is one.
class Steps {
 public:
  explicit Steps(Progress* progress) : progress_(progress) {}
  void begin(std::uint64_t total) const {
    if (progress_ != nullptr) progress_->done = 0, progress_->total = total;
  }
  void step() const {
    if (progress_ != nullptr) progress_->done.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  Progress* progress_;
};

/// Made when it is first asked for. Safe to use from several threads.
template <class T>
class Lazily {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(*once_, [&] { *value_ = make(); });
    return **value_;
  }

 private:
  std::unique_ptr<std::once_flag> once_ = std::make_unique<std::once_flag>();
  std::unique_ptr<std::optional<T>> value_ = std::make_unique<std::optional<T>>();
};

/// The boundary of a placed mesh as exact cells are found in it.
struct ExactPart {
  solid::Part part;
  bool is_plain;  ///< it is closed and does not meet itself
};

/// One placed mesh with what judging needs.
struct Part {
  std::optional<Mesh> mesh;
  Pose pose;
  std::shared_ptr<const MeshPieces> found;
  clash::PlacedPart placed;
  PartFacts facts;
  double rounding = 0;  ///< how far rounding may have moved its vertices

  /// Once it is stopped, the result is meaningless.
  [[nodiscard]] const ExactPart& exact(const std::stop_token& stop) const;
  /// The whole mesh; solid if it is closed.
  [[nodiscard]] const solid::Part& whole() const;

 private:
  Lazily<ExactPart> exact_;
  Lazily<solid::Part> whole_;
};

/// The objects' world vertices; an empty body for an object without a mesh.
std::vector<solid::Body> bodies_of(const std::vector<Placed>& objects, int threads);

/// How far rounding may have moved the vertices of a part: 2^-20 of the diagonal of its box, and 2^-22 of the largest
/// |coordinate| of its mesh and |translation| if these were single-precision numbers, whose unit of rounding is 2^-24.
double rounding_of(const solid::Body& body);

/// How many steps `make_parts` counts: one for each mesh and one for each object.
std::uint64_t steps_of_parts(const std::vector<Placed>& objects);

/// Makes a part of each object; `bodies` are the objects'. Errors: `cancelled`.
Result<std::vector<Part>> make_parts(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                     const ClashOptions& options);

}  // namespace impinge
