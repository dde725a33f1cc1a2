// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace impinge::test {

/// A glTF 2.0 file that is put together piece by piece. Its mesh 0 is the cube from -1 to 1.
class AnimatedGltf {
 public:
  using json = nlohmann::json;

  AnimatedGltf() {
    root = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", json::array({{{"nodes", json::array()}}})},
            {"nodes", json::array()},
            {"meshes", json::array()},
            {"bufferViews", json::array()},
            {"accessors", json::array()}};
    std::vector<double> corners;
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) corners.push_back((i >> k & 1) * 2 - 1);
    mesh(corners,
         {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5});
  }

  /// Three numbers for each corner, three corners for each triangle. Returns the mesh's number.
  int mesh(const std::vector<double>& corners, const std::vector<int>& triangles) {
    const int positions = floats(corners, "VEC3");
    json lo = json::array(), hi = json::array();
    for (std::size_t k = 0; k < 3; ++k) {
      float least = static_cast<float>(corners[k]), most = least;
      for (std::size_t i = k; i < corners.size(); i += 3)
        least = std::min(least, static_cast<float>(corners[i])), most = std::max(most, static_cast<float>(corners[i]));
      lo.push_back(least), hi.push_back(most);
    }
    root["accessors"].back()["min"] = lo, root["accessors"].back()["max"] = hi;
    std::string indices;
    for (const int corner : triangles) append(indices, static_cast<std::uint16_t>(corner));
    const int list = accessor(view(indices), 5123, triangles.size(), "SCALAR");
    root["meshes"].push_back(
        {{"primitives", json::array({{{"attributes", {{"POSITION", positions}}}, {"indices", list}}})}});
    return static_cast<int>(root["meshes"].size()) - 1;
  }

  /// A node; a root unless it is named among some node's children. Returns its number.
  int node(json about) {
    root["nodes"].push_back(std::move(about));
    return static_cast<int>(root["nodes"].size()) - 1;
  }
  void roots(const std::vector<int>& nodes) { root["scenes"][0]["nodes"] = nodes; }

  int view(std::string_view data, int stride = 0) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}});
    if (stride > 0) root["bufferViews"].back()["byteStride"] = stride;
    bytes += data;
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  int accessor(int view, int component, std::size_t count, const char* type, std::size_t offset = 0) {
    root["accessors"].push_back({{"bufferView", view},
                                 {"componentType", component},
                                 {"count", count},
                                 {"type", type},
                                 {"byteOffset", offset},
                                 {"normalized", component != 5126 && component != 5125}});
    if (component == 5123 && std::string_view(type) == "SCALAR") root["accessors"].back().erase("normalized");
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  int floats(const std::vector<double>& numbers, const char* type) {
    std::string data;
    for (const double number : numbers) append(data, static_cast<float>(number));
    const std::string_view name = type;
    return accessor(view(data), 5126, numbers.size() / (name == "SCALAR" ? 1 : name == "VEC3" ? 3 : 4), type);
  }

  void animation(const std::string& name) {
    root["animations"].push_back({{"name", name}, {"channels", json::array()}, {"samplers", json::array()}});
  }
  /// A channel of the last animation with accessors that are there.
  void channel(int node, const char* path, int input, int output, const char* between) {
    json& last = root["animations"].back();
    last["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", between}});
    last["channels"].push_back(
        {{"sampler", last["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }
  void channel(int node, const char* path, const std::vector<double>& times, const std::vector<double>& values,
               const char* between = "LINEAR") {
    const int input = floats(times, "SCALAR");
    channel(node, path, input, floats(values, std::string_view(path) == "rotation" ? "VEC4" : "VEC3"), between);
  }

  /// The text, with the buffer in it or at a URI.
  [[nodiscard]] std::string text(const std::string& uri = {}) const {
    json whole = root;
    whole["buffers"] =
        json::array({{{"byteLength", bytes.size()},
                      {"uri", uri.empty() ? "data:application/octet-stream;base64," + base64(bytes) : uri}}});
    return whole.dump();
  }
  [[nodiscard]] std::string glb() const {
    json whole = root;
    whole["buffers"] = json::array({{{"byteLength", bytes.size()}}});
    std::string text = whole.dump(), data = bytes, file = "glTF";
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4);
    append(file, std::uint32_t{2});
    append(file, static_cast<std::uint32_t>(28 + text.size() + data.size()));
    append(file, static_cast<std::uint32_t>(text.size()));
    file += "JSON" + text;
    append(file, static_cast<std::uint32_t>(data.size()));
    return file + std::string("BIN\0", 4) + data;
  }

  template <class T>
  static void append(std::string& out, T number) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(number);
    out.append(raw.data(), raw.size());
  }

  static std::string base64(std::string_view data) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < data.size(); i += 3) {
      std::uint32_t three = 0;
      for (std::size_t k = 0; k < 3; ++k)
        three = three << 8U | (i + k < data.size() ? static_cast<unsigned char>(data[i + k]) : 0U);
      for (std::size_t k = 0; k < 4; ++k) out += i + k <= data.size() ? kDigits[three >> (18 - 6 * k) & 63U] : '=';
    }
    return out;
  }

  json root;
  std::string bytes;
};

}  // namespace impinge::test
