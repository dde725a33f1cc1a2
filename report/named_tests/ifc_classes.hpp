// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

/// The classes of IFC's products, and which are derived from which.
namespace impinge::report {

[[nodiscard]] bool is_ifc_class(std::string_view name);

/// Whether objects of the class `name` are of the class `wanted`: it is that, or derived from it.
[[nodiscard]] bool is_of_ifc_class(std::string_view name, std::string_view wanted);

/// The known class that is spelled most like the word.
[[nodiscard]] std::string nearest_ifc_class(std::string_view word);

}  // namespace impinge::report
