// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <unordered_map>

#include "core/guarded.hpp"
#include "io/model.hpp"
#include "io/readers.hpp"

/// Wavefront OBJ: `v` and `f`; `o`, or `g` in a file without any `o`, say which object a face belongs to. Normals,
/// texture coordinates, materials, points, lines and curves are passed over.
namespace impinge::io {
namespace {

class ObjReader : FailingReader {
 public:
  ObjReader(std::string_view bytes, const Source& source)
      : source_(source), lines_(bytes), has_objects_(contains_object(bytes)) {}

  Result<Model> read() {
    out_.parts.push_back({});
    while (!lines_.at_end()) {
      if (!read_statement()) return line_error(source_, line_, problem_);
    }
    if (highest_corner_ >= vertex_count() && highest_line_ > 0) {
      return line_error(source_, highest_line_,
                        sentence("the face names vertex ", highest_corner_ + 1, ", but the file has only ",
                                 vertex_count(), "; mend the index or add the vertices"));
    }
    std::erase_if(out_.parts, [](const Part& part) { return part.sizes.empty(); });
    return make_model(source_, std::move(out_));
  }

 private:
  /// A first look for an `o` statement, which decides what `g` means.
  static bool contains_object(std::string_view bytes) {
    Scanner lines(bytes);
    while (!lines.at_end()) {
      const std::string_view line = trimmed(lines.rest_of_line());
      if (line == "o" || line.starts_with("o ") || line.starts_with("o\t")) return true;
    }
    return false;
  }

  /// The next line with its continuations.
  std::string_view next_line() {
    std::string_view line = lines_.rest_of_line();
    line_ = lines_.line();
    if (line.ends_with('\\')) {
      joined_.clear();
      for (;; line = lines_.rest_of_line()) {
        const bool goes_on = line.ends_with('\\');
        joined_ += goes_on ? line.substr(0, line.size() - 1) : line;
        joined_ += ' ';
        if (!goes_on || lines_.at_end()) break;
      }
      line = joined_;
    }
    return line;
  }

  bool read_statement() {
    const std::string_view line = next_line();
    Scanner words(line, '#');
    const std::string_view keyword = words.word();
    if (keyword == "v") return read_vertex(words);
    if (keyword == "f") return read_face(words);
    if (keyword != "o" && (keyword != "g" || has_objects_)) return true;
    // Each `o` starts an object of its own, even under a name seen before; a group that comes again goes on.
    const std::string name(trimmed(words.rest_of_line()));
    const std::size_t next = out_.parts.size();
    part_ = keyword == "o" ? next : groups_.try_emplace(name, next).first->second;
    if (part_ == next) out_.parts.push_back({name, {}, {}});
    return true;
  }

  bool read_vertex(Scanner& words) {
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = words.word();
      double value = 0;
      if (word.empty()) return fail("a vertex needs three coordinates; the line is cut short");
      if (!parse_real(word, value, problem_)) return fail(problem_ + "; a vertex needs three finite coordinates");
      out_.xyz.push_back(value);
    }
    return true;
  }

  bool read_face(Scanner& words) {
    Part& part = out_.parts[part_];
    std::uint32_t size = 0;
    for (std::string_view word = words.word(); !word.empty(); word = words.word(), ++size) {
      std::uint32_t corner = 0;
      if (!read_corner(word, corner)) return false;
      part.corners.push_back(corner);
    }
    part.sizes.push_back(size);
    return true;
  }

  /// v, v/vt, v//vn or v/vt/vn. Positive indices count from the file's first vertex and may lie ahead, negative ones
  /// count back from the last vertex so far.
  bool read_corner(std::string_view word, std::uint32_t& corner) {
    const std::size_t slash = word.find('/');
    std::int64_t index = 0;
    if (!parse_integer(word.substr(0, slash), index, problem_) ||
        word.find_first_not_of("0123456789+-/", std::min(slash, word.size())) != word.npos) {
      return fail(sentence("the face's corner ", in_quotes(word), " is not of the form v, v/vt, v//vn or v/vt/vn"));
    }
    const auto count = static_cast<std::int64_t>(vertex_count());
    if (index == 0 || index < -count || index >= kMostVertices) {
      return fail(
          sentence("the face names vertex ", index, ", but indices run from 1 and, backwards, from -1 to -", count));
    }
    corner = static_cast<std::uint32_t>(index > 0 ? index - 1 : count + index);
    if (highest_line_ == 0 || corner > highest_corner_) {
      highest_corner_ = corner;
      highest_line_ = line_;
    }
    return true;
  }

  [[nodiscard]] std::uint64_t vertex_count() const { return out_.xyz.size() / 3; }

  static constexpr std::int64_t kMostVertices = std::int64_t{1} << 32;
  Source source_;
  Scanner lines_;
  bool has_objects_;
  Parts out_;
  std::unordered_map<std::string, std::size_t> groups_;  ///< the part of each name that `g` gives
  std::size_t part_ = 0;
  std::uint64_t line_ = 0;
  std::uint64_t highest_corner_ = 0, highest_line_ = 0;
  std::string joined_;
};

}  // namespace

Result<Model> read_obj(std::string_view bytes, const Source& source) {
  return guarded([&]() -> Result<Model> {
    if (bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE")) {
      return file_error(source, "the text is UTF-16; save it as UTF-8");
    }
    if (const Result<void> text = check_text(bytes, source); !text) return text.error();
    return ObjReader(without_byte_order_mark(bytes), source).read();
  });
}

Result<Model> read_obj(std::string_view bytes, std::string_view name) { return read_obj(bytes, Source{name, name}); }

}  // namespace impinge::io
