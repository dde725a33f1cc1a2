// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/contacts.hpp"
#include "report/assembly.hpp"
#include "report/part.hpp"
#include "report/sink.hpp"

/// The documents of `--json`, written piece by piece: an answer of a billion pairs needs no memory of its own.
namespace impinge::report {

/// A JSON string with its quotes; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// The shortest number that reads back as the same double; null for infinities and NaN, and 0 for -0.
std::string json_number(double value);

/// [one,another], by a function that makes the text of each.
std::string json_list(const auto& items, auto text_of) {
  std::string text = "[";
  for (const auto& item : items) {
    if (text.size() > 1) text += ',';
    text += text_of(item);
  }
  return text += ']';
}

/// A map as a page has it: [r00,r01,r02,tx, r10,...], 3 rows of 4.
std::string json_map(const Affine& map);

/// {"a_in_b":[lo,hi],"b_in_a":[lo,hi]}, or null where there is none.
std::string json_depth(const std::optional<OverlapDepth>& depth);

/// What an object is called and where it comes from, as members of a JSON object, without braces: "id" to "triangles".
std::string json_identity(const Assembly& assembly, std::size_t object);

/// "missing":[...] and what separates it from the next member; nothing where nothing is missing of the files.
std::string json_missing(const Assembly& assembly);

/// How the triangles of one row of an answer touch, counted.
struct RowCounts {
  std::uint64_t crossing = 0, touching = 0, coplanar = 0;
};
RowCounts count_row(const Contacts& contacts, std::size_t row);

/// "crossing", "touching" or "coplanar".
std::string_view kind_name(Kind kind);

/// Errors: `cancelled`. Write errors stay in the sink.
Result<void> write_check_json(Sink& sink, const Assembly& assembly, const Contacts& contacts,
                              const CheckArguments& arguments, const std::stop_token& stop);

/// What `info` found out about one object.
struct ObjectFacts {
  std::string name, path, product;
  std::uint64_t triangles = 0, vertices = 0;
  std::optional<Part> part;  ///< nothing where the coordinates are outside the exact range
  Point center{};
  double radius = 0;
};

/// What `info` found out about one file.
struct FileFacts {
  std::string file;
  std::string error;  ///< why it was not read; empty if it was
  std::vector<ObjectFacts> objects;
  std::vector<std::string> warnings;
};

Result<void> write_info_json(Sink& sink, const std::vector<FileFacts>& files);

}  // namespace impinge::report
