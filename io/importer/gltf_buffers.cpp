// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/gltf_buffers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <type_traits>

#include "io/importer/gltf_json.hpp"
#include "io/little_endian.hpp"

namespace impinge::importer {
namespace {

using nlohmann::json;

/// A type of component: its size, and what it is divided by where it stands for a fraction (glTF 2.0, section 3.6.2).
struct Component {
  std::size_t bytes;
  double one;
  double (*load)(const char*);

  /// The least whole number is as good as the next one, so that both signs reach as far.
  [[nodiscard]] double value(const char* from) const {
    return one == 1 ? load(from) : std::max(load(from) / one, -1.0);
  }
};

template <class T, class Bits = std::make_unsigned_t<T>>
double load(const char* from) {
  return static_cast<double>(std::bit_cast<T>(io::load_little<Bits>(from)));
}
double load_float(const char* from) { return std::bit_cast<float>(io::load_little<std::uint32_t>(from)); }

std::optional<Component> component_of(std::int64_t type) {
  switch (type) {
    case 5120:
      return Component{1, 127, load<std::int8_t>};
    case 5121:
      return Component{1, 255, load<std::uint8_t>};
    case 5122:
      return Component{2, 32767, load<std::int16_t>};
    case 5123:
      return Component{2, 65535, load<std::uint16_t>};
    case 5126:
      return Component{4, 1, load_float};
    default:
      return std::nullopt;
  }
}

/// A count or an offset, up to what no file reaches; nothing for anything else.
std::optional<std::uint64_t> size_of(const json& value, std::uint64_t missing) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40;
  if (value.is_null()) return missing;
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kMost) return std::nullopt;
  return value.get<std::uint64_t>();
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in ? std::string(std::istreambuf_iterator<char>(in), {}) : std::string();
}

/// RFC 4648; ends at the first character that is no digit.
std::string from_base64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t group = 0, bits = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) break;
    group = group << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 0xFFU);
  }
  return bytes;
}

/// A path as a URI has it: "%20" is a space (RFC 3986, section 2.1).
std::string from_uri(std::string_view uri) {
  std::string path;
  const auto digit = [](char c) { return std::string_view("0123456789abcdef").find(static_cast<char>(c | 0x20)); };
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) < 16 && digit(uri[i + 2]) < 16) {
      path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

}  // namespace

GltfBuffers::GltfBuffers(const char* file, const json& root) : file_(file), root_(root) {}

std::vector<double> GltfBuffers::read(const json& accessor, std::size_t components) {
  constexpr std::array<std::string_view, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
  const json& view = element(member(root_, "bufferViews"), member(accessor, "bufferView"));
  const auto component = component_of(integer_of(member(accessor, "componentType"), 0));
  if (!component || !view.is_object() || accessor.contains("sparse")) return {};
  if (text_of(member(accessor, "type")) != kTypes[components - 1]) return {};
  const std::string& bytes = bytes_of(element(member(root_, "buffers"), member(view, "buffer")));
  const json& stride_of = member(view, "byteStride");
  const std::size_t size = components * component->bytes;
  const auto count = size_of(member(accessor, "count"), 0), offset = size_of(member(accessor, "byteOffset"), 0),
             start = size_of(member(view, "byteOffset"), 0),
             stride = size_of(stride_of.is_null() ? member(accessor, "byteStride") : stride_of, 0);  // glTF 1
  if (!count || !offset || !start || !stride || *count == 0) return {};
  const std::uint64_t step = *stride == 0 ? size : *stride, first = *start + *offset;
  if (first > bytes.size() || size > bytes.size() - first || step < size ||
      *count - 1 > (bytes.size() - first - size) / step)
    return {};
  std::vector<double> numbers;
  numbers.reserve(*count * components);
  for (std::uint64_t i = 0; i < *count; ++i)
    for (std::size_t k = 0; k < components; ++k)
      numbers.push_back(component->value(bytes.data() + first + i * step + k * component->bytes));
  return numbers;
}

const std::string& GltfBuffers::bytes_of(const json& buffer) {
  const auto [place, is_new] = loaded_.try_emplace(&buffer);
  if (is_new) place->second = load(buffer);
  return place->second;
}

std::string GltfBuffers::load(const json& buffer) const {
  const std::string uri = text_of(member(buffer, "uri"));
  if (!uri.starts_with("data:")) {
    const std::string path = from_uri(uri);
    return path.empty() ? binary_chunk() : file_bytes(file_.parent_path() / path);
  }
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) return {};
  return from_base64(std::string_view(uri).substr(comma + 1));
}

/// The second chunk of a GLB file.
std::string GltfBuffers::binary_chunk() const {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  std::string bytes = file_bytes(file_);
  if (bytes.size() < kHeader + 2 * kChunkHeader || !bytes.starts_with("glTF")) return {};
  const std::uint64_t begin = kHeader + kChunkHeader + io::load_little<std::uint32_t>(bytes.data() + kHeader);
  if (begin > bytes.size() - kChunkHeader) return {};
  const std::uint64_t length = io::load_little<std::uint32_t>(bytes.data() + begin);
  bytes.erase(0, begin + kChunkHeader);
  if (bytes.size() > length) bytes.resize(length);
  return bytes;
}

}  // namespace impinge::importer
