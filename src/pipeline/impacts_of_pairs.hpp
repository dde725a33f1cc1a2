// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "broad/object_pairs.hpp"
#include "impinge/impacts.hpp"
#include "impinge/result.hpp"
#include "motion/features.hpp"

namespace impinge {

/// Errors of options with values that they cannot have.
Result<void> validate(const MotionOptions& options);

/// The world vertices of an object's mesh at both ends, and the features of its triangles; null: without triangles.
struct MovingObject {
  motion::Vertices vertices{};
  const motion::Features* features = nullptr;
  motion::FeaturesCache* cache = nullptr;
};

/// The impacts of each of these pairs of objects, in the order of the pairs; of an object with itself where both are
/// the same. The answer has no hash. Throws `Stopped`.
SceneImpacts impacts_of_pairs(std::span<const MovingObject> objects, std::span<const broad::ObjectPair> pairs,
                              const MotionOptions& options);

}  // namespace impinge
