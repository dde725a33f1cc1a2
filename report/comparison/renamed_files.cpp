// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/comparison/renamed_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "report/identity.hpp"
#include "report/json_writer.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

/// The parts of a file, as far as they tell that it is the same.
struct Content {
  std::multiset<std::string> paths, placed;
  std::set<std::string> steps;  ///< of the paths as they stand in the file
};
using Contents = std::map<std::string, Content>;  // by the names of the files

/// A part that has no name is called as its file is, which says nothing here. Texts are as they stand in a report.
void add(Content& to, std::string_view own_path, const std::string& file, const std::string& placed) {
  for (std::size_t from = 0; from <= own_path.size();) {
    const std::size_t end = std::min(own_path.find('/', from), own_path.size());
    to.steps.emplace(own_path.substr(from, end - from));
    from = end + 1;
  }
  const std::string path = path_in(own_path, file, "");
  to.paths.insert(path);
  to.placed.insert(fmt::format("{}:{}{}", path.size(), path, placed));
}

std::string without_folders(const std::string& name) { return name.substr(name.rfind('/') + 1); }

std::string stem_of(const std::string& name) { return std::filesystem::path(name).stem().string(); }

std::size_t in_common(const std::multiset<std::string>& a, const std::multiset<std::string>& b) {
  std::size_t count = 0;
  for (auto i = a.begin(), k = b.begin(); i != a.end() && k != b.end();) {
    if (*i < *k)
      ++i;
    else if (*k < *i)
      ++k;
    else
      ++count, ++i, ++k;
  }
  return count;
}

/// How many parts two files have in common; 0 where these are few.
std::size_t likeness(const Content& a, const Content& b) {
  const std::size_t common = in_common(a.placed, b.placed);
  // A frame that is in all files does not make them the same.
  return 2 * common < std::min(a.placed.size(), b.placed.size()) ? 0 : common;
}

/// Whether each of two files has more parts in common with the other than with any other, of then or of now.
bool are_same(const Contents::value_type& then, const Contents::value_type& now, const Contents& all_then,
              const Contents& all_now) {
  const std::size_t common = likeness(then.second, now.second);
  const auto is_rival_of_then = [&](const auto& each) {
    return each.first != then.first && likeness(each.second, now.second) >= common;
  };
  const auto is_rival_of_now = [&](const auto& each) {
    return each.first != now.first && likeness(then.second, each.second) >= common;
  };
  return common > 0 && std::ranges::none_of(all_then, is_rival_of_then) &&
         std::ranges::none_of(all_now, is_rival_of_now);
}

class Renaming {
 public:
  Renaming(const Assembly& assembly, const std::vector<std::string>& names, const Previous& previous)
      : assembly_(assembly), names_(names), previous_(previous) {
    for (const Previous::OldFile& file : previous.files) {
      known_as_.emplace(file.name, file.known_as);
      old_.insert(file.name);
      taken_.insert(file.known_as);
    }
    now_.insert(names.begin(), names.end());
  }

  FileNames names() {
    find_renamed();
    FileNames found;
    for (const std::string& name : names_) {
      const auto [known, fresh] = known_as_.try_emplace(name, name);
      // What has the name that another file is known by is not that file.
      for (int number = 2; fresh && !taken_.insert(known->second).second; ++number)
        known->second = fmt::format("{} ({})", name, number);
      found.known_as.push_back(known->second);
    }
    found.renamed = std::move(renamed_);
    if (!gone_.empty() && !fresh_.empty()) found.gone = gone_, found.fresh = fresh_;
    return found;
  }

 private:
  void find_renamed() {
    gone_ = missing(old_, now_);
    fresh_ = missing(now_, old_);
    if (gone_.empty() || fresh_.empty()) return;
    read_contents();
    const bool is_only_one = old_.size() == 1 && now_.size() == 1;
    std::vector<std::pair<std::string, std::string>> same;
    for (const std::string& then : gone_)
      for (const std::string& now : fresh_)
        if (!is_mixed_up(then, now) &&
            (is_only_one ? in_common(earlier_.at(then).paths, present_.at(now).paths) > 0
                         : are_same(*earlier_.find(then), *present_.find(now), earlier_, present_)))
          same.emplace_back(then, now);
    take(same);
  }

