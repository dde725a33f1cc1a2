// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/contact_history.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/guarded.hpp"

namespace impinge {

struct ContactHistory::State {
  std::vector<ContactEvent> touching;  ///< what the last call left: `enter` and `stay`, in order
  std::vector<ContactEvent> now, events;
};

namespace {

auto place_of(const ContactEvent& event) { return std::pair(event.objects[0].index, event.objects[1].index); }

/// By objects; of different objects that had and have the same indices, the earlier ones, which leave, first.
bool precedes(const ContactEvent& x, const ContactEvent& y) {
  return std::pair(place_of(x), x.kind != ContactEvent::Kind::leave) <
         std::pair(place_of(y), y.kind != ContactEvent::Kind::leave);
}

/// Appends an event for each row of an answer that is one, by its contacts' or impacts' numbers.
template <class Answer, class IsOne>
Result<void> read_rows(const Scene& scene, const Answer& answer, const char* name, ContactEvent::Kind kind,
                       std::vector<ContactEvent>& events, const IsOne& is_one) {
  for (std::size_t row = 0; row < answer.objects.size(); ++row) {
    ContactEvent event{kind, {}};
    for (const std::size_t side : {0, 1}) {
      const auto id = scene.id(answer.objects[row][side]);
      if (!id)
        return Error{Code::unknown_id, std::string(name) + ".objects[" + std::to_string(row) + "] names object " +
                                           std::to_string(answer.objects[row][side]) +
                                           ", which is not in this scene; give what it has just found"};
      event.objects[side] = *id;
    }
    if (is_one(answer.offsets[row], answer.offsets[row + 1])) events.push_back(event);
  }
  return {};
}

/// The event of these very objects among some that are in order.
bool holds(const std::vector<ContactEvent>& events, const ContactEvent& event) {
  const auto found = std::ranges::lower_bound(events, place_of(event), {}, place_of);
  return found != events.end() && found->objects == event.objects;
}

}  // namespace

ContactHistory::ContactHistory() : state_(std::make_unique<State>()) {}
ContactHistory::~ContactHistory() = default;
ContactHistory::ContactHistory(ContactHistory&&) noexcept = default;
ContactHistory& ContactHistory::operator=(ContactHistory&&) noexcept = default;

Result<std::span<const ContactEvent>> ContactHistory::update(const Scene& scene, const Contacts& contacts,
                                                             const SceneImpacts* between) {
  return guarded([&]() -> Result<std::span<const ContactEvent>> {
    if (contacts.truncated || (between != nullptr && between->truncated))
      return Error{Code::bad_option, std::string(contacts.truncated ? "the contacts" : "the impacts") +
                                         " were cut off at a limit; ask for all of them"};
    State& s = *state_;
    s.now.clear(), s.events.clear();
    const auto is_any = [](std::uint64_t begin, std::uint64_t end) { return begin < end; };
    if (auto read = read_rows(scene, contacts, "contacts", ContactEvent::Kind::enter, s.now, is_any); !read)
      return read.error();
    std::ranges::sort(s.now, precedes);
    if (between != nullptr) {
      const auto is_apart_at_start = [&](std::uint64_t begin, std::uint64_t end) {
        const auto impacts = std::span(between->impacts).subspan(begin, end - begin);
        return begin < end && std::ranges::all_of(impacts, [](const Impact& x) { return x.time.hi > 0; });
      };
      if (auto read = read_rows(scene, *between, "between", ContactEvent::Kind::pass, s.events, is_apart_at_start);
          !read)
        return read.error();
      std::erase_if(s.events,
                    [&](const ContactEvent& event) { return holds(s.now, event) || holds(s.touching, event); });
    }
    for (ContactEvent& event : s.now)
      if (holds(s.touching, event)) event.kind = ContactEvent::Kind::stay;
    for (ContactEvent event : s.touching) {
      event.kind = ContactEvent::Kind::leave;
      if (!holds(s.now, event)) s.events.push_back(event);
    }
    s.events.insert(s.events.end(), s.now.begin(), s.now.end());
    std::ranges::sort(s.events, precedes);
    std::swap(s.touching, s.now);
    return std::span<const ContactEvent>(s.events);
  });
}

}  // namespace impinge
