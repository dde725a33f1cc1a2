// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/ply_header.hpp"

#include <array>
#include <optional>

namespace impinge::io {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
  struct Name {
    std::string_view name;
    PlyType type;
  };
  static constexpr std::array<Name, 16> kNames{{{"char", PlyType::int8},
                                                {"uchar", PlyType::uint8},
                                                {"short", PlyType::int16},
                                                {"ushort", PlyType::uint16},
                                                {"int", PlyType::int32},
                                                {"uint", PlyType::uint32},
                                                {"float", PlyType::float32},
                                                {"double", PlyType::float64},
                                                {"int8", PlyType::int8},
                                                {"uint8", PlyType::uint8},
                                                {"int16", PlyType::int16},
                                                {"uint16", PlyType::uint16},
                                                {"int32", PlyType::int32},
                                                {"uint32", PlyType::uint32},
                                                {"float32", PlyType::float32},
                                                {"float64", PlyType::float64}}};
  for (const Name& known : kNames) {
    if (known.name == name) return known.type;
  }
  return std::nullopt;
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

}  // namespace

std::size_t bytes_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

Result<PlyHeader> read_ply_header(std::string_view bytes, const Source& source) {
  return HeaderReader(bytes, source).read();
}

}  // namespace impinge::io
