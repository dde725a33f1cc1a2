// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "read_scene.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace oracle {
namespace {

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class T>
  T one() {
    T value{};
    many(&value, 1);
    return value;
  }
  template <class T>
  void many(T* values, std::size_t count) {
    if (!fine_ || count > (bytes_.size() - at_) / sizeof(T)) {
      fine_ = false;
      return;
    }
    if (count != 0) std::memcpy(values, bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  /// Whether `count` things of `size` bytes can still follow.
  bool holds(std::uint64_t count, std::size_t size) {
    fine_ = fine_ && count <= (bytes_.size() - at_) / size;
    return fine_;
  }
  [[nodiscard]] bool fine() const { return fine_; }
  [[nodiscard]] bool at_end() const { return fine_ && at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
  bool fine_ = true;
};

}  // namespace

std::optional<std::vector<WorldObject>> read_scene(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  Reader reader(std::string(std::istreambuf_iterator<char>(in), {}));
  if (reader.one<std::array<char, 8>>() != std::array{'i', 'm', 'p', 's', 'c', 'n', '0', '1'}) return std::nullopt;
  const auto mesh_count = reader.one<std::uint64_t>();
  const auto object_count = reader.one<std::uint64_t>();
  std::vector<Mesh> meshes;
  for (std::uint64_t i = 0; i < mesh_count && reader.fine(); ++i) {
    const auto vertex_count = reader.one<std::uint64_t>();
    const auto triangle_count = reader.one<std::uint64_t>();
    if (!reader.holds(vertex_count, 24) || !reader.holds(triangle_count, 12)) return std::nullopt;
    Mesh& mesh = meshes.emplace_back();
    mesh.vertices.resize(vertex_count);
    mesh.triangles.resize(triangle_count);
    reader.many(mesh.vertices.data(), vertex_count);
    reader.many(mesh.triangles.data(), triangle_count);
  }
  std::vector<WorldObject> objects;
  for (std::uint64_t i = 0; i < object_count && reader.fine(); ++i) {
    const auto mesh = reader.one<std::uint32_t>();
    const auto group = reader.one<std::uint32_t>();
    const auto placement = reader.one<Placement>();
    if (!reader.fine() || mesh >= meshes.size()) return std::nullopt;
    objects.push_back(placed(meshes[mesh], placement));
    objects.back().group = group;
  }
  if (!reader.at_end()) return std::nullopt;
  return objects;
}

}  // namespace oracle
