// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <system_error>

#include "report/text.hpp"

namespace impinge::report {
namespace {

/// Parts of a key are kept apart by their lengths: no two lists of parts have one text.
std::string joined(std::string_view a, std::string_view b) { return fmt::format("{}:{}{}", a.size(), a, b); }

using Steps = std::vector<std::string>;

/// The folders of a file from the root down, and its name: at least one, for a file that nothing is known of too. As
/// UTF-8, since the next run knows them from a JSON document, which holds nothing else.
Steps steps_of(const std::string& file) {
  std::error_code unknown;
  std::filesystem::path path = std::filesystem::absolute(file, unknown);
  if (unknown) path = file;  // in a folder that is gone
  Steps steps;
  for (const std::filesystem::path& step : path.lexically_normal()) steps.push_back(distinct_utf8(step.string()));
  if (steps.empty()) steps.emplace_back();
  return steps;
}

/// The last `count` steps.
std::string ending(std::span<const std::string> steps, std::size_t count) {
  std::string text;
  for (const std::string& step : steps.last(count)) text += (text.empty() ? "" : "/") + step;
  return text;
}

/// How many folders from the root down all of them have in common.
std::size_t folders_in_common(const std::vector<Steps>& files) {
  std::size_t common = files.front().size() - 1;
  for (const Steps& file : files) {
    const std::size_t most = std::min(common, file.size() - 1);
    const auto [here, there] =
        std::mismatch(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(most), files.front().begin());
    common = static_cast<std::size_t>(here - file.begin());
  }
  return common;
}

/// Names for different files that have one name without folders.
std::map<Steps, std::string> tell_apart(const std::vector<Steps>& files) {
  const std::size_t common = folders_in_common(files);
  std::map<std::string, std::size_t> count;  // of files with each ending
  for (const Steps& file : files)
    for (std::size_t steps = 2; steps <= file.size() - common; ++steps) ++count[ending(file, steps)];
  std::map<Steps, std::string> names;
  for (const Steps& file : files) {
    const std::size_t all = file.size() - common;
    std::size_t steps = 2;
    while (steps <= all && count[ending(file, steps)] > 1) ++steps;
    // All of it is the ending of another one: it must not have the name that it would have without that one.
    names[file] = steps <= all ? ending(file, steps) : "./" + ending(file, all);
  }
  return names;
}

void append(std::string& bytes, std::uint64_t word) {
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(word >> shift & 0xFF);
}
void append(std::string& bytes, double number) {
  append(bytes, std::bit_cast<std::uint64_t>(number == 0 ? 0.0 : number));  // -0 is 0
}

std::string shape_of(const Mesh& mesh) {
  std::string bytes;
  append(bytes, std::uint64_t{mesh.vertices().size()});
  for (const Point& vertex : mesh.vertices())
    for (const double coordinate : {vertex.x, vertex.y, vertex.z}) append(bytes, coordinate);
  for (const auto& triangle : mesh.triangles())
    for (const std::uint32_t corner : triangle) append(bytes, std::uint64_t{corner});
  return guid_of(bytes);
}

using Numbers = std::vector<std::size_t>;

/// Of the twin with this number, from 0. No other key ends so: a key ends with a path, whose length it says, or with a
/// UUID.
std::string twin_key(const std::string& first, std::size_t number) {
  return number == 0 ? first : fmt::format("{}#{}", first, number + 1);
}

}  // namespace

std::vector<std::string> names_of_files(const std::vector<std::string>& files) {
  std::vector<Steps> steps;
  std::map<std::string, std::vector<Steps>> namesakes;
  for (const std::string& file : files) {
    steps.push_back(steps_of(file));
    namesakes[steps.back().back()].push_back(steps.back());
  }
  std::map<Steps, std::string> names;
  for (auto& [name, all] : namesakes) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (all.size() == 1)
      names[all.front()] = name;
    else
      names.merge(tell_apart(all));
  }
  std::vector<std::string> found;
  found.reserve(files.size());
  for (const Steps& file : steps) found.push_back(names.at(file));
  return found;
}

