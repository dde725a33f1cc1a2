// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/selector.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <re2/re2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>

#include "report/identity.hpp"
#include "report/named_tests/ifc_classes.hpp"
#include "report/scene.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f";

Error bad(std::string sentence) { return {Code::bad_file, std::move(sentence)}; }

std::string in_quotes(std::string_view text) { return fmt::format("'{}'", fit(printable(text), 80)); }

/// What may stand before a comparison. IfcOpenShell has assembly, host, layer, system, storey, building and site by
/// query: alone.
constexpr std::array<std::string_view, 19> kKeys{
    "Description",    "GlobalId", "Name", "ObjectType", "PredefinedType", "Tag",      "assembly", "building",
    "classification", "group",    "host", "layer",      "location",       "material", "parent",   "site",
    "storey",         "system",   "type"};

/// The properties that a key asks for.
std::vector<std::string> properties_of(const std::string& key) {
  if (key == "group") return {"group", "system"};
  if (key == "location") return {"space", "storey", "building", "facility", "site"};
  if (key == "parent") return {"host", "assembly", "space", "storey", "building", "facility", "site"};
  return {key};
}

/// The property that a path behind "query:" asks for which is neither an attribute nor of a property set; empty for
/// other paths.
std::string_view property_of_query(std::string_view path) {
  constexpr std::string_view kName = ".Name";
  constexpr std::array<std::string_view, 9> kNamed{"type",  "material", "classification", "group", "system",
                                                   "space", "storey",   "building",       "site"};
  if (path == "class") return "class";
  if (path == "predefined_type") return "PredefinedType";
  if (path == "classification.Identification") return "classification";
  if (!path.ends_with(kName)) return {};
  path.remove_suffix(kName.size());
  if (path == "materials" || path == "mat" || path == "mats") return "material";
  const auto named = std::ranges::find(kNamed, path);
  return named == kNamed.end() ? std::string_view() : *named;
}

/// Words that lead from an element to another in IfcOpenShell's queries, and are no property sets.
constexpr std::array<std::string_view, 27> kSteps{
    "type",     "types",  "occurrences", "material", "materials", "mat",      "mats", "item",   "i",
    "profiles", "styles", "container",   "space",    "storey",    "building", "site", "parent", "classification",
    "group",    "system", "zone",        "count",    "id",        "x",        "y",    "z",      "elevation"};

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// An attribute of IFC, such as Name: the other keys are words of IfcOpenShell.
bool is_attribute(std::string_view key) { return !key.empty() && key.front() >= 'A' && key.front() <= 'Z'; }

bool is_class(std::string_view word) {
  return word.starts_with("Ifc") && std::all_of(word.begin(), word.end(), is_word_character);
}

/// IFC's base 64 of 128 bits: 22 characters, of which the first has two bits.
bool is_global_id(std::string_view word) {
  return word.size() == 22 && word[0] >= '0' && word[0] <= '3' &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_word_character(c) || c == '$'; });
}

