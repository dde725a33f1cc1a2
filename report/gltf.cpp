// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/gltf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "report/conventions.hpp"
#include "report/json_writer.hpp"
#include "report/text.hpp"
#include "report/triage_json.hpp"
#include "report/vector.hpp"

namespace impinge::report {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF has numbers with the lowest byte first");

enum Mode { kPoints = 0, kLines = 1 };  // glTF 2.0, 3.7.2.1

/// A list in JSON that grows.
class List {
 public:
  /// Returns the item's number.
  std::size_t add(std::string_view item) {
    text_ += count_ > 0 ? ",\n" : "\n";
    text_ += item;
    return count_++;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// In bytes.
  [[nodiscard]] std::size_t size() const { return text_.size(); }
  /// As a member of an object, with a comma before it; glTF allows no list without items.
  [[nodiscard]] std::string member(std::string_view name) const {
    return count_ == 0 ? "" : fmt::format(",\n\"{}\":[{}]", name, text_);
  }

 private:
  std::string text_;
  std::size_t count_ = 0;
};

float nearest_float(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

std::string numbers(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? "," : "") + json_number(value);
  return text + "]";
}

/// Colours as baseColorFactor: linear, not sRGB.
constexpr std::array<std::string_view, 6> kColours{"[0.35,0.0,0.5,1]", "[0.0,0.15,0.6,1]",  "[0.6,0.0,0.05,1]",
                                                   "[0.75,0.2,0.0,1]", "[0.0,0.35,0.15,1]", "[0.2,0.2,0.2,1]"};

class Document {
 public:
  /// A mesh of points and of lines between them (two numbers a line), seen from `origin`; its number.
  std::size_t mesh(std::span<const Point> line_points, std::span<const std::uint32_t> ends,
                   std::span<const Point> points, const Point& origin, Verdict verdict) {
    std::string primitives;
    const auto material = static_cast<std::size_t>(verdict);
    if (!ends.empty())
      primitives = fmt::format("{{\"attributes\":{{\"POSITION\":{}}},\"indices\":{},\"material\":{},\"mode\":{}}}",
                               positions_of(line_points, origin), indices_of(ends), material, +kLines);
    if (!points.empty())
      primitives += fmt::format("{}{{\"attributes\":{{\"POSITION\":{}}},\"material\":{},\"mode\":{}}}",
                                primitives.empty() ? "" : ",", positions_of(points, origin), material, +kPoints);
    return meshes_.add(fmt::format("{{\"primitives\":[{}]}}", primitives));
  }

  /// A node of these members; its number.
  std::size_t node(std::string_view members) { return nodes_.add(fmt::format("{{{}}}", members)); }

  [[nodiscard]] bool is_too_large() const {
    constexpr std::uint64_t kRoom = 1 << 20;  // for what goes before and after the lists
    return nodes_.size() + meshes_.size() + accessors_.size() + 4 * (positions_.size() + indices_.size()) + kRoom >
           std::numeric_limits<std::uint32_t>::max();
  }

  void write(Sink& sink, std::size_t root) const {
    std::string text = json(root);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t data = 4 * (positions_.size() + indices_.size());
    constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
    const std::uint64_t all = 12 + 8 + text.size() + (data > 0 ? 8 + data : 0);
    u32(sink, {kMagic, kVersion, static_cast<std::uint32_t>(all), static_cast<std::uint32_t>(text.size()), kJson});
    sink.write(text);
    if (data == 0) return;
    u32(sink, {static_cast<std::uint32_t>(data), kBinary});
    bytes(sink, std::span(positions_));
    bytes(sink, std::span(indices_));
  }

 private:
  /// An accessor of positions; its number.
  std::size_t positions_of(std::span<const Point> points, const Point& origin) {
    const std::size_t offset = 4 * positions_.size();
    std::array<float, 3> least, most;
    least.fill(std::numeric_limits<float>::max());
    most.fill(std::numeric_limits<float>::lowest());
    for (const Point& point : points) {
      const Point p = point - origin;
      const std::array<float, 3> xyz{nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], xyz[k]);
        most[k] = std::max(most[k], xyz[k]);
      }
      positions_.insert(positions_.end(), xyz.begin(), xyz.end());
    }
    const std::array<double, 3> lo{least[0], least[1], least[2]}, hi{most[0], most[1], most[2]};
    return accessors_.add(
        fmt::format("{{\"bufferView\":0,\"byteOffset\":{},\"componentType\":5126,\"count\":{},\"type\":\"VEC3\","
                    "\"min\":{},\"max\":{}}}",
                    offset, points.size(), numbers(lo), numbers(hi)));
  }
  std::size_t indices_of(std::span<const std::uint32_t> ends) {
    const std::size_t offset = 4 * indices_.size();
    indices_.insert(indices_.end(), ends.begin(), ends.end());
    return accessors_.add(
        fmt::format("{{\"bufferView\":1,\"byteOffset\":{},\"componentType\":5125,\"count\":{},\"type\":\"SCALAR\"}}",
                    offset, ends.size()));
  }

