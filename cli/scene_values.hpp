// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "command_options.hpp"

/// Values that several commands take: what is read, how the work is done, and the page. Each function says what is
/// wrong with a text as a `bad_option`; an empty one was not given and changes nothing.
namespace impinge::cli {

Result<void> take_limit(const std::string& text, std::uint64_t& to);
Result<void> take_threads(const std::string& text, int& to);
Result<void> take_max_file(const std::string& text, std::uint64_t& to);
/// The page, and the upward axis, on which other outputs may depend as well.
Result<void> take_page(const Raw& raw, PageArguments& to);
/// The JSON's place, and what the files are and what of them is left out.
Result<void> take_scene(const Raw& raw, SceneArguments& to);

}  // namespace impinge::cli
