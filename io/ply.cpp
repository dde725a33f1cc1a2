// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/guarded.hpp"
#include "io/little_endian.hpp"
#include "io/model.hpp"
#include "io/readers.hpp"

/// PLY, text and binary. Vertices are the properties x, y, z of the element `vertex`, polygons the list
/// `vertex_indices` or `vertex_index` of `face`, strips the same list of `tristrips`, -1 between them. All else is
/// passed over. Numbers of a text file are read as doubles, whatever type the header gives them.
namespace impinge::io {
namespace {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type;  ///< of a list: of its items
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format : std::uint8_t { text, little_endian, big_endian };
  Format format;
  std::vector<PlyElement> elements;
  std::size_t body_byte;    ///< where the body begins
  std::uint64_t body_line;  ///< the line that it begins on
  std::vector<std::string> warnings;
};

std::size_t bytes_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

/// Each type has two names, in the order of the types.
std::optional<PlyType> type_named(std::string_view name) {
  static constexpr std::array<std::string_view, 16> kNames{"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                                           "float", "double", "int8",    "uint8",  "int16", "uint16",
                                                           "int32", "uint32", "float32", "float64"};
  const auto known = std::find(kNames.begin(), kNames.end(), name);
  if (known == kNames.end()) return std::nullopt;
  return static_cast<PlyType>((known - kNames.begin()) % 8);
}

class HeaderReader : FailingReader {
 public:
  HeaderReader(std::string_view bytes, const Source& source) : bytes_(bytes), source_(source), line_end_("\n") {
    const std::size_t end = bytes.find_first_of("\r\n");
    if (end != bytes.npos && bytes[end] == '\r') line_end_ = bytes.substr(end, 2) == "\r\n" ? "\r\n" : "\r";
  }

  Result<PlyHeader> read() {
    std::string_view line;
    if (!next_line(line) || trimmed(line) != "ply") {
      return line_error(source_, 1, "a PLY file begins with a line 'ply'; is it another format?");
    }
    while (next_line(line)) {
      Scanner words(line);
      const std::string_view keyword = words.word();
      if (keyword == "end_header") {
        if (!has_format_) return line_error(source_, line_, "the header has no 'format' line");
        header_.body_byte = next_;
        header_.body_line = line_ + 1;
        return std::move(header_);
      }
      if (!read_line(keyword, words)) return line_error(source_, line_, problem_);
    }
    return line_error(source_, line_, "the header has no 'end_header' line; the file is cut short");
  }

 private:
  /// Lines end as the first one does: a body of numbers may begin with the byte of another line end.
  bool next_line(std::string_view& line) {
    if (next_ >= bytes_.size()) return false;
    const std::size_t end = bytes_.find(line_end_, next_);
    line = bytes_.substr(next_, end == bytes_.npos ? end : end - next_);
    next_ = end == bytes_.npos ? bytes_.size() : end + line_end_.size();
    ++line_;
    return true;
  }

  bool read_line(std::string_view keyword, Scanner& words) {
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return true;
    if (keyword == "format") return read_format(words.word());
    if (keyword == "element") return read_element(words);
    if (keyword == "property") return read_property(words);
    header_.warnings.push_back(sentence("Line ", line_, " of the header of ", source_.label, " begins with ",
                                        in_quotes(keyword), ", which PLY does not know; it was passed over."));
    return true;
  }

  bool read_format(std::string_view name) {
    has_format_ = true;
    if (name == "ascii") {
      header_.format = PlyHeader::Format::text;
    } else if (name == "binary_little_endian") {
      header_.format = PlyHeader::Format::little_endian;
    } else if (name == "binary_big_endian") {
      header_.format = PlyHeader::Format::big_endian;
    } else {
      return fail(
          sentence("the format ", in_quotes(name), " is none of ascii, binary_little_endian, binary_big_endian"));
    }
    return true;
  }

