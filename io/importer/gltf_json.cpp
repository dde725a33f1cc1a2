// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/gltf_json.hpp"

#include <utf8.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/little_endian.hpp"
#include "io/text.hpp"

namespace impinge::importer {
namespace {

constexpr std::size_t kGlbHeader = 20;  // with the first chunk's length and type

}  // namespace

bool is_gltf_name(const char* file) {
  const std::string ending = io::lower_case(std::filesystem::path(file).extension().string());
  return ending == ".gltf" || ending == ".glb" || ending == ".vrm";
}

const nlohmann::json& member(const nlohmann::json& object, const char* name) {
  static const nlohmann::json kNull;
  if (!object.is_object()) return kNull;
  const auto place = object.find(name);
  return place == object.end() ? kNull : *place;
}

const nlohmann::json& element(const nlohmann::json& list, const nlohmann::json& reference) {
  static const nlohmann::json kNull;
  if (list.is_object() && reference.is_string()) return member(list, reference.get_ref<const std::string&>().c_str());
  if (!list.is_array() || !reference.is_number_unsigned()) return kNull;
  const auto index = reference.get<std::uint64_t>();
  return index < list.size() ? list[index] : kNull;
}

const nlohmann::json& shown_roots(const nlohmann::json& file) {
  static const nlohmann::json kFirst = 0U;
  const nlohmann::json& chosen = member(file, "scene");
  return member(element(member(file, "scenes"), chosen.is_null() ? kFirst : chosen), "nodes");
}

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::int64_t integer_of(const nlohmann::json& value, std::int64_t missing) {
  return value.is_number_integer() ? value.get<std::int64_t>() : missing;
}

std::string json_text(const char* file, std::string& problem) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  const std::streamoff end = in.tellg();
  if (!in || end < 0) return problem = "the file cannot be read", std::string();
  auto length = static_cast<std::size_t>(end);
  in.seekg(0);
  std::array<char, kGlbHeader> header{};
  in.read(header.data(), header.size());
  const bool is_binary = in.gcount() >= 4 && std::string_view(header.data(), 4) == "glTF";
  if (is_binary) {
    if (length < kGlbHeader) return problem = "the file ends in the GLB header; it is cut short", std::string();
    const auto chunk = io::load_little<std::uint32_t>(header.data() + 12);
    if (chunk > length - kGlbHeader) {
      problem = io::sentence("the JSON chunk of ", chunk, " bytes is longer than the rest of the file, ",
                             length - kGlbHeader, " bytes; it is cut short");
      return {};
    }
    length = chunk;
  }
  std::string text(length, '\0');
  in.clear();
  in.seekg(is_binary ? std::streamoff{kGlbHeader} : 0);
  in.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(std::min(static_cast<std::size_t>(in.gcount()), text.find('\0')));  // some pad a chunk with NULs
  text.erase(0, text.size() - io::without_byte_order_mark(text).size());
  // assimp takes any bytes in names, the parser only UTF-8.
  if (!utf8::is_valid(text.begin(), text.end()))
    std::replace_if(
        text.begin(), text.end(), [](char c) { return (c & 0x80) != 0; }, '?');
  return text;
}

}  // namespace impinge::importer
