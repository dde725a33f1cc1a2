// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace impinge::importer {

/// An IFC product's node is called "IfcWindow_EG-Fenster-6_1srAI$R4T8ihLXSNHmUSET" by assimp: type, name, GlobalId.
struct IfcProduct {
  std::string_view type, name;
};

/// Whether a node's name has that form.
bool parse_ifc_product(std::string_view node_name, IfcProduct& product);

}  // namespace impinge::importer
