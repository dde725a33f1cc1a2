// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/previous.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "report/identity.hpp"
#include "report/json_file.hpp"
#include "report/text.hpp"
#include "report/vector.hpp"

namespace impinge::report {
namespace {

using nlohmann::json;

/// Members with other keys, such as the lines of regions and what people added, are not kept in memory.
bool is_compared(const std::string& key) {
  static const std::unordered_set<std::string> keys{"version",  "files",    "file", "name",    "known_as", "objects",
                                                    "path",     "placed",   "key",  "pairs",   "id",       "a",
                                                    "b",        "verdict",  "test", "nearest", "box",      "regions",
                                                    "centroid", "resolved", "unit", "metres"};
  return keys.contains(key);
}

/// What is wrong with the report, and where. `parse_previous` catches it.
struct Mistake {
  std::string pointer, what;
};
[[noreturn]] void fail(std::string pointer, std::string what) { throw Mistake{std::move(pointer), std::move(what)}; }

/// A value of the report, with the JSON pointer to it.
struct Value {
  const json* value;  ///< null where the report has none, or null
  std::string pointer;

  Value operator[](const char* key) const {
    if (!value->is_object()) fail(pointer, "an object should stand here");
    const auto found = value->find(key);
    return {found == value->end() || found->is_null() ? nullptr : &*found, fmt::format("{}/{}", pointer, key)};
  }
  explicit operator bool() const { return value != nullptr; }

