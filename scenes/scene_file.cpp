// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/scene_file.hpp"

namespace impinge::scenes {
namespace {

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  if (count != 0) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
}

void append_count(std::string& bytes, std::size_t count) {
  const std::uint64_t value = count;
  append(bytes, &value, 1);
}

}  // namespace

std::string scene_bytes(const PlacedScene& scene) {
  std::string bytes = "impscn01";
  append_count(bytes, scene.meshes.size());
  append_count(bytes, scene.objects.size());
  for (const MeshData& mesh : scene.meshes) {
    append_count(bytes, mesh.vertex_count());
    append_count(bytes, mesh.triangle_count());
    append(bytes, mesh.xyz.data(), mesh.xyz.size());
    append(bytes, mesh.triangles.data(), mesh.triangles.size());
  }
  for (const PlacedObject& object : scene.objects) {
    append(bytes, &object.mesh, 1);
    append(bytes, &object.group, 1);
    append(bytes, object.pose.R.data(), object.pose.R.size());
    append(bytes, object.pose.t.data(), object.pose.t.size());
  }
  return bytes;
}

}  // namespace impinge::scenes
