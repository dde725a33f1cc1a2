// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "broad/sweep_and_prune.hpp"
#include "hierarchy/obb_tree.hpp"
#include "impinge/contacts.hpp"
#include "impinge/result.hpp"
#include "scene/scene_view.hpp"

namespace impinge {

/// A question to the pipeline.
struct Query {
  scene::SceneView view;
  std::span<hierarchy::ObbTree* const> trees;  ///< an object's, null where its mesh is
  const broad::SweepAndPrune* borders;         ///< up to date; null: all pairs of objects are held against each other
  const Options& options;
};

/// Runs the stages in order. Sets no floating-point environment on the calling thread: the public calls do.
Result<Contacts> run_pipeline(const Query& query);

/// Errors of options that cannot be.
Result<void> validate(const Options& options);

}  // namespace impinge
