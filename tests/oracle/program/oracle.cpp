// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge_oracle [--rational] SCENE SET: reads a scene (scenes/scene_file.hpp) and writes every pair of triangles of
/// different objects that touch, by exact arithmetic that is not impinge's.
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>

#include "decide.hpp"

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
    if (count != 0) {
      std::memcpy(values, bytes_.data() + at_, count * sizeof(T));
    }
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

std::optional<std::vector<oracle::WorldObject>> read_scene(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  Reader reader(std::string(std::istreambuf_iterator<char>(in), {}));
  if (reader.one<std::array<char, 8>>() != std::array{'i', 'm', 'p', 's', 'c', 'n', '0', '1'}) {
    return std::nullopt;
  }
  const auto mesh_count = reader.one<std::uint64_t>();
  const auto object_count = reader.one<std::uint64_t>();
  std::vector<oracle::Mesh> meshes;
  for (std::uint64_t i = 0; i < mesh_count && reader.fine(); ++i) {
    const auto vertex_count = reader.one<std::uint64_t>();
    const auto triangle_count = reader.one<std::uint64_t>();
    if (!reader.holds(vertex_count, 24) || !reader.holds(triangle_count, 12)) {
      return std::nullopt;
    }
    oracle::Mesh& mesh = meshes.emplace_back();
    mesh.vertices.resize(vertex_count);
    mesh.triangles.resize(triangle_count);
    reader.many(mesh.vertices.data(), vertex_count);
    reader.many(mesh.triangles.data(), triangle_count);
  }
  std::vector<oracle::WorldObject> objects;
  for (std::uint64_t i = 0; i < object_count && reader.fine(); ++i) {
    const auto mesh = reader.one<std::uint32_t>();
    const auto group = reader.one<std::uint32_t>();
    const auto placement = reader.one<oracle::Placement>();
    if (!reader.fine() || mesh >= meshes.size()) {
      return std::nullopt;
    }
    objects.push_back(oracle::placed(meshes[mesh], placement));
    objects.back().group = group;
  }
  if (!reader.at_end()) {
    return std::nullopt;
  }
  return objects;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool rational = !arguments.empty() && arguments.front() == "--rational";
  if (rational) {
    arguments.erase(arguments.begin());
  }
  if (arguments.size() != 2) {
    std::cerr << "usage: impinge_oracle [--rational] SCENE SET\n";
    return 2;
  }
  const auto objects = read_scene(arguments[0]);
  if (!objects) {
    std::cerr << arguments[0] << ": not a scene that the oracle can read.\n";
    return 2;
  }
  oracle::Counts counts;
  const auto contacts = rational ? oracle::contacts_by_rationals(*objects) : oracle::contacts_of(*objects, counts);
  if (!oracle::write_contacts(arguments[1], contacts)) {
    std::cerr << arguments[1] << ": cannot be written.\n";
    return 2;
  }
  if (!rational) {
    std::cout << contacts.size() << " contacts, " << counts.candidates << " candidates, " << counts.rationals
              << " decided by rationals\n";
  }
  return 0;
}
