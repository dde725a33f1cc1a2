// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "impinge/io.hpp"
#include "impinge/scene.hpp"
#include "scenes/scene.hpp"

/// Real assemblies from Debian's assimp-testmodels.
namespace impinge::bench {

struct Assembly {
  std::string name;
  std::string file;
};
std::vector<Assembly> assemblies();

io::Model read_model(const Assembly& assembly);

/// The model as a scene whose trees are not yet built; objects that share a mesh go on sharing it.
Scene fresh_scene(const io::Model& model, const TreeConfig& tree = {});
/// The same of numbers.
Scene fresh_scene(const scenes::PlacedScene& placed, const TreeConfig& tree = {});

}  // namespace impinge::bench
