// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// Decisions in BCF of any tool: the topics whose GUIDs are ids of pairs.
#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <memory>
#include <pugixml.hpp>

#include "report/bcf/bcf_xml.hpp"
#include "report/decisions.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

// Far more than people write, and what a hostile archive costs at most.
constexpr std::uint64_t kMostBytesOfMarkup = 4'000'000, kMostBytesOfMarkups = 256'000'000;

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// The bytes of a member; no more than its entry says. Errors: `bad_file`, without the archive's name.
Result<std::string> unpacked(zip_t* archive, const zip_stat_t& about) {
  const auto refused = [&](std::string_view why) {
    return Error{Code::bad_file,
                 fmt::format("'{}' in it cannot be unpacked ({})", fit(printable(about.name), 80), why)};
  };
  if (about.size > kMostBytesOfMarkup)
    return refused(fmt::format("it has more than {} bytes", grouped(kMostBytesOfMarkup)));
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(zip_fopen_index(archive, about.index, 0), zip_fclose);
  if (!file) return refused(zip_strerror(archive));
  std::string bytes(about.size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0) return refused(zip_file_strerror(file.get()));
    if (got == 0) return refused("it is cut off");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

std::string text_in(const pugi::xml_node& parent, const char* name) {
  std::string text = parent.child(name).text().get();
  constexpr std::string_view kBlanks = " \t\r\n";
  text.erase(std::min(text.find_last_not_of(kBlanks) + 1, text.size()));
  return text.erase(0, std::min(text.find_first_not_of(kBlanks), text.size()));
}

/// What a topic says, its comments one after the other, a line for each.
Decision decision_of(const pugi::xml_node& markup) {
  const pugi::xml_node topic = markup.child("Topic");
  Decision decision;
  decision.status = topic.attribute("TopicStatus").value();
  if (decision.status == kUndecided) decision.status.clear();
  decision.assignee = text_in(topic, "AssignedTo");
  // Up to 2.1 beside the topic, in 3.0 within it.
  for (const pugi::xml_node& parent : {markup, topic.child("Comments")})
    for (const pugi::xml_node& comment : parent.children("Comment"))
      if (const std::string text = text_in(comment, "Comment"); !text.empty())
        decision.comment += (decision.comment.empty() ? "" : "\n") + text;
  if (const std::string due = text_in(topic, "DueDate").substr(0, 10); is_day(due)) decision.due = due;
  return decision;
}

}  // namespace

Result<Decisions> read_decided_bcf(const std::string& name) {
  const auto bad = [&](std::string_view what) { return Error{Code::bad_file, fmt::format("{}: {}", name, what)}; };
  int code = 0;
  const Archive archive(zip_open(name.c_str(), ZIP_RDONLY, &code), zip_discard);
  if (!archive) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    return bad(fmt::format("this is no BCF, a zip archive: {}", why));
  }
  if (zip_name_locate(archive.get(), "bcf.version", 0) < 0) return bad("this is no BCF: 'bcf.version' is not in it");
  Decisions decisions;
  std::uint64_t bytes = 0;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    zip_stat_t about{};
    if (zip_stat_index(archive.get(), static_cast<zip_uint64_t>(i), 0, &about) != 0 ||
        !std::string_view(about.name).ends_with("/markup.bcf"))
      continue;
    const std::string member = fit(printable(about.name), 80);
    if ((bytes += about.size) > kMostBytesOfMarkups)
      return bad(fmt::format("its topics have more than {} bytes together", grouped(kMostBytesOfMarkups)));
    const Result<std::string> text = unpacked(archive.get(), about);
    if (!text) return bad(text.error().message);
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
    if (!parsed)
      return bad(fmt::format("'{}' in it is no XML: {}, at byte {}", member, parsed.description(), parsed.offset));
    const pugi::xml_node markup = document.child("Markup");
    std::string id = markup.child("Topic").attribute("Guid").value();
    std::ranges::transform(id, id.begin(), [](char c) { return c >= 'A' && c <= 'F' ? static_cast<char>(c + 32) : c; });
    if (!is_pair_id(id)) return bad(fmt::format("'{}' in it has no topic with a GUID", member));
    if (!decisions.add(id, decision_of(markup)))
      return bad(fmt::format("'{}' in it: another topic decides otherwise about the pair {}", member, id));
  }
  return decisions;
}

}  // namespace impinge::report