  bool read_element(Scanner& words) {
    const std::string_view name = words.word(), count = words.word();
    std::int64_t value = 0;
    if (!parse_integer(count, value, problem_) || value < 0) {
      return fail(sentence("element ", in_quotes(name), " has no proper count"));
    }
    header_.elements.push_back({std::string(name), static_cast<std::uint64_t>(value), {}});
    return true;
  }

  bool read_property(Scanner& words) {
    if (header_.elements.empty()) return fail("a property stands before the first element");
    std::string_view type_name = words.word();
    PlyProperty property{{}, PlyType::int8};
    if (type_name == "list") {
      const std::string_view count_name = words.word();
      const std::optional<PlyType> count_type = type_named(count_name);
      if (!count_type || !is_integer(*count_type)) {
        return fail(sentence("a list is counted by ", in_quotes(count_name), ", which is no whole-number type of PLY"));
      }
      property.is_list = true;
      property.count_type = *count_type;
      type_name = words.word();
    }
    const std::optional<PlyType> type = type_named(type_name);
    if (!type) return fail(sentence("a property is of type ", in_quotes(type_name), ", which PLY does not know"));
    property.type = *type;
    property.name = words.word();
    header_.elements.back().properties.push_back(std::move(property));
    return true;
  }

  std::string_view bytes_;
  Source source_;
  std::string_view line_end_;
  std::size_t next_ = 0;
  std::uint64_t line_ = 0;
  bool has_format_ = false;
  PlyHeader header_{};
};

/// The body as text: one word a value.
class TextBody {
 public:
  TextBody(std::string_view bytes, const PlyHeader& header)
      : words_(bytes.substr(header.body_byte)), first_line_(header.body_line) {}

  /// Whether the rest can hold so many rows: a value takes at least a digit and a separator, which the last may lack.
  bool has_room_for(std::uint64_t rows, const PlyElement& element) const {
    return element.properties.empty() || rows <= (words_.bytes_left() + 1) / (2 * element.properties.size());
  }
  bool real(PlyType, double& value, std::string& problem) {
    const std::string_view word = words_.word();
    if (word.empty()) return cut_short(problem);
    return parse_real(word, value, problem);
  }
  bool integer(PlyType, std::int64_t& value, std::string& problem) {
    const std::string_view word = words_.word();
    if (word.empty()) return cut_short(problem);
    return parse_integer(word, value, problem);
  }
  bool skip(PlyType, std::int64_t count, std::string& problem) {
    for (; count > 0; --count) {
      if (words_.word().empty()) return cut_short(problem);
    }
    return true;
  }
  [[nodiscard]] Error error(const Source& source, std::string_view problem) const {
    return line_error(source, first_line_ + words_.line() - 1, problem);
  }

 private:
  static bool cut_short(std::string& problem) {
    problem = "the file ends here; it is cut short";
    return false;
  }
  Scanner words_;
  std::uint64_t first_line_;
};

/// The body as bytes.
class BinaryBody {
 public:
  BinaryBody(std::string_view bytes, const PlyHeader& header)
      : bytes_(bytes), next_(header.body_byte), is_big_(header.format == PlyHeader::Format::big_endian) {}

