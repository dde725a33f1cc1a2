// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <filesystem>
#include <unordered_map>

namespace impinge::cli {
namespace {

/// Parts of a key are kept apart by their lengths: no two lists of parts have one text.
std::string joined(std::string_view a, std::string_view b) { return fmt::format("{}:{}{}", a.size(), a, b); }

}  // namespace

std::vector<std::string> keys_of(const Assembly& assembly) {
  std::unordered_map<std::string, std::size_t> seen;
  std::vector<std::string> keys;
  keys.reserve(assembly.objects.size());
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    const std::string file = std::filesystem::path(assembly.files[assembly.file_of[i]]).filename().string();
    std::string key = joined(file, joined(assembly.objects[i].path, assembly.objects[i].name));
    if (const std::size_t earlier = seen[key]++; earlier > 0) key += fmt::format("#{}", earlier + 1);
    keys.push_back(std::move(key));
  }
  return keys;
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

}  // namespace impinge::cli
