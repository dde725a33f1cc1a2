// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <map>

#include "bench/assemblies.hpp"
#include "bench/support.hpp"

namespace impinge::bench {

std::vector<Assembly> assemblies() {
  const std::string models = "/usr/share/assimp/models/";
  return {{"2CylinderEngine.glb", models + "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"},
          {"AC14-FZK-Haus.ifc", models + "IFC/AC14-FZK-Haus.ifc"}};
}

io::Model read_model(const Assembly& assembly) {
  if (!std::filesystem::exists(assembly.file)) fail(assembly.file + " is missing; install assimp-testmodels");
  return must(io::read(assembly.file));
}

Scene fresh_scene(const io::Model& model, const TreeConfig& tree) {
  std::map<const MeshState*, Mesh> meshes;
  Scene scene;
  for (const io::Object& object : model.objects) {
    const MeshState* known = &object.mesh.state();
    if (!meshes.contains(known)) meshes.emplace(known, without_tree(object.mesh, tree));
    must(scene.add(meshes.at(known), object.pose));
  }
  if (const auto updated = scene.update(); !updated) fail(updated.error().message);
  return scene;
}

Scene fresh_scene(const scenes::PlacedScene& placed, const TreeConfig& tree) {
  std::vector<Mesh> meshes;
  for (const scenes::MeshData& data : placed.meshes) meshes.push_back(make_mesh(data, tree));
  Scene scene;
  for (const scenes::PlacedObject& object : placed.objects)
    must(scene.add(meshes[object.mesh], object.pose, object.group));
  if (const auto updated = scene.update(); !updated) fail(updated.error().message);
  return scene;
}

}  // namespace impinge::bench
