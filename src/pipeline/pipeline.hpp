// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"
#include "pipeline/query.hpp"

namespace impinge {

/// Runs the stages in order. Sets no floating-point environment on the calling thread: the public calls do.
Result<Contacts> run_pipeline(const Query& query, Workspace::State& memory);

/// Whether the backend is the paper's way, whose broad phase keeps sorted borders of its own.
bool is_papers_way(const Options& options);

/// Errors of options with values that they cannot have.
Result<void> validate(const Options& options);

}  // namespace impinge
