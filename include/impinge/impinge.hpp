// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

/// impinge: every pair of triangles that touch between meshes, exactly.
#include "impinge/clash.hpp"
#include "impinge/collide.hpp"
#include "impinge/contact_history.hpp"
#include "impinge/contacts.hpp"
#include "impinge/devices.hpp"
#include "impinge/impacts.hpp"
#include "impinge/manifolds.hpp"
#include "impinge/measures.hpp"
#include "impinge/mesh.hpp"
#include "impinge/options.hpp"
#include "impinge/predicates.hpp"
#include "impinge/regions.hpp"
#include "impinge/result.hpp"
#include "impinge/scene.hpp"
#include "impinge/sweeps.hpp"
#include "impinge/version.hpp"
#include "impinge/workspace.hpp"
