// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace impinge::importer {

/// Whether a file's name ends in .ifc or .ifczip.
bool is_ifc(const char* file);

/// Becomes Node.js, which reads the file by the script of io/ifc and writes the stream to standard output, with
/// property sets if asked for. Limits that are set go with it. Returns only where that cannot be: a sentence without a
/// full stop that says what to install.
std::string become_ifc_importer(const char* file, bool property_sets);

}  // namespace impinge::importer
