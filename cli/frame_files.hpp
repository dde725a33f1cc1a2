// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "impinge/result.hpp"

namespace impinge::cli {

/// The files of a sequence in order: those that are given, or those that a single name with '#' in the place of digits
/// stands for, from the lowest number to the highest. `frame_####.ply` is frame_0001.ply, of four digits or more;
/// `frame_#.ply` frame_1.ply to frame_10.ply. A file that is named with '#' itself is that file.
/// Errors: `bad_file` (a number that is missing; no such file), `bad_option` (fewer than two files; given ones whose
/// numbers do not go on evenly, as those of a shell's pattern do where one is missing, or 10 comes before 9).
Result<std::vector<std::string>> frame_files(const std::vector<std::string>& given);

}  // namespace impinge::cli
