// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
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
#include "report/vector.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF has numbers with the lowest byte first");

enum { kPoints = 0, kLines = 1 };  // glTF 2.0, 3.7.2.1

float nearest_float(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// Colours as baseColorFactor: linear, not sRGB.
constexpr std::array<std::array<double, 4>, 6> kColours{{{0.35, 0, 0.5, 1},
                                                         {0, 0.15, 0.6, 1},
                                                         {0.6, 0, 0.05, 1},
                                                         {0.75, 0.2, 0, 1},
                                                         {0, 0.35, 0.15, 1},
                                                         {0.2, 0.2, 0.2, 1}}};

class Document {
 public:
  /// A mesh of points and of lines between them (two numbers a line), seen from `origin`; its number.
  std::size_t mesh(std::span<const Point> line_points, std::span<const std::uint32_t> ends,
                   std::span<const Point> points, const Point& origin, Verdict verdict) {
    Json primitives = Json::array();
    const auto material = static_cast<std::size_t>(verdict);
    if (!ends.empty())
      primitives.push_back(Json{{"attributes", {{"POSITION", positions_of(line_points, origin)}}},
                                {"indices", indices_of(ends)},
                                {"material", material},
                                {"mode", +kLines}});
    if (!points.empty())
      primitives.push_back(Json{
          {"attributes", {{"POSITION", positions_of(points, origin)}}}, {"material", material}, {"mode", +kPoints}});
    return add("meshes", Json{{"primitives", std::move(primitives)}});
  }

  /// Something about the whole document.
  void about(const char* key, Json value) { json_["asset"]["extras"][key] = std::move(value); }
  /// Returns the node's number.
  std::size_t node(Json node) { return add("nodes", std::move(node)); }

  /// Errors: `bad_file` where it is too large.
  Result<void> write(Sink& sink, std::size_t root) {
    add_buffer();
    json_["scenes"] = Json::array({Json{{"nodes", {root}}}});
    std::string text = json_text(json_);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t data = 4 * (positions_.size() + indices_.size());
    constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
    const std::uint64_t all = 12 + 8 + text.size() + (data > 0 ? 8 + data : 0);
    if (all > std::numeric_limits<std::uint32_t>::max())
      return Error{Code::bad_file, "the regions are more than a binary glTF can hold; leave pairs out by --ignore"};
    u32(sink, {kMagic, kVersion, static_cast<std::uint32_t>(all), static_cast<std::uint32_t>(text.size()), kJson});
    sink.write(text);
    if (data == 0) return {};
    u32(sink, {static_cast<std::uint32_t>(data), kBinary});
    bytes(sink, std::span(positions_));
    bytes(sink, std::span(indices_));
    return {};
  }

 private:
  /// Adds an item to a list of the document, which is made with its first one as glTF allows none without; its number.
  std::size_t add(const char* list, Json item) {
    Json& items = json_[list];
    items.push_back(std::move(item));
    return items.size() - 1;
  }

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
    return add("accessors", Json{{"bufferView", 0},
                                 {"byteOffset", offset},
                                 {"componentType", 5126},
                                 {"count", points.size()},
                                 {"type", "VEC3"},
                                 {"min", std::array<double, 3>{least[0], least[1], least[2]}},
                                 {"max", std::array<double, 3>{most[0], most[1], most[2]}}});
  }
  std::size_t indices_of(std::span<const std::uint32_t> ends) {
    const std::size_t offset = 4 * indices_.size();
    indices_.insert(indices_.end(), ends.begin(), ends.end());
    return add("accessors", Json{{"bufferView", 1},
                                 {"byteOffset", offset},
                                 {"componentType", 5125},
                                 {"count", ends.size()},
                                 {"type", "SCALAR"}});
  }

  /// Describes the numbers that follow the JSON, and adds the materials of what they draw.
  void add_buffer() {
    constexpr int kVertices = 34962, kIndices = 34963;
    const std::size_t vertices = 4 * positions_.size(), indices = 4 * indices_.size();
    if (vertices == 0) return;
    add("bufferViews", Json{{"buffer", 0}, {"byteLength", vertices}, {"target", kVertices}});
    if (indices > 0)
      add("bufferViews", Json{{"buffer", 0}, {"byteOffset", vertices}, {"byteLength", indices}, {"target", kIndices}});
    add("buffers", Json{{"byteLength", vertices + indices}});
    for (std::size_t i = 0; i < kColours.size(); ++i)
      add("materials",
          Json{{"name", name(static_cast<Verdict>(i))}, {"pbrMetallicRoughness", {{"baseColorFactor", kColours[i]}}}});
  }

  template <class T>
  static void bytes(Sink& sink, std::span<T> values) {
    sink.write({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  static void u32(Sink& sink, std::initializer_list<std::uint32_t> values) {
    bytes(sink, std::span(values.begin(), values.size()));
  }

  Json json_{{"asset", {{"generator", "impinge"}, {"version", "2.0"}, {"extras", {{"schema", 1}}}}}, {"scene", 0}};
  std::vector<float> positions_;
  std::vector<std::uint32_t> indices_;
};

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
  Json extras{{"id", standing.id},
              {"change", or_null(name(standing.change))},
              {"pairs", region.pairs},
              {"area", region.area},
              {"length", region.length},
              {"centroid", json_point(region.centroid)},
              {"normal", json_point(region.normal)}};
  return document.node({{"name", fmt::format("region {}", number)},
                        {"translation", json_point(origin)},
                        {"mesh", mesh},
                        {"extras", std::move(extras)}});
}

std::size_t node_of(Document& document, const Nearest& nearest, Verdict verdict) {
  const Point origin = middle(nearest.a, nearest.b);
  const std::array ends{nearest.a, nearest.b};
  const std::size_t mesh = document.mesh(ends, std::array<std::uint32_t, 2>{0, 1}, ends, origin, verdict);
  return document.node({{"name", "nearest"},
                        {"translation", json_point(origin)},
                        {"mesh", mesh},
                        {"extras", {{"distance", nearest.distance}}}});
}

Json json_part(const Assembly& assembly, std::uint32_t object) {
  return {{"id", object},
          {"name", assembly.objects[object].name},
          {"path", assembly.objects[object].path},
          {"file", assembly.files[assembly.file_of[object]]}};
}

std::size_t node_of(Document& document, const Review& review, std::size_t pair, std::size_t rank) {
  const Clash& clash = review.clashes.pairs[pair];
  const Standing& standing = review.standings[pair];
  const Assembly& assembly = review.assembly;
  std::vector<std::size_t> children;
  for (std::size_t i = 0; i < clash.regions.size(); ++i)
    children.push_back(node_of(document, clash.regions[i], standing.regions[i], i + 1, clash.verdict));
  if (clash.nearest) children.push_back(node_of(document, *clash.nearest, clash.verdict));
  Json extras{{"id", review.ids[pair]},
              {"rank", rank},
              {"verdict", name(clash.verdict)},
              {"fails", standing.fails},
              {"fails_below", json_finite(clash.fails_below)},
              {"depth", clash.overlap_depth ? Json(depth_of(clash.overlap_depth).hi) : Json()},
              {"volume", clash.overlap_volume ? Json(clash.overlap_volume->volume) : Json()},
              {"distance", clash.nearest ? Json(clash.nearest->distance) : Json()},
              {"a", json_part(assembly, clash.objects[0])},
              {"b", json_part(assembly, clash.objects[1])}};
  extras.update(json_triage(review, pair));
  Json node{{"name", fmt::format("{} / {}: {}", assembly.labels[clash.objects[0]], assembly.labels[clash.objects[1]],
                                 name(clash.verdict))},
            {"extras", std::move(extras)}};
  if (!children.empty()) node["children"] = children;
  return document.node(std::move(node));
}

}  // namespace

Result<void> write_gltf(Sink& sink, const Review& review) {
  Document document;
  std::vector<std::size_t> clashes;
  std::size_t rank = 0;
  for (const std::size_t pair : ranked(review.clashes.pairs)) {
    if (review.options.stop.stop_requested()) return interrupted();
    clashes.push_back(node_of(document, review, pair, ++rank));
  }
  if (!review.assembly.missing.empty()) document.about("missing", review.assembly.missing);
  if (!review.assembly.alignment.empty()) document.about("warnings", review.assembly.alignment);
  Json root{{"name", "impinge"}, {"matrix", matrix_to_gltf(conventions_of(review.options, review.assembly))}};
  if (!clashes.empty()) root["children"] = clashes;
  return document.write(sink, document.node(std::move(root)));
}

}  // namespace impinge::report