  bool has_room_for(std::uint64_t rows, const PlyElement& element) {
    last_ = next_;
    std::uint64_t row_bytes = 0;
    for (const PlyProperty& p : element.properties) row_bytes += bytes_of(p.is_list ? p.count_type : p.type);
    return row_bytes == 0 || rows <= (bytes_.size() - next_) / row_bytes;
  }
  bool real(PlyType type, double& value, std::string& problem) {
    if (is_integer(type)) {
      std::int64_t whole = 0;
      if (!integer(type, whole, problem)) return false;
      value = static_cast<double>(whole);
      return true;
    }
    const char* const at = take(bytes_of(type), problem);
    if (!at) return false;
    value = type == PlyType::float32 ? double{std::bit_cast<float>(load<std::uint32_t>(at))}
                                     : std::bit_cast<double>(load<std::uint64_t>(at));
    if (std::isfinite(value)) return true;
    problem = "the number is not finite";
    return false;
  }
  bool integer(PlyType type, std::int64_t& value, std::string& problem) {
    const char* const at = take(bytes_of(type), problem);
    if (!at) return false;
    value = type == PlyType::int8     ? whole<std::int8_t>(at)
            : type == PlyType::uint8  ? whole<std::uint8_t>(at)
            : type == PlyType::int16  ? whole<std::int16_t>(at)
            : type == PlyType::uint16 ? whole<std::uint16_t>(at)
            : type == PlyType::int32  ? whole<std::int32_t>(at)
                                      : whole<std::uint32_t>(at);
    return true;
  }
  bool skip(PlyType type, std::int64_t count, std::string& problem) {
    return take(bytes_of(type) * static_cast<std::uint64_t>(count), problem) != nullptr;
  }
  [[nodiscard]] Error error(const Source& source, std::string_view problem) const {
    return byte_error(source, last_, problem);
  }

 private:
  const char* take(std::uint64_t count, std::string& problem) {
    last_ = next_;
    if (count > bytes_.size() - next_) {
      problem = "the file ends here; it is cut short";
      return nullptr;
    }
    next_ += count;
    return bytes_.data() + last_;
  }
  template <class T>
  T load(const char* at) const {
    return is_big_ ? load_big<T>(at) : load_little<T>(at);
  }
  template <class T>
  std::int64_t whole(const char* at) const {
    return static_cast<T>(load<std::make_unsigned_t<T>>(at));
  }
  std::string_view bytes_;
  std::size_t next_, last_ = 0;
  bool is_big_;
};

template <class Body>
class PlyReader : FailingReader {
 public:
  PlyReader(std::string_view bytes, const PlyHeader& header, const Source& source)
      : source_(source), header_(header), body_(bytes, header) {}

  Result<Model> read() {
    out_.parts.emplace_back();
    out_.warnings = header_.warnings;
    if (!find_vertices()) return file_error(source_, problem_);
    for (const PlyElement& element : header_.elements) {
      if (!read_element(element)) {
        return body_.error(source_, sentence("element '", element.name, "', row ", row_, ": ", problem_));
      }
    }
    return make_model(source_, std::move(out_));
  }

 private:
  /// Which property is which coordinate; and how many vertices there are, for faces may stand before them.
  bool find_vertices() {
    const PlyElement* vertices = nullptr;
    for (const PlyElement& element : header_.elements) {
      if (element.name != "vertex") continue;
      if (vertices) return fail("the header has two elements 'vertex'; join them");
      vertices = &element;
    }
    if (!vertices) return fail("the header has no element 'vertex', so the file holds no mesh");
    vertex_count_ = vertices->count;
    for (std::size_t i = 0; i < vertices->properties.size(); ++i) {
      const PlyProperty& property = vertices->properties[i];
      if (property.is_list || property.name.size() != 1) continue;
      const int axis = property.name[0] - 'x';
      if (axis < 0 || axis > 2) continue;
      if (axis_of_.size() <= i) axis_of_.resize(i + 1, -1);
      axis_of_[i] = axis;
      found_axes_ |= 1 << axis;
      out_.floats |= property.type == PlyType::float32;
    }
    if (found_axes_ == 7) return true;
    return fail("the element 'vertex' lacks one of the properties x, y and z");
  }

  bool read_element(const PlyElement& element) {
    row_ = 0;
    if (element.properties.empty()) return true;
    if (!body_.has_room_for(element.count, element)) {
      return fail(sentence("the header promises ", element.count,
                           " rows, more than the rest of the file can hold; it "
                           "is cut short"));
    }
    for (; row_ < element.count; ++row_) {
      std::array<double, 3> vertex{};
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (!read_property(element, i, vertex)) return false;
      }
      if (element.name == "vertex") out_.xyz.insert(out_.xyz.end(), vertex.begin(), vertex.end());
    }
    return true;
  }