std::string path_in(std::string_view path, const std::string& file, std::string_view instead) {
  const std::string own = std::filesystem::path(file).stem().string();
  if (own.empty() || own == instead) return std::string(path);
  const std::string other = std::string(instead) + '\0';  // no name of a part has that character
  std::string found;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t to = std::min(path.find('/', from), path.size());
    const std::string_view step = path.substr(from, to - from);
    found += from > 0 ? "/" : "";
    found += step == own ? instead : step == instead ? std::string_view(other) : step;
    from = to + 1;
  }
  return found;
}

std::string Shapes::placed(const io::Object& object) {
  std::string& shape = shapes_[{object.mesh.vertices().data(), object.mesh.triangles().data()}];
  if (shape.empty()) shape = shape_of(object.mesh);
  std::string bytes = shape;
  for (const double number : object.pose.R) append(bytes, number);
  for (const double number : object.pose.t) append(bytes, number);
  return guid_of(bytes);
}

std::vector<Identity> identities_of(const Assembly& assembly, const std::vector<std::string>& file_names) {
  std::vector<std::string> stems;
  stems.reserve(file_names.size());
  for (const std::string& name : file_names) stems.push_back(std::filesystem::path(name).stem().string());
  std::map<std::string, Numbers> namesakes;
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    // Not the name, which has a number where several of a file have one: that changes when one is added. Nor the path
    // where there is a GlobalId, which outlives it.
    const std::string_view guid = ifc_guid(assembly.objects[i]);
    const std::uint32_t file = assembly.file_of[i];
    std::string path;
    if (guid.empty()) path = path_in(assembly.objects[i].path, assembly.files[file], stems[file]);
    namesakes[joined(file_names[file], joined(guid, joined(path, "")))].push_back(i);
  }
  Shapes shapes;
  std::vector<Identity> identities(assembly.objects.size());
  for (std::size_t i = 0; i < identities.size(); ++i) identities[i].placed = shapes.placed(assembly.objects[i]);
  for (const auto& [key, objects] : namesakes) {
    std::map<std::string, Numbers> twins;
    for (const std::size_t object : objects) twins[identities[object].placed].push_back(object);
    for (const auto& [placed, same] : twins) {
      // Where all are twins, what one of them was known by when it was alone is still the name of the first.
      const std::string first = twins.size() == 1 ? key : key + placed;
      for (std::size_t k = 0; k < same.size(); ++k) identities[same[k]].key = twin_key(first, k);
    }
  }
  return identities;
}

std::string_view ifc_guid(const io::Object& object) {
  // "IfcWall_Name_1srAI$R4T8ihLXSNHmUSET", and " (2)" after it where the file repeats a GlobalId.
  constexpr std::size_t kLength = 22;
  std::string_view text = object.product;
  if (text.ends_with(')')) text = text.substr(0, text.rfind(" ("));
  if (text.size() <= kLength || text[text.size() - kLength - 1] != '_') return {};
  return std::string_view(object.product).substr(text.size() - kLength, kLength);
}

std::string guid_of(std::string_view text) {
  // A name space of impinge's own: any fixed UUID does.
  static const boost::uuids::uuid kClashes = {
      {0x8d, 0x2f, 0x61, 0x4b, 0x53, 0xc0, 0x4e, 0x17, 0x9a, 0x6e, 0x2b, 0x90, 0xf4, 0x7d, 0x31, 0xc5}};
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(kClashes)(text.data(), text.size()));
}

std::string guid_of_pair(std::string_view key_a, std::string_view key_b, std::string_view what) {
  const auto [first, second] = std::minmax(key_a, key_b);
  return guid_of(joined(first, joined(second, what)));
}

}  // namespace impinge::report