  [[nodiscard]] std::string json(std::size_t root) const {
    List materials, views, buffers;
    for (std::size_t i = 0; i < kColours.size(); ++i)
      materials.add(fmt::format("{{\"name\":\"{}\",\"pbrMetallicRoughness\":{{\"baseColorFactor\":{}}}}}",
                                name(static_cast<Verdict>(i)), kColours[i]));
    constexpr int kVertices = 34962, kIndices = 34963;
    if (!positions_.empty()) {
      views.add(fmt::format("{{\"buffer\":0,\"byteLength\":{},\"target\":{}}}", 4 * positions_.size(), kVertices));
      if (!indices_.empty())
        views.add(fmt::format("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}",
                              4 * positions_.size(), 4 * indices_.size(), kIndices));
      buffers.add(fmt::format("{{\"byteLength\":{}}}", 4 * (positions_.size() + indices_.size())));
    }
    return fmt::format(
               "{{\"asset\":{{\"generator\":\"impinge\",\"version\":\"2.0\",\"extras\":{{\"schema\":1}}}},\n"
               "\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}]",
               root) +
           nodes_.member("nodes") + (meshes_.count() > 0 ? materials.member("materials") : "") +
           meshes_.member("meshes") + accessors_.member("accessors") + views.member("bufferViews") +
           buffers.member("buffers") + "}";
  }

  template <class T>
  static void bytes(Sink& sink, std::span<T> values) {
    sink.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  static void u32(Sink& sink, std::initializer_list<std::uint32_t> values) {
    bytes(sink, std::span(values.begin(), values.size()));
  }

  List nodes_, meshes_, accessors_;
  std::vector<float> positions_;
  std::vector<std::uint32_t> indices_;
};

std::string json_vector(const Point& p) { return numbers(std::array{p.x, p.y, p.z}); }

/// The region's lines and its centroid, about the middle of its box.
std::size_t node_of(Document& document, const Region& region, const RegionStanding& standing, std::size_t number,
                    Verdict verdict) {
  std::vector<Point> points;
  std::vector<std::uint32_t> ends;
  for (const auto& line : region.lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto at = static_cast<std::uint32_t>(points.size());
      if (i > 0) ends.insert(ends.end(), {at - 1, at});
      points.push_back(line[i]);
    }
  }
  const Point origin = middle(region.box[0], region.box[1]);
  const std::size_t mesh = document.mesh(points, ends, std::array{region.centroid}, origin, verdict);
  return document.node(fmt::format(
      "\"name\":\"region {}\",\"translation\":{},\"mesh\":{},\"extras\":{{\"id\":{},{},\"pairs\":{},\"area\":{},"
      "\"length\":{},\"centroid\":{},\"normal\":{}}}",
      number, json_vector(origin), mesh, json_string(standing.id), json_standing(standing.change, standing.remark),
      region.pairs, json_number(region.area), json_number(region.length), json_vector(region.centroid),
      json_vector(region.normal)));
}

std::size_t node_of(Document& document, const Nearest& nearest, Verdict verdict) {
  const Point origin = middle(nearest.a, nearest.b);
  const std::array ends{nearest.a, nearest.b};
  const std::size_t mesh = document.mesh(ends, std::array<std::uint32_t, 2>{0, 1}, ends, origin, verdict);
  return document.node(fmt::format("\"name\":\"nearest\",\"translation\":{},\"mesh\":{},\"extras\":{{\"distance\":{}}}",
                                   json_vector(origin), mesh, json_number(nearest.distance)));
}

std::string json_part(const Assembly& assembly, std::uint32_t object) {
  return fmt::format("{{\"id\":{},\"name\":{},\"path\":{},\"file\":{}}}", object,
                     json_string(assembly.objects[object].name), json_string(assembly.objects[object].path),
                     json_string(assembly.files[assembly.file_of[object]]));
}

std::size_t node_of(Document& document, const Review& review, std::size_t pair, std::size_t rank) {
  const Clash& clash = review.clashes.pairs[pair];
  const Standing& standing = review.standings[pair];
  const Assembly& assembly = review.assembly;
  List children;
  for (std::size_t i = 0; i < clash.regions.size(); ++i)
    children.add(fmt::format("{}", node_of(document, clash.regions[i], standing.regions[i], i + 1, clash.verdict)));
  if (clash.nearest) children.add(fmt::format("{}", node_of(document, *clash.nearest, clash.verdict)));
  const std::string title = fmt::format("{} / {}: {}", assembly.labels[clash.objects[0]],
                                        assembly.labels[clash.objects[1]], name(clash.verdict));
  std::string extras = fmt::format(
      "\"id\":\"{}\",\"rank\":{},\"verdict\":\"{}\",\"fails\":{},\"depth\":{},\"distance\":{},\"a\":{},\"b\":{}",
      review.ids[pair], rank, name(clash.verdict), standing.fails,
      clash.overlap_depth ? json_number(depth_of(clash)) : "null",
      clash.nearest ? json_number(clash.nearest->distance) : "null", json_part(assembly, clash.objects[0]),
      json_part(assembly, clash.objects[1]));
  extras += "," + json_triage(review, pair);
  return document.node(
      fmt::format("\"name\":{},\"extras\":{{{}}}{}", json_string(title), extras, children.member("children")));
}

}  // namespace

Result<void> write_gltf(Sink& sink, const Review& review, const ClashArguments& arguments,
                        const std::stop_token& stop) {
  Document document;
  List clashes;
  std::size_t rank = 0;
  for (const std::size_t pair : ranked(review.clashes.pairs)) {
    if (stop.stop_requested()) return interrupted();
    clashes.add(fmt::format("{}", node_of(document, review, pair, ++rank)));
    if (document.is_too_large())
      return Error{Code::bad_file, "the regions are more than a binary glTF can hold; leave pairs out by --ignore"};
  }
  const std::size_t root =
      document.node(fmt::format("\"name\":\"impinge\",\"matrix\":{}{}",
                                numbers(matrix_to_gltf(conventions_of(arguments))), clashes.member("children")));
  document.write(sink, root);
  return {};
}

}  // namespace impinge::report