  bool read_property(const PlyElement& element, std::size_t i, std::array<double, 3>& vertex) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) {
      const int axis = element.name == "vertex" && i < axis_of_.size() ? axis_of_[i] : -1;
      if (axis < 0) return body_.skip(property.type, 1, problem_);
      return body_.real(property.type, vertex[static_cast<std::size_t>(axis)], problem_);
    }
    std::int64_t count = 0;
    if (!body_.integer(property.count_type, count, problem_)) return false;
    if (count < 0) return fail("a list has a negative length");
    const bool is_indices = property.name == "vertex_indices" || property.name == "vertex_index";
    if (is_indices && element.name == "face") return read_polygon(property, count);
    if (is_indices && element.name == "tristrips") return read_strips(property, count);
    return body_.skip(property.type, count, problem_);
  }

  bool read_index(const PlyProperty& property, std::int64_t& index) {
    if (!is_integer(property.type)) return fail("the indices are no whole numbers; declare them as int or uint");
    return body_.integer(property.type, index, problem_);
  }

  bool check_index(std::int64_t index) {
    if (index >= 0 && static_cast<std::uint64_t>(index) < vertex_count_ && index < std::int64_t{1} << 32) return true;
    return fail(sentence("it names vertex ", index, ", but indices run from 0 to ", vertex_count_,
                         " exclusive; mend the "
                         "index"));
  }

  bool read_polygon(const PlyProperty& property, std::int64_t count) {
    Part& part = out_.parts[0];
    for (std::int64_t k = 0; k < count; ++k) {
      std::int64_t index = 0;
      if (!read_index(property, index) || !check_index(index)) return false;
      part.corners.push_back(static_cast<std::uint32_t>(index));
    }
    part.sizes.push_back(static_cast<std::uint32_t>(count));
    return true;
  }

  /// Every corner from a strip's third makes a triangle with the two before it, every second one turned round.
  bool read_strips(const PlyProperty& property, std::int64_t count) {
    Part& part = out_.parts[0];
    std::array<std::uint32_t, 2> before{};
    std::int64_t in_strip = 0;
    for (std::int64_t k = 0; k < count; ++k) {
      std::int64_t index = 0;
      if (!read_index(property, index)) return false;
      if (index == -1) {
        in_strip = 0;
        continue;
      }
      if (!check_index(index)) return false;
      const auto corner = static_cast<std::uint32_t>(index);
      if (in_strip >= 2) {
        const bool is_turned = in_strip % 2 == 1;
        part.corners.insert(part.corners.end(), {before[is_turned ? 1 : 0], before[is_turned ? 0 : 1], corner});
        part.sizes.push_back(3);
      }
      before = {before[1], corner};
      ++in_strip;
    }
    return true;
  }

  Source source_;
  const PlyHeader& header_;
  Body body_;
  Parts out_;
  std::uint64_t vertex_count_ = 0, row_ = 0;
  std::vector<int> axis_of_;
  int found_axes_ = 0;
};

}  // namespace

Result<Model> read_ply(std::string_view bytes, const Source& source) {
  return guarded([&]() -> Result<Model> {
    bytes = without_byte_order_mark(bytes);
    const Result<PlyHeader> header = HeaderReader(bytes, source).read();
    if (!header) return header.error();
    if (header->format == PlyHeader::Format::text) {
      if (const Result<void> text = check_text(bytes, source); !text) return text.error();
      return PlyReader<TextBody>(bytes, *header, source).read();
    }
    return PlyReader<BinaryBody>(bytes, *header, source).read();
  });
}

Result<Model> read_ply(std::string_view bytes, std::string_view name) { return read_ply(bytes, Source{name, name}); }

}  // namespace impinge::io
