// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "impinge/contacts.hpp"
#include "impinge/impacts.hpp"
#include "impinge/result.hpp"
#include "impinge/scene.hpp"

/// Events: what has come to touch, still touches, touches no more, or has touched in between.
namespace impinge {

struct ContactEvent {
  enum class Kind : std::uint8_t {
    enter,  ///< they touch, and did not in the last call
    stay,   ///< they touch, as in the last call
    leave,  ///< they touched in the last call, and do not any more; or one is gone, or they are not tested any more
    pass,   ///< they touch neither now nor in the last call, but have met on the way
  };
  Kind kind;
  std::array<ObjectId, 2> objects;  ///< the lower index first; twice the same of an object with itself
};

/// Compares the contacts of a scene from call to call, object by object: of contacts, no index is taken for that of an
/// earlier object. Each `enter` has one `leave`, the call after the last one of which the contacts hold the pair,
/// whatever is the reason.
class ContactHistory {
 public:
  ContactHistory();
  ~ContactHistory();
  ContactHistory(ContactHistory&&) noexcept;
  ContactHistory& operator=(ContactHistory&&) noexcept;

  /// What has changed since the last call, in order of objects; valid until the next call. `contacts` are all that
  /// `Scene::collide` finds now, or the first of each pair, of all kinds; `between`, for `pass`, all that
  /// `Scene::find_impacts` found since the last call, with the objects that the scene has now: it names them by index.
  /// No `pass` is told of a pair that has an impact at the start of the motion. After an error the history is as it
  /// was. Errors: `unknown_id` (objects that the scene does not have), `bad_option` (contacts or impacts that were cut
  /// off at a limit), `out_of_memory`.
  Result<std::span<const ContactEvent>> update(const Scene& scene, const Contacts& contacts,
                                               const SceneImpacts* between = nullptr);

  struct State;  // internal

 private:
  std::unique_ptr<State> state_;
};

}  // namespace impinge