  /// Whether a part has the name of the other file: it would be known as one of those that have none, or one of those
  /// as it.
  [[nodiscard]] bool is_mixed_up(const std::string& then, const std::string& now) const {
    const std::string known_stem = stem_of(known_as_.at(then)), new_stem = stem_of(now);
    return (new_stem != stem_of(then) && earlier_.at(then).steps.contains(new_stem)) ||
           (new_stem != known_stem && present_.at(now).steps.contains(known_stem));
  }

  /// Names that are in the one set and not in the other. A file that has only more or fewer folders in its name, as
  /// others of its name have come or gone, is not renamed: it is known by something else, and says so.
  static std::vector<std::string> missing(const std::set<std::string>& of, const std::set<std::string>& in) {
    std::set<std::string> known;
    for (const std::string& name : in) known.insert(without_folders(name));
    std::vector<std::string> files;
    for (const std::string& name : of)
      if (!known.contains(without_folders(name))) files.push_back(name);
    return files;
  }

  void read_contents() {
    for (const std::string& name : old_) earlier_[name];
    for (const std::string& name : now_) present_[name];
    std::map<std::string, const Previous::OldFile*> files;
    for (const Previous::OldFile& file : previous_.files) {
      const auto [known, fresh] = files.try_emplace(file.file, &file);
      // Bytes that are no UTF-8 made one text of two files: nobody knows of which a part is.
      if (!fresh && known->second != nullptr && known->second->name != file.name) known->second = nullptr;
    }
    for (const OldPart& part : previous_.parts)
      if (const auto file = files.find(part.file); file != files.end() && file->second != nullptr)
        add(earlier_[file->second->name], part.path, part.file, part.placed);
    Shapes shapes;
    for (std::size_t i = 0; i < assembly_.objects.size(); ++i) {
      const std::uint32_t file = assembly_.file_of[i];
      add(present_[names_[file]], as_read_back(assembly_.objects[i].path), as_read_back(assembly_.files[file]),
          shapes.placed(assembly_.objects[i]));
    }
  }

  void take(const std::vector<std::pair<std::string, std::string>>& same) {
    for (const auto& [then, now] : same) {
      known_as_[now] = known_as_.at(then);
      renamed_.emplace_back(now, then);
      std::erase(gone_, then);
      std::erase(fresh_, now);
    }
  }

  const Assembly& assembly_;
  const std::vector<std::string>& names_;
  const Previous& previous_;
  std::map<std::string, std::string> known_as_;  // by the names of then, and of now where they are found again
  std::set<std::string> old_, now_, taken_;
  Contents earlier_, present_;
  std::vector<std::string> gone_, fresh_;
  std::vector<std::pair<std::string, std::string>> renamed_;
};

/// "a.obj", "a.obj and 3 others".
std::string in_short(const std::vector<std::string>& names) {
  std::string first = printable(names.front());
  if (names.size() == 1) return first;
  return fmt::format("{} and {}", first, counted(names.size() - 1, "other"));
}

}  // namespace

FileNames known_names(const Assembly& assembly, const std::vector<std::string>& names, const Previous* previous) {
  if (previous == nullptr) return {names, {}, {}, {}};
  return Renaming(assembly, names, *previous).names();
}

std::vector<std::string> renaming_warnings(const FileNames& names, const std::string& previous) {
  std::vector<std::string> warnings;
  if (!names.renamed.empty()) {
    const auto& [now, then] = names.renamed.front();
    const std::string more = names.renamed.size() > 1
                                 ? fmt::format(", and {} likewise", counted(names.renamed.size() - 1, "other file"))
                                 : "";
    warnings.push_back(fmt::format("{} is taken for {} of {}, renamed{}: its parts are known by the same names as then",
                                   printable(now), printable(then), printable(previous), more));
  }
  if (!names.fresh.empty())
    warnings.push_back(
        fmt::format("all clashes of {} are new: {} has no file of that name, and {}, which it has, cannot be told "
                    "for certain to be the same, renamed; if so, give the file the name that it had then",
                    in_short(names.fresh), printable(previous), in_short(names.gone)));
  return warnings;
}

}  // namespace impinge::report
