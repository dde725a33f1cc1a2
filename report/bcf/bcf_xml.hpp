// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "report/bcf/raster.hpp"
#include "report/conventions.hpp"
#include "report/review.hpp"

/// The XML of BCF 2.1 and 3.0, with its elements in the order of the published schemas: version.xsd, extensions.xsd,
/// markup.xsd, visinfo.xsd.
namespace impinge::report {

std::string version_document(BcfVersion version);

/// Of BCF 3.0: the words that its topics use.
std::string extensions_document(const Review& review, const std::vector<std::size_t>& topics);

/// What a topic is marked with: verdict, test, change, and the storeys and classes of its parts; printable.
std::vector<std::string> labels_of(const Review& review, std::size_t pair);
/// What people decided, or else `kUndecided`; printable.
std::string status_of(const Review& review, std::size_t pair);
inline constexpr const char *kUndecided = "Open", *kTopicType = "Clash";
inline constexpr std::array kPriorities{"High", "Medium", "Low"};

/// The topic of a pair, which is the rank-th, with what people wrote about it. Lengths and places in it are in metres
/// with Z up, as those of the viewpoint.
std::string markup_of(const Review& review, std::size_t pair, std::size_t rank);

/// The topic about files that were skipped, and no clash of which is known: of none of its own pairs, without
/// viewpoint.
std::string markup_of_skipped(const Review& review);
std::string guid_of_skipped(const Review& review);

/// Where it is seen from, both parts, and as many of the lines as a viewer can take.
std::string viewpoint_of(const Review& review, std::size_t pair, const View& view,
                         const std::vector<std::vector<Point>>& lines, const Conventions& conventions);

std::string guid_of_viewpoint(const std::string& pair);

/// What files and parts are called in a topic: printable.
std::string file_name_of(const Review& review, std::uint32_t object);

/// Gives a document its declaration and its root, which is returned.
pugi::xml_node begin_document(pugi::xml_document& document, const char* root);
std::string text_of(const pugi::xml_document& document);
/// Appends an element with a text in it, which is printable: XML has no control characters.
void add_element(pugi::xml_node parent, const char* name, const std::string& text);

}  // namespace impinge::report
