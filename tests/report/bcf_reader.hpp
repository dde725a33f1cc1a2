// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <pugixml.hpp>
#include <string>
#include <vector>

#include "read_back.hpp"

/// BCF read back by libzip and pugixml.
namespace impinge::test {

struct Vec {
  double x, y, z;
};
/// Of an element with X, Y and Z.
Vec vec(const pugi::xml_node& node);

/// What the elements of this name say that stand right below.
std::vector<std::string> texts(const pugi::xml_node& node, const char* name);

struct Topic {
  std::string guid;
  pugi::xml_document markup, viewpoint;
  Pixels snapshot;
  [[nodiscard]] pugi::xml_node topic() const { return markup.document_element().child("Topic"); }
  /// What an element of the topic says, empty where there is none.
  [[nodiscard]] std::string text(const char* element) const { return topic().child(element).text().get(); }
  [[nodiscard]] pugi::xml_node view() const { return viewpoint.document_element(); }
};

/// The topics by their index, held against the published schemas and each other.
std::vector<Topic> read_bcf(const std::string& archive);

}  // namespace impinge::test
