// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/glb.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

namespace impinge::scenes {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little endian, and numbers are copied as they are");

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", static_cast<double>(static_cast<float>(value)));
  return text;
}

template <std::size_t N>
std::string numbers(const std::array<double, N>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ",") + number(value);
  return "[" + text + "]";
}

/// What stands between the brackets of a list.
class List {
 public:
  void add(const std::string& item) { text_ += (text_.empty() ? "" : ",\n") + item; }
  [[nodiscard]] std::string in_brackets() const { return "[" + text_ + "]"; }

 private:
  std::string text_;
};

class Writer {
 public:
  std::string write(const PlacedScene& scene, std::span<const std::string> names, std::span<const NodeMotion> motions) {
    for (const MeshData& mesh : scene.meshes) add(mesh);
    List nodes, roots;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      nodes.add(node(scene.objects[i], names[i], motions.empty() ? nullptr : &motions[i]));
      roots.add(std::to_string(i));
    }
    for (std::size_t i = 0; i < motions.size(); ++i) add(i, motions[i]);
    const std::string animations = channels_.in_brackets() == "[]"
                                       ? std::string()
                                       : R"("animations":[{"channels":)" + channels_.in_brackets() + R"(,"samplers":)" +
                                             samplers_.in_brackets() + "}],";
    std::string json = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" + roots.in_brackets() + "}]," +
                       animations + "\"nodes\":" + nodes.in_brackets() + ",\"meshes\":" + meshes_.in_brackets() +
                       ",\"accessors\":" + accessors_.in_brackets() + ",\"bufferViews\":" + views_.in_brackets() +
                       R"(,"buffers":[{"byteLength":)" + std::to_string(data_.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string file = "glTF";
    append<std::uint32_t>(file, 2);
    append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + data_.size()));
    append(file, static_cast<std::uint32_t>(json.size()));
    file += "JSON" + json;
    append(file, static_cast<std::uint32_t>(data_.size()));
    file += std::string("BIN\0", 4) + data_;
    return file;
  }

 private:
  void add(const MeshData& mesh) {
    std::array<double, 3> low{}, high{};
    const std::size_t first_byte = data_.size();
    for (std::size_t i = 0; i < mesh.xyz.size(); ++i) {
      const auto value = static_cast<float>(mesh.xyz[i]);
      append(data_, value);
      low[i % 3] = i < 3 ? double{value} : std::min(low[i % 3], double{value});
      high[i % 3] = i < 3 ? double{value} : std::max(high[i % 3], double{value});
    }
    const std::size_t first_index = data_.size();
    for (const std::uint32_t corner : mesh.triangles) append(data_, corner);
    add_view(first_byte, first_index);
    add_view(first_index, data_.size());
    accessors_.add(R"({"bufferView":)" + std::to_string(2 * count_) +
                   R"(,"componentType":5126,"type":"VEC3","count":)" + std::to_string(mesh.vertex_count()) +
                   ",\"min\":" + numbers(low) + ",\"max\":" + numbers(high) + "}");
    accessors_.add(R"({"bufferView":)" + std::to_string(2 * count_ + 1) +
                   R"(,"componentType":5125,"type":"SCALAR","count":)" + std::to_string(mesh.triangles.size()) + "}");
    meshes_.add(R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(2 * count_) + R"(},"indices":)" +
                std::to_string(2 * count_ + 1) + "}]}");
    ++count_;
    tables_ += 2;
  }

  template <std::size_t N>
  std::size_t add(const std::vector<std::array<double, N>>& values, const char* type) {
    const std::size_t first = data_.size();
    std::array<double, N> low{}, high{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t k = 0; k < N; ++k) {
        const auto value = static_cast<float>(values[i][k]);
        append(data_, value);
        low[k] = i == 0 ? double{value} : std::min(low[k], double{value});
        high[k] = i == 0 ? double{value} : std::max(high[k], double{value});
      }
    }
    add_view(first, data_.size());
    accessors_.add(R"({"bufferView":)" + std::to_string(tables_) + R"(,"componentType":5126,"type":")" + type +
                   R"(","count":)" + std::to_string(values.size()) + ",\"min\":" + numbers(low) +
                   ",\"max\":" + numbers(high) + "}");
    return tables_++;
  }

  void add(std::size_t node, const NodeMotion& motion) {
    if (motion.times.size() < 2) return;
    std::vector<std::array<double, 1>> times;
    for (const double time : motion.times) times.push_back({time});
    const std::size_t input = add(times, "SCALAR");
    const auto add_channel = [&](std::size_t output, const char* path) {
      samplers_.add(R"({"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(output) + "}");
      channels_.add(R"({"sampler":)" + std::to_string(sampler_count_++) + R"(,"target":{"node":)" +
                    std::to_string(node) + R"(,"path":")" + path + "\"}}");
    };
    add_channel(add(motion.rotations, "VEC4"), "rotation");
    add_channel(add(motion.translations, "VEC3"), "translation");
  }

  void add_view(std::size_t from, std::size_t to) {
    views_.add(R"({"buffer":0,"byteOffset":)" + std::to_string(from) + R"(,"byteLength":)" + std::to_string(to - from) +
               "}");
  }

  static std::string node(const PlacedObject& object, const std::string& name, const NodeMotion* motion) {
    const std::string begin = R"({"name":")" + name + R"(","mesh":)" + std::to_string(object.mesh);
    if (motion != nullptr)
      return begin + ",\"rotation\":" + numbers(motion->rotations[0]) +
             ",\"translation\":" + numbers(motion->translations[0]) + "}";
    const auto& R = object.pose.R;
    const auto& t = object.pose.t;
    const std::array<double, 16> columns{R[0], R[3], R[6], 0, R[1], R[4], R[7], 0,
                                         R[2], R[5], R[8], 0, t[0], t[1], t[2], 1};
    return begin + ",\"matrix\":" + numbers(columns) + "}";
  }

  std::string data_;
  List meshes_, accessors_, views_, channels_, samplers_;
  std::size_t count_ = 0, tables_ = 0, sampler_count_ = 0;
};

}  // namespace

std::string glb_bytes(const PlacedScene& scene, std::span<const std::string> names) {
  return Writer().write(scene, names, {});
}

std::string glb_bytes(const PlacedScene& scene, std::span<const std::string> names,
                      std::span<const NodeMotion> motions) {
  return Writer().write(scene, names, motions);
}

}  // namespace impinge::scenes