/// Linear in the text, whatever the expression is.
std::unique_ptr<const RE2> compiled(const TextMatch& match) {
  RE2::Options options;
  options.set_log_errors(false);
  return std::make_unique<const RE2>(match.text, options);
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<Selector> parse() {
    Selector selector;
    do {
      auto& list = selector.lists.emplace_back();
      do {
        Result<Facet> facet = parse_facet();
        if (!facet) return facet.error();
        if (list.empty() && facet->is_not && facet->kind != Facet::Kind::value)
          return bad(fmt::format("{} takes away from nothing; write IfcElement, {}", in_quotes(facet->written),
                                 facet->written));
        list.push_back(*std::move(facet));
      } while (skip(","));
      // A '+' may stand at the end.
    } while (skip("+") && !is_at_end());
    if (!is_at_end()) return unexpected();
    return selector;
  }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size()); }
  bool is_at_end() {
    skip_blanks();
    return at_ == text_.size();
  }
  bool skip(std::string_view token) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }

  Error unexpected() {
    if (is_at_end()) return bad("it ends where a class, a global id or a filter such as Name=D01 should stand");
    return bad(fmt::format("{} is not understood", in_quotes(text_.substr(at_))));
  }

  /// "quoted", /regular expression/ or a word without blanks and signs; of a value, with dots.
  Result<TextMatch> parse_text(bool is_value) {
    if (skip("\"")) {
      std::string text;
      for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
        if (text_.substr(at_).starts_with("\\\"")) ++at_;
        text += text_[at_];
      }
      if (at_++ == text_.size()) return bad("a quotation mark is not closed");
      return TextMatch{std::move(text), false};
    }
    if (skip("/")) {
      const std::size_t end = text_.find('/', at_);
      if (end == std::string_view::npos) return bad("a regular expression is not closed by '/'");
      TextMatch match{std::string(text_.substr(at_, end - at_)), true};
      at_ = end + 1;
      const auto expression = compiled(match);
      if (!expression->ok())
        return bad(fmt::format("the regular expression {} cannot be used: {}", in_quotes(match.text),
                               printable(expression->error())));
      return match;
    }
    skip_blanks();
    const std::size_t end =
        std::min(text_.find_first_of(is_value ? " \t\r\n\f,=><*!+\"" : " \t\r\n\f,=><*!+\".", at_), text_.size());
    if (end == at_) return unexpected();
    TextMatch match{std::string(text_.substr(at_, end - at_)), false};
    at_ = end;
    return match;
  }

  Result<Facet> parse_facet() {
    skip_blanks();
    const std::size_t begin = at_;
    Facet facet;
    facet.is_not = skip("!");
    if (!skip("#")) skip(".");  // before an id and a class, as IfcClash once wrote them
    const bool is_query = skip("query:");
    Result<TextMatch> first = parse_text(false);
    if (!first) return first.error();
    bool of_set = skip(".");
    if (of_set) {
      Result<TextMatch> property = parse_text(false);
      if (!property) return property.error();
      facet.property_set = *first;
      facet.property = *std::move(property);
    }
    if (is_query) {
      const std::string path = of_set ? first->text + "." + facet.property.text : first->text;
      if (skip(".")) return not_supported("query:" + path + "." + std::string(text_.substr(at_, 20)));
      if (const std::string_view property = property_of_query(path); !property.empty()) {
        facet.properties = {std::string(property)};
        facet.property_set = facet.property = {};
        of_set = false;
      } else if (of_set && !first->is_regex && std::ranges::find(kSteps, first->text) != kSteps.end()) {
        return not_supported("query:" + path);
      }
    }
    const std::optional<bool> compares = parse_comparison(facet);
    if (!compares) return unexpected();
    const auto written = [&] { return std::string(text_.substr(begin, at_ - begin)); };
    if (!*compares) {
      facet.written = written();
      if (of_set || first->is_regex) return bad(fmt::format("{} is compared with nothing", in_quotes(facet.written)));
      facet.word = first->text;
      facet.kind = is_class(facet.word) ? Facet::Kind::ifc_class : Facet::Kind::global_id;
      if (facet.kind == Facet::Kind::global_id && !is_global_id(facet.word))
        return bad(fmt::format("{} is no class, no global id and no filter such as Name=D01", in_quotes(facet.word)));
      return facet;
    }
    if (text_[begin] == '!') return bad(fmt::format("'!' before {} stands before '='", in_quotes(first->text)));
    if (!of_set && facet.properties.empty()) {
      const bool is_known = std::ranges::find(kKeys, first->text) != kKeys.end();
      if (!is_known || first->is_regex || (is_query && !is_attribute(first->text)))
        return not_supported(std::string(is_query ? "query:" : "") + first->text);
      facet.properties = properties_of(first->text);
    }
    if (auto value = parse_value(facet); !value) return value.error();
    facet.written = written();
    // IfcOpenShell finds these by their GlobalIds as well, which are not read.
    if (!of_set && !is_query && !is_attribute(first->text) && is_global_id(facet.value.text))
      return bad(fmt::format("{}: impinge compares {} with names, not with a GlobalId; write its name",
                             in_quotes(facet.written), first->text));
    return facet;
  }

  /// Whether there is one; nothing: a part of one.
  std::optional<bool> parse_comparison(Facet& facet) {
    using enum Facet::Comparison;
    skip_blanks();
    const std::size_t begin = at_;
    const bool is_not = skip("!");
    for (const auto& [sign, comparison] :
         {std::pair("*=", contains), {">=", at_least}, {"<=", at_most}, {"=", equal}, {">", more}, {"<", less}}) {
      if (!skip(sign)) continue;
      const bool can_be_turned = comparison == equal || comparison == contains;
      if (is_not && !can_be_turned) break;
      facet.is_not = facet.is_not || is_not;
      facet.comparison = comparison;
      return true;
    }
    if (at_ == begin) return false;
    at_ = begin;
    return std::nullopt;
  }

  Result<void> parse_value(Facet& facet) {
    skip_blanks();
    const bool is_bare = at_ < text_.size() && text_[at_] != '"' && text_[at_] != '/';
    Result<TextMatch> value = parse_text(true);
    if (!value) return value.error();
    if (is_bare && value->text == "NULL") facet.is_null = true;
    facet.value = *std::move(value);
    if (facet.comparison != Facet::Comparison::equal && facet.value.is_regex)
      return bad("a regular expression is compared by = and != alone");
    return {};
  }

  static Error not_supported(const std::string& key) {
    return bad(
        fmt::format("impinge does not filter by {}; it does by {}, and by properties such as "
                    "Pset_WallCommon.FireRating",
                    in_quotes(key), fmt::join(kKeys, ", ")));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// The product's own name, which an object's may differ from where several have the same: it stands between its class
/// and its global id.
std::string_view ifc_name(const io::Object& object) {
  std::string_view name = object.product;
  const std::size_t end = name.rfind(fmt::format("_{}", ifc_guid(object)));
  const std::size_t begin = name.find('_') + 1;
  return end == std::string_view::npos || end < begin ? object.name : name.substr(begin, end - begin);
}

/// Whether a filter of one facet lets objects through.
class Filter {
 public:
  explicit Filter(const Facet& facet) : facet_(facet) {
    if (facet.value.is_regex) value_ = compiled(facet.value);
    if (facet.property_set.is_regex) set_ = compiled(facet.property_set);
    if (facet.property.is_regex) property_ = compiled(facet.property);
  }

  [[nodiscard]] bool lets_through(const io::Object& object) const {
    bool is_there = false, says = false;
    const auto look_at = [&](std::string_view text) {
      is_there = true;
      says = says || agrees(text);
    };
    if (const auto name = ifc_name(object); !name.empty() && asks_for("Name")) look_at(name);
    for (const auto& [name, value] : object.properties)
      if (asks_for(name)) look_at(value);
    if (facet_.is_null) says = !is_there;
    return says != facet_.is_not;
  }

 private:
  static bool begins(const RE2& expression, std::string_view text) {
    return expression.Match({text.data(), text.size()}, 0, text.size(), RE2::ANCHOR_START, nullptr, 0);
  }
  static bool is(const TextMatch& match, const std::unique_ptr<const RE2>& expression, std::string_view text) {
    return expression ? begins(*expression, text) : match.text == text;
  }
  static std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
  }

  [[nodiscard]] bool asks_for(std::string_view name) const {
    if (!facet_.properties.empty()) return std::ranges::find(facet_.properties, name) != facet_.properties.end();
    const std::size_t dot = name.find('.');
    return dot != std::string_view::npos && is(facet_.property_set, set_, name.substr(0, dot)) &&
           is(facet_.property, property_, name.substr(dot + 1));
  }

  [[nodiscard]] bool agrees(std::string_view text) const {
    using enum Facet::Comparison;
    if (facet_.is_null) return false;
    if (facet_.comparison == contains) return text.find(facet_.value.text) != std::string_view::npos;
    if (value_) return begins(*value_, text);
    const std::optional<double> a = number(text), b = number(facet_.value.text);
    const bool are_numbers = a && b;
    switch (facet_.comparison) {
      case more:
        return are_numbers && *a > *b;
      case less:
        return are_numbers && *a < *b;
      case at_least:
        return are_numbers && *a >= *b;
      case at_most:
        return are_numbers && *a <= *b;
      default:
        // "0.250" in a property set is 0.25; a tag is a text.
        return text == facet_.value.text || (facet_.properties.empty() && are_numbers && *a == *b);
    }
  }

  const Facet& facet_;
  std::unique_ptr<const RE2> value_, set_, property_;
};

