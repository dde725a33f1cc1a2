// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/io.hpp"
#include "io/import_stream.hpp"
#include "io/text.hpp"

namespace impinge::io {

/// Reads a file by assimp or web-ifc in a child process, whose crash, hang or hunger is an error that names the file.
/// Errors: `bad_file`, `cancelled`.
Result<Model> import_file(const std::filesystem::path& file, const Source& source, const ReadOptions& options);

/// Objects of what the importer sent: an object's world matrix becomes its pose where a pose may hold it, else it is
/// baked into the mesh. Errors: `bad_file`.
Result<Model> model_of(Imported&& imported, const Source& source);

}  // namespace impinge::io
