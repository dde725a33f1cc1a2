// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string_view>

#include "impinge/contacts.hpp"
#include "impinge/result.hpp"

namespace impinge {

/// A comparison of a few instructions, which `==` makes a call of: small queries take some thousand.
template <std::size_t N>
bool is_named(std::string_view backend, const char (&name)[N]) {
  return backend.size() == N - 1 && std::memcmp(backend.data(), name, N - 1) == 0;
}

/// Whether the backend is the paper's way, whose broad phase keeps sorted borders of its own.
bool is_papers_way(const Options& options);

/// Errors of options with values that they cannot have.
Result<void> validate(const Options& options);

}  // namespace impinge
