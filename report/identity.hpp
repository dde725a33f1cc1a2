// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/assembly.hpp"

/// Names that clashes keep from one revision of the files to the next (docs/triage.md).
namespace impinge::report {

/// For each file a name that no other one has: that without folders; and of several that have the same, as many of the
/// folders above each as tell it apart, none of them above the folder that all of these are in. So a project may be
/// moved, and the order in which files are named means nothing. What is one file has one name. Names are UTF-8, with
/// bytes that are part of no character spelled out (`distinct_utf8`).
std::vector<std::string> names_of_files(const std::vector<std::string>& files);

/// The path of a part, with another name for each of its steps that is only the file's own, without ending: so are
/// parts called that have no name. A part that really has that other name gets one that no part has.
std::string path_in(std::string_view path, const std::string& file, std::string_view instead);

/// Shapes with their places as UUIDs: equal only where both are equal to the last bit. A mesh that many objects share
/// is looked at once.
class Shapes {
 public:
  std::string placed(const io::Object& object);

 private:
  std::map<std::pair<const void*, const void*>, std::string> shapes_;
};

/// What an object is known by, whatever its number is.
struct Identity {
  std::string key;     ///< no two objects have one
  std::string placed;  ///< a UUID of its shape and place: two have one only where both are equal to the last bit
};

/// For each object: the name that its file is known by, and its GlobalId or else its path. Where several have the same,
/// their shape and place tell them apart; where that is the same too, their order. The first of several twins is known
/// by what it would be known by without the others. `file_names` may be others than the files have now: those of a
/// revision before they were renamed.
std::vector<Identity> identities_of(const Assembly& assembly, const std::vector<std::string>& file_names);

/// The GlobalId of the IFC product that an object is part of, "" for none.
std::string_view ifc_guid(const io::Object& object);

/// A UUID (RFC 4122, version 5) that is the same for the same text, as "01234567-89ab-5cde-8f01-23456789abcd".
std::string guid_of(std::string_view text);

/// That of a clash between two objects, in any order; `what` tells several of the same two apart.
std::string guid_of_pair(std::string_view key_a, std::string_view key_b, std::string_view what = {});

}  // namespace impinge::report