/// The objects that a name, class or global id stands for. Errors: `bad_file`, of one that adds nothing.
Result<PartSet> named_by(const Facet& facet, const Assembly& assembly) {
  const std::vector<io::Object>& objects = assembly.objects;
  PartSet set(objects.size());
  if (facet.kind == Facet::Kind::ifc_class) {
    if (facet.word == "IfcElement" || facet.word == "IfcProduct") return PartSet(objects.size(), true);
    if (!facet.is_not || !is_ifc_class(facet.word)) return of_class(assembly, facet.word);
    for (std::size_t i = 0; i < set.size(); ++i) set[i] = is_of_ifc_class(class_of(objects[i]), facet.word);
    return set;
  }
  if (facet.kind == Facet::Kind::name) {
    const auto named = objects_named(assembly, facet.word);
    if (!named) return named.error();
    for (const std::uint32_t object : *named) set[object] = true;
    return set;
  }
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = ifc_guid(objects[i]) == facet.word;
  if (!facet.is_not && std::ranges::find(set, true) == set.end())
    return bad(fmt::format("no part's GlobalId is '{}'", facet.word));
  return set;
}

}  // namespace

bool Selector::needs_property_sets() const {
  return std::ranges::any_of(lists, [](const std::vector<Facet>& list) {
    return std::ranges::any_of(list, [](const Facet& facet) { return !facet.property.text.empty(); });
  });
}

