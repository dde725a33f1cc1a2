// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "core/guarded.hpp"
#include "io/model.hpp"
#include "io/readers.hpp"

/// Geomview's OFF as text: [ST][C][N]OFF, the counts, a vertex and then a polygon a line. What follows a vertex's
/// three coordinates or a polygon's indices on their line (normals, colours, texture coordinates) is passed over.
namespace impinge::io {
namespace {

class OffReader : FailingReader {
 public:
  OffReader(std::string_view bytes, const Source& source) : source_(source), words_(bytes, '#') {}

  Result<Model> read() {
    if (!read_header() || !read_vertices() || !read_faces()) {
      return line_error(source_, words_.line(), problem_);
    }
    return make_model(source_, std::move(out_));
  }

 private:
  bool read_header() {
    std::string_view word = words_.word();
    if (word.ends_with("OFF")) {
      const std::string_view prefix = word.substr(0, word.size() - 3);
      if (prefix.find('4') != prefix.npos || prefix.find('n') != prefix.npos) {
        return fail(sentence(in_quotes(word), " holds points of another dimension than 3; write it as OFF"));
      }
      if (prefix.find_first_not_of("STCN") != prefix.npos) return fail(not_an_off(word));
      word = words_.word();
    } else if (std::int64_t number = 0; !parse_integer(word, number, problem_)) {  // the keyword may be left out
      return fail(not_an_off(word));
    }
    if (word == "BINARY") return fail("binary OFF is not supported; write the file as text OFF or as PLY");
    if (!to_count(word, vertices_, "vertices") || !to_count(words_.word(), faces_, "faces")) return false;
    words_.rest_of_line();  // the number of edges, which says nothing
    // A vertex takes at least "0 0 0" and a line end, a polygon "0" and one; the last may lack its end.
    const std::uint64_t bytes = words_.bytes_left() + 1;
    if (vertices_ <= bytes / 6 && faces_ <= bytes / 2) return true;
    return fail(sentence("the header promises ", vertices_, " vertices and ", faces_, " faces, more than the file's ",
                         words_.bytes_left(), " remaining bytes can hold; the file is cut short"));
  }

  static std::string not_an_off(std::string_view word) {
    return sentence("an OFF file begins with 'OFF', this one with ", in_quotes(word), "; is it another format?");
  }

  bool to_count(std::string_view word, std::uint64_t& count, std::string_view what) {
    std::int64_t value = 0;
    if (word.empty()) return fail(sentence("the number of ", what, " is missing; the file is cut short"));
    if (!parse_integer(word, value, problem_)) return fail(sentence("the number of ", what, " is missing: ", problem_));
    if (value < 0) return fail(sentence("the number of ", what, " is negative"));
    count = static_cast<std::uint64_t>(value);
    return true;
  }

  bool read_vertices() {
    out_.xyz.reserve(3 * vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = words_.word();
        double value = 0;
        if (word.empty()) return fail(sentence("the file ends in vertex ", i, " of ", vertices_, "; it is cut short"));
        if (!parse_real(word, value, problem_)) return fail(sentence("vertex ", i, ": ", problem_));
        out_.xyz.push_back(value);
      }
      words_.rest_of_line();
    }
    return true;
  }

  bool read_faces() {
    Part& part = out_.parts.emplace_back();
    part.sizes.reserve(faces_);
    for (std::uint64_t i = 0; i < faces_; ++i) {
      const std::string_view word = words_.word();
      std::int64_t size = 0;
      if (word.empty()) return fail(sentence("the file ends before face ", i, " of ", faces_, "; it is cut short"));
      if (!parse_integer(word, size, problem_)) return fail(sentence("face ", i, ": ", problem_));
      if (size < 0) return fail(sentence("face ", i, " has a negative number of corners"));
      if (size >= std::int64_t{1} << 32) return fail(sentence("face ", i, " has too many corners; split it"));
      for (std::int64_t k = 0; k < size; ++k) {
        if (!read_corner(i, part)) return false;
      }
      part.sizes.push_back(static_cast<std::uint32_t>(size));
      words_.rest_of_line();
    }
    return true;
  }

  bool read_corner(std::uint64_t face, Part& part) {
    const std::string_view word = words_.word();
    std::int64_t index = 0;
    if (word.empty()) return fail(sentence("the file ends in face ", face, "; it is cut short"));
    if (!parse_integer(word, index, problem_)) return fail(sentence("face ", face, ": ", problem_));
    if (index < 0 || static_cast<std::uint64_t>(index) >= vertices_ || index >= std::int64_t{1} << 32) {
      return fail(sentence("face ", face, " names vertex ", index, ", but indices run from 0 to ", vertices_,
                           " exclusive; mend the index or the header's count"));
    }
    part.corners.push_back(static_cast<std::uint32_t>(index));
    return true;
  }

  Source source_;
  Scanner words_;
  Parts out_;
  std::uint64_t vertices_ = 0, faces_ = 0;
};

}  // namespace

Result<Model> read_off(std::string_view bytes, const Source& source) {
  return guarded([&]() -> Result<Model> {
    if (const Result<void> text = check_text(bytes, source); !text) return text.error();
    return OffReader(without_byte_order_mark(bytes), source).read();
  });
}

Result<Model> read_off(std::string_view bytes, std::string_view name) { return read_off(bytes, Source{name, name}); }

}  // namespace impinge::io
