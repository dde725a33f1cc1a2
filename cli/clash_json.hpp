// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "review.hpp"
#include "sink.hpp"

namespace impinge::cli {

/// The document of `clash --json`: no times, so that the same files and settings give the same bytes.
/// Errors: `cancelled`. Write errors stay in the sink.
Result<void> write_clash_json(Sink& sink, const Review& review, const ClashArguments& arguments,
                              const std::stop_token& stop);

}  // namespace impinge::cli
