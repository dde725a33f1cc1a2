// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/report.hpp"

namespace impinge::report {

/// What a person is shown for each object: its name, made printable, with its file where objects of two files have the
/// same name.
std::vector<std::string> labels_of(const Assembly& assembly);

/// For each object a number that those of the same IFC product of the same file have in common; 0 without a product.
std::vector<std::uint32_t> products_of(const Assembly& assembly);

/// The first value that the object's file gives of a property; empty where it does not say it.
std::string_view property_of(const io::Object& object, std::string_view property);

/// The error, whose reason may be that files were skipped, with the first of them after it.
Error with_skipped(Error error, const Assembly& assembly);

/// A scene's error that begins with "object 3", with that object's label instead.
Error with_label(Error error, const Assembly& assembly);

/// The error that an interrupted command ends with, whatever it was doing.
Error interrupted();

}  // namespace impinge::report
