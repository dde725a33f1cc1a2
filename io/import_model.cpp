// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/import_process.hpp"
#include "io/model.hpp"
#include "io/precision.hpp"
#include "scene/validate_pose.hpp"

namespace impinge::io {
namespace {

Affine affine_of(const std::array<double, 16>& world) {
  Affine map;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) map.m[3 * row + column] = world[4 * row + column];
    map.t[row] = world[4 * row + 3];
  }
  return map;
}

std::optional<std::uint32_t> known(std::uint32_t number) {
  return number == kNoNode ? std::nullopt : std::optional(number);
}

bool is_affine(const std::array<double, 16>& world) {
  return world[12] == 0 && world[13] == 0 && world[14] == 0 && world[15] == 1;
}

}  // namespace

Result<Model> model_of(Imported&& imported, const Source& source) {
  Model model;
  model.warnings = std::move(imported.warnings), model.missing = std::move(imported.missing);
  std::vector<Mesh> meshes;
  // Where objects are placed in double precision, their floats are about their own middle, and have lost no more than
  // parts of any origin are assumed to have.
  const Precision numbers = imported.exact_places ? Precision::whole : Precision::single;
  for (ImportedMesh& raw : imported.meshes) {
    Result<Mesh> mesh = Mesh::create(raw.xyz, raw.triangles, {}, numbers);
    if (!mesh) return file_error(source, sentence("mesh ", meshes.size(), ": ", mesh.error().message));
    meshes.push_back(std::move(*mesh));
    raw = {};
  }
  for (const ImportedNode& node : imported.nodes) {
    model.nodes.push_back({known(node.parent), affine_of(node.local), node.scale, node.rotation, node.translation});
  }
  for (ImportedGroup& group : imported.groups) model.groups.push_back({std::move(group.name), known(group.parent)});
  model.animations = std::move(imported.animations);
  model.grids = std::move(imported.grids);
  model.unit_in_metres = imported.unit_in_metres;
  PrecisionCheck precision;
  for (ImportedObject& object : imported.objects) {
    const Mesh& mesh = meshes[object.mesh];
    const std::string name = object.name.empty() ? std::string(source.name) : std::move(object.name);
    if (!is_affine(object.world)) {
      return file_error(source, sentence("the transform of object '", name,
                                         "' has a last row other than 0 0 0 1; export it without perspective"));
    }
    if (object.path.empty()) object.path = name;
    const std::optional<std::uint32_t> node = known(object.node), group = known(object.group);
    const Affine map = affine_of(object.world);
    const Pose pose{map.m, map.t};
    precision.add(name, mesh, imported.exact_places ? Affine{} : map);
    if (scene::validate(pose)) {
      model.objects.push_back({name, std::move(object.path), std::move(object.product), mesh, pose, node, false, group,
                               std::move(object.properties), std::move(object.incomplete)});
      continue;
    }
    Result<Mesh> baked = mesh.transformed(map);
    if (!baked) return file_error(source, sentence("object '", name, "': ", baked.error().message));
    model.objects.push_back({name, std::move(object.path), std::move(object.product), std::move(*baked), Pose{}, node,
                             true, group, std::move(object.properties), std::move(object.incomplete)});
  }
  if (model.objects.empty()) {
    return file_error(source, "the file holds no triangles; export the part as a mesh with faces");
  }
  precision.report(model.warnings);
  make_names_unique(model.objects);
  return model;
}

}  // namespace impinge::io
