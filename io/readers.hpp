// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "impinge/io.hpp"
#include "io/text.hpp"

/// The readers as `read` calls them: `source` tells what messages call the file, and what an object without a name is
/// called.
namespace impinge::io {

Result<Model> read_obj(std::string_view bytes, const Source& source);
Result<Model> read_off(std::string_view bytes, const Source& source);
Result<Model> read_ply(std::string_view bytes, const Source& source);
Result<Model> read_stl(std::string_view bytes, const Source& source);

}  // namespace impinge::io
