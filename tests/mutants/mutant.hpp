// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

/// The mutant of mutants.txt that is at work, 0 for none: chosen by the environment when the program starts.
inline const int impinge_mutant = std::getenv("IMPINGE_MUTANT") ? std::atoi(std::getenv("IMPINGE_MUTANT")) : 0;
