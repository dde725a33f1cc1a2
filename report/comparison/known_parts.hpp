// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/assembly.hpp"
#include "report/comparison/previous.hpp"
#include "report/identity.hpp"

/// Parts that have another GlobalId or name than in the previous run, as exports that make all of them anew give them.
namespace impinge::report {

/// For each object what it is known by, which stays what it was in the previous run: that of the part of then with the
/// same key; or else, where one part of its file is gone and it alone is new with that shape and place, of that part.
/// `file_names` are what the files are known by. `made_anew` counts the latter.
std::vector<std::string> known_keys(const Assembly& assembly, const std::vector<std::string>& file_names,
                                    const std::vector<Identity>& identities, const Previous* previous,
                                    std::size_t& made_anew);

}  // namespace impinge::report
