// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "impinge/contacts.hpp"
#include "report/assembly.hpp"
#include "report/part.hpp"
#include "report/sink.hpp"

/// The documents of `--json`: their parts as values of nlohmann-json, which keep the order of keys.
namespace impinge::report {

using Json = nlohmann::ordered_json;

/// On one line. Bytes that are not UTF-8 become U+FFFD; infinities and NaN become null.
std::string json_text(const Json& value);

/// What a reader of the JSON gets for this text: it differs where the bytes are not UTF-8.
std::string as_read_back(const std::string& text);

/// A JSON object that is written member by member, so that a long list needs the memory of one of its items.
class JsonDocument {
 public:
  explicit JsonDocument(Sink& sink, std::stop_token stop = {}) : sink_(sink), stop_(std::move(stop)) {}

  void member(std::string_view key, const Json& value);
  /// A list of `count` items, one a line: `item(i)` returns the i-th or writes it itself. It breaks off at a request to
  /// stop, or where nothing can be written any more.
  template <class Item>
  void list(std::string_view key, std::size_t count, const Item& item) {
    begin_member(key);
    sink_.write("[");
    for (std::size_t i = 0; i < count && !sink_.failed() && !stop_.stop_requested(); ++i) {
      sink_.write(i > 0 ? ",\n" : "\n");
      if constexpr (std::is_void_v<std::invoke_result_t<Item, std::size_t>>)
        item(i);
      else
        sink_.write(json_text(item(i)));
    }
    sink_.write("\n]");
  }
  /// Errors: `cancelled`. Write errors stay in the sink.
  Result<void> end();

 private:
  void begin_member(std::string_view key);

  Sink& sink_;
  std::stop_token stop_;
  bool is_empty_ = true;
};

/// null for nothing, and for a text without characters.
template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}
inline Json or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// Null for infinity.
inline Json json_finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

/// What was asked for, "auto" unless it is a number.
inline Json json_tolerance(const std::optional<double>& asked) { return asked ? Json(*asked) : Json("auto"); }

/// [x,y,z], with 0 for -0.
Json json_point(const Point& point);
Json json_points(std::span<const Point> points);

/// A map as a page has it: [r00,r01,r02,tx, r10,...], 3 rows of 4.
Json json_map(const Affine& map);

/// {"a_in_b":[lo,hi],"b_in_a":[lo,hi]}, or null where there is none.
Json json_depth(const std::optional<OverlapDepth>& depth);

/// What an object is called and where it comes from: "id" to "properties".
Json json_identity(const Assembly& assembly, std::size_t object);

/// The facts of a part: "class" to "inner_radius", all null where there is no part; not "closed" and "open_edges".
Json json_facts(const std::optional<Part>& part);

/// Members of a pair: "test", "change", "status", "comment", "assignee", "due" and "was".
Json json_triage(const Review& review, std::size_t pair);

/// {"name":"mm","metres":0.001}, with null for the name of one that has none; null where nobody said it.
Json json_unit(const std::optional<double>& metres);

/// A list of what is missing of the files, where something is.
void write_missing(JsonDocument& document, const Assembly& assembly);

/// How many triangles of one row of an answer touch in each way, by `Kind`.
std::array<std::uint64_t, 3> count_row(const Contacts& contacts, std::size_t row);

/// "crossing", "touching" or "coplanar".
std::string_view kind_name(Kind kind);

/// Errors: `cancelled`. Write errors stay in the sink.
Result<void> write_check_json(Sink& sink, const Assembly& assembly, const Contacts& contacts, bool with_triangles,
                              bool with_hash, const std::stop_token& stop);

/// What `info` found out about one object.
struct ObjectFacts {
  std::string name, path, product, incomplete;
  std::uint64_t triangles = 0, vertices = 0;
  std::optional<Part> part;  ///< nothing where the coordinates are outside the exact range
  Point center{};
  double radius = 0;
};

/// What `info` found out about one file.
struct FileFacts {
  std::string file;
  std::string error;  ///< why it was not read; empty if it was
  std::optional<double> unit_in_metres;
  std::vector<ObjectFacts> objects;
  std::vector<std::string> warnings;
};

Result<void> write_info_json(Sink& sink, const std::vector<FileFacts>& files);

}  // namespace impinge::report
