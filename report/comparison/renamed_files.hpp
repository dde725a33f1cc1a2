// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/assembly.hpp"
#include "report/comparison/previous.hpp"

/// Files that have another name than in the previous run, such as the date of an export.
namespace impinge::report {

/// What the files of a run are known by, which stays what it was when they are renamed.
struct FileNames {
  std::vector<std::string> known_as;                         ///< for each file; no two files have the same
  std::vector<std::pair<std::string, std::string>> renamed;  ///< by this run: the present name and that of then
  std::vector<std::string> fresh, gone;  ///< names that are left, if both are: some may be renamed, nobody knows
};

/// `names` are the present ones, for each file (`names_of_files`). The only file of a run is the only one of the run
/// before, if parts have the same path. Of several, one whose name is gone is the one with a new name that most parts
/// are in with the same path, shape and place; at least half of the parts of one of them, and more than in any other of
/// then or now. None in which a part has the name of the other.
FileNames known_names(const Assembly& assembly, const std::vector<std::string>& names, const Previous* previous);

/// Sentences that say so.
std::vector<std::string> renaming_warnings(const FileNames& names, const std::string& previous);

}  // namespace impinge::report
