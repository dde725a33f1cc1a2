// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/import_stream.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <type_traits>

namespace impinge::io {
namespace {

constexpr std::string_view kMagic = "impinge6";
constexpr std::size_t kBufferBytes = std::size_t{1} << 16;

/// Numbers of a key.
std::uint64_t width_of(const Track& track) {
  const std::uint64_t one = track.property == Track::Property::rotation ? 4 : 3;
  return track.between == Track::Between::cubic ? 3 * one : one;
}

class Decoder {
 public:
  explicit Decoder(std::string_view stream) : rest_(stream) {}

  Result<Imported> decode() {
    if (!rest_.starts_with(kMagic)) return incomplete();
    rest_.remove_prefix(kMagic.size());
    for (;;) {
      char letter = 0;
      if (!read(letter)) return incomplete();
      if (letter == 'Z' && rest_.empty()) return std::move(out_);
      if (letter == 'E') {
        if (!read(out_.error)) return incomplete();
        return std::move(out_);
      }
      if (!record(letter)) return incomplete();
    }
  }

 private:
  bool record(char letter) {
    switch (letter) {
      case 'M':
        return mesh();
      case 'G':
        return group();
      case 'O':
        return object();
      case 'P':
        return property();
      case 'I':
        return !out_.objects.empty() && read(out_.objects.back().incomplete);
      case 'L':
        return read(out_.unit_in_metres.emplace());
      case 'D':
        return out_.exact_places = true;
      case 'R':
        return grid();
      case 'N':
        return node();
      case 'A':
        return animation();
      case 'T':
        return track();
      case 'U':
        return unfollowed();
      case 'W':
        return read(out_.warnings.emplace_back());
      case 'X':
        return read(out_.missing.emplace_back());
      default:
        return false;
    }
  }

  static Error incomplete() { return {Code::bad_file, "what it wrote is incomplete"}; }

  /// Reads fields in their order, as long as there are bytes.
  template <class... Fields>
  bool read(Fields&... fields) {
    return (field(fields) && ...);
  }
  template <class T>
  bool field(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (rest_.size() < sizeof value) return false;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return true;
  }
  template <class T>
  bool numbers(std::vector<T>& values, std::uint64_t count) {
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), rest_.data(), count * sizeof(T));
    rest_.remove_prefix(count * sizeof(T));
    return true;
  }
  bool field(std::string& value) {
    std::uint32_t length = 0;
    if (!field(length) || length > rest_.size()) return false;
    value = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return true;
  }

  /// Whether a number is that of one of a list's items, or of none.
  static bool is_known(std::uint32_t number, const auto& list) { return number == kNoNode || number < list.size(); }

  bool mesh() {
    std::uint64_t vertices = 0, triangles = 0;
    if (!read(vertices, triangles)) return false;
    constexpr std::uint64_t kVertexBytes = 3 * sizeof(double), kTriangleBytes = 3 * sizeof(std::uint32_t);
    if (vertices > rest_.size() / kVertexBytes) return false;
    if (triangles > (rest_.size() - vertices * kVertexBytes) / kTriangleBytes) return false;
    ImportedMesh& mesh = out_.meshes.emplace_back();
    return numbers(mesh.xyz, 3 * vertices) && numbers(mesh.triangles, 3 * triangles);
  }

  bool group() {
    ImportedGroup group{};
    if (!read(group.name, group.parent) || !is_known(group.parent, out_.groups)) return false;
    out_.groups.push_back(std::move(group));
    return true;
  }

  bool object() {
    ImportedObject& object = out_.objects.emplace_back();
    return read(object.name, object.path, object.product, object.mesh, object.node, object.group, object.world) &&
           object.mesh < out_.meshes.size() && is_known(object.node, out_.nodes) && is_known(object.group, out_.groups);
  }

  bool property() {
    if (out_.objects.empty()) return false;
    auto& [name, value] = out_.objects.back().properties.emplace_back();
    return read(name, value);
  }

  bool grid() {
    Grid& grid = out_.grids.emplace_back();
    std::uint32_t axes = 0;
    if (!read(grid.name, grid.storey, axes)) return false;
    for (; axes > 0; --axes) {
      GridAxis& axis = grid.axes.emplace_back();
      std::uint64_t points = 0;
      if (!read(axis.tag, axis.family, points) || axis.family > 2) return false;
      if (points < 2 || points > rest_.size() / sizeof(Point)) return false;
      if (!numbers(axis.points, points)) return false;
    }
    return true;
  }

  bool node() {
    ImportedNode node{};
    if (!read(node.parent, node.local, node.scale, node.rotation, node.translation)) return false;
    if (!is_known(node.parent, out_.nodes)) return false;
    out_.nodes.push_back(node);
    return true;
  }

  bool animation() {
    Animation& animation = out_.animations.emplace_back();
    return read(animation.name, animation.seconds);
  }

