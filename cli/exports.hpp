// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stop_token>

#include "arguments.hpp"
#include "documents.hpp"
#include "report/review.hpp"

/// The files of `clash` that other tools read: `--csv`, `--bcf` and `--gltf`.
namespace impinge::cli {

/// Errors: as `Documents::order`.
Result<void> order_exports(Documents& documents, const ClashArguments& arguments);

/// Writes those that were ordered. Errors: as `Documents::write`; `cancelled`.
Result<void> write_exports(Documents& documents, const Review& review, const ClashArguments& arguments,
                           const std::stop_token& stop);

}  // namespace impinge::cli
