// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "clash/known_part.hpp"
#include "impinge/clash.hpp"
#include "impinge/mesh.hpp"
#include "solid/body.hpp"
#include "solid/part.hpp"

/// What the parts of a clash are, before any two of them are looked at.
namespace impinge {

/// A mesh that was placed somewhere.
struct Placed {
  const Mesh* mesh;  ///< null: nothing is here
  Pose pose;
};

/// What is done and what is to be done, if somebody wants to know.
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

/// The tolerance on what has coordinates up to `largest`.
inline double tolerance_of(const ClashOptions& options, double largest) {
  return options.tolerance.value_or(0x1p-20 * largest);
}

inline Error cancelled() { return {Code::cancelled, "the query was stopped before it was complete"}; }

/// What is to be looked through for defects: a mesh as it was made, once however often it is placed; or each object
/// where it is, if every rounding counts.
struct Checks {
  struct Check : Placed {
    bool is_as_made;  ///< what is found holds wherever the mesh stands, for this tolerance
  };
  std::vector<Check> placed;
  std::vector<std::size_t> of_object;
};

/// Of these objects.
Checks list_checks(const std::vector<Placed>& objects, const ClashOptions& options);

/// A part as the verdicts see it, which is its boundary alone, and as it is.
struct SeenPart {
  clash::KnownPart known;
  std::optional<Mesh> boundary;      ///< without the shells that are none, where there are such
  std::optional<solid::Part> whole;  ///< and then the part with them

  [[nodiscard]] const solid::Part& part() const { return whole ? *whole : known.linked.part; }
};

/// The objects in the world. Where nothing is placed there is an empty body.
std::vector<solid::Body> bodies_of(const std::vector<Placed>& objects, int threads);

/// `bodies` are the objects', of which the parts are made; `checks` is their list. A step is counted for each check and
/// each object. Errors: `cancelled`.
Result<std::vector<SeenPart>> see_all(const std::vector<Placed>& objects, std::vector<solid::Body> bodies,
                                      const Checks& checks, const ClashOptions& options);

}  // namespace impinge
