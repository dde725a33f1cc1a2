// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/previous.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "report/comparison/mistaken_file.hpp"
#include "report/identity.hpp"
#include "report/json_file.hpp"
#include "report/json_reader.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

using Kind = JsonReader::Kind;

/// A text, or null: then it is empty.
std::string read_text(JsonReader& reader) {
  if (reader.kind() != Kind::null) return reader.string();
  reader.skip();
  return {};
}

std::optional<std::uint32_t> read_number(JsonReader& reader) {
  const double number = reader.number();
  if (!reader.failed() && (number < 0 || number >= 0x1p32 || number != std::floor(number)))
    reader.fail("a part's id is a whole number");
  if (reader.failed()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

Point read_point(JsonReader& reader) {
  std::array<double, 3> xyz{};
  std::size_t count = 0;
  reader.array([&] {
    const double coordinate = reader.number();
    if (count < 3) xyz[count] = coordinate;
    ++count;
  });
  if (!reader.failed() && count != 3) reader.fail("a point is a list of three numbers");
  return {xyz[0], xyz[1], xyz[2]};
}

/// Of points, two at most.
std::vector<Point> read_points(JsonReader& reader) {
  std::vector<Point> points;
  reader.array([&] {
    points.push_back(read_point(reader));
    if (points.size() > 2) reader.fail("there are two points here, no more");
  });
  if (!reader.failed() && points.size() != 2) reader.fail("there are two points here, no fewer");
  return points;
}

Verdict read_verdict(JsonReader& reader) {
  const std::string word = reader.string();
  for (int i = 0; i <= static_cast<int>(Verdict::apart); ++i)
    if (word == name(static_cast<Verdict>(i))) return static_cast<Verdict>(i);
  reader.fail(fmt::format("there is no verdict '{}'", fit(printable(word), 80)));
  return Verdict::apart;
}

/// Whether the key is one of a remark.
bool read_remark(JsonReader& reader, const std::string& key, Remark& remark) {
  if (key == "status") return remark.status = read_text(reader), true;
  if (key == "comment") return remark.comment = read_text(reader), true;
  return false;
}

/// Halves first: no difference of two of them overflows.
double half_diagonal(const Point& lo, const Point& hi) {
  return std::hypot(hi.x / 2 - lo.x / 2, hi.y / 2 - lo.y / 2, hi.z / 2 - lo.z / 2);
}

Previous::OldRegion read_region(JsonReader& reader) {
  Previous::OldRegion region;
  bool has_centroid = false;
  reader.object([&](const std::string& key) {
    if (key == "id") {
      region.id = read_text(reader);
    } else if (key == "centroid") {
      region.centroid = read_point(reader), has_centroid = true;
    } else if (key == "box") {
      const std::vector<Point> box = read_points(reader);
      if (!reader.failed()) region.reach = half_diagonal(box[0], box[1]);
    } else if (!read_remark(reader, key, region.remark)) {
      reader.skip();
    }
  });
  if (!reader.failed() && !has_centroid) reader.fail("this region has no \"centroid\"");
  return region;
}

OldPart read_part(JsonReader& reader) {
  OldPart part;
  reader.object([&](const std::string& key) {
    if (key == "name") return part.name = reader.string(), void();
    if (key == "path") return part.path = reader.string(), void();
    if (key == "file") return part.file = reader.string(), void();
    if (key == "placed") return part.placed = read_text(reader), void();
    reader.skip();
  });
  return part;
}

Previous::OldFile read_file_names(JsonReader& reader) {
  Previous::OldFile file;
  reader.object([&](const std::string& key) {
    if (key == "file") return file.file = reader.string(), void();
    if (key == "name") return file.name = reader.string(), void();
    if (key == "known_as") return file.known_as = reader.string(), void();
    reader.skip();
  });
  return file;
}

Resolved read_resolved(JsonReader& reader);

std::vector<Resolved> read_resolved_regions(JsonReader& reader) {
  std::vector<Resolved> regions;
  reader.array([&] { regions.push_back(read_resolved(reader)); });
  return regions;
}

/// Also of the regions in a resolved pair, which have fewer keys.
Resolved read_resolved(JsonReader& reader) {
  Resolved resolved;
  reader.object([&](const std::string& key) {
    if (key == "id") {
      resolved.id = reader.string();
    } else if (key == "region") {
      resolved.region = read_text(reader);
    } else if (key == "a" || key == "b") {
      (key == "a" ? resolved.a : resolved.b) = read_part(reader);
    } else if (key == "test") {
      resolved.test = read_text(reader);
    } else if (key == "verdict") {
      resolved.verdict = read_verdict(reader);
    } else if (key == "centroid") {
      if (reader.kind() == Kind::null)
        reader.skip();
      else
        resolved.centroid = read_point(reader);
    } else if (key == "reach") {
      resolved.reach = reader.number();
    } else if (key == "regions") {
      resolved.regions = read_resolved_regions(reader);
    } else if (key == "ambiguous") {
      resolved.is_ambiguous = reader.boolean();
    } else if (!read_remark(reader, key, resolved.remark)) {
      reader.skip();
    }
  });
  if (!reader.failed() && resolved.id.empty() && resolved.region.empty()) reader.fail("this has no \"id\"");
  return resolved;
}

/// A pair, and the ids of its parts in that document.
struct NumberedPair {
  Previous::Pair pair;
  std::uint32_t a = 0, b = 0;
  std::string place;
};

NumberedPair read_pair(JsonReader& reader) {
  NumberedPair numbered;
  Previous::Pair& pair = numbered.pair;
  std::optional<std::uint32_t> a, b;
  bool has_verdict = false;
  numbered.place = reader.place_of_next();
  reader.object([&](const std::string& key) {
    if (key == "id") {
      pair.id = reader.string();
    } else if (key == "a") {
      a = read_number(reader);
    } else if (key == "b") {
      b = read_number(reader);
    } else if (key == "test") {
      pair.test = read_text(reader);
    } else if (key == "verdict") {
      pair.verdict = read_verdict(reader), has_verdict = true;
    } else if (key == "nearest" && reader.kind() != Kind::null) {
      const std::vector<Point> ends = read_points(reader);
      if (!reader.failed())
        pair.middle =
            Point{ends[0].x / 2 + ends[1].x / 2, ends[0].y / 2 + ends[1].y / 2, ends[0].z / 2 + ends[1].z / 2};
    } else if (key == "regions") {
      pair.has_regions = true;
      reader.array([&] { pair.regions.push_back(read_region(reader)); });
    } else if (!read_remark(reader, key, pair.remark)) {
      reader.skip();
    }
  });
  if (reader.failed()) return numbered;
  if (pair.id.empty() || !a || !b || !has_verdict)
    reader.fail("this pair has no \"id\", \"a\", \"b\" or \"verdict\"; only the JSON of impinge clash has them");
  numbered.a = a.value_or(0), numbered.b = b.value_or(0);
  if (!pair.regions.empty()) pair.middle = pair.regions.front().centroid;
  return numbered;
}

/// What a document with these keys is, if it is none of `impinge clash`.
std::string_view what_has(const std::set<std::string>& keys) {
  if (is_gltf(keys)) return "it is a glTF file";
  if (keys.contains("spans")) return "it is the JSON of impinge motion";
  if (keys.contains("truncated") && !keys.contains("counts")) return "it is the JSON of impinge check";
  if (!keys.contains("version") && keys.contains("tests")) return "it is a configuration, which --config takes";
  if (keys.contains("pairs") && keys.contains("version")) return {};
  if (keys.contains("version") && keys.contains("files")) return "it is the JSON of impinge info";
  return "it has no \"version\" or no \"pairs\"";
}

std::string no_report(std::string_view what) {
  return fmt::format("this is no report of an earlier run, which impinge clash FILE... --json REPORT writes: {}", what);
}

class Document {
 public:
  explicit Document(JsonReader& reader) : reader_(reader) {}

  void read() {
    const std::set<std::string> keys = reader_.keys();
    const std::string_view other = what_has(keys);
    // Without a version nothing of it is written as in a report. That of another version says so itself.
    if (!other.empty() && !keys.contains("version")) return reader_.fail(no_report(other));
    reader_.object([&](const std::string& key) {
      if (key == "version") {
        if (reader_.number() != 1)
          reader_.fail("this is a document of another version of impinge, which wrote version 1");
      } else if (key == "files") {
        reader_.array([&] { previous_.files.push_back(read_file_names(reader_)); });
      } else if (key == "objects") {
        reader_.array([&] { read_object(); });
      } else if (key == "pairs") {
        reader_.array([&] { pairs_.push_back(read_pair(reader_)); });
      } else if (key == "resolved") {
        reader_.array([&] { previous_.resolved.push_back(read_resolved(reader_)); });
      } else {
        reader_.skip();
      }
    });
    if (!other.empty()) reader_.fail(no_report(other));
  }

  Result<Previous> finish() {
    if (reader_.failed()) return reader_.error();
    for (const Previous::OldFile& file : previous_.files)
      if (file.name.empty() || file.known_as.empty())
        return reader_.error_at({}, "one of the \"files\" has no \"name\" or no \"known_as\"");
    std::unordered_set<std::string_view> ids;
    for (NumberedPair& numbered : pairs_) {
      const auto a = objects_.find(numbered.a), b = objects_.find(numbered.b);
      if (a == objects_.end() || b == objects_.end())
        return reader_.error_at(numbered.place, "this pair is of a part that is not among the \"objects\"");
      numbered.pair.a = a->second, numbered.pair.b = b->second;
      if (!ids.insert(numbered.pair.id).second)
        return reader_.error_at(numbered.place, "an earlier pair has the same \"id\"");
    }
    for (NumberedPair& numbered : pairs_) previous_.pairs.push_back(std::move(numbered.pair));
    for (auto& [id, part] : objects_) previous_.parts.push_back(std::move(part));
    if (previous_.files.empty()) name_files();
    return std::move(previous_);
  }

 private:
  /// What a report says that tells no names of files.
  void name_files() {
    std::set<std::string> given;
    for (const OldPart& part : previous_.parts)
      if (!part.file.empty()) given.insert(part.file);
    const std::vector<std::string> files(given.begin(), given.end()), names = names_of_files(files);
    for (std::size_t i = 0; i < files.size(); ++i) previous_.files.push_back({files[i], names[i], names[i]});
  }

  void read_object() {
    std::optional<std::uint32_t> id;
    OldPart part;
    reader_.object([&](const std::string& key) {
      if (key == "id") return id = read_number(reader_), void();
      if (key == "name") return part.name = reader_.string(), void();
      if (key == "path") return part.path = reader_.string(), void();
      if (key == "file") return part.file = reader_.string(), void();
      if (key == "placed") return part.placed = reader_.string(), void();
      reader_.skip();
    });
    if (reader_.failed()) return;
    if (!id) return reader_.fail("this object has no \"id\"");
    if (!objects_.emplace(*id, std::move(part)).second) reader_.fail("an earlier object has the same \"id\"");
  }

  JsonReader& reader_;
  Previous previous_;
  std::vector<NumberedPair> pairs_;
  std::unordered_map<std::uint32_t, OldPart> objects_;
};

}  // namespace

Result<Previous> parse_previous(const std::string& name, const std::string& text) {
  if (const std::string instead = what_it_is_instead(text); !instead.empty())
    return json_error(name, text, {}, no_report(instead));
  JsonReader reader(text, name);
  if (reader.kind() == Kind::array) reader.fail(no_report("it is a list"));
  Document document(reader);
  document.read();
  return document.finish();
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
