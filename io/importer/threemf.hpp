// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "io/import_stream.hpp"

/// 3MF, read by lib3mf: what the file's build items show, with the components that they are made of.
namespace impinge::importer {

/// By its name.
bool is_3mf(const char* file);

/// Writes a part for each mesh of each build item, but not the stream's end. Returns a part of a sentence where lib3mf
/// or the file is at fault, or nothing.
std::string write_3mf(const char* file, io::ImportWriter& writer);

}  // namespace impinge::importer