  bool track() {
    if (out_.animations.empty()) return false;
    Track& track = out_.animations.back().tracks.emplace_back();
    std::uint32_t property = 0, between = 0;
    std::uint64_t keys = 0;
    if (!read(track.node, property, between, keys)) return false;
    if (track.node >= out_.nodes.size() || property > 2 || between > 2) return false;
    track.property = static_cast<Track::Property>(property);
    track.between = static_cast<Track::Between>(between);
    const std::uint64_t width = width_of(track);
    if (keys == 0 || keys > rest_.size() / ((1 + width) * sizeof(double))) return false;
    return numbers(track.times, keys) && numbers(track.values, keys * width);
  }

  bool unfollowed() {
    if (out_.animations.empty()) return false;
    Unfollowed& lost = out_.animations.back().unfollowed.emplace_back();
    std::uint32_t node = 0, what = 0;
    if (!read(node, what, lost.sentence) || what > 1 || !is_known(node, out_.nodes)) return false;
    lost.what = static_cast<Unfollowed::What>(what);
    if (node != kNoNode) lost.node = node;
    return true;
  }

  std::string_view rest_;
  Imported out_;
};

}  // namespace

ImportWriter::ImportWriter(int descriptor) : descriptor_(descriptor) {
  buffer_.reserve(kBufferBytes);
  bytes(kMagic.data(), kMagic.size());
}

void ImportWriter::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty() && !failed_) {
    const ssize_t written = write(descriptor_, rest.data(), rest.size());
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) failed_ = true;
  }
  buffer_.clear();
}

void ImportWriter::bytes(const void* data, std::size_t count) {
  std::string_view rest(static_cast<const char*>(data), count);
  while (!rest.empty()) {
    if (buffer_.size() >= kBufferBytes) flush();
    const std::string_view part = rest.substr(0, kBufferBytes - buffer_.size());
    buffer_ += part;
    rest.remove_prefix(part.size());
  }
}

void ImportWriter::field(std::string_view text) {
  field(static_cast<std::uint32_t>(text.size()));
  bytes(text.data(), text.size());
}

template <class... Fields>
void ImportWriter::record(char letter, const Fields&... fields) {
  bytes(&letter, 1);
  (field(fields), ...);
}

void ImportWriter::mesh(std::span<const double> xyz, std::span<const std::uint32_t> triangles) {
  record('M', std::uint64_t{xyz.size() / 3}, std::uint64_t{triangles.size() / 3});
  bytes(xyz.data(), xyz.size_bytes());
  bytes(triangles.data(), triangles.size_bytes());
}

void ImportWriter::group(std::string_view name, std::uint32_t parent) { record('G', name, parent); }

void ImportWriter::object(std::string_view name, std::string_view path, std::string_view product, std::uint32_t mesh,
                          std::uint32_t node, std::uint32_t group, const std::array<double, 16>& world) {
  record('O', name, path, product, mesh, node, group, world);
}

void ImportWriter::node(const ImportedNode& node) {
  record('N', node.parent, node.local, node.scale, node.rotation, node.translation);
}

void ImportWriter::animation(const Animation& animation) {
  const auto number = [](auto value) { return static_cast<std::uint32_t>(value); };
  record('A', animation.name, animation.seconds);
  for (const Track& track : animation.tracks) {
    record('T', track.node, number(track.property), number(track.between), std::uint64_t{track.times.size()});
    bytes(track.times.data(), track.times.size() * sizeof(double));
    bytes(track.values.data(), track.values.size() * sizeof(double));
  }
  for (const Unfollowed& lost : animation.unfollowed)
    record('U', lost.node.value_or(kNoNode), number(lost.what), lost.sentence);
}

void ImportWriter::grid(const Grid& grid) {
  record('R', grid.name, grid.storey, static_cast<std::uint32_t>(grid.axes.size()));
  for (const GridAxis& axis : grid.axes) {
    field(axis.tag);
    field(axis.family);
    field(std::uint64_t{axis.points.size()});
    bytes(axis.points.data(), axis.points.size() * sizeof(Point));
  }
}

void ImportWriter::property(std::string_view name, std::string_view value) { record('P', name, value); }

void ImportWriter::incomplete(std::string_view text) { record('I', text); }

void ImportWriter::unit(double metres) { record('L', metres); }

void ImportWriter::exact_places() { record('D'); }

void ImportWriter::warning(std::string_view message) { record('W', message); }

void ImportWriter::missing(std::string_view message) { record('X', message); }

void ImportWriter::error(std::string_view message) {
  record('E', message);
  flush();
}

bool ImportWriter::end() {
  record('Z');
  flush();
  return !failed_;
}

Result<Imported> decode_import(std::string_view stream) { return Decoder(stream).decode(); }

}  // namespace impinge::io
