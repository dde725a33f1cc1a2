// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "broad/object_pairs.hpp"
#include "scene/scene_view.hpp"

namespace impinge::paper {

/// The broad phase by brute force: the twin that sweep and prune is held against.
broad::ObjectPairs all_pairs(const scene::SceneView& view);

}  // namespace impinge::paper
