// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "core/guarded.hpp"
#include "io/little_endian.hpp"
#include "io/model.hpp"
#include "io/readers.hpp"

/// STL: text, in which every solid is an object, or binary, one object of 32-bit floats. Vertices at equal
/// coordinates become one; normals and attributes are passed over.
namespace impinge::io {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50;

/// Finds the vertex at given coordinates, or makes it.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<double>& xyz) : xyz_(xyz) {}

  std::uint32_t vertex_at(const Point& point) {
    const auto next = static_cast<std::uint32_t>(xyz_.size() / 3);
    // -0 + 0 is 0: both zeros are one coordinate.
    const auto [place, is_new] = index_.try_emplace(Point{point.x + 0.0, point.y + 0.0, point.z + 0.0}, next);
    if (is_new) xyz_.insert(xyz_.end(), {point.x, point.y, point.z});
    return place->second;
  }
  void clear() { index_.clear(); }

 private:
  /// With a secret in it, or a file could be made whose points all fall on one another, and reading it would take
  /// quadratic time. No answer depends on the secret: vertices are numbered as they come.
  struct Hash {
    std::size_t operator()(const Point& p) const {
      static const std::uint64_t secret = random_bits();
      std::uint64_t hash = secret;
      for (const double x : {p.x, p.y, p.z}) hash = mixed(hash ^ std::bit_cast<std::uint64_t>(x));
      return hash;
    }

   private:
    static std::uint64_t random_bits() {
      std::uint64_t bits = 0;
      const bool is_random = getentropy(&bits, sizeof bits) == 0;
      return is_random ? bits : 0x9E3779B97F4A7C15;
    }
    /// The finaliser of splitmix64.
    static std::uint64_t mixed(std::uint64_t x) {
      x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
      x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
      return x ^ (x >> 31);
    }
  };
  std::vector<double>& xyz_;
  std::unordered_map<Point, std::uint32_t, Hash> index_;
};

Result<Model> read_binary(std::string_view bytes, const Source& source) {
  const auto count = load_little<std::uint32_t>(bytes.data() + 80);
  const std::size_t present = (bytes.size() - kHeaderBytes) / kFacetBytes;
  if (count > present) {
    return byte_error(source, 80,
                      sentence("the header promises ", count, " triangles, but the file holds only ", present,
                               " whole ones; it is cut short, or not an STL file"));
  }
  if (count < present) {
    return byte_error(source, 80,
                      sentence("the header promises ", count, " triangles, but there is room for ", present,
                               " in the file; it is another format, or its header is wrong"));
  }
  Parts out;
  out.floats = true;
  Part& part = out.parts.emplace_back();
  part.corners.reserve(3 * std::size_t{count});
  part.sizes.assign(count, 3);
  VertexMerger merger(out.xyz);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t byte = kHeaderBytes + i * kFacetBytes + 12 + corner * 12;
      std::array<double, 3> x{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        x[axis] = std::bit_cast<float>(load_little<std::uint32_t>(bytes.data() + byte + 4 * axis));
        if (!std::isfinite(x[axis])) {
          return byte_error(source, byte + 4 * axis,
                            sentence("triangle ", i,
                                     " has a coordinate that is not a finite "
                                     "number; repair the mesh or leave the triangle out"));
        }
      }
      part.corners.push_back(merger.vertex_at({x[0], x[1], x[2]}));
    }
  }
  if (const std::size_t rest = bytes.size() - kHeaderBytes - count * kFacetBytes; rest > 0) {
    out.warnings.push_back(
        sentence("The ", rest, " bytes after the last triangle of ", source.label, " were ignored."));
  }
  return make_model(source, std::move(out));
}

class TextReader : FailingReader {
 public:
  TextReader(std::string_view bytes, const Source& source) : source_(source), words_(bytes) {}

  Result<Model> read() {
    for (std::string_view word = words_.word(); !word.empty(); word = words_.word()) {
      if (!read_solid(word)) return line_error(source_, words_.line(), problem_);
    }
    return make_model(source_, std::move(out_));
  }

 private:
  bool expect(std::string_view keyword) {
    const std::string_view word = words_.word();
    if (lower_case(word) == keyword) return true;
    if (word.empty()) return fail(sentence("the file ends where '", keyword, "' should stand; it is cut short"));
    return fail(
        sentence(in_quotes(word), " stands where '", keyword, "' should; the file is no text STL from here on"));
  }

  bool read_solid(std::string_view first) {
    if (lower_case(first) != "solid") return fail(sentence(in_quotes(first), " stands where 'solid' should"));
    out_.parts.push_back({std::string(trimmed(words_.rest_of_line())), {}, {}});
    merger_.clear();
    for (;;) {
      const std::string word = lower_case(words_.word());
      if (word == "endsolid") {
        words_.rest_of_line();
        return true;
      }
      if (word.empty()) return fail("the file ends within a solid, 'endsolid' is missing; it is cut short");
      if (word != "facet") return fail(sentence(in_quotes(word), " stands where 'facet' or 'endsolid' should"));
      if (!read_facet()) return false;
    }
  }

  bool read_facet() {
    for (int i = 0; i < 4; ++i) {  // normal and its numbers, which may be anything
      if (words_.word().empty()) return fail("the file ends within a facet; it is cut short");
    }
    if (!expect("outer") || !expect("loop")) return false;
    Part& part = out_.parts.back();
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> x{};
      if (!expect("vertex")) return false;
      for (double& coordinate : x) {
        const std::string_view word = words_.word();
        if (word.empty()) return fail("the file ends within a vertex; it is cut short");
        if (!parse_real(word, coordinate, problem_)) return false;
      }
      part.corners.push_back(merger_.vertex_at({x[0], x[1], x[2]}));
    }
    part.sizes.push_back(3);
    return expect("endloop") && expect("endfacet");
  }

  Source source_;
  Scanner words_;
  Parts out_;
  VertexMerger merger_{out_.xyz};
};

/// Text begins with "solid", but so do the headers of some binary files: those are told by their size.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= kHeaderBytes) {
    const std::uint64_t count = load_little<std::uint32_t>(bytes.data() + 80);
    if (bytes.size() == kHeaderBytes + kFacetBytes * count) return true;
  }
  return lower_case(trimmed(bytes.substr(0, 256)).substr(0, 5)) != "solid";
}

}  // namespace

Result<Model> read_stl(std::string_view bytes, const Source& source) {
  return guarded([&]() -> Result<Model> {
    if (!is_binary(bytes)) return TextReader(bytes, source).read();
    const std::string_view text = without_byte_order_mark(bytes);
    if (text.size() < bytes.size() && !is_binary(text)) return TextReader(text, source).read();
    if (bytes.size() >= kHeaderBytes) return read_binary(bytes, source);
    return file_error(source,
                      "the file is neither text STL, which begins with 'solid', nor binary STL, which has at least "
                      "84 bytes; it is cut short, or another format");
  });
}

Result<Model> read_stl(std::string_view bytes, std::string_view name) { return read_stl(bytes, Source{name, name}); }

}  // namespace impinge::io