Result<Selector> parse_selector(std::string_view text) {
  // One word that is none of IfcOpenShell's is a pattern of names, for files that know no classes.
  const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
  const std::string_view word = text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
  if (!word.empty() && word.find_first_of("!=<>,+\"/#") == std::string_view::npos && !word.starts_with('.') &&
      !word.starts_with("Ifc") && !word.starts_with("query:") && !is_global_id(word))
    return Selector{{{Facet{.kind = Facet::Kind::name, .word = std::string(word), .written = std::string(word)}}}};
  return Parser(text).parse();
}

Result<PartSet> select(const Selector& selector, const Assembly& assembly) {
  PartSet all(assembly.objects.size());
  for (const std::vector<Facet>& list : selector.lists) {
    // A list that begins with a filter filters everything.
    PartSet set(all.size(), list.front().kind == Facet::Kind::value);
    for (const Facet& facet : list) {
      if (facet.kind == Facet::Kind::value) {
        const Filter filter(facet);
        for (std::size_t i = 0; i < set.size(); ++i) set[i] = set[i] && filter.lets_through(assembly.objects[i]);
        if (std::ranges::find(set, true) == set.end())
          return bad(fmt::format("no part is left by {}", in_quotes(facet.written)));
        continue;
      }
      const Result<PartSet> named = named_by(facet, assembly);
      if (!named) return named.error();
      for (std::size_t i = 0; i < set.size(); ++i)
        if ((*named)[i]) set[i] = !facet.is_not;
    }
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] || set[i];
  }
  return all;
}

std::string_view class_of(const io::Object& object) {
  return std::string_view(object.product).substr(0, object.product.find('_'));
}

Result<PartSet> of_class(const Assembly& assembly, std::string_view ifc_class) {
  PartSet set(assembly.objects.size());
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = is_of_ifc_class(class_of(assembly.objects[i]), ifc_class);
  if (std::ranges::find(set, true) != set.end()) return set;
  if (is_ifc_class(ifc_class))
    return bad(fmt::format("no part's IFC class, or one that it is derived from, is '{}'", ifc_class));
  return bad(fmt::format("impinge knows no class {} of IFC, and no part is of it; the nearest is '{}'",
                         in_quotes(ifc_class), nearest_ifc_class(ifc_class)));
}

}  // namespace impinge::report