  /// The items of a list; none if it is missing.
  [[nodiscard]] std::vector<Value> items() const {
    std::vector<Value> found;
    if (value == nullptr) return found;
    if (!value->is_array()) fail(pointer, "a list should stand here");
    for (const json& item : *value) found.push_back({&item, fmt::format("{}/{}", pointer, found.size())});
    return found;
  }
  /// Empty if it is missing.
  [[nodiscard]] std::string text() const {
    if (value == nullptr) return {};
    if (!value->is_string()) fail(pointer, "a text in quotes should stand here");
    return value->get<std::string>();
  }
  [[nodiscard]] double number() const {
    if (value == nullptr || !value->is_number()) fail(pointer, "a number should stand here");
    return value->get<double>();
  }
  [[nodiscard]] std::uint32_t whole() const {
    const double found = number();
    if (found < 0 || found >= 0x1p32 || found != std::floor(found)) fail(pointer, "a part's id is a whole number");
    return static_cast<std::uint32_t>(found);
  }
  [[nodiscard]] Point point() const {
    const std::vector<Value> xyz = items();
    if (xyz.size() != 3) fail(pointer, "a point is a list of three numbers");
    return {xyz[0].number(), xyz[1].number(), xyz[2].number()};
  }
  [[nodiscard]] std::array<Point, 2> two_points() const {
    const std::vector<Value> ends = items();
    if (ends.size() != 2) fail(pointer, "two points should stand here");
    return {ends[0].point(), ends[1].point()};
  }
  [[nodiscard]] Verdict verdict() const {
    const std::string word = text();
    for (int i = 0; i <= static_cast<int>(Verdict::apart); ++i)
      if (word == name(static_cast<Verdict>(i))) return static_cast<Verdict>(i);
    fail(pointer, fmt::format("there is no verdict '{}'", fit(printable(word), 80)));
  }
};

using Parts = std::unordered_map<std::uint32_t, OldPart>;  // by their ids

Parts read_parts(const Value& objects) {
  Parts parts;
  for (const Value& object : objects.items()) {
    OldPart part{object["name"].text(),   object["path"].text(), object["file"].text(),
                 object["placed"].text(), object["key"].text(),  object["known_as"].text()};
    if (!object["id"]) fail(object.pointer, "this object has no \"id\"");
    if (!parts.emplace(object["id"].whole(), std::move(part)).second)
      fail(object.pointer, "an earlier object has the same \"id\"");
  }
  return parts;
}

Previous::Pair read_pair(const Value& from, const Parts& parts) {
  Previous::Pair pair;
  pair.id = from["id"].text();
  if (pair.id.empty() || !from["a"] || !from["b"] || !from["verdict"])
    fail(from.pointer, "this pair has no \"id\", \"a\", \"b\" or \"verdict\"; only the JSON of impinge clash has them");
  const auto a = parts.find(from["a"].whole()), b = parts.find(from["b"].whole());
  if (a == parts.end() || b == parts.end())
    fail(from.pointer, "this pair is of a part that is not among the \"objects\"");
  pair.a = a->second, pair.b = b->second;
  pair.test = from["test"].text();
  pair.verdict = from["verdict"].verdict();
  if (from["nearest"]) {
    const std::array<Point, 2> nearest = from["nearest"].two_points();
    pair.middle = middle(nearest[0], nearest[1]);
  }
  pair.has_regions = static_cast<bool>(from["regions"]);
  for (const Value& region : from["regions"].items()) {
    if (!region["centroid"]) fail(region.pointer, "this region has no \"centroid\"");
    pair.regions.push_back({region["id"].text(), region["centroid"].point()});
    if (!region["box"]) continue;
    const auto [lo, hi] = region["box"].two_points();
    pair.regions.back().half_diagonal = length(0.5 * hi - 0.5 * lo);
  }
  if (!pair.regions.empty()) pair.middle = pair.regions.front().centroid;
  return pair;
}

/// What a report says that tells no names of files.
std::vector<Previous::OldFile> files_of(const std::vector<OldPart>& parts) {
  std::set<std::string> given;
  for (const OldPart& part : parts)
    if (!part.file.empty()) given.insert(part.file);
  const std::vector<std::string> files(given.begin(), given.end()), names = names_of_files(files);
  std::vector<Previous::OldFile> found;
  for (std::size_t i = 0; i < files.size(); ++i) found.push_back({files[i], names[i], names[i]});
  return found;
}

Previous read_report(const Value& report) {
  for (const char* key : {"version", "objects", "pairs", "resolved"})
    if (!report.value->is_object() || !report[key])
      fail("", fmt::format("this is no report of an earlier run, which impinge clash FILE... --json REPORT writes: it "
                           "has no \"{}\"",
                           key));
  if (report["version"].number() != 1)
    fail("/version", "this is a document of another version of impinge, which wrote version 1");
  Previous previous;
  if (const Value unit = report["unit"]) {
    previous.unit_in_metres = unit["metres"].number();
    if (!(*previous.unit_in_metres > 0)) fail("/unit/metres", "a number above 0 should stand here");
  }
  const Parts parts = read_parts(report["objects"]);
  std::unordered_set<std::string> ids;
  for (const Value& pair : report["pairs"].items()) {
    previous.pairs.push_back(read_pair(pair, parts));
    if (!ids.insert(previous.pairs.back().id).second) fail(pair.pointer, "an earlier pair has the same \"id\"");
  }
  for (const auto& [id, part] : parts) previous.parts.push_back(part);
  for (const Value& file : report["files"].items()) {
    previous.files.push_back({file["file"].text(), file["name"].text(), file["known_as"].text()});
    if (previous.files.back().name.empty() || previous.files.back().known_as.empty())
      fail(file.pointer, "this file has no \"name\" or no \"known_as\"");
  }
  if (previous.files.empty()) previous.files = files_of(previous.parts);
  return previous;
}

}  // namespace

Result<Previous> parse_previous(const std::string& name, const std::string& text) {
  const Result<json> report = parse_json(name, text, is_compared);
  if (!report) return report.error();
  try {
    return read_report({&*report, ""});
  } catch (const Mistake& mistake) {
    return json_error(name, text, mistake.pointer, mistake.what);
  }
}

Result<Previous> read_previous(const std::string& name, std::uint64_t most_bytes) {
  std::error_code unknown;
  if (!std::filesystem::exists(name, unknown) && !unknown)
    return Error{Code::bad_file, fmt::format("--previous {}: there is no such file; a first run has nothing to compare "
                                             "with: leave --previous out, and write {} with --json",
                                             printable(name), printable(name))};
  const Result<std::string> text = read_text_file(name, most_bytes);
  if (!text) return text.error();
  return parse_previous(name, *text);
}

}  // namespace impinge::report
