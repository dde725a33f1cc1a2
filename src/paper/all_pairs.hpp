// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "broad/object_pairs.hpp"
#include "scene/scene_view.hpp"

namespace impinge::broad {

/// The broad phase by brute force: the twin that sweep and prune is held against.
ObjectPairs all_pairs(const scene::SceneView& view);

}  // namespace impinge::broad
