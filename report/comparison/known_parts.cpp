// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/known_parts.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "report/json_writer.hpp"

namespace impinge::report {
namespace {

/// A file with a shape and place in it.
using Spot = std::pair<std::string, std::string>;

/// The parts at each spot.
template <class Part>
using AtSpots = std::map<Spot, std::vector<Part>>;

/// Parts of then whose keys no part has now.
AtSpots<const OldPart*> gone_parts(const Previous& previous, const std::set<std::string>& keys) {
  std::map<std::string, std::string> files;  // what they are known by
  for (const Previous::OldFile& file : previous.files) files.emplace(file.file, file.known_as);
  AtSpots<const OldPart*> gone;
  for (const OldPart& part : previous.parts)
    if (const auto file = files.find(part.file); file != files.end() && !part.key.empty() && !keys.contains(part.key))
      gone[{file->second, part.placed}].push_back(&part);
  return gone;
}

}  // namespace

std::vector<std::string> known_keys(const Assembly& assembly, const std::vector<std::string>& file_names,
                                    const std::vector<Identity>& identities, const Previous* previous,
                                    std::size_t& made_anew) {
  std::vector<std::string> known;
  known.reserve(identities.size());
  for (const Identity& identity : identities) known.push_back(identity.key);
  if (previous == nullptr) return known;
  std::unordered_map<std::string, const OldPart*> earlier;
  std::set<std::string> keys;
  for (const OldPart& part : previous->parts) earlier.emplace(part.key, &part);
  AtSpots<std::size_t> fresh;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < identities.size(); ++i) {
    const std::string key = as_read_back(identities[i].key);
    keys.insert(key);
    const auto same = earlier.find(key);
    if (same == earlier.end())
      fresh[{file_names[assembly.file_of[i]], identities[i].placed}].push_back(i);
    else if (!same->second->known_as.empty())
      known[i] = same->second->known_as;
  }
  const AtSpots<const OldPart*> gone = gone_parts(*previous, keys);
  for (const auto& [spot, parts] : fresh) {
    const auto then = gone.find(spot);
    if (parts.size() != 1 || then == gone.end() || then->second.size() != 1) continue;
    const OldPart& part = *then->second.front();
    known[parts.front()] = part.known_as.empty() ? part.key : part.known_as;
    ++made_anew;
  }
  // What has the key that another part is known by is not that part.
  for (std::string& key : known)
    for (int number = 2; !taken.insert(key).second; ++number) key = fmt::format("{} ({})", key, number);
  return known;
}

}  // namespace impinge::report
